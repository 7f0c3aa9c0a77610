//! Supports that move together on a line, or one behind the other by a phase.

use serde::{Deserialize, Serialize};

use super::{Excitation, Instant, SupportMotion};
use crate::drive::{Drive, Sine};
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

impl Excitation for SineSupports {
    #[inline]
    fn supports(&self, instant: Instant) -> [SupportMotion; 2] {
        let right = Sine {
            phase: self.sine.phase + self.phase_difference,
            ..self.sine
        };
        [self.sine, right].map(|sine| {
            let motion = sine.motion(instant.time());
            let [x, y] = self.direction;
            SupportMotion {
                place: [motion.displacement * x, motion.displacement * y, 0.0],
                rates: [motion.velocity * x, motion.velocity * y, 0.0],
                accelerations: [motion.acceleration * x, motion.acceleration * y, 0.0],
            }
        })
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
