//! FMU of the packing of fourth order with located contact events, driven by inputs.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

fmi_component::export_fmu!(dyn &jostle::scene::models::PACKING_LOCATED);
