//! Sinusoidal base, `y = A sin(2 pi f t + phase)` (P 2.37).

use crate::elementary::{mul_add, powi, sin_cos};
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
    /// Amplitude \[m\] that gives the dimensionless acceleration `gamma`.
    pub fn amplitude_of(gamma: f64, frequency: f64, gravity: f64) -> f64 {
        gamma * gravity / powi(TAU * frequency, 2)
    }
}

impl Drive for Sine {
    fn motion(&self, time: f64) -> Motion {
        // Whole periods go first: the argument keeps its digits however long the run.
        let (sine, cosine) = sin_cos(TAU * (self.frequency * time).fract() + self.phase);
        let angular_frequency = TAU * self.frequency;
        Motion {
            displacement: self.amplitude * sine,
            velocity: self.amplitude * angular_frequency * cosine,
            acceleration: -self.amplitude * powi(angular_frequency, 2) * sine,
        }
    }
}

impl BoundedDrive for Sine {
    #[inline]
    fn greatest_acceleration(&self) -> f64 {
        self.amplitude.abs() * powi(TAU * self.frequency, 2)
    }

    #[inline]
    fn known_until(&self) -> f64 {
        f64::INFINITY
    }

    /// The phase at the origin is exact however many periods have passed: the product is taken with its rounding error.
    fn counted_from(&self, origin: f64) -> Self {
        let periods = self.frequency * origin;
        let rounded_away = mul_add(self.frequency, origin, -periods);
        let phase = TAU * (periods.fract() + rounded_away) + self.phase;
        Self { phase, ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.1 Hz as stored is 3602879701896397 / 2^55: the period count at 2^36 s is known in whole numbers.
    #[test]
    fn the_phase_is_exact_after_many_periods() {
        let sine = Sine {
            amplitude: 1.0,
            frequency: 0.1,
            phase: 0.25,
        };
        let origin = f64::from(1 << 30) * 64.0;
        let whole = 1_u64 << (55 - 36);
        let exact = (3_602_879_701_896_397_u64 % whole) as f64 / whole as f64;
        let counted = sine.counted_from(origin);
        assert!((counted.phase - (TAU * exact + 0.25)).abs() < 1e-15);
        // A frequency and an origin of 53 bits each: the product has 106, of which plain rounding would keep 53.
        let sine = Sine {
            frequency: 70.495_318_215_9,
            ..sine
        };
        let origin = 65_536.1;
        let mantissa = |number: f64| u128::from((number.to_bits() & ((1 << 52) - 1)) | (1 << 52));
        // 2^6 <= f < 2^7 and 2^16 <= t < 2^17: f t = product / 2^(46 + 36).
        let product = mantissa(sine.frequency) * mantissa(origin);
        let exact = (product % (1 << 82)) as f64 / (1_u128 << 82) as f64;
        assert!((sine.counted_from(origin).phase - (TAU * exact + 0.25)).abs() < 2e-15);
    }
}
