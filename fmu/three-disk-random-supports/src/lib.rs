//! FMU of the disk on two supports that vibrate randomly.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

fmi_component::export_fmu!(dyn &jostle::scene::models::THREE_DISK_RANDOM_SUPPORTS);
