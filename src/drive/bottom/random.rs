//! Disks that vibrate randomly about their places, each inside a circle (P 1.3), over a base at rest.
//!
//! P gives the circle and nothing else of the noise. Here x and y of a disk come from two damped oscillators forced by white
//! noise, as the supports of P 5.10, of unit variance: q. The displacement
//! ```text
//! d = epsilon q sqrt(1 - exp(-s)) / sqrt(2 s),   s = |q|^2 / 2
//! ```
//! has the direction of q and a length below epsilon, and since s is exponentially distributed, `(|d| / epsilon)^2` is even:
//! in the long run a disk is anywhere in its circle with the same probability. Near the centre d is `epsilon q / sqrt(2)`.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::HeldDisk;
use crate::clone_in_place::clone_in_place;
use crate::drive::gaussian_step::{GaussianStep, PhasePoint};
use crate::drive::normal::normal_pair;
use crate::drive::{Drive, Motion};
use crate::elementary::exp_m1;

/// Cells of the noise in the shortest time of an oscillator.
const CELLS: f64 = 50.0;

/// Cells that a state may lie behind its time: more than a time step has.
const LAG: f64 = 8.0;

/// Standard deviations that the displacement or the rate of an oscillator may have.
const MOST_DEVIATIONS: f64 = 100.0;

/// Below this s, the series in it.
const SMALL: f64 = 0.2;

/// What the random vibration of disks needs to know.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RandomVibration {
    /// Radius epsilon \[m\] of the circle that a centre stays in.
    pub radius: f64,
    /// Natural angular frequency omega_b \[rad/s\] of the oscillators.
    pub angular_frequency: f64,
    /// Their damping ratio c.
    pub damping_ratio: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl RandomVibration {
    /// The shortest time \[s\] in which the vibration changes: strong damping is faster than the oscillator.
    pub fn period(&self) -> f64 {
        TAU / (self.angular_frequency * (2.0 * self.damping_ratio).max(1.0))
    }
}

/// A disk and its oscillators, x and y, at the ends of the present cell of time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct VibratingDisk {
    disk: HeldDisk,
    now: [PhasePoint; 2],
    next: [PhasePoint; 2],
}

/// Base at rest, and disks that vibrate randomly and do not turn. They start at rest at their places.
///
/// The noise lives in cells of time of its own, a fiftieth of the shortest period: runs with other time steps have the same
/// noise. At the ends of cells the oscillators have the exact joint distribution of P 5.10; inside they follow the cubic through
/// displacements and rates, the mean of all noise that fits.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct RandomBottom {
    vibration: RandomVibration,
    step: GaussianStep,
    /// Duration of a cell \[s\].
    duration: f64,
    /// Start of the first cell \[s\].
    start: f64,
    /// Number of the present cell.
    cell: u64,
    disks: Vec<VibratingDisk>,
    generator: Pcg64,
}

clone_in_place!(RandomBottom {
    vibration,
    step,
    duration,
    start,
    cell,
    disks,
    generator
});

impl RandomBottom {
    /// Vibration from `start` \[s\] on, of no disks yet.
    pub fn new(vibration: RandomVibration, start: f64) -> Self {
        let duration = vibration.period() / CELLS;
        Self {
            step: GaussianStep::new(vibration.angular_frequency, vibration.damping_ratio, duration),
            generator: Pcg64::seed_from_u64(vibration.seed),
            vibration,
            duration,
            start,
            cell: 0,
            disks: Vec::new(),
        }
    }

    /// Moves these disks too, from rest at their places. Before the first cell has ended.
    pub fn hold(&mut self, disks: &[HeldDisk]) {
        let resting = disks.iter().map(|&disk| VibratingDisk {
            disk,
            now: [[0.0; 2]; 2],
            next: [[0.0; 2]; 2],
        });
        self.disks.extend(resting);
        self.draw();
    }

    /// How it vibrates.
    pub fn vibration(&self) -> &RandomVibration {
        &self.vibration
    }

