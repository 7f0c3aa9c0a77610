//! Torque that an importer gives: held, or continued at the rate that it gives too.

use serde::{Deserialize, Serialize};

use super::{Excitation, Piece};
use crate::error::are_sane;

/// `torque + rate (t - since)`: zero-order hold with rate 0, first order otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeldTorque {
    /// Torque at `since` \[N.m\].
    pub torque: f64,
    /// Its rate \[N.m/s\].
    pub rate: f64,
    /// When it was given \[s\].
    pub since: f64,
}

impl HeldTorque {
    /// Takes what is given at `time` \[s\] and says whether the torque changes by it.
    pub fn set_target(&mut self, time: f64, torque: f64, rate: f64) -> bool {
        let given = Self {
            torque,
            rate,
            since: time,
        };
        let same = self.torque == torque && self.rate == rate && (rate == 0.0 || self.since == time);
        if !same {
            *self = given;
        }
        !same
    }
}

/// The torque in one cell: at its start \[N.m\], and its rate \[N.m/s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearTorque {
    torque: f64,
    rate: f64,
}

impl Piece for LinearTorque {
    #[inline]
    fn torque(&self, offset: f64) -> f64 {
        self.torque + self.rate * offset
    }
}

impl Excitation for HeldTorque {
    type Piece = LinearTorque;

    fn piece(&self, start: f64) -> LinearTorque {
        LinearTorque {
            torque: self.torque + self.rate * (start - self.since),
            rate: self.rate,
        }
    }

    fn is_sane(&self) -> bool {
        are_sane([self.torque, self.rate, self.since])
    }
}
