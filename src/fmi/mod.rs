//! The FMI boundary: a scene in, a co-simulation component for FMI 2.0 and FMI 3.0 out.
//!
//! [`Instance`] is the component without FMI's C types: life cycle, time, values, saved states. `abi` puts the 44
//! functions of FMI 2.0 and the 75 of FMI 3.0 around it, and [`export_fmu!`](crate::export_fmu) makes a library of them:
//!
//! ```text
//! importer -> fmi2DoStep / fmi3DoStep -> abi (pointers, panics, logger) -> Instance::do_step -> Scene::advance_to
//! ```
//!
//! Not here: physics. A new scene needs nothing from this folder but the macro.

pub mod abi;
pub mod arrays;
pub mod derivatives;
pub mod instance;
pub mod life_cycle;
pub mod snapshot;
pub mod token;

#[cfg(feature = "command-line")]
pub mod bundle;
#[cfg(feature = "command-line")]
pub mod documentation;
#[cfg(feature = "command-line")]
pub mod icon;
#[cfg(feature = "command-line")]
pub mod model_description;
#[cfg(feature = "command-line")]
pub mod reference;
#[cfg(feature = "command-line")]
pub mod replay;
#[cfg(feature = "command-line")]
pub mod terminals;
#[cfg(feature = "command-line")]
mod xml;

pub use instance::Instance;
pub use life_cycle::{Phase, Version};
pub use snapshot::Snapshot;

/// Value reference of the row at `position`; 0 is the independent variable `time`.
pub const fn value_reference(position: usize) -> u32 {
    position as u32 + 1
}

/// Value reference of the independent variable `time`.
pub const TIME_REFERENCE: u32 = 0;

/// Parameter to which an importer's relative tolerance goes, where a scene has it.
pub const TOLERANCE: &str = "tolerance";

/// Categories of log messages, as declared in the model description: name and description.
pub const LOG_CATEGORIES: [(&str, &str); 3] = [
    (
        "logStatusError",
        "Calls that were refused, with the reason and the remedy",
    ),
    (
        "logStatusDiscard",
        "Steps that could not be done; the state is the one before the step",
    ),
    ("logEvents", "Life cycle: instantiated, initialised, terminated, reset"),
];
