//! FMUs of any model of [`fmi_component`]: model description, documentation page, terminals, icon, reference trajectory and
//! library in one archive, for FMI 2.0 and FMI 3.0.
//!
//! A [`Component`] is a model, or the library of one, with its structural parameters, notices and icon. [`write()`] puts it into a file with the
//! [`Libraries`] that export the model, one for each [`Platform`]; [`replay()`] runs the library of this system in such a file and
//! compares it with the trajectory beside it. [`check()`] looks for its faults. [`merge()`] joins FMUs of one
//! model that were made on different systems.
//!
//! Several of them, connected, are a [`system::System`], which becomes an SSP archive.
//!
//! ```text
//! Component -> model_description, documentation, terminals, reference -> bundle -> FILE.fmu -> check, merge, replay
//! ```
//!
#![doc = include_str!("../README.md")]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // those of clippy.toml

mod archive;
mod bundle;
mod check;
mod component;
mod documentation;
mod importer;
mod legal;
mod libraries;
mod merge;
pub mod model_description;
mod outputs;
mod platform;
mod program;
pub mod reference;
mod related_files;
mod replay;
mod run;
pub mod system;
pub mod terminals;
mod xml;

pub use bundle::{cannot_write, find_library, pack, write};
pub use check::{CheckReport, Fault, check};
pub use component::{Component, Icon, Notices, Origin, nominal_amplitude};
pub use fmi_component::{Error, Result, Version};
pub use libraries::Libraries;
pub use merge::merge;
pub use outputs::write_versions;
pub use platform::Platform;
pub use program::main;
pub use replay::{ReplayReport, TOLERANCE, replay, replay_against};
