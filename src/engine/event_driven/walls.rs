//! Straight walls, some of them fixed to a base that vibrates truly or in the random-phase approximation.

use rand_pcg::Pcg64;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::drive::{Drive, FirstHit, Motion, RandomPhase};
use crate::geometry::{Flight, Wall, disk_wall};

use super::{Body, Boundary, Meeting};

/// What the walls that follow the base do. Part of the state.
pub trait VibratingBase: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static {
    /// Farthest displacement from rest \[m\] until further notice.
    fn farthest(&self) -> f64;

    /// Motion that the geometry sees at `time` \[s\].
    fn motion(&self, time: f64) -> Motion;

    /// Delay \[s\] from `time` \[s\] of the first hit of a flight relative to the moving wall with normal part n_y up.
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64;

    /// Velocity \[m/s\] of the base, up, at the impact at `time` \[s\] of a disk with normal velocity v_n \[m/s\].
    /// `separation` tells u_n' for u_n.
    fn velocity(&mut self, time: f64, normal_velocity: f64, normal_up: f64, separation: impl Fn(f64) -> f64) -> f64;
}

/// Base that moves as its drive says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Moving<D> {
    /// The drive.
    pub drive: D,
    /// Farthest displacement from rest \[m\] until the drive is aimed anew.
    pub farthest: f64,
}

impl<D> VibratingBase for Moving<D>
where
    D: Drive + FirstHit,
{
    fn farthest(&self) -> f64 {
        self.farthest
    }

    #[inline]
    fn motion(&self, time: f64) -> Motion {
        self.drive.motion(time)
    }

    #[inline]
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64 {
        self.drive.first_hit(time, flight, normal_up)
    }

    #[inline]
    fn velocity(&mut self, time: f64, _: f64, _: f64, _: impl Fn(f64) -> f64) -> f64 {
        self.drive.motion(time).velocity
    }
}

/// Base that stays in place and lends each impact a velocity (P 2.3.3).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AtRandomPhase {
    /// The approximation.
    pub phase: RandomPhase,
    /// Source of phases.
    pub generator: Pcg64,
}

impl VibratingBase for AtRandomPhase {
    fn farthest(&self) -> f64 {
        0.0
    }

    #[inline]
    fn motion(&self, _time: f64) -> Motion {
        Motion::default()
    }

    #[inline]
    fn first_hit(&self, _time: f64, flight: &Flight, _normal_up: f64) -> f64 {
        disk_wall(flight)
    }

    /// Drawn again while the disk would not leave. A disk at rest meets the base at rest.
    #[inline]
    fn velocity(&mut self, _: f64, normal_velocity: f64, normal_up: f64, separation: impl Fn(f64) -> f64) -> f64 {
        let leaves = |base: f64| {
            let (approach, lift) = (normal_velocity - base * normal_up, base * normal_up);
            approach < 0.0 && separation(approach) + lift > 0.0
        };
        let drawn = self
            .phase
            .sample_leaving(&mut self.generator, normal_velocity, normal_up, leaves);
        drawn.unwrap_or(0.0)
    }
}

/// Up to 32 walls at rest or on a base.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Walls<W> {
    /// The walls.
    pub walls: Vec<Wall>,
    /// Base of those that follow it.
    pub base: W,
    /// Time \[s\] at which local time is zero.
    pub origin: f64,
}

impl<W: VibratingBase> Boundary for Walls<W> {
    const EXISTS: bool = true;

    fn within_reach(&self, [x, y]: [f64; 2], distance: f64) -> u32 {
        let near = |wall: &Wall| wall.distance(x, y, 0.0) - self.base.farthest() * wall.follows_base <= distance;
        let bits = self.walls.iter().enumerate().filter(|(_, wall)| near(wall));
        bits.fold(0, |bits, (index, _)| bits | 1 << index)
    }

    fn first_hit(&self, mut walls: u32, body: &Body, now: f64, gravity: f64, horizon: f64) -> (f64, u32) {
        let time = self.origin + now;
        let (mut earliest, mut first) = (horizon, 0);
        let mut found = false;
        while walls != 0 {
            let index = walls.trailing_zeros();
            walls &= walls - 1;
            let wall = &self.walls[index as usize];
            let [nx, ny] = wall.normal;
            let mut flight = Flight {
                gap: 0.0,
                velocity: nx * body.vx + ny * body.vy,
                pull: gravity * ny,
            };
            let delay = if wall.follows_base == 0.0 {
                flight.gap = wall.distance(body.x, body.y, 0.0) - body.radius;
                disk_wall(&flight)
            } else {
                let base = self.base.motion(time);
                flight.gap = wall.distance(body.x, body.y, base.displacement) - body.radius;
                flight.velocity -= ny * base.velocity;
                self.base.first_hit(time, &flight, ny)
            };
            if delay < earliest {
                (earliest, first, found) = (delay, index, true);
            }
        }
        (if found { earliest } else { f64::INFINITY }, first)
    }

    fn meet(&mut self, wall: u32, body: &Body, now: f64, separation: impl Fn(f64) -> f64) -> Meeting {
        let wall = self.walls[wall as usize];
        let [nx, ny] = wall.normal;
        if wall.follows_base == 0.0 {
            return Meeting {
                normal: wall.normal,
                velocity: [0.0, 0.0],
            };
        }
        let velocity = self
            .base
            .velocity(self.origin + now, nx * body.vx + ny * body.vy, ny, separation);
        Meeting {
            normal: wall.normal,
            velocity: [0.0, velocity],
        }
    }

    fn is_base(&self, wall: u32) -> bool {
        self.walls[wall as usize].follows_base != 0.0
    }

    fn shift(&mut self, seconds: f64) {
        self.origin += seconds;
    }

    fn fits(&self, other: &Self, epoch: f64) -> bool {
        other.walls == self.walls && other.origin == epoch && other.base.farthest().abs() < 1e100
    }

    fn count(&self) -> u32 {
        self.walls.len() as u32
    }
}
