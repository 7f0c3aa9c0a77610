//! What turns a disk on two supports: a torque on it, or a motion of the supports; one type a file.

mod harmonic_torque;
mod held_torque;
mod random_supports;
mod sine_supports;

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use harmonic_torque::HarmonicTorque;
pub use held_torque::HeldTorque;
pub use random_supports::{NoiseSign, RandomSupports, Vibration};
pub use sine_supports::SineSupports;

/// Motion of one support at one instant: x, y \[m\] and angle \[rad\] from where it rests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SupportMotion {
    /// Displacement and angle.
    pub place: [f64; 3],
    /// Their rates \[m/s, rad/s\].
    pub rates: [f64; 3],
    /// The rates' rates \[m/s2, rad/s2\].
    pub accelerations: [f64; 3],
}

impl SupportMotion {
    /// At rest.
    pub const REST: Self = Self {
        place: [0.0; 3],
        rates: [0.0; 3],
        accelerations: [0.0; 3],
    };
}

/// An instant: start of a cell of the engine's grid of time \[s\], and the offset from it \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// Start of the cell.
    pub start: f64,
    /// Time since.
    pub offset: f64,
}

impl Instant {
    /// Time \[s\].
    #[inline]
    pub fn time(self) -> f64 {
        self.start + self.offset
    }
}

/// Torque on the disk and motion of the supports as functions of time, smooth inside each cell of the grid.
///
/// It is part of the state: what changes in it is saved and restored.
pub trait Excitation: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static {
    /// Torque on the disk \[N.m\], counter-clockwise.
    #[inline]
    fn torque(&self, _instant: Instant) -> f64 {
        0.0
    }

    /// Motion of the left and the right support.
    #[inline]
    fn supports(&self, _instant: Instant) -> [SupportMotion; 2] {
        [SupportMotion::REST; 2]
    }

    /// Goes to the next cell, which lasts as long as the one before.
    #[inline]
    fn next_cell(&mut self) {}

    /// Whether all its numbers are finite and far from overflow.
    fn is_sane(&self) -> bool;
}
