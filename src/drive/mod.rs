//! Motion of the vibrating base: time in, displacement, velocity and acceleration out.
//!
//! A drive is a type, so that a scene compiles only the one it has.

mod base_motion;
mod bottom;
pub mod excitation;
mod extrapolation;
mod first_hit;
mod follows_input;
mod gaussian_step;
mod normal;
mod quintic;
mod random_phase;
mod sine;

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use base_motion::{AtRandomPhase, BaseMotion, BaseProfile, DrawCounts};
pub use bottom::{FixedBottom, HeldDisk, RandomBottom, RandomVibration};
pub use extrapolation::{Contradiction, Degree, Extrapolation, InputHistory, InputSample};
pub use first_hit::FirstHit;
pub use follows_input::FollowsInput;
pub use random_phase::{RandomPhase, leaves_wall};
pub use sine::Sine;

/// Vertical motion of the base at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, serde::Deserialize)]
pub struct Motion {
    /// Displacement from the rest position, up \[m\].
    pub displacement: f64,
    /// Velocity, up \[m/s\].
    pub velocity: f64,
    /// Acceleration, up \[m/s2\].
    pub acceleration: f64,
}

/// A motion of the base as a function of time. It is part of the state: what changes in it is saved and restored.
pub trait Drive: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static {
    /// Whether it moves disks too, beside the base.
    const MOVES_DISKS: bool = false;

    /// Motion at `time` \[s\].
    fn motion(&self, time: f64) -> Motion;

    /// Tells `place` the index, position \[m\] and velocity \[m/s\] of each disk that it moves, at `time` \[s\]. Times do not go back by
    /// more than a time step.
    #[inline(always)]
    fn move_disks(&mut self, _time: f64, _place: impl FnMut(usize, [f64; 2], [f64; 2])) {}
}

/// A drive whose acceleration is bounded as far as its motion is known.
pub trait BoundedDrive: Drive {
    /// Size of the acceleration \[m/s2\] that is not exceeded until [`BoundedDrive::known_until`].
    fn greatest_acceleration(&self) -> f64;

    /// End \[s\] of what is known of the motion.
    fn known_until(&self) -> f64;

    /// The same motion with time counted from `origin` \[s\], so that times keep their digits in long runs.
    #[must_use]
    fn counted_from(&self, origin: f64) -> Self;
}
