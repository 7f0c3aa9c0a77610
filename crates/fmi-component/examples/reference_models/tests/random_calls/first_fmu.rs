//! Random sequences of calls on the first FMU of the README.
#![allow(unsafe_code, dead_code, clippy::undocumented_unsafe_blocks)]

#[path = "../../../../../../fuzz/harness/model.rs"]
mod harness;

/// What the harness knows of the model.
mod library {
    use fmi_component::{Export, ModelType};

    pub use first_fmu::{fmi2, fmi3};
    pub use fmi_component::c_api::{Boolean, CallbackFunctions, Fmi2Log, IntermediateUpdate, Opaque, Status};

    /// Longest step that is asked for \[s\].
    pub const LONGEST_STEP: f64 = 10.0;

    pub fn tokens() -> (Vec<String>, usize) {
        super::harness::tokens::of(&ModelType::of::<<first_fmu::Dahlquist as Export>::Model>(), &[&[]])
    }
}
