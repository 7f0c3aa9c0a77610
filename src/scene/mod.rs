//! Scenes: engines, laws, drives and measures wired together as models, with their parameters, ranges and variables.
//!
//! Each scene is a [`Model`]. A Rust program runs a [`Simulation`] of it, or an [`AnySimulation`] if the scene is chosen by name
//! at run time. No other part of this crate knows the crate `fmi_component`. A new scene, and a scene on a new drive, is one line
//! in [`models`].

mod any_simulation;
pub mod base_drive;
pub mod catalogue;
mod contact_list;
pub mod disk_on_two_supports;
pub mod disks_on_base;
pub mod drives {
    //! The drives of a base, one a file: their parameters and inputs as rows.

    pub(super) mod extrapolated;
    mod fixed_bottom;
    mod follows_input;
    mod random_bottom;
    pub mod sine;
}
pub mod hard_disks;
mod info;
pub mod laws {
    //! The normal forces of soft disks, one a file: their parameters as rows.

    mod linear_dashpot;
}
pub mod models;
pub mod packing;
mod random_phase_base;
pub mod ratchet;
#[cfg(feature = "toml")]
mod recipe;
mod recommended;
mod sheet;
pub mod soft_disks;
mod threads;
pub mod wedge;
mod work_limit;

pub use any_simulation::{AnySimulation, Selection};
pub use fmi_component::{
    Causality, Column, DataSheet, Derived, DynSaved, DynSimulation, Error, ExampleRun, Kind, ListInfo, Listed, Listing,
    Model, ModelInfo, ModelType, Quantity, Reached, Read, Recommended, Result, Row, Saved, Simulation,
    StructuralParameters, Symbol, TIME, Table, Unit, Value, Values, Variable, Warning,
};
pub use info::SceneInfo;
pub use models::MODELS;
#[cfg(feature = "toml")]
pub use recipe::Recipe;

impl From<crate::error::Error> for Error {
    fn from(refused: crate::error::Error) -> Self {
        let crate::error::Error {
            name,
            value,
            allowed,
            remedy,
        } = refused;
        Self::Parameter {
            name,
            value,
            allowed,
            remedy,
        }
    }
}
