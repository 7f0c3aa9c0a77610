//! FMU of the disk on two supports under an input torque.
#![allow(unsafe_code)] // the exported C functions; each is checked in `jostle::fmi::abi`

jostle::export_fmu!(jostle::scene::three_disk::ThreeDiskOnInput);
