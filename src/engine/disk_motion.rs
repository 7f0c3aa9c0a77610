//! Where a disk is and how it moves at one instant.

use nalgebra::Vector2;

/// A disk at one instant, in the laboratory: x to the right, y up, rotation counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiskMotion {
    /// Centre \[m\].
    pub position: Vector2<f64>,
    /// Velocity of the centre \[m/s\].
    pub velocity: Vector2<f64>,
    /// Angle turned since the start \[rad\], unwrapped.
    pub angle: f64,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: f64,
}
