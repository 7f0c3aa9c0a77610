//! FMU of the disk in a wedge that moves as a sine, by molecular dynamics.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

fmi_component::export_fmu!(dyn &jostle::scene::models::WEDGE_MOLECULAR_DYNAMICS);
