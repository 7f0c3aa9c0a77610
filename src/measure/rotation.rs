//! Rotation of disks: angles at even intervals since a mark in, mean angular velocities and how steady they are out
//! (P 3.1).
//!
//! Per disk only sums are kept. They are sums of deviations from the mean so far (B. P. Welford, Technometrics 4, 419
//! (1962)), since differences of plain sums of squares lose the digits that tell a steady rotation from a perfect one.

use serde::{Deserialize, Serialize};

use crate::clone_in_place::clone_in_place;
use crate::elementary::powi;
use crate::engine::dem::Sampler;
use crate::error::are_sane;

/// Rotation of each disk since a mark.
///
/// It is the duty of the caller to [`Rotation::record`] the angles at each [`Rotation::due`] time. What is computed from
/// them holds until the last of these times, and is 0 before the second.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct Rotation {
    /// Time of the first sample \[s\].
    mark: f64,
    /// Time from one sample to the next \[s\].
    interval: f64,
    /// Samples taken.
    samples: u64,
    /// The angular path of each disk.
    paths: Vec<AngularPath>,
}

clone_in_place!(Rotation {
    mark,
    interval,
    samples,
    paths
});

/// Sums over the samples `theta_0` to `theta_n` of the angle of one disk.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct AngularPath {
    /// First sample \[rad\].
    first: f64,
    /// Last sample \[rad\].
    last: f64,
    /// Mean of the samples \[rad\].
    mean: f64,
    /// Sum of the squared deviations of the samples from their mean \[rad2\].
    squares: f64,
    /// Sum of the deviations of the samples times those of their numbers 0 to n \[rad\].
    products: f64,
    /// Sum of the squared deviations of the angles turned in an interval from their mean \[rad2\].
    increment_squares: f64,
}

impl AngularPath {
    /// Takes the sample that comes after `intervals` intervals.
    fn record(&mut self, angle: f64, intervals: u64) {
        if intervals == 0 {
            (self.first, self.last, self.mean) = (angle, angle, angle);
            return;
        }
        let (number, former) = (intervals as f64, (intervals - 1) as f64);
        let mean_increment = (self.last - self.first) / former.max(1.0);
        let deviation = angle - self.last - mean_increment;
        self.increment_squares += deviation * deviation * (former / number);
        let deviation = angle - self.mean;
        self.mean += deviation / (number + 1.0);
        self.squares += deviation * deviation * (number / (number + 1.0));
        // The mean of the numbers 0 to n is n / 2.
        self.products += 0.5 * number * deviation;
        self.last = angle;
    }

    fn excursion(&self) -> f64 {
        self.last - self.first
    }

    /// Squared correlation of the samples with their numbers, whose squared deviations add up to n (n + 1) (n + 2) / 12.
    fn correlation(&self, intervals: f64) -> f64 {
        let scale = self.squares * (intervals * (intervals + 1.0) * (intervals + 2.0) / 12.0);
        if scale > 0.0 {
            (self.products * self.products / scale).min(1.0)
        } else {
            0.0
        }
    }

    /// Whether these can be sums at all: what is read back may be anything.
    fn is_sound(&self) -> bool {
        // A negative sum of squares has no root.
        let deviations = [self.squares.sqrt(), self.increment_squares.sqrt()];
        are_sane([self.first, self.last, self.mean, self.products]) && are_sane(deviations)
    }
}

impl Rotation {
    /// Rotation of `disks` disks, sampled at `mark` \[s\] and every `interval` \[s\] from then on.
    pub fn new(disks: usize, mark: f64, interval: f64) -> Self {
        Self {
            mark,
            interval,
            samples: 0,
            paths: vec![AngularPath::default(); disks],
        }
    }

    /// Time \[s\] at which the angles have to be recorded next; the first is the mark.
    #[inline]
    pub fn due(&self) -> f64 {
        self.time_of(self.samples)
    }

    /// Never a running sum.
    fn time_of(&self, sample: u64) -> f64 {
        self.mark + sample as f64 * self.interval
    }

    /// Takes the angles \[rad\], unwrapped, of all disks at the time that was due.
    pub fn record(&mut self, angles: impl Iterator<Item = f64>) {
        for (path, angle) in self.paths.iter_mut().zip(angles) {
            path.record(angle, self.samples);
        }
        self.samples += 1;
    }

    /// Intervals between samples, once there is one.
    fn intervals(&self) -> Option<f64> {
        (self.samples > 1).then(|| (self.samples - 1) as f64)
    }

    /// Mean over the disks of what is computed from a path and the number of its intervals; 0 before there is one.
    fn mean(&self, of: impl Fn(&AngularPath, f64) -> f64) -> f64 {
        let Some(intervals) = self.intervals() else {
            return 0.0;
        };
        let sum: f64 = self.paths.iter().map(|path| of(path, intervals)).sum();
        sum / self.paths.len() as f64
    }

