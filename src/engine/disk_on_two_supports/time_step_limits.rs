//! Time steps that resolve the contacts and the excitation.

use crate::elementary::hypot;
use std::f64::consts::TAU;

use super::TwoSupportsRig;

/// Time steps \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepLimits {
    /// Taken if none is given.
    pub default: f64,
    /// Largest accepted one.
    pub largest: f64,
}

impl TimeStepLimits {
    /// Radians of the fastest mode in a default step.
    const DEFAULT: f64 = 0.5;
    /// Radians in the largest step.
    const LARGEST: f64 = 1.0;
    /// Steps in a period of the excitation, default and smallest.
    const STEPS_A_PERIOD: [f64; 2] = [100.0, 20.0];

    /// For this rig and the shortest period of the excitation \[s\], if it is known.
    ///
    /// The fastest mode of two stuck contacts has `omega^2 <= 2 (k_n + 3 k_t) / m`, the trace of the stiffness in x, y
    /// and R theta / sqrt 2 over the mass; slipping ones have at most `2 k_n (1 + 3 mu) / m`; damping adds rates of at most
    /// `2 gamma_n (1 + 3 mu) / m`.
    pub fn of(rig: &TwoSupportsRig, period: Option<f64>) -> Self {
        let (normal, tangential) = (rig.normal, rig.tangential);
        let dragged = 1.0 + 3.0 * tangential.friction;
        let stiffness = (normal.stiffness + 3.0 * tangential.stiffness).max(normal.stiffness * dragged);
        let rate = (2.0 * stiffness / rig.mass).sqrt();
        let damping = 2.0 * normal.damping * dragged / rig.mass;
        let fastest = hypot(rate, damping);
        let [usual, least] = Self::STEPS_A_PERIOD.map(|steps| period.map_or(f64::INFINITY, |period| period / steps));
        Self {
            default: (Self::DEFAULT / fastest).min(usual),
            largest: (Self::LARGEST / fastest).min(least),
        }
    }

    /// Period \[s\] of an angular frequency \[rad/s\].
    pub fn period(angular_frequency: f64) -> f64 {
        TAU / angular_frequency
    }
}
