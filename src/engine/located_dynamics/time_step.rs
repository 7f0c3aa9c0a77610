//! Which time step keeps a given tolerance.

/// Steps in a period of the fastest contact that keep the error of an impact at `tolerance`.
///
/// The error of the velocities after an impact, relative to those before and as a root mean square over where in a step
/// the touch falls, is `0.8 / n^4` with n steps in a period of the contact's fastest oscillation; measured for sticking,
/// sliding and rolling back, damping ratios 0 to 0.2 (`cargo test --test located_dynamics -- --nocapture`).
pub fn steps_for(tolerance: f64) -> f64 {
    (ERROR_OF_ONE_STEP / tolerance).powf(0.25)
}

/// Error that the law of the fourth power gives for one step a period.
const ERROR_OF_ONE_STEP: f64 = 0.8;
