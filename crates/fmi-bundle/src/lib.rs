//! FMUs of any model of [`fmi_component`]: model description, documentation page, terminals, icon, reference trajectory and
//! library in one archive, for FMI 2.0 and FMI 3.0.
//!
//! A [`Component`] is a model with its structural parameters, notices and icon. [`write()`] puts it into a file with the library
//! that exports the model; [`replay()`] runs the library in such a file and compares it with the trajectory beside it.
//!
//! ```text
//! Component -> model_description, documentation, terminals, reference -> bundle -> FILE.fmu -> replay
//! ```
//!
#![doc = include_str!("../README.md")]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // those of clippy.toml

mod bundle;
mod check;
mod component;
mod documentation;
mod importer;
pub mod model_description;
mod platform;
pub mod reference;
mod related_files;
mod replay;
pub mod terminals;
mod xml;

pub use bundle::{cannot_write, find_library, pack, write};
pub use component::{Component, Icon, Notices, Origin, nominal_amplitude};
pub use fmi_component::Version;
pub use replay::{ReplayReport, TOLERANCE, replay};
