//! An importer that wants to be called inside of a step, at events or to renew inputs: intermediate update (FMI 3.0 section 4.2).

use super::types::{Boolean, FALSE, IntermediateUpdate, Opaque, TRUE};

/// Its callback with the environment that it wants back.
#[derive(Clone, Copy)]
pub struct Listener {
    /// `intermediateUpdate`.
    pub update: IntermediateUpdate,
    /// `instanceEnvironment`, handed back untouched.
    pub environment: Opaque,
    /// It lets steps end early.
    pub early_return: bool,
    /// It offers inputs, and is asked for them.
    pub inputs: bool,
}

impl Listener {
    /// Reports an event, or a place to renew inputs, at `time` \[s\]. Gives the time at which the importer wants the step to end, if it wants that and may;
    /// a request is ignored where `canReturnEarly` was false.
    pub fn report(&self, time: f64) -> Option<f64> {
        let (mut wanted, mut until) = (FALSE, time);
        // SAFETY: the importer's own callback with its own environment; the pointers are to values that outlive the call.
        unsafe {
            (self.update)(
                self.environment,
                time,
                Boolean::from(self.inputs), // else those of the beginning of the step hold to its end
                TRUE,
                TRUE,
                Boolean::from(self.early_return),
                &mut wanted,
                &mut until,
            );
        }
        (self.early_return && wanted != FALSE).then_some(until)
    }
}
