//! Base that follows the importer's inputs along cubics without jumps in position or velocity.

use serde::{Deserialize, Serialize};

use super::{BoundedDrive, Drive, Motion};

/// One communication step of base motion: the cubic from the present position and velocity to the predicted ones.
///
/// Inputs given at time t predict `displacement + h velocity` and `velocity` at t + h. An importer that samples a smooth
/// motion at 1 kHz thus moves the base smoothly instead of hammering the grains at each sample.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FollowsInput {
    start_time: f64,
    duration: f64,
    /// Coefficients of 1, u, u^2, u^3 with u = (t - start_time) / duration \[m\].
    coefficients: [f64; 4],
}

impl FollowsInput {
    /// Base that keeps a constant velocity \[m/s\] through `displacement` \[m\] at `time` \[s\] until it has a target.
    pub fn uniform(time: f64, displacement: f64, velocity: f64) -> Self {
        Self {
            start_time: time,
            duration: 1.0,
            coefficients: [displacement, velocity, 0.0, 0.0],
        }
    }

    /// A displacement \[m\] that the base does not exceed from the start of the present cubic to its end.
    ///
    /// The largest of the control points of the cubic in Bernstein's form, of which it is a convex combination.
    pub fn highest(&self) -> f64 {
        let [c0, c1, c2, c3] = self.coefficients;
        let controls = [c0, c0 + c1 / 3.0, c0 + (2.0 * c1 + c2) / 3.0, c0 + c1 + c2 + c3];
        controls.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    /// Goes on from where the base is at `time` \[s\] so that after `duration` \[s\] it is where the inputs predict.
    ///
    /// Source: cubic Hermite interpolation.
    pub fn set_target(&mut self, time: f64, duration: f64, displacement: f64, velocity: f64) {
        let from = self.motion(time);
        let target = displacement + duration * velocity;
        let (start_slope, end_slope) = (from.velocity * duration, velocity * duration);
        let rise = target - from.displacement;
        self.start_time = time;
        self.duration = duration;
        self.coefficients = [
            from.displacement,
            start_slope,
            3.0 * rise - 2.0 * start_slope - end_slope,
            start_slope + end_slope - 2.0 * rise,
        ];
    }

    /// End of the present cubic \[s\]: what comes after depends on the next inputs.
    pub fn end_time(&self) -> f64 {
        self.start_time + self.duration
    }

    /// Rate of the acceleration \[m/s3\], constant along a cubic.
    pub fn jerk(&self) -> f64 {
        6.0 * self.coefficients[3] / self.duration.powi(3)
    }
}

impl Drive for FollowsInput {
    fn motion(&self, time: f64) -> Motion {
        let [c0, c1, c2, c3] = self.coefficients;
        let u = (time - self.start_time) / self.duration;
        Motion {
            displacement: c0 + u * (c1 + u * (c2 + u * c3)),
            velocity: (c1 + u * (2.0 * c2 + u * 3.0 * c3)) / self.duration,
            acceleration: (2.0 * c2 + u * 6.0 * c3) / self.duration.powi(2),
        }
    }
}

impl BoundedDrive for FollowsInput {
    /// The acceleration changes evenly along a cubic: it is greatest at one of the ends.
    #[inline]
    fn greatest_acceleration(&self) -> f64 {
        let [_, _, c2, c3] = self.coefficients;
        (2.0 * c2).abs().max((2.0 * c2 + 6.0 * c3).abs()) / self.duration.powi(2)
    }

    #[inline]
    fn known_until(&self) -> f64 {
        self.end_time()
    }

    fn counted_from(&self, origin: f64) -> Self {
        Self {
            start_time: self.start_time - origin,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extrapolated_motion_is_reached_without_jumps() {
        let mut base = FollowsInput::uniform(2.0, 0.1, -0.3);
        base.set_target(2.0, 0.25, 0.2, 0.7);
        let start = base.motion(2.0);
        let end = base.motion(2.25);
        assert!((start.displacement - 0.1).abs() < 1e-15 && (start.velocity + 0.3).abs() < 1e-15);
        assert!((end.displacement - (0.2 + 0.25 * 0.7)).abs() < 1e-15 && (end.velocity - 0.7).abs() < 1e-14);
    }

    #[test]
    fn never_exceeds_its_highest() {
        let mut base = FollowsInput::uniform(0.0, 0.0, 3.0);
        base.set_target(0.0, 0.5, -0.2, -1.0);
        let reached = (0..=1000)
            .map(|i| base.motion(0.5 * f64::from(i) / 1000.0).displacement)
            .fold(0.0, f64::max);
        // The control points are 0, 0.5, -0.53 and -0.7.
        assert!(
            reached <= base.highest() && (base.highest() - 0.5).abs() < 1e-15,
            "{reached} {}",
            base.highest()
        );
    }

    /// Differences of a quadratic and Simpson's rule on it are exact.
    #[test]
    fn velocity_and_acceleration_are_the_derivatives() {
        let mut base = FollowsInput::uniform(0.0, 0.0, 0.0);
        base.set_target(0.0, 1e-3, 1e-5, 0.02);
        let (before, after, middle) = (base.motion(4e-4), base.motion(6e-4), base.motion(5e-4));
        assert!(((after.velocity - before.velocity) / 2e-4 - middle.acceleration).abs() < 1e-9);
        let simpson = 2e-4 / 6.0 * (before.velocity + 4.0 * middle.velocity + after.velocity);
        assert!((after.displacement - before.displacement - simpson).abs() < 1e-18);
    }
}
