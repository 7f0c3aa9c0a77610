//! Harmonic torque, `A_e sin(omega_e t)` (P 5.1).

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{Excitation, Instant};
use crate::error::are_sane;

/// Torque of fixed amplitude and angular frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HarmonicTorque {
    /// Amplitude A_e \[N.m\].
    pub amplitude: f64,
    /// Angular frequency omega_e \[rad/s\].
    pub angular_frequency: f64,
}

impl Excitation for HarmonicTorque {
    #[inline]
    fn torque(&self, instant: Instant) -> f64 {
        // Whole periods go first: the argument keeps its digits however long the run.
        let periods = (self.angular_frequency / TAU * instant.start).fract();
        self.amplitude * (TAU * periods + self.angular_frequency * instant.offset).sin()
    }

    fn is_sane(&self) -> bool {
        are_sane([self.amplitude, self.angular_frequency])
    }
}
