//! FMU of the granular ratchet whose base moves as a sine.
#![allow(unsafe_code)] // the exported C functions; each is checked in `jostle::fmi::abi`

jostle::export_fmu!(jostle::scene::ratchet::RatchetOnSine);