    fn velocity(&self, path: &AngularPath, intervals: f64) -> f64 {
        path.excursion() / (intervals * self.interval)
    }

    /// Population variance \[rad2/s2\] of the mean angular velocities in the intervals.
    fn variance(&self, path: &AngularPath, intervals: f64) -> f64 {
        path.increment_squares / (intervals * self.interval * self.interval)
    }

    fn deviation(&self, path: &AngularPath, intervals: f64) -> f64 {
        let deviation = self.variance(path, intervals).sqrt();
        let scale = self.velocity(path, intervals).abs() + deviation;
        if scale > 0.0 { deviation / scale } else { 1.0 }
    }

    /// Mean angular velocity \[rad/s\] of a disk, counted from 0: the whole excursion over its time (P 3.1).
    pub fn mean_angular_velocity(&self, disk: usize) -> f64 {
        self.intervals()
            .map_or(0.0, |intervals| self.velocity(&self.paths[disk], intervals))
    }

    /// Squared correlation `rho^2` of the angle of a disk with time (P 3.1); 0 for a disk that never turned.
    pub fn correlation(&self, disk: usize) -> f64 {
        self.intervals()
            .map_or(0.0, |intervals| self.paths[disk].correlation(intervals))
    }

    /// Adjusted deviation of a disk, `sigma_a = sigma / (|mean| + sigma)` with `sigma` the population standard deviation of
    /// the mean angular velocities in the intervals (P 3.1): 0 steady, 1 all noise; 1 for a disk that never turned.
    pub fn adjusted_deviation(&self, disk: usize) -> f64 {
        self.intervals()
            .map_or(0.0, |intervals| self.deviation(&self.paths[disk], intervals))
    }

    /// Mean over the disks of the squared mean angular velocity \[rad2/s2\].
    pub fn mean_square(&self) -> f64 {
        self.mean(|path, intervals| powi(self.velocity(path, intervals), 2))
    }

    /// The same less what a random walk of the angles adds in a record of n intervals, the variance of the mean of n
    /// independent velocities: `mean^2 - variance / (n - 1)` \[rad2/s2\], which may be negative. 0 before two intervals.
    pub fn persistent_mean_square(&self) -> f64 {
        if self.samples < 3 {
            return 0.0;
        }
        self.mean(|path, intervals| {
            let walk = self.variance(path, intervals) / (intervals - 1.0);
            powi(self.velocity(path, intervals), 2) - walk
        })
    }

    /// Mean over the disks of [`Self::correlation`].
    pub fn mean_correlation(&self) -> f64 {
        self.mean(AngularPath::correlation)
    }

    /// Mean over the disks of [`Self::adjusted_deviation`].
    pub fn mean_adjusted_deviation(&self) -> f64 {
        self.mean(|path, intervals| self.deviation(path, intervals))
    }

    /// Share of the disks whose [`Self::correlation`] is above `correlation`.
    pub fn share_above(&self, correlation: f64) -> f64 {
        self.mean(|path, intervals| f64::from(u8::from(path.correlation(intervals) > correlation)))
    }

    /// Largest magnitude of a disk's mean angular velocity \[rad/s\].
    pub fn fastest(&self) -> f64 {
        let speeds = (0..self.paths.len()).map(|disk| self.mean_angular_velocity(disk).abs());
        speeds.fold(0.0, f64::max)
    }

    /// Whether this can be the record of the same run as `own` at `time` \[s\]: what is read back may be anything.
    pub fn continues(&self, own: &Self, time: f64) -> bool {
        let same = (self.mark, self.interval, self.paths.len()) == (own.mark, own.interval, own.paths.len());
        let taken = match self.samples.checked_sub(1) {
            Some(last) => self.time_of(last) <= time && self.due() > time,
            // At the mark itself the angles are taken by the step that begins there.
            None => self.mark >= time,
        };
        same && taken && self.paths.iter().all(AngularPath::is_sound)
    }
}

impl Sampler for Rotation {
    fn due(&self) -> f64 {
        Self::due(self)
    }

    fn samples_until(&self, end_time: f64) -> f64 {
        let ahead = end_time - self.due();
        if ahead < 0.0 {
            0.0
        } else {
            (ahead / self.interval).floor() + 1.0
        }
    }

