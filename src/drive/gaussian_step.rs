//! A damped oscillator forced by white noise, advanced by exact steps (P 5.10).

use crate::elementary::{cos, cosh, exp, sin, sinh};
use serde::{Deserialize, Serialize};

/// Displacement and rate of one oscillator of unit variance \[1, 1/s\].
pub type PhasePoint = [f64; 2];

/// One step of the oscillator, exact: mean by the transition matrix, scatter by the root of the covariance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GaussianStep {
    transition: [[f64; 2]; 2],
    /// Lower triangular root of the covariance: 11, 21, 22.
    root: [f64; 3],
}

/// Response of the oscillator to a unit kick and its rate after `time` \[s\].
fn response(angular_frequency: f64, damping_ratio: f64, time: f64) -> (f64, f64) {
    let decay = damping_ratio * angular_frequency;
    let detuning = angular_frequency * angular_frequency * (1.0 - damping_ratio * damping_ratio);
    let root = detuning.abs().sqrt();
    // Critical damping is the limit of both branches: below 1e-4 rad the series is exact to rounding.
    let (sine, cosine) = if root * time < 1e-4 {
        let square = detuning * time * time;
        (time * (1.0 - square / 6.0), 1.0 - 0.5 * square)
    } else if detuning > 0.0 {
        (sin(root * time) / root, cos(root * time))
    } else {
        (sinh(root * time) / root, cosh(root * time))
    };
    let faded = exp(-decay * time);
    (faded * sine, faded * (cosine - decay * sine))
}

/// Gauss and Legendre's five points on (-1, 1) and their weights.
const POINTS: [(f64, f64); 5] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
/// Pieces on which they are used.
const PIECES: u32 = 16;

impl GaussianStep {
    /// The step of `duration` \[s\] of the oscillator of unit variance.
    ///
    /// The covariance is D times the integral of the response's squares, `D = 4 c omega^3` (P 5.11). The closed form
    /// `S - E S E^T` would lose (omega duration)^3 to cancellation.
    pub fn new(angular_frequency: f64, damping_ratio: f64, duration: f64) -> Self {
        let (place, rate) = response(angular_frequency, damping_ratio, duration);
        let drag = 2.0 * damping_ratio * angular_frequency;
        let stiffness = angular_frequency * angular_frequency;
        let transition = [[rate + drag * place, place], [-stiffness * place, rate]];
        let intensity = 2.0 * drag * stiffness;
        let (mut places, mut mixed, mut rates) = (0.0, 0.0, 0.0);
        let piece = duration / f64::from(PIECES);
        for index in 0..PIECES {
            for (point, weight) in POINTS {
                let time = (f64::from(index) + 0.5 * (1.0 + point)) * piece;
                let (place, rate) = response(angular_frequency, damping_ratio, time);
                let weight = 0.5 * weight * piece * intensity;
                places += weight * place * place;
                mixed += weight * place * rate;
                rates += weight * rate * rate;
            }
        }
        let first = places.sqrt();
        let second = mixed / first;
        let third = (rates - second * second).max(0.0).sqrt();
        Self {
            transition,
            root: [first, second, third],
        }
    }

    #[inline]
    /// One step from `from`, with two independent standard normal numbers.
    pub fn after(&self, from: PhasePoint, noise: [f64; 2]) -> PhasePoint {
        let [[xx, xv], [vx, vv]] = self.transition;
        let [first, second, third] = self.root;
        [
            xx * from[0] + xv * from[1] + first * noise[0],
            vx * from[0] + vv * from[1] + second * noise[0] + third * noise[1],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covariance(step: &GaussianStep) -> [f64; 3] {
        let [a, b, c] = step.root;
        [a * a, a * b, b * b + c * c]
    }

    /// `E S E^T` for the covariance S = (xx, xv, vv).
    fn carried(step: &GaussianStep, [xx, xv, vv]: [f64; 3]) -> [f64; 3] {
        let [[a, b], [c, d]] = step.transition;
        [
            a * a * xx + 2.0 * a * b * xv + b * b * vv,
            a * c * xx + (a * d + b * c) * xv + b * d * vv,
            c * c * xx + 2.0 * c * d * xv + d * d * vv,
        ]
    }

    /// Two steps of h have the law of one of 2h, and every step keeps the steady state: what "exact" means.
    #[test]
    fn steps_compose_and_keep_the_steady_state() {
        for ratio in [1e-3, 0.5, 1.0, 3.0] {
            let omega = 62.8;
            for duration in [1e-9, 1e-6, 1e-4, 1e-3] {
                let (one, two) = (
                    GaussianStep::new(omega, ratio, duration),
                    GaussianStep::new(omega, ratio, 2.0 * duration),
                );
                let scatter = covariance(&one);
                let composed = carried(&one, scatter);
                let steady = carried(&one, [1.0, 0.0, omega * omega]);
                let sizes = [1.0, omega, omega * omega];
                for row in 0..3 {
                    let sum = composed[row] + scatter[row];
                    let expected = covariance(&two)[row];
                    assert!(
                        (sum - expected).abs() < 1e-13 * expected.abs(),
                        "{ratio} {duration} {row}: {sum:e} {expected:e}"
                    );
                    let kept = steady[row] + scatter[row];
                    let expected = [1.0, 0.0, omega * omega][row];
                    assert!(
                        (kept - expected).abs() < 1e-14 * sizes[row],
                        "{ratio} {duration} {row}: {kept:e}"
                    );
                }
            }
        }
    }
}
