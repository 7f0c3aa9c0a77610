//! Random sequences of calls of all functions of both versions, on a model with events and a tunable parameter: see `fuzz/run`.
#![allow(unsafe_code, dead_code, clippy::undocumented_unsafe_blocks)]

#[path = "../../../../../../fuzz/harness/fmi.rs"]
mod fmi;
#[path = "../../../../../../fuzz/harness/fmi_calls.rs"]
mod fmi_calls;
#[path = "../../../../../../fuzz/harness/hand.rs"]
mod hand;
#[path = "../../../../../../fuzz/harness/lives.rs"]
mod lives;
#[path = "../../../../../../fuzz/harness/tokens.rs"]
mod tokens;

/// What the harness knows of the model.
mod library {
    pub use fmi_component::c_api::{Boolean, CallbackFunctions, Fmi2Log, IntermediateUpdate, Opaque, Status};

    fmi_component::export_fmu!(reference_models::BouncingBall);

    /// Longest step that is asked for \[s\].
    pub const LONGEST_STEP: f64 = 10.0;

    pub fn tokens() -> (Vec<String>, usize) {
        super::tokens::of(&reference_models::ALL[0].1, &[&[]])
    }
}

use proptest::prelude::*;

proptest! {
    #[test]
    fn any_sequence_of_calls_is_answered(bytes in prop::collection::vec(any::<u8>(), 0..1000)) {
        fmi_calls::run(&bytes);
    }
}
