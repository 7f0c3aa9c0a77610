//! FMU of the event-driven packing whose base moves as a sine.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

fmi_component::export_fmu!(dyn &jostle::scene::models::PACKING_EVENT_DRIVEN_SINE);
