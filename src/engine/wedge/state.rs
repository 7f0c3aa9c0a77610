//! Everything of a disk in a wedge that changes with time.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::drive::Motion;

use super::frame::Side;

/// The flight since the last impact, and what the impacts before it added up to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WedgeState<B> {
    /// Motion of the walls, with its random generator if it has one.
    pub walls: B,
    /// Start of the flight \[s\]: a sum of delays, whose rounding shifts the phase of the base and nothing else.
    pub time: f64,
    /// Motion of the walls then.
    pub base: Motion,
    /// Wall in whose frame the flight is.
    pub side: Side,
    /// Centre of the disk at the start of the flight, from the vertex of the shifted wedge, which moves with the walls
    /// \[m\], in the frame of `side`. After an impact y is zero to the last bit.
    pub position: Vector2<f64>,
    /// Velocity of the centre relative to the laboratory at the start of the flight \[m/s\], in the frame of `side`.
    pub velocity: Vector2<f64>,
    /// Surface velocity of the spinning disk, `R omega`, counter-clockwise \[m/s\].
    pub surface_velocity: f64,
    /// Arc length that the surface has turned by up to the start of the flight \[m\]: R times the angle.
    pub arc_length: f64,
    /// Wall that the disk meets next.
    pub next_side: Side,
    /// When it meets it, counted from the start of the flight \[s\]; infinite if not before the walls' motion is unknown.
    pub delay: f64,
    /// Sums over the impacts so far.
    pub sums: Sums,
    /// Start of the interval that the watchdog checks next \[s\].
    pub watched_since: f64,
    /// Impacts in it.
    pub watched: u32,
}

/// What impacts add up to, per mass of the disk.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sums {
    /// Vertical velocity that the walls gave to the disk \[m/s\].
    pub velocity: f64,
    /// Work of the walls on the disk \[J/kg\].
    pub input: f64,
    /// Energy lost in impacts \[J/kg\].
    pub lost: f64,
    /// Impacts.
    pub collisions: u64,
    /// Impacts that left the wall at the velocity floor.
    pub slow_collisions: u64,
}
