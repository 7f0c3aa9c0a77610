//! Everything of a disk in a wedge that changes with time.

use serde::{Deserialize, Serialize};

use crate::drive::Motion;

use super::frame::{Local, Side};

/// The flight since the last impact, and what the impacts before it added up to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State<B> {
    /// Motion of the walls, with its random generator if it has one.
    pub walls: B,
    /// Start of the flight \[s\]: a sum of delays, whose rounding shifts the phase of the base and nothing else.
    pub time: f64,
    /// Motion of the walls then.
    pub base: Motion,
    /// Wall in whose frame the flight is.
    pub side: Side,
    /// Centre of the disk at the start of the flight, from the vertex of the shifted wedge, which moves with the walls
    /// \[m\]. After an impact `above` is zero to the last bit.
    pub place: Local,
    /// Velocity of the centre in the laboratory at the start of the flight \[m/s\].
    pub velocity: Local,
    /// Velocity of the rim by the disk's spin, `R omega`, counter-clockwise \[m/s\].
    pub rim_velocity: f64,
    /// Way of the rim by the disk's spin up to the start of the flight \[m\]: R times the angle turned.
    pub rim_way: f64,
    /// Wall that the disk meets next.
    pub next_side: Side,
    /// When it meets it, counted from the start of the flight \[s\]; infinite if not before the walls' motion is unknown.
    pub delay: f64,
    /// Sums over the impacts so far.
    pub sums: Sums,
    /// Start of the present stretch of impacts that the watchdog looks at \[s\].
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

/// Disk and walls at one instant, in the laboratory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Centre of the disk \[m\], x to the right and y up, from the wedge's own vertex while the walls are at rest.
    pub place: [f64; 2],
    /// Velocity of the centre \[m/s\].
    pub velocity: [f64; 2],
    /// Angle turned \[rad\], counter-clockwise and unwrapped.
    pub angle: f64,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: f64,
}
