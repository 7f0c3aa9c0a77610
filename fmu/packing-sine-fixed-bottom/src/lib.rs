//! FMU of the packing whose base moves as a sine with the bottom row of disks fixed to it.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

fmi_component::export_fmu!(dyn &jostle::scene::models::PACKING_SINE_FIXED_BOTTOM);
