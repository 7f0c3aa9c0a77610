//! Straight walls, some of them fixed to a base that vibrates truly or in the random-phase approximation.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::drive::{AtRandomPhase, BaseMotion, FirstHit, FollowsInput, Motion};
use crate::geometry::{Flight, Wall, disk_wall};

use super::{Body, Boundary, WallContact, WallHit};

/// Motion of the base of some walls, with a bound on its displacement. Part of the state.
pub trait VibratingBase: BaseMotion {
    /// Farthest displacement from rest \[m\] until further notice.
    fn farthest(&self) -> f64;
}

/// Base that moves as its drive says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Moving<D> {
    /// The drive.
    pub drive: D,
    /// Farthest displacement from rest \[m\] until the drive has another target.
    pub farthest: f64,
}

impl<D: FirstHit> BaseMotion for Moving<D> {
    #[inline]
    fn motion(&self, time: f64) -> Motion {
        self.drive.motion(time)
    }

    #[inline]
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64 {
        self.drive.first_hit(time, flight, normal_up)
    }

    #[inline]
    fn velocity_at_impact(&mut self, motion: Motion, _: f64, _: f64, _: impl Fn(f64) -> bool) -> Option<f64> {
        Some(motion.velocity)
    }
}

impl<D: FirstHit> VibratingBase for Moving<D> {
    fn farthest(&self) -> f64 {
        self.farthest
    }
}

impl VibratingBase for AtRandomPhase {
    fn farthest(&self) -> f64 {
        0.0
    }
}

/// Up to 32 walls at rest or on a base.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct Walls<W> {
    /// The walls.
    pub walls: Vec<Wall>,
    /// Base of those that follow it.
    pub base: W,
    /// Time \[s\] at which local time is zero.
    pub origin: f64,
}

impl<W: Clone> Clone for Walls<W> {
    fn clone(&self) -> Self {
        Self {
            walls: self.walls.clone(),
            base: self.base.clone(),
            origin: self.origin,
        }
    }

    /// Copies without allocating where there is room.
    fn clone_from(&mut self, source: &Self) {
        self.walls.clone_from(&source.walls);
        self.base.clone_from(&source.base);
        self.origin = source.origin;
    }
}

impl Walls<Moving<FollowsInput>> {
    /// No walls: disks in a periodic cell.
    pub fn none() -> Self {
        let drive = FollowsInput::uniform(0.0, 0.0, 0.0);
        Self {
            walls: Vec::new(),
            base: Moving { drive, farthest: 0.0 },
            origin: 0.0,
        }
    }
}

impl<W: VibratingBase> Boundary for Walls<W> {
    fn walls_within(&self, distance: f64, position: Vector2<f64>) -> u32 {
        let near = |wall: &Wall| wall.distance(position, 0.0) - self.base.farthest() * wall.follows_base <= distance;
        let indices = self.walls.iter().enumerate().filter(|(_, wall)| near(wall));
        indices.fold(0, |set, (index, _)| set | 1 << index)
    }

    fn first_hit(&self, mut walls: u32, body: &Body, gravity: f64, horizon: f64) -> WallHit {
        let time = self.origin + body.time;
        let (mut hit, mut earliest) = (WallHit::NONE, horizon);
        while walls != 0 {
            let index = walls.trailing_zeros();
            walls &= walls - 1;
            let wall = &self.walls[index as usize];
            let mut flight = Flight {
                gap: 0.0,
                velocity: wall.normal.dot(&body.velocity),
                pull: gravity * wall.normal.y,
            };
            // A vertical wall is where it is however the base moves.
            let delay = if wall.follows_base * wall.normal.y == 0.0 {
                flight.gap = wall.distance(body.position, 0.0) - body.radius;
                disk_wall(&flight)
            } else {
                let base = self.base.motion(time);
                flight.gap = wall.distance(body.position, base.displacement) - body.radius;
                flight.velocity -= wall.normal.y * base.velocity;
                self.base.first_hit(time, &flight, wall.normal.y)
            };
            if delay < earliest {
                (earliest, hit) = (delay, WallHit { delay, wall: index });
            }
        }
        hit
    }

    /// A disk that does not leave whatever the velocity of the base, as one at rest, meets the base at rest.
    fn contact(&mut self, wall: u32, body: &Body, separation_velocity: impl Fn(f64) -> f64) -> WallContact {
        let Wall {
            normal, follows_base, ..
        } = self.walls[wall as usize];
        let mut velocity = Vector2::zeros();
        if follows_base != 0.0 {
            let motion = self.base.motion(self.origin + body.time);
            let normal_velocity = normal.dot(&body.velocity);
            let leaves = |base: f64| {
                let (approach, lift) = (normal_velocity - base * normal.y, base * normal.y);
                approach < 0.0 && separation_velocity(approach) + lift > 0.0
            };
            let sampled = self.base.velocity_at_impact(motion, normal_velocity, normal.y, leaves);
            velocity.y = sampled.unwrap_or(0.0);
        }
        WallContact {
            normal,
            velocity,
            part: 0,
        }
    }

    fn is_base(&self, wall: u32) -> bool {
        self.walls[wall as usize].follows_base != 0.0
    }

    fn shift_origin(&mut self, seconds: f64) {
        self.origin += seconds;
    }

    fn fits(&self, other: &Self, epoch: f64) -> bool {
        other.walls == self.walls && other.origin == epoch && other.base.farthest().abs() < 1e100
    }

    fn count(&self) -> u32 {
        self.walls.len() as u32
    }
}
