#![doc = include_str!("../README.md")]
//!
//! # How it works
//!
//! A model implements [`Model`]: its variables as [`Row`]s, each with name, unit, range, start value, meaning, dependencies and
//! how its value is read; how it starts, advances, saves and restores its state. From that this crate makes
//!
//! - a [`Simulation`] for Rust programs: parameters in, then inputs, steps and outputs by name;
//! - the same behind a pointer, [`DynSimulation`], for programs that choose the model at run time;
//! - an [`Instance`], which owns such a simulation and adds the life cycle of FMI, events in the midst of steps and arrays;
//! - the C functions around an instance (module [`c_api`]), exported by [`export_fmu!`].
//!
//! A step goes down, one level a call, and outputs are computed on the way of those who ask for them:
//!
//! ```text
//! importer -> fmi2DoStep, fmi3DoStep    exported by the macro
//!          -> Entry::change             pointer, lock, panics, messages
//!          -> Instance::do_step         phase, communication point, stop time
//!          -> Simulation::advance_to    time, inputs -> Model::advance_to
//! ```
//!
//! Not here: files (the crate `fmi-bundle` writes model descriptions and FMUs) and physics.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // those of clippy.toml

pub mod arrays;
pub mod c_api;
mod component;
#[doc(hidden)]
pub mod derived;
pub mod description;
mod dynamic;
mod enumeration;
pub mod error;
pub mod handle;
mod info;
pub mod instance;
mod kind;
mod leaked;
pub mod life_cycle;
mod listing;
pub mod memory;
mod model;
mod recommended;
mod row;
pub mod saved_bytes;
mod sheet;
mod simulation;
mod standard;
mod step;
mod structure;
mod table;
pub mod times;
pub mod token;
mod unit;
mod value;
mod values;
pub mod variable;

pub use component::{CoSimulation, Component, ComponentModel, Export};
pub use dynamic::{DynSaved, DynSimulation, ModelType};
pub use enumeration::Enumeration;
pub use error::{Error, Result};
pub use fmi_component_derive::{Component, Enumeration};
pub use info::{ModelInfo, StructuralParameter};
pub use instance::{Importer, Instance};
pub use kind::{Kind, Quantity, WholeSize};
pub use life_cycle::{Phase, Version};
pub use listing::{Column, ListInfo, Listed, Listing};
pub use model::{Model, Reached, Warning};
pub use recommended::{Derived, Recommended};
pub use row::{Read, Row};
pub use sheet::{DataSheet, ExampleRun, Symbol};
pub use simulation::{Saved, Simulation};
pub use standard::{LOG_CATEGORIES, TIME_REFERENCE, TOLERANCE, value_reference};
pub use step::{Grid, Step};
pub use structure::StructuralParameters;
pub use table::Table;
pub use unit::Unit;
pub use value::Value;
pub use values::Values;
pub use variable::{Causality, TIME, TerminalMember, Variability, Variable};
