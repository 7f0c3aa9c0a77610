//! FMU of the camera of the shaker laboratory.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

fmi_component::export_fmu!(shaker_lab::Camera);
