//! What turns a disk on two supports: a torque on it, or a motion of the supports; one type a file.

mod harmonic_torque;
mod input_torque;
mod random_supports;
mod sine_supports;

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use harmonic_torque::HarmonicTorque;
pub use input_torque::InputTorque;
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

/// Torque on the disk and motion of the supports in one cell of the engine's grid of time, smooth in it.
pub trait Piece: Copy {
    /// Torque on the disk \[N.m\], counter-clockwise, `offset` \[s\] after the start of the cell.
    #[inline]
    fn torque(&self, _offset: f64) -> f64 {
        0.0
    }

    /// Motion of the left and the right support, `offset` \[s\] after the start of the cell.
    #[inline]
    fn supports(&self, _offset: f64) -> [SupportMotion; 2] {
        [SupportMotion::REST; 2]
    }
}

/// What drives the disk, cell by cell of the grid of time.
///
/// It is part of the state: what changes in it is saved and restored.
pub trait Excitation: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static {
    /// What it does in one cell.
    type Piece: Piece;

    /// What it does in the present cell, which begins at `start` \[s\].
    fn piece(&self, start: f64) -> Self::Piece;

    /// Goes to the next cell, which lasts as long as the one before.
    #[inline]
    fn next_cell(&mut self) {}

    /// Whether all its numbers are finite and far from overflow.
    fn is_sane(&self) -> bool;
}

/// Sine and cosine of a small angle \[rad\], exact to rounding up to 0.4 and useful up to 1.
#[inline]
fn small_sine_cosine(angle: f64) -> (f64, f64) {
    let x = angle * angle;
    let sine =
        1.0 - x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0 * (1.0 - x / 110.0 * (1.0 - x / 156.0)))));
    let cosine =
        1.0 - x / 2.0 * (1.0 - x / 12.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0 * (1.0 - x / 132.0)))));
    (angle * sine, cosine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_of_small_angles_are_exact() {
        for angle in [0.0_f64, 1e-9, -0.1, 0.3, 0.4] {
            let (sine, cosine) = small_sine_cosine(angle);
            assert!(
                (sine - angle.sin()).abs() < 2e-16 && (cosine - angle.cos()).abs() < 3e-16,
                "{angle}"
            );
        }
    }
}