    fn take(&mut self, positions: &[[f64; 3]]) {
        self.record(positions.iter().map(|[_, _, angle]| *angle));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    /// Rotation of one disk with these angles \[rad\], half a second apart from 3 s on.
    fn of(angles: &[f64]) -> Rotation {
        let mut rotation = Rotation::new(1, 3.0, 0.5);
        for angle in angles {
            rotation.record([*angle].into_iter());
        }
        rotation
    }

    fn all(rotation: &Rotation) -> [f64; 7] {
        [
            rotation.mean_angular_velocity(0),
            rotation.correlation(0),
            rotation.adjusted_deviation(0),
            rotation.mean_square(),
            rotation.persistent_mean_square(),
            rotation.share_above(0.95),
            rotation.fastest(),
        ]
    }

    /// Angles 1, 3, 0, 6 rad: excursion 5 rad in 1.5 s, velocities 4, -6 and 12 rad/s with mean 10/3 and variance 488/9;
    /// products of deviations 6.5 and squares 21 of the angles, 5 of the numbers.
    #[test]
    fn four_samples_give_what_is_worked_out_by_hand() {
        let rotation = of(&[1.0, 3.0, 0.0, 6.0]);
        let (mean, variance) = (10.0_f64 / 3.0, 488.0_f64 / 9.0);
        let expected = [
            mean,
            6.0 * 6.0 / (21.0 * 5.0),
            variance.sqrt() / (mean + variance.sqrt()),
            mean * mean,
            mean * mean - variance / 2.0,
            0.0,
            mean,
        ];
        for (found, expected) in all(&rotation).into_iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-14 * expected.abs().max(1.0),
                "{found} {expected}"
            );
        }
    }

    #[test]
    fn an_even_rotation_is_steady_to_rounding_after_a_large_angle() {
        let angles: Vec<f64> = (0..900).map(|index| 1e4 - 0.25 * f64::from(index)).collect();
        let rotation = of(&angles);
        assert_eq!(rotation.mean_angular_velocity(0), -0.5);
        assert!(rotation.correlation(0) > 1.0 - 1e-12 && rotation.correlation(0) <= 1.0);
        assert!(rotation.adjusted_deviation(0) < 1e-12 && rotation.share_above(0.95) == 1.0);
        assert!((rotation.persistent_mean_square() - 0.25).abs() < 1e-14 && rotation.fastest() == 0.5);
    }

    #[test]
    fn nothing_is_known_before_the_second_sample_and_a_disk_at_rest_is_all_noise() {
        for angles in [&[][..], &[0.7]] {
            assert_eq!(all(&of(angles)), [0.0; 7]);
        }
        assert_eq!(all(&of(&[0.7, 1.2])), [1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0]);
        assert_eq!(all(&of(&[0.7; 5])), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    }

    /// Random walks of n steps of variance 1/3 rad2 with a drift: the plain mean square has the drift and a part in n of the
    /// steps, the persistent one the drift alone.
    #[test]
    fn a_random_walk_adds_nothing_to_the_persistent_mean_square() {
        const DISKS: usize = 20_000;
        for drift in [0.0, 0.2] {
            let mut generator = rand_pcg::Pcg64::seed_from_u64(7);
            let mut rotation = Rotation::new(DISKS, 0.0, 1.0);
            let mut angles = vec![0.0; DISKS];
            rotation.record(angles.iter().copied());
            for _ in 0..20 {
                angles
                    .iter_mut()
                    .for_each(|angle| *angle += drift + generator.random_range(-1.0..1.0));
                rotation.record(angles.iter().copied());
            }
            let square = drift * drift;
            let walk = 1.0 / 60.0;
            assert!((rotation.mean_square() - square - walk).abs() < 1e-3);
            assert!((rotation.persistent_mean_square() - square).abs() < 1e-3);
        }
    }

    #[test]
    fn samples_are_due_at_multiples_of_the_interval() {
        let mut rotation = Rotation::new(1, 0.1, 0.1);
        assert_eq!(
            [0.0, 0.1, 0.15, 0.25].map(|time| rotation.samples_until(time)),
            [0.0, 1.0, 1.0, 2.0]
        );
        for sample in 0..1000 {
            assert_eq!(rotation.due(), 0.1 + f64::from(sample) * 0.1);
            rotation.record([0.0].into_iter());
        }
    }

    #[test]
    fn records_of_other_runs_times_and_numbers_are_not_continued() {
        let (own, rotation) = (of(&[]), of(&[0.0, 1.0]));
        assert!(own.continues(&own, 2.0) && own.continues(&own, 3.0) && !own.continues(&own, 3.1));
        assert!(rotation.continues(&own, 3.5) && rotation.continues(&own, 3.9));
        assert!(!rotation.continues(&own, 3.4) && !rotation.continues(&own, 4.0));
        for other in [
            Rotation::new(2, 3.0, 0.5),
            Rotation::new(1, 3.1, 0.5),
            Rotation::new(1, 3.0, 0.4),
        ] {
            assert!(!rotation.continues(&other, 3.5));
        }
        let damaged = |change: fn(&mut AngularPath)| {
            let mut rotation = rotation.clone();
            change(&mut rotation.paths[0]);
            !rotation.continues(&own, 3.5)
        };
        assert!(damaged(|path| path.last = f64::NAN) && damaged(|path| path.products = 1e200));
        assert!(damaged(|path| path.squares = -1.0) && damaged(|path| path.increment_squares = f64::INFINITY));
    }
}
