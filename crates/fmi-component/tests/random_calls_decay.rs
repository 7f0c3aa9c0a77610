//! Random sequences of calls on the smallest model that lists its variables itself.
#![allow(unsafe_code, dead_code, clippy::undocumented_unsafe_blocks)]

#[path = "../examples/decay.rs"]
mod decay;
#[path = "../../../fuzz/harness/model.rs"]
mod harness;

pub use decay::Decay;

/// What the harness knows of the model.
mod library {
    pub use super::decay::{fmi2, fmi3};
    pub use fmi_component::c_api::{Boolean, CallbackFunctions, Fmi2Log, IntermediateUpdate, Opaque, Status};

    /// Longest step that is asked for \[s\].
    pub const LONGEST_STEP: f64 = 1e300;

    pub fn tokens() -> (Vec<String>, usize) {
        super::harness::tokens::of(&fmi_component::ModelType::of::<super::Decay>(), &[&[]])
    }
}
