//! Library that exports the model.
#![allow(unsafe_code)] // the exported C functions; each is checked in `fmi_component::c_api`

fmi_component::export_fmu!(reference_models::VanDerPol);
