//! What bounds the disks of an event-driven run: walls at rest and walls on a base that moves.

use nalgebra::Vector2;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::Body;

/// A wall as a disk touches it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallContact {
    /// Unit normal into the free half plane.
    pub normal: Vector2<f64>,
    /// Velocity of the wall at the instant of contact \[m/s\].
    pub velocity: Vector2<f64>,
    /// Part of the wall, as [`Boundary::record`] gets it back; 0 where walls have no parts.
    pub part: u32,
}

/// The first wall that a disk hits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallHit {
    /// Delay \[s\] from the time of the disk; infinite if it hits none.
    pub delay: f64,
    /// Index of the wall.
    pub wall: u32,
}

impl WallHit {
    /// No hit.
    pub const NONE: Self = Self {
        delay: f64::INFINITY,
        wall: 0,
    };
}

/// Walls of a run. Part of the state: a base that follows inputs or draws random phases changes with time.
///
/// Sets of walls are bits of a `u32`: bit i stands for wall i.
pub trait Boundary: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static {
    /// Walls that a disk may hit whose centre stays within a distance \[m\] of `position`, its radius and the slack of its
    /// shell together.
    fn walls_within(&self, distance: f64, position: Vector2<f64>) -> u32;

    /// First hit on one of `walls` within `horizon` \[s\] of the body's time, under `gravity` \[m/s2\] downwards.
    fn first_hit(&self, walls: u32, body: &Body, gravity: f64, horizon: f64) -> WallHit;

    /// The wall that the body touches at its present time. `separation_velocity` gives the relative normal velocity
    /// \[m/s\] after an impact from the one before it.
    fn contact(&mut self, wall: u32, body: &Body, separation_velocity: impl Fn(f64) -> f64) -> WallContact;

    /// An impact on that part of the wall has given `impulse` \[N.s\] to the disk: for boundaries that keep sums of their own.
    #[inline(always)]
    fn record(&mut self, _wall: u32, _part: u32, _impulse: Vector2<f64>) {}

    /// Whether the wall belongs to the vibrating base.
    fn is_base(&self, wall: u32) -> bool;

    /// The origin of local time moves on by `seconds`.
    fn shift_origin(&mut self, seconds: f64);

    /// Whether `other` can be these walls at another time, when local time began at `epoch` \[s\]: states come from
    /// outside.
    fn fits(&self, other: &Self, epoch: f64) -> bool;

    /// How many walls there are, at most 32.
    fn count(&self) -> u32;

    /// What a prediction may cost for a disk of this radius \[m\], beside the work of an event.
    fn most_work(&self, _radius: f64) -> u64 {
        0
    }
}
