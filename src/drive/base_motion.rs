//! What event-driven engines need of a base: where it is, when a flight meets it, how fast it is at the impact.
//!
//! Two kinds: a drive, which truly moves, and the random-phase approximation, which moves at impacts only (P 2.3.3).

use rand_pcg::Pcg64;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::{FirstHit, Motion, RandomPhase};
use crate::geometry::{Flight, disk_wall};

/// Vertical motion of a base as impacts see it. Part of the state.
pub trait BaseMotion: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static {
    /// Motion at `time` \[s\] as far as flights are concerned.
    fn motion(&self, time: f64) -> Motion;

    /// Delay \[s\] from `time` \[s\] until a disk meets a wall whose normal has the vertical component `normal_up`; see
    /// [`FirstHit::first_hit`].
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64;

    /// Velocity \[m/s\] of the base, up, at an impact while it is at `motion`; `normal_velocity` \[m/s\] is the disk's
    /// along the wall's normal. None if no velocity is found after which the disk `leaves` the wall.
    fn velocity_at_impact(
        &mut self,
        motion: Motion,
        normal_velocity: f64,
        normal_up: f64,
        leaves: impl Fn(f64) -> bool,
    ) -> Option<f64>;
}

impl<D: FirstHit> BaseMotion for D {
    #[inline]
    fn motion(&self, time: f64) -> Motion {
        super::Drive::motion(self, time)
    }

    #[inline]
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64 {
        FirstHit::first_hit(self, time, flight, normal_up)
    }

    #[inline]
    fn velocity_at_impact(&mut self, motion: Motion, _: f64, _: f64, _: impl Fn(f64) -> bool) -> Option<f64> {
        Some(motion.velocity)
    }
}

/// How a base that stays in place would move, which decides its velocity at an impact (P 2.3.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BaseProfile {
    /// A sine, met at a random phase.
    Sine,
    /// A sawtooth that rises evenly and falls at once: whatever falls on it meets it rising, with the largest velocity of the
    /// sine. For walls that face up: one that hangs over would be met where the base falls.
    Sawtooth,
}

/// Base that stays in place and gives each impact the velocity of a sine at a random phase, or of a sawtooth (P 2.3.3).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AtRandomPhase {
    /// Distribution of the velocity.
    pub phase: RandomPhase,
    /// Source of random phases.
    pub generator: Pcg64,
    /// Velocities drawn so far.
    pub counts: DrawCounts,
    /// What it lends its velocity from.
    pub profile: BaseProfile,
}

/// How many velocities a base of random phase has drawn: how rare rejections are says whether the approximation holds (P 2.3.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct DrawCounts {
    /// All draws, those rejected among them.
    pub draws: u64,
    /// Draws after which the disk would still have moved into the wall, so that another followed.
    pub rejected: u64,
}

impl AtRandomPhase {
    /// A sine that has drawn nothing yet.
    pub fn new(phase: RandomPhase, generator: Pcg64) -> Self {
        Self {
            phase,
            generator,
            counts: DrawCounts::default(),
            profile: BaseProfile::Sine,
        }
    }

    /// The same with another profile.
    #[must_use]
    pub fn with_profile(self, profile: BaseProfile) -> Self {
        Self { profile, ..self }
    }
}

impl BaseMotion for AtRandomPhase {
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
        let Self {
            phase,
            generator,
            counts,
            profile,
        } = self;
        if *profile == BaseProfile::Sawtooth {
            let velocity = phase.peak_velocity;
            return leaves(velocity).then_some(velocity);
        }
        // Saturating, since a state that is read back may hold any count.
        let counted = |velocity: f64| {
            let leaves = leaves(velocity);
            counts.draws = counts.draws.saturating_add(1);
            counts.rejected = counts.rejected.saturating_add(u64::from(!leaves));
            leaves
        };
        phase.sample_leaving(generator, normal_velocity, normal_up, counted)
    }
}
