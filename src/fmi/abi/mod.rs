//! The C side of the FMI boundary: pointers, panics, log messages. All `unsafe` of the library is in this folder.
//!
//! Needs: an importer that passes pointers of the size it says, and an instance that it has not freed. Guarantees:
//! everything else is checked. A panic of a scene stays in its own instance, which then only reads, restores, resets and
//! frees; the importer gets an error, never `fmi2Fatal` or `fmi3Fatal`, since these would condemn all other instances.
//! Saved states are handed out as numbers, not as addresses, so that a stale or foreign one is told and not followed.
#![allow(unsafe_code)] // pointers of the importer are followed here and nowhere else

pub mod common;
pub mod fmi2;
pub mod fmi3;
pub mod handle;
#[cfg(feature = "command-line")]
pub mod importer;
pub mod intermediate;
pub mod logger;
pub mod memory;
pub mod states;
pub mod values;

mod export;
mod export_fmi2;
mod export_fmi3;
