//! Supports that move together on a line, or one behind the other by a phase.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{Excitation, Piece, SupportMotion, small_sine_cosine};
use crate::drive::Sine;
use crate::elementary::sin_cos;
use crate::error::are_sane;

/// Both supports on a sine along one direction, the right one ahead by a phase.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SineSupports {
    /// The left support along the direction.
    pub sine: Sine,
    /// Phase \[rad\] by which the right support is ahead.
    pub phase_difference: f64,
    /// Unit vector along which they move.
    pub direction: [f64; 2],
}

/// The motion in one cell, by the sums of angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurningSupports {
    angular_frequency: f64,
    direction: [f64; 2],
    /// Sine and cosine of the phase of each support at the start of the cell, times the amplitude \[m\].
    phases: [[f64; 2]; 2],
}

impl Piece for TurningSupports {
    #[inline]
    fn supports(&self, offset: f64) -> [SupportMotion; 2] {
        let (sine, cosine) = small_sine_cosine(self.angular_frequency * offset);
        let [x, y] = self.direction;
        self.phases.map(|[from_sine, from_cosine]| {
            let displacement = from_sine * cosine + from_cosine * sine;
            let velocity = self.angular_frequency * (from_cosine * cosine - from_sine * sine);
            let acceleration = -self.angular_frequency * self.angular_frequency * displacement;
            SupportMotion {
                place: [displacement * x, displacement * y, 0.0],
                rates: [velocity * x, velocity * y, 0.0],
                accelerations: [acceleration * x, acceleration * y, 0.0],
            }
        })
    }
}

impl Excitation for SineSupports {
    type Piece = TurningSupports;

    fn piece(&self, start: f64) -> TurningSupports {
        let Sine {
            amplitude,
            frequency,
            phase,
        } = self.sine;
        // Whole periods go first: the argument keeps its digits however long the run.
        let turned = TAU * (frequency * start).fract() + phase;
        let phases = [turned, turned + self.phase_difference].map(|phase| {
            let (sine, cosine) = sin_cos(phase);
            [amplitude * sine, amplitude * cosine]
        });
        TurningSupports {
            angular_frequency: TAU * frequency,
            direction: self.direction,
            phases,
        }
    }

    fn is_sane(&self) -> bool {
        let Sine {
            amplitude,
            frequency,
            phase,
        } = self.sine;
        are_sane([amplitude, frequency, phase, self.phase_difference]) && are_sane(self.direction)
    }
}
