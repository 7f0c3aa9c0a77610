//! FMU of the packing of fourth order with located contact events, whose base moves as a sine.
#![allow(unsafe_code)] // the exported C functions; each is checked in `jostle::fmi::abi`

jostle::export_fmu!(jostle::scene::packing::LocatedPackingOnSine);