    /// Whether `other` can be an earlier or later state of the same vibration, that of `time` \[s\].
    pub fn continues(&self, other: &Self, time: f64) -> bool {
        let same_disks = self
            .disks
            .iter()
            .map(|own| own.disk)
            .eq(other.disks.iter().map(|own| own.disk));
        let mut phases = other.disks.iter().flat_map(|own| own.now.iter().chain(&own.next));
        // No normal number is as large.
        let most = [MOST_DEVIATIONS, MOST_DEVIATIONS * self.vibration.angular_frequency];
        let phases_hold = |[x, v]: &PhasePoint| x.abs() <= most[0] && v.abs() <= most[1];
        let cells = (time - self.start) / self.duration;
        same_disks
            && (self.vibration, self.step) == (other.vibration, other.step)
            && (self.duration, self.start) == (other.duration, other.start)
            && (other.cell as f64 - cells).abs() <= LAG
            && phases.all(phases_hold)
    }

    /// Ends of the present cell from its beginnings.
    fn draw(&mut self) {
        for VibratingDisk { now, next, .. } in &mut self.disks {
            for (now, next) in now.iter().zip(next) {
                *next = self.step.after(*now, normal_pair(&mut self.generator));
            }
        }
    }

    fn enter_cell_of(&mut self, elapsed: f64) {
        while elapsed > (self.cell + 1) as f64 * self.duration {
            self.cell += 1;
            for disk in &mut self.disks {
                disk.now = disk.next;
            }
            self.draw();
        }
    }
}

impl Drive for RandomBottom {
    const MOVES_DISKS: bool = true;

    fn motion(&self, _time: f64) -> Motion {
        Motion::default()
    }

    fn move_disks(&mut self, time: f64, mut place: impl FnMut(usize, [f64; 2], [f64; 2])) {
        let elapsed = time - self.start;
        self.enter_cell_of(elapsed);
        let offset = elapsed - self.cell as f64 * self.duration;
        for VibratingDisk { disk, now, next } in &self.disks {
            let oscillators: [PhasePoint; 2] =
                std::array::from_fn(|axis| between(now[axis], next[axis], self.duration, offset));
            let (displacement, velocity) = in_circle(self.vibration.radius, oscillators);
            let [x, y] = disk.place;
            place(
                disk.index as usize,
                [x + displacement[0], y + displacement[1]],
                velocity,
            );
        }
    }
}

/// The cubic through displacements and rates at the ends of a cell of `duration` \[s\], `offset` \[s\] after its start.
#[inline]
fn between([x, v]: PhasePoint, [next_x, next_v]: PhasePoint, duration: f64, offset: f64) -> PhasePoint {
    let mean = (next_x - x) / duration;
    let square = (3.0 * mean - 2.0 * v - next_v) / duration;
    let cube = (v + next_v - 2.0 * mean) / (duration * duration);
    [
        x + offset * (v + offset * (square + offset * cube)),
        v + offset * (2.0 * square + offset * (3.0 * cube)),
    ]
}

/// Displacement \[m\] inside the circle and its rate \[m/s\] for q and its rate.
#[inline]
fn in_circle(radius: f64, [[x, vx], [y, vy]]: [PhasePoint; 2]) -> ([f64; 2], [f64; 2]) {
    let s = 0.5 * (x * x + y * y);
    // u = (1 - exp(-s)) / (2 s) and its derivative.
    let (u, slope) = if s < SMALL {
        series(s)
    } else {
        let lost = -exp_m1(-s);
        (0.5 * lost / s, 0.5 * ((1.0 - lost) * s - lost) / (s * s))
    };
    let factor = radius * u.sqrt();
    let rate = 0.5 * factor * slope / u * (x * vx + y * vy);
    (
        [factor * x, factor * y],
        [factor * vx + rate * x, factor * vy + rate * y],
    )
}

