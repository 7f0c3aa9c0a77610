//! FMU of the disk in a wedge that follows the importer's inputs, from impact to impact.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

fmi_component::export_fmu!(dyn &jostle::scene::models::WEDGE_EVENT_DRIVEN_INPUT);
