//! The C side of a component: pointers, panics, log messages. Compiled once, whatever the model.
//!
//! Needs: an importer that passes pointers of the size it says, and an instance that it has not freed. Guarantees:
//! everything else is checked. A panic of a model stays in its own instance, which then only reads, restores, resets and
//! frees; the importer gets an error, never `fmi2Fatal` or `fmi3Fatal`, since these would condemn all other instances.
//! Saved states are handed out as numbers, not as addresses, so that a stale or foreign one is recognised and not followed.
//! Not here: what a call does ([`Instance`](crate::Instance)).
#![allow(unsafe_code)] // pointers of the importer are followed here, in `handle` and in `memory`

pub mod calls;
mod component;
pub mod contents;
pub mod description;
pub mod fmi2;
pub mod fmi3;
mod listener;
mod logger;
mod saved_states;
pub mod states;
mod types;
pub mod values;

mod export;
mod export_fmi2;
mod export_fmi3;

pub use component::{Entry, free};
pub use types::{
    Boolean, CallbackFunctions, ClockUpdate, Enumeration, Fmi2Log, Fmi3Log, IntermediateUpdate, Opaque, Preemption,
    Status,
};
