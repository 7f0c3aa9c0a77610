//! What bounds the disks of an event-driven run: walls at rest and a base that moves. Types, so that a scene without
//! walls predicts none.

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::Body;

/// A wall as a disk meets it: its normal into the free half plane and its own velocity \[m/s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meeting {
    /// Unit normal.
    pub normal: [f64; 2],
    /// Velocity of the wall at the instant of contact \[m/s\].
    pub velocity: [f64; 2],
}

/// Walls of a run. Part of the state: a base that follows inputs or draws random phases changes with time.
pub trait Boundary: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static {
    /// Whether there is any wall.
    const EXISTS: bool;

    /// Bits of the walls that a disk may meet whose centre stays within a distance \[m\] of `place`, its radius and slack
    /// together.
    fn within_reach(&self, place: [f64; 2], distance: f64) -> u32;

    /// Delay \[s\] and index of the first wall among `walls` that the disk meets within `horizon` \[s\]; an infinite delay
    /// if there is none. `now` is the local time \[s\] of the disk's place, `gravity` \[m/s2\] pulls down.
    fn first_hit(&self, walls: u32, body: &Body, now: f64, gravity: f64, horizon: f64) -> (f64, u32);

    /// The wall at the instant `now` \[s\] of contact with a disk. `separation` tells the relative normal velocity after
    /// an impact with the one before it.
    fn meet(&mut self, wall: u32, body: &Body, now: f64, separation: impl Fn(f64) -> f64) -> Meeting;

    /// Wall `wall` belongs to the vibrating base.
    fn is_base(&self, wall: u32) -> bool;

    /// The origin of local time moves on by `seconds`.
    fn shift(&mut self, seconds: f64);

    /// Whether `other` can be these walls at another time, when local time began at `epoch` \[s\]: states come from
    /// outside.
    fn fits(&self, other: &Self, epoch: f64) -> bool;

    /// How many walls there are.
    fn count(&self) -> u32;

    /// What a prediction may cost for a disk of this radius \[m\], beside the work of an event.
    fn most_work(&self, _radius: f64) -> u64 {
        0
    }
}

/// No walls: a periodic cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, serde::Deserialize)]
pub struct Unbounded;

impl Boundary for Unbounded {
    const EXISTS: bool = false;

    fn within_reach(&self, _place: [f64; 2], _distance: f64) -> u32 {
        0
    }

    fn first_hit(&self, _walls: u32, _body: &Body, _now: f64, _gravity: f64, _horizon: f64) -> (f64, u32) {
        (f64::INFINITY, 0)
    }

    fn meet(&mut self, _wall: u32, _body: &Body, _now: f64, _separation: impl Fn(f64) -> f64) -> Meeting {
        Meeting {
            normal: [0.0, 1.0],
            velocity: [0.0, 0.0],
        }
    }

    fn is_base(&self, _wall: u32) -> bool {
        false
    }

    fn shift(&mut self, _seconds: f64) {}

    fn fits(&self, _other: &Self, _epoch: f64) -> bool {
        true
    }

    fn count(&self) -> u32 {
        0
    }
}
