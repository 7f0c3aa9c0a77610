//! How the walls of a wedge move: when a disk in flight meets one, and how fast the wall is then.

use rand_pcg::Pcg64;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::drive::{FirstHit, Motion, RandomPhase};
use crate::geometry::{Flight, disk_wall};

/// Motion of both walls, up and down together. It is part of the state.
pub trait WallMotion: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static {
    /// Where the walls are at `time` \[s\], as far as flights are concerned.
    fn motion(&self, time: f64) -> Motion;

    /// Delay \[s\] from `time` \[s\] until a disk meets a wall whose normal has the vertical part `normal_up`; see
    /// [`FirstHit::first_hit`].
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64;

    /// Velocity \[m/s\], up, of the walls at an impact while they are at `motion`; `normal_velocity` \[m/s\] is the disk's along the
    /// wall's normal. None if there is no velocity with which `leaves` says that the disk gets off the wall.
    fn velocity_at_impact(
        &mut self,
        motion: Motion,
        normal_velocity: f64,
        normal_up: f64,
        leaves: impl Fn(f64) -> bool,
    ) -> Option<f64>;
}

/// Walls that truly move with a drive.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Moving<D>(pub D);

impl<D: FirstHit> WallMotion for Moving<D> {
    #[inline]
    fn motion(&self, time: f64) -> Motion {
        self.0.motion(time)
    }

    #[inline]
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64 {
        self.0.first_hit(time, flight, normal_up)
    }

    #[inline]
    fn velocity_at_impact(&mut self, motion: Motion, _: f64, _: f64, _: impl Fn(f64) -> bool) -> Option<f64> {
        Some(motion.velocity)
    }
}

/// Walls at rest that give each impact the velocity of a sine at a random phase (P 2.3.3).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Resting {
    /// Distribution of the velocity.
    pub phase: RandomPhase,
    /// Where its random numbers come from.
    pub generator: Pcg64,
}

impl WallMotion for Resting {
    #[inline]
    fn motion(&self, _time: f64) -> Motion {
        Motion::default()
    }

    #[inline]
    fn first_hit(&self, _time: f64, flight: &Flight, _normal_up: f64) -> f64 {
        disk_wall(flight)
    }

    #[inline]
    fn velocity_at_impact(
        &mut self,
        _motion: Motion,
        normal_velocity: f64,
        normal_up: f64,
        leaves: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        self.phase
            .sample_leaving(&mut self.generator, normal_velocity, normal_up, leaves)
    }
}
