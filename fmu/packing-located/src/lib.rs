//! FMU of the packing of fourth order with located contact events, driven by inputs.
#![allow(unsafe_code)] // the exported C functions; each is checked in `jostle::fmi::abi`

jostle::export_fmu!(jostle::scene::packing::LocatedPackingOnInput);
