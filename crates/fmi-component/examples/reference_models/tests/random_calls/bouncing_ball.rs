//! Random sequences of calls on a model with events and a tunable parameter.
#![allow(unsafe_code, dead_code, clippy::undocumented_unsafe_blocks)]

#[path = "../../../../../../fuzz/harness/model.rs"]
mod harness;

/// What the harness knows of the model.
mod library {
    pub use fmi_component::c_api::{Boolean, CallbackFunctions, Fmi2Log, IntermediateUpdate, Opaque, Status};

    fmi_component::export_fmu!(reference_models::BouncingBall);

    /// Longest step that is asked for \[s\].
    pub const LONGEST_STEP: f64 = 10.0;

    pub fn tokens() -> (Vec<String>, usize) {
        super::harness::tokens::of(&reference_models::model::<reference_models::BouncingBall>(), &[&[]])
    }
}