/// `(1 - exp(-s)) / (2 s)` and its derivative for small s: `1 / (k + 1)!` times `(-s)^k`, halved.
fn series(s: f64) -> (f64, f64) {
    let (mut value, mut slope, mut term) = (0.0, 0.0, 0.5);
    for k in 0..12 {
        let k = f64::from(k);
        value += term;
        let next = -term / (k + 2.0);
        slope += (k + 1.0) * next;
        term = next * s;
    }
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIBRATION: RandomVibration = RandomVibration {
        radius: 2e-4,
        angular_frequency: 500.0,
        damping_ratio: 0.5,
        seed: 4,
    };

    fn vibrating(disks: u32) -> RandomBottom {
        let mut bottom = RandomBottom::new(VIBRATION, 1.5);
        let disks: Vec<HeldDisk> = (0..disks)
            .map(|index| HeldDisk {
                index,
                place: [f64::from(index), -1.0],
            })
            .collect();
        bottom.hold(&disks);
        bottom
    }

    /// Displacements and velocities at `time` of all disks.
    fn motions(bottom: &mut RandomBottom, time: f64) -> Vec<[f64; 4]> {
        let mut motions = Vec::new();
        bottom.move_disks(time, |index, [x, y], [vx, vy]| {
            motions.push([x - index as f64, y + 1.0, vx, vy]);
        });
        motions
    }

    /// Shares of radii and of directions are even, by Kolmogorov and Smirnov at the level 1e-4, and no disk leaves its circle.
    #[test]
    fn a_disk_is_anywhere_in_its_circle() {
        let mut bottom = vibrating(400);
        let (mut areas, mut directions) = (Vec::new(), Vec::new());
        for sample in 1..=50 {
            // Six correlation times 1 / (c omega) apart.
            for [x, y, ..] in motions(&mut bottom, 1.5 + 0.024 * f64::from(sample)) {
                areas.push((x * x + y * y) / VIBRATION.radius.powi(2));
                directions.push(y.atan2(x) / TAU + 0.5);
            }
        }
        for shares in [&mut areas, &mut directions] {
            assert!(shares.iter().all(|share| (0.0..1.0).contains(share)));
            shares.sort_by(f64::total_cmp);
            let count = shares.len() as f64;
            let distance = shares
                .iter()
                .enumerate()
                .map(|(index, share)| (share - (index as f64 + 0.5) / count).abs())
                .fold(0.0, f64::max);
            assert!(distance < 2.23 / count.sqrt(), "{}", distance * count.sqrt());
        }
    }

    /// Velocities are the rates of the places, near the centre and far out, across ends of cells.
    #[test]
    fn velocities_are_rates_of_places() {
        let mut bottom = vibrating(40);
        let step = 1e-8;
        for sample in 1..200 {
            let time = 1.5 + 1.03e-4 * f64::from(sample);
            let before = motions(&mut bottom, time - step);
            let now = motions(&mut bottom, time);
            let after = motions(&mut bottom, time + step);
            for ((before, now), after) in before.iter().zip(&now).zip(&after) {
                for axis in 0..2 {
                    let rate = (after[axis] - before[axis]) / (2.0 * step);
                    assert!(
                        (rate - now[axis + 2]).abs() < 1e-5 * VIBRATION.radius * VIBRATION.angular_frequency + 1e-7
                    );
                }
            }
        }
    }

    /// They start at rest at their places, and the series meets the closed form.
    #[test]
    fn the_start_is_smooth_and_so_is_the_way_out_of_the_centre() {
        assert!(
            motions(&mut vibrating(3), 1.5)
                .iter()
                .flatten()
                .all(|number| *number == 0.0)
        );
        let (value, slope) = series(SMALL);
        let lost = -(-SMALL).exp_m1();
        assert!((value - 0.5 * lost / SMALL).abs() < 1e-15);
        assert!((slope - 0.5 * ((1.0 - lost) * SMALL - lost) / (SMALL * SMALL)).abs() < 1e-14);
        assert_eq!(series(0.0), (0.5, -0.25));
    }
}
