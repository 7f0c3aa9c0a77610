//! Which time steps keep a tolerance.

use std::f64::consts::TAU;

use crate::engine::molecular_dynamics::{ContactLaws, TimeStepLimits};

/// Error of an impact if the law of the fourth power held down to one step a period.
const ERROR_OF_ONE_STEP: f64 = 0.8;

/// Steps in a period below which a disk with six contacts gains energy: 6 and 7 do so in a packing at rest, 8 does not.
const FEWEST_STEPS: f64 = 8.0;

/// Largest step over the time m / gamma_n in which a contact is damped: six contacts damp a disk three times as fast.
const MOST_DAMPING: f64 = 1.0 / 3.0;

/// Time steps for the two lightest disks of `masses` \[kg\] in contact and for a drive of frequency \[Hz\] if it is known.
///
/// The error of the velocities after an impact, relative to those before it and as a root mean square over where in a
/// step the touch falls, is about `0.8 / n^4` with n steps in the period `2 pi / Omega`,
/// `Omega^2 = max(k_n, 3 k_t) / m + (gamma_n / m)^2`; measured for sticking, sliding and rolling back and damping ratios
/// from 0 to 2 (`cargo test --test located_dynamics -- --nocapture`). `tolerance` asks for that error.
pub fn limits(laws: &ContactLaws, masses: &[f64], drive_frequency: Option<f64>, tolerance: f64) -> TimeStepLimits {
    let (mut lightest, mut second) = (f64::INFINITY, f64::INFINITY);
    for &mass in masses {
        if mass < lightest {
            (lightest, second) = (mass, lightest);
        } else if mass < second {
            second = mass;
        }
    }
    let mass = 1.0 / (1.0 / lightest + 1.0 / second);
    let grips = laws.skin.friction > 0.0;
    let tangential = if grips { 3.0 * laws.skin.stiffness } else { 0.0 };
    let oscillation = laws.normal.stiffness.max(tangential) / mass;
    let decay = laws.normal.damping / mass;
    let period = TAU / (oscillation + decay * decay).sqrt();
    let drive_period = drive_frequency.map_or(f64::INFINITY, |frequency| 1.0 / frequency);
    let shortest = period.min(drive_period);
    let largest = (shortest / FEWEST_STEPS).min(MOST_DAMPING / decay);
    let steps = (ERROR_OF_ONE_STEP / tolerance).powf(0.25);
    TimeStepLimits {
        default: largest.min(shortest / steps),
        largest,
    }
}
