//! Base that follows the importer's inputs: in each communication step from where it is to where the inputs are expected
//! to be at its end.

use serde::{Deserialize, Serialize};

use super::extrapolation::{Degree, InputHistory, InputSample};
use super::quintic::QuinticPath;
use super::{BoundedDrive, Drive, Motion};

/// Base on inputs. Displacement, velocity and acceleration have no jumps.
///
/// Inputs arrive at communication points only, and the step from t to t + h must be done before those at t + h are known: the
/// end of the path is extrapolated from the samples so far, by [`InputHistory`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FollowsInput {
    path: QuinticPath,
    history: InputHistory,
    degree: Degree,
}

impl FollowsInput {
    /// Base that keeps a constant velocity \[m/s\] through `displacement` \[m\] at `time` \[s\] until it has a target.
    pub fn uniform(time: f64, displacement: f64, velocity: f64) -> Self {
        let motion = Motion {
            displacement,
            velocity,
            acceleration: 0.0,
        };
        Self::starting(time, motion, Degree::Automatic)
    }

    /// Base that keeps the acceleration of `motion` from `time` \[s\] until it has a target, and then follows inputs with
    /// an extrapolation of this degree.
    pub fn starting(time: f64, motion: Motion, degree: Degree) -> Self {
        Self {
            path: QuinticPath::parabola(time, motion),
            history: InputHistory::default(),
            degree,
        }
    }

    /// Continues from where the base is at `time` \[s\] so that after `duration` \[s\] it is where the inputs are expected
    /// to be, of which `inputs` are those at `time`: displacement \[m\], and velocity \[m/s\] and acceleration \[m/s2\], zero if
    /// they are not given.
    pub fn set_target(&mut self, time: f64, duration: f64, inputs: Motion) {
        let Motion {
            displacement,
            velocity,
            acceleration,
        } = inputs;
        let values = [displacement, velocity, acceleration];
        self.history.record(InputSample { time, values });
        let (from, end) = (self.path.motion(time), time + duration);
        // There is a sample now.
        let Some(expected) = self.history.extrapolate(end, self.degree) else {
            return;
        };
        let [displacement, velocity, acceleration] = expected.at(end);
        let to = Motion {
            displacement,
            velocity,
            acceleration,
        };
        self.path = QuinticPath::between(time, from, duration, to);
    }

    /// The path of the present step.
    pub fn path(&self) -> &QuinticPath {
        &self.path
    }

    /// The inputs so far.
    pub fn history(&self) -> &InputHistory {
        &self.history
    }
}

impl Drive for FollowsInput {
    #[inline]
    fn motion(&self, time: f64) -> Motion {
        self.path.motion(time)
    }
}

impl BoundedDrive for FollowsInput {
    #[inline]
    fn greatest_acceleration(&self) -> f64 {
        self.path.greatest_acceleration()
    }

    #[inline]
    fn known_until(&self) -> f64 {
        self.path.end_time()
    }

    fn counted_from(&self, origin: f64) -> Self {
        Self {
            path: self.path.counted_from(origin),
            ..*self
        }
    }
}
