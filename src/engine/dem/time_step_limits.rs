//! Time steps that resolve the contacts and the drive.

use std::f64::consts::TAU;

use crate::contact::{ContactLaws, NormalForce};
use crate::elementary::powf;

/// Time steps that suit a set of contact laws and masses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepLimits {
    /// Taken if none is given \[s\].
    pub default: f64,
    /// Largest accepted one \[s\].
    pub largest: f64,
}

/// Error of an impact by located events if the law of the fourth power held down to one step a period.
const ERROR_OF_ONE_STEP: f64 = 0.8;

/// Steps of located events in a period below which a disk with six contacts gains energy: 6 and 7 do so in a packing at
/// rest, 8 does not.
const FEWEST_STEPS: f64 = 8.0;

/// Largest step of located events over the time m / gamma_n in which a contact is damped: six contacts damp a disk three
/// times as fast.
const MOST_DAMPING: f64 = 1.0 / 3.0;

impl TimeStepLimits {
    /// For [`Verlet`](super::Verlet) and [`Gear`](super::Gear), with the two lightest disks of `masses` \[kg\] in contact
    /// and a drive of frequency \[Hz\] if it is known.
    ///
    /// Default: a hundredth of the shortest contact period, as P 2.2 asks at least. Largest: a twentieth; beyond, impacts
    /// are no longer resolved and disks with many contacts become unstable. The period of a contact of effective mass m is
    /// `2 pi sqrt(m / max(k_n, 3 k_t))`: the tangential spring of two uniform disks acts on the effective mass m / 3
    /// (P 4.60). Damping adds the rate `gamma_n / m`, of which up to six contacts act at once. A drive is resolved by 20
    /// steps a period at least.
    ///
    /// Stability: with six contacts on a disk the highest frequency is below `sqrt(6)` times that of one contact, and
    /// velocity Verlet is stable up to 2 over it, which is 0.13 periods of one contact: 2.6 times `largest`.
    pub fn verlet<N: NormalForce>(laws: &ContactLaws<N>, masses: &[f64], drive_frequency: Option<f64>) -> Self {
        let mass = smallest_effective_mass(masses);
        let period = TAU * (mass / largest_stiffness(laws)).sqrt();
        // No comparison finds a time of minus infinity, which a damping of -0.0 has.
        let damping_time = mass / laws.normal.damping().abs();
        let drive_period = period_of(drive_frequency);
        Self {
            default: (period / 100.0).min(damping_time / 30.0).min(drive_period / 100.0),
            largest: (period / 20.0).min(damping_time / 6.0).min(drive_period / 20.0),
        }
    }

    /// For [`EventLocated`](super::EventLocated), with the two lightest disks of `masses` \[kg\] in contact and a drive of
    /// frequency \[Hz\] if it is known.
    ///
    /// The error of the velocities after an impact, relative to those before it and as a root mean square over where in a
    /// step the touch falls, is about `0.8 / n^4` with n steps in the period `2 pi / Omega`,
    /// `Omega^2 = max(k_n, 3 k_t) / m + (gamma_n / m)^2`; measured for sticking, sliding and rolling back and damping ratios
    /// from 0 to 2 (`cargo test --test event_located -- --nocapture`). The default step has the error `tolerance`.
    pub fn event_located(laws: &ContactLaws, masses: &[f64], drive_frequency: Option<f64>, tolerance: f64) -> Self {
        let mass = smallest_effective_mass(masses);
        let oscillation = largest_stiffness(laws) / mass;
        let decay = (laws.normal.damping / mass).abs();
        let period = TAU / (oscillation + decay * decay).sqrt();
        let shortest = period.min(period_of(drive_frequency));
        let largest = (shortest / FEWEST_STEPS).min(MOST_DAMPING / decay);
        let steps = powf(ERROR_OF_ONE_STEP / tolerance, 0.25);
        Self {
            default: largest.min(shortest / steps),
            largest,
        }
    }
}

/// Effective mass \[kg\] of the two lightest disks.
fn smallest_effective_mass(masses: &[f64]) -> f64 {
    let (mut lightest, mut second) = (f64::INFINITY, f64::INFINITY);
    for &mass in masses {
        if mass < lightest {
            (lightest, second) = (mass, lightest);
        } else if mass < second {
            second = mass;
        }
    }
    1.0 / (1.0 / lightest + 1.0 / second)
}

/// `max(k_n, 3 k_t)` \[N/m\].
fn largest_stiffness<N: NormalForce>(laws: &ContactLaws<N>) -> f64 {
    let tangential = if laws.tangential.acts() {
        3.0 * laws.tangential.stiffness
    } else {
        0.0
    };
    laws.normal.stiffness().max(tangential)
}

fn period_of(frequency: Option<f64>) -> f64 {
    frequency.map_or(f64::INFINITY, |frequency| 1.0 / frequency.abs())
}
