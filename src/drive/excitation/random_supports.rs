//! Supports that vibrate randomly: damped oscillators forced by white noise (P 5.10), in x, y and angle each.

use rand::SeedableRng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::{Excitation, Piece, SupportMotion};
use crate::drive::gaussian_step::{GaussianStep, PhasePoint};
use crate::drive::normal::normal_pair;
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

/// x, y and angle of both supports.
type Phases = [[PhasePoint; 3]; 2];

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
    let drawn: Phases = std::array::from_fn(|_| std::array::from_fn(|_| normal_pair(generator)));
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
