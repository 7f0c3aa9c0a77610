//! What the harness knows of the oscillators: the FMI functions, the longest step, tokens.

pub use fmi_component::c_api::{Boolean, CallbackFunctions, Fmi2Log, IntermediateUpdate, Opaque, Status};
pub use oscillators::{fmi2, fmi3};

/// Longest step that is asked for [s]: beyond every end.
pub const LONGEST_STEP: f64 = 1e300;

pub fn tokens() -> (Vec<String>, usize) {
    let model = fmi_component::ModelType::of::<oscillators::Oscillators>();
    super::tokens::of(&model, &[&[("bodies", 3)], &[("bodies", 1)]])
}
