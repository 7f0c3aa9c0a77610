//! Torque that an importer gives, with its rate if it has it, continued over a step by an extrapolation of what it gave.

use serde::{Deserialize, Serialize};

use super::{Excitation, Piece};
use crate::drive::extrapolation::{Degree, Extrapolation, InputHistory, InputSample, MOST_COEFFICIENTS};
use crate::error::are_sane;

/// A torque that is a polynomial in each communication step. It may jump where steps join.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct InputTorque {
    torque: Extrapolation,
    history: InputHistory,
    degree: Degree,
}

impl InputTorque {
    /// `torque` \[N.m\] at `time` \[s\] and its rate \[N.m/s\], until there are new inputs, which are continued with a polynomial of
    /// this degree.
    pub fn starting(time: f64, torque: f64, rate: f64, degree: Degree) -> Self {
        let mut coefficients = [0.0; MOST_COEFFICIENTS];
        [coefficients[0], coefficients[1]] = [torque, rate];
        Self {
            torque: Extrapolation {
                since: time,
                coefficients,
            },
            history: InputHistory::default(),
            degree,
        }
    }

    /// Takes the torque \[N.m\] and its rate \[N.m/s\], zero if it is not given, at `time` \[s\] for a step to `end` \[s\]. Says
    /// whether the torque is another one than without them.
    pub fn set_target(&mut self, time: f64, end: f64, torque: f64, rate: f64) -> bool {
        let values = [torque, rate, 0.0];
        self.history.record(InputSample { time, values });
        let Some(next) = self.history.extrapolate(end, self.degree) else {
            return false;
        };
        let constant = |torque: &Extrapolation| torque.coefficients[1..].iter().all(|coefficient| *coefficient == 0.0);
        let both_constant = constant(&next) && constant(&self.torque);
        if self.torque == next || both_constant && self.torque.coefficients[0] == next.coefficients[0] {
            return false;
        }
        self.torque = next;
        true
    }

    /// The inputs so far.
    pub fn history(&self) -> &InputHistory {
        &self.history
    }
}

/// The torque in one cell, as a polynomial in the time since its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolynomialTorque {
    coefficients: [f64; MOST_COEFFICIENTS],
}

impl Piece for PolynomialTorque {
    #[inline]
    fn torque(&self, offset: f64) -> f64 {
        let highest_first = self.coefficients.iter().rev();
        highest_first.fold(0.0, |sum, coefficient| sum * offset + coefficient)
    }
}

impl Excitation for InputTorque {
    type Piece = PolynomialTorque;

    fn piece(&self, start: f64) -> PolynomialTorque {
        PolynomialTorque {
            coefficients: self.torque.counted_from(start),
        }
    }

    fn is_sane(&self) -> bool {
        let samples = self.history.samples().iter();
        let given = samples.flat_map(|sample| sample.values.into_iter().chain([sample.time]));
        are_sane(
            self.torque
                .coefficients
                .into_iter()
                .chain([self.torque.since])
                .chain(given),
        )
    }
}
