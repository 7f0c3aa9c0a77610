//! A motion that is a polynomial of degree five for a while: the path of the base through one communication step.

use crate::elementary::powi;
use serde::{Deserialize, Serialize};

use super::Motion;

/// The quintic between two motions: displacement, velocity and acceleration are those given at both ends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct QuinticPath {
    start_time: f64,
    duration: f64,
    /// Coefficients of 1, u, ..., u^5 with u = (t - start_time) / duration \[m\].
    coefficients: [f64; 6],
}

impl QuinticPath {
    /// Path at a constant acceleration through `motion` at `time` \[s\].
    pub fn parabola(time: f64, motion: Motion) -> Self {
        Self {
            start_time: time,
            duration: 1.0,
            coefficients: [
                motion.displacement,
                motion.velocity,
                0.5 * motion.acceleration,
                0.0,
                0.0,
                0.0,
            ],
        }
    }

    /// Path from the motion `from` at `time` \[s\] to the motion `to` after `duration` \[s\].
    ///
    /// Source: quintic Hermite interpolation.
    pub fn between(time: f64, from: Motion, duration: f64, to: Motion) -> Self {
        let (v0, v1) = (duration * from.velocity, duration * to.velocity);
        let square = duration * duration;
        let (a0, a1) = (square * from.acceleration, square * to.acceleration);
        let rise = to.displacement - from.displacement;
        Self {
            start_time: time,
            duration,
            coefficients: [
                from.displacement,
                v0,
                0.5 * a0,
                10.0 * rise - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1,
                -15.0 * rise + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1,
                6.0 * rise - 3.0 * (v0 + v1) - 0.5 * (a0 - a1),
            ],
        }
    }

    /// End of the path \[s\]: what comes after depends on the next inputs.
    pub fn end_time(&self) -> f64 {
        self.start_time + self.duration
    }

    /// A displacement \[m\] that is not exceeded from the start of the path to its end: the largest of the control points of
    /// Bernstein's form, of which the path is a convex combination.
    pub fn highest(&self) -> f64 {
        bernstein(&self.coefficients)
            .into_iter()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Derivatives of the displacement at `time` \[s\], each over the factorial of its order: coefficients of the powers of the
    /// time that passes from then on \[m, m/s, m/s2, ...\].
    #[inline]
    pub fn expansion(&self, time: f64) -> [f64; 6] {
        let u = (time - self.start_time) / self.duration;
        let mut coefficients = self.coefficients;
        // Horner's scheme again and again: division by (u' - u).
        for first in 0..5 {
            for index in (first..5).rev() {
                coefficients[index] += u * coefficients[index + 1];
            }
        }
        let mut scale = 1.0;
        coefficients.map(|coefficient| {
            let scaled = coefficient * scale;
            scale /= self.duration;
            scaled
        })
    }

    /// Motion at `time` \[s\].
    #[inline]
    pub fn motion(&self, time: f64) -> Motion {
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        let u = (time - self.start_time) / self.duration;
        Motion {
            displacement: c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5)))),
            velocity: (c1 + u * (2.0 * c2 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))) / self.duration,
            acceleration: (2.0 * c2 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / powi(self.duration, 2),
        }
    }

    /// Size of the acceleration \[m/s2\] that is not exceeded until the end: the largest control point of the cubic that the
    /// acceleration is.
    #[inline]
    pub fn greatest_acceleration(&self) -> f64 {
        let [_, _, c2, c3, c4, c5] = self.coefficients;
        let controls = bernstein(&[2.0 * c2, 6.0 * c3, 12.0 * c4, 20.0 * c5]);
        controls
            .into_iter()
            .fold(0.0, |most: f64, control| most.max(control.abs()))
            / powi(self.duration, 2)
    }

    /// The same path with time counted from `origin` \[s\].
    #[must_use]
    pub fn counted_from(&self, origin: f64) -> Self {
        Self {
            start_time: self.start_time - origin,
            ..*self
        }
    }
}

/// Control points of Bernstein's form of degree n on \[0, 1\] from the coefficients of 1, u, ..., u^n.
#[inline]
pub(super) fn bernstein<const COUNT: usize>(coefficients: &[f64; COUNT]) -> [f64; COUNT] {
    let degree = (COUNT - 1) as f64;
    let mut controls = *coefficients;
    // c_j / binomial(n, j), then sums of the triangle of Pascal.
    let mut binomial = 1.0;
    for (power, control) in controls.iter_mut().enumerate() {
        *control /= binomial;
        binomial *= (degree - power as f64) / (power as f64 + 1.0);
    }
    for first in 1..COUNT {
        for index in (first..COUNT).rev() {
            controls[index] += controls[index - 1];
        }
    }
    controls
}

#[cfg(test)]
mod tests {
    use super::*;

    const FROM: Motion = Motion {
        displacement: 0.1,
        velocity: -0.3,
        acceleration: 5.0,
    };
    const TO: Motion = Motion {
        displacement: 0.2,
        velocity: 0.7,
        acceleration: -2.0,
    };

    fn path() -> QuinticPath {
        QuinticPath::between(2.0, FROM, 0.25, TO)
    }

    #[test]
    fn both_ends_are_those_given() {
        for (time, given) in [(2.0, FROM), (2.25, TO)] {
            let found = path().motion(time);
            assert!((found.displacement - given.displacement).abs() < 1e-15);
            assert!((found.velocity - given.velocity).abs() < 1e-13);
            assert!((found.acceleration - given.acceleration).abs() < 1e-11);
        }
    }

    #[test]
    fn no_displacement_and_no_acceleration_exceeds_its_bound() {
        let (path, mut highest, mut greatest) = (path(), f64::NEG_INFINITY, 0.0_f64);
        for step in 0..=1000 {
            let motion = path.motion(2.0 + 0.25 * f64::from(step) / 1000.0);
            highest = highest.max(motion.displacement);
            greatest = greatest.max(motion.acceleration.abs());
        }
        // Both are reached at an end, where the bounds are equal but for rounding.
        assert!(highest <= path.highest() + 1e-15 && greatest <= path.greatest_acceleration() * (1.0 + 1e-12));
        assert!(path.greatest_acceleration() < 2.0 * greatest);
    }

    #[test]
    fn the_expansion_is_that_of_taylor() {
        let (path, time) = (path(), 2.1);
        let expansion = path.expansion(time);
        let after = |delay: f64| {
            expansion
                .iter()
                .rev()
                .fold(0.0, |sum, coefficient| sum * delay + coefficient)
        };
        for delay in [0.0, 0.01, 0.15] {
            assert!((after(delay) - path.motion(time + delay).displacement).abs() < 1e-15);
        }
        assert!((2.0 * expansion[2] - path.motion(time).acceleration).abs() < 1e-12);
    }
}
