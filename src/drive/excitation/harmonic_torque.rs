//! Harmonic torque, `A_e sin(omega_e t)` (P 5.1).

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{Excitation, Piece, small_sine_cosine};
use crate::elementary::sin_cos;
use crate::error::are_sane;

/// Torque of fixed amplitude and angular frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HarmonicTorque {
    /// Amplitude A_e \[N.m\].
    pub amplitude: f64,
    /// Angular frequency omega_e \[rad/s\].
    pub angular_frequency: f64,
}

/// The torque in one cell, by the sums of angles: `sine cos(omega_e s) + cosine sin(omega_e s)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurningTorque {
    angular_frequency: f64,
    sine: f64,
    cosine: f64,
}

impl Piece for TurningTorque {
    #[inline]
    fn torque(&self, offset: f64) -> f64 {
        let (sine, cosine) = small_sine_cosine(self.angular_frequency * offset);
        self.sine * cosine + self.cosine * sine
    }
}

impl Excitation for HarmonicTorque {
    type Piece = TurningTorque;

    fn piece(&self, start: f64) -> TurningTorque {
        // Whole periods go first: the argument keeps its digits however long the run.
        let (sine, cosine) = sin_cos(TAU * (self.angular_frequency / TAU * start).fract());
        TurningTorque {
            angular_frequency: self.angular_frequency,
            sine: self.amplitude * sine,
            cosine: self.amplitude * cosine,
        }
    }

    fn is_sane(&self) -> bool {
        are_sane([self.amplitude, self.angular_frequency])
    }
}
