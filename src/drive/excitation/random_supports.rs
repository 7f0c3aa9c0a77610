//! Supports that vibrate randomly: damped oscillators forced by white noise (P 5.10), in x, y and angle each.

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::{Excitation, Piece, SupportMotion};
use crate::error::are_sane;

/// Which of the runs that are equally likely as the drawn one is taken. Means of such pairs scatter less.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum NoiseSign {
    /// As drawn.
    AsDrawn,
    /// Every displacement and angle reversed.
    Reversed,
    /// Mirrored: supports exchanged, x and angle reversed.
    Mirrored,
}

/// Displacement and rate of one oscillator of unit variance \[1, 1/s\].
type PhasePoint = [f64; 2];
/// x, y and angle of both supports.
type Phases = [[PhasePoint; 3]; 2];

/// One step of the oscillator, exact: mean by the transition matrix, scatter by the root of the covariance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct GaussianStep {
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
        ((root * time).sin() / root, (root * time).cos())
    } else {
        ((root * time).sinh() / root, (root * time).cosh())
    };
    let faded = (-decay * time).exp();
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
    fn new(angular_frequency: f64, damping_ratio: f64, duration: f64) -> Self {
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
    fn after(&self, from: PhasePoint, noise: [f64; 2]) -> PhasePoint {
        let [[xx, xv], [vx, vv]] = self.transition;
        let [first, second, third] = self.root;
        [
            xx * from[0] + xv * from[1] + first * noise[0],
            vx * from[0] + vv * from[1] + second * noise[0] + third * noise[1],
        ]
    }
}

/// Both supports, each coordinate an oscillator of its own.
///
/// At the ends of the cells the oscillators have the exact joint distribution of P 5.10, whatever the cell's duration.
/// Inside a cell they follow the cubic through displacements and rates at its ends: the mean of all noise that fits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RandomSupports {
    step: GaussianStep,
    /// Duration of a cell \[s\].
    duration: f64,
    /// Root mean square of x, y \[m\] and angle \[rad\].
    amplitudes: [f64; 3],
    sign: NoiseSign,
    now: Phases,
    next: Phases,
    generator: Pcg64,
}

/// What random supports need to know.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vibration {
    /// Root mean square displacement A_b \[m\] in x and y.
    pub amplitude: f64,
    /// Root mean square angle \[rad\].
    pub angle: f64,
    /// Natural angular frequency omega_b \[rad/s\].
    pub angular_frequency: f64,
    /// Damping ratio c.
    pub damping_ratio: f64,
    /// Seed of the noise.
    pub seed: u64,
    /// Which of the paired runs.
    pub sign: NoiseSign,
}

impl RandomSupports {
    /// Vibration in its steady state, in cells of `duration` \[s\].
    pub fn new(vibration: &Vibration, duration: f64) -> Self {
        let Vibration {
            amplitude,
            angle,
            angular_frequency,
            damping_ratio,
            seed,
            sign,
        } = *vibration;
        let mut generator = Pcg64::seed_from_u64(seed);
        let steady = draw(&mut generator, sign).map(|support| support.map(|[x, v]| [x, angular_frequency * v]));
        let mut supports = Self {
            step: GaussianStep::new(angular_frequency, damping_ratio, duration),
            duration,
            amplitudes: [amplitude, amplitude, angle],
            sign,
            now: steady,
            next: steady,
            generator,
        };
        supports.next_cell();
        supports
    }

    /// Whether `other` can be an earlier or later state of the same vibration.
    pub fn continues(&self, other: &Self) -> bool {
        self.step == other.step
            && self.duration == other.duration
            && self.amplitudes == other.amplitudes
            && self.sign == other.sign
    }
}

/// Twelve independent standard normal numbers.
fn draw(generator: &mut Pcg64, sign: NoiseSign) -> Phases {
    let mut normal = || -> f64 { StandardNormal.sample(generator) };
    let drawn: Phases = std::array::from_fn(|_| std::array::from_fn(|_| [normal(), normal()]));
    let reversed = |[x, v]: PhasePoint| [-x, -v];
    match sign {
        NoiseSign::AsDrawn => drawn,
        NoiseSign::Reversed => drawn.map(|support| support.map(reversed)),
        NoiseSign::Mirrored => {
            let [left, right] = drawn.map(|[x, y, angle]| [reversed(x), y, reversed(angle)]);
            [right, left]
        }
    }
}

/// The motion in one cell: coefficients of 1, s, s^2, s^3 with s the time since its start, for x, y and angle of both
/// supports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CubicSupports([[[f64; 4]; 3]; 2]);

impl Piece for CubicSupports {
    #[inline]
    fn supports(&self, offset: f64) -> [SupportMotion; 2] {
        let s = offset;
        self.0.map(|cubics| SupportMotion {
            place: cubics.map(|[c0, c1, c2, c3]| c0 + s * (c1 + s * (c2 + s * c3))),
            rates: cubics.map(|[_, c1, c2, c3]| c1 + s * (2.0 * c2 + s * (3.0 * c3))),
            accelerations: cubics.map(|[_, _, c2, c3]| 2.0 * c2 + s * (6.0 * c3)),
        })
    }
}

impl Excitation for RandomSupports {
    type Piece = CubicSupports;

    fn piece(&self, _start: f64) -> CubicSupports {
        let h = self.duration;
        CubicSupports(std::array::from_fn(|support| {
            std::array::from_fn(|row| {
                let ([x, v], [next_x, next_v]) = (self.now[support][row], self.next[support][row]);
                let amplitude = self.amplitudes[row];
                let mean = (next_x - x) / h;
                let square = (3.0 * mean - 2.0 * v - next_v) / h;
                let cube = (v + next_v - 2.0 * mean) / (h * h);
                [amplitude * x, amplitude * v, amplitude * square, amplitude * cube]
            })
        }))
    }

    #[inline]
    fn next_cell(&mut self) {
        let noise = draw(&mut self.generator, self.sign);
        self.now = self.next;
        self.next = std::array::from_fn(|support| {
            std::array::from_fn(|row| self.step.after(self.now[support][row], noise[support][row]))
        });
    }

    fn is_sane(&self) -> bool {
        let phases = |phases: &Phases| are_sane(phases.iter().flatten().flatten().copied());
        phases(&self.now) && phases(&self.next) && self.duration > 0.0
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
