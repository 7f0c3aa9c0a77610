//! Sinusoidal base, `y = A sin(2 pi f t + phase)` (P 2.37).

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{BoundedDrive, Drive, Motion};

/// Sine of fixed amplitude and frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sine {
    /// Amplitude A \[m\].
    pub amplitude: f64,
    /// Frequency f \[Hz\].
    pub frequency: f64,
    /// Phase at t = 0 \[rad\].
    pub phase: f64,
}

impl Sine {
    /// Peak acceleration over gravity, `Gamma = A (2 pi f)^2 / g` (P 2.2).
    pub fn dimensionless_acceleration(&self, gravity: f64) -> f64 {
        self.amplitude * (TAU * self.frequency).powi(2) / gravity
    }

    /// Amplitude \[m\] that gives the dimensionless acceleration `gamma`.
    pub fn amplitude_of(gamma: f64, frequency: f64, gravity: f64) -> f64 {
        gamma * gravity / (TAU * frequency).powi(2)
    }
}

impl Drive for Sine {
    fn motion(&self, time: f64) -> Motion {
        // Whole periods go first: the argument keeps its digits however long the run.
        let (sine, cosine) = (TAU * (self.frequency * time).fract() + self.phase).sin_cos();
        let angular_frequency = TAU * self.frequency;
        Motion {
            displacement: self.amplitude * sine,
            velocity: self.amplitude * angular_frequency * cosine,
            acceleration: -self.amplitude * angular_frequency.powi(2) * sine,
        }
    }
}

impl BoundedDrive for Sine {
    #[inline]
    fn greatest_acceleration(&self) -> f64 {
        self.amplitude.abs() * (TAU * self.frequency).powi(2)
    }

    #[inline]
    fn known_until(&self) -> f64 {
        f64::INFINITY
    }
}
