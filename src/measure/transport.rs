//! Transport: positions of the disks in, without jumps at the edges of a periodic cell; their mean velocity since a mark
//! out, with its error and spread.
//!
//! A displacement over a time is an exact time average of the velocity. The standard error is that of batch means
//! ([`super::BatchMeans`]), which know the memory of the flow only if it is shorter than a batch: see
//! [`Transport::FIRST_BATCH`].

use serde::{Deserialize, Serialize};

use crate::clone_in_place::clone_in_place;
use crate::elementary::powi;
use crate::error::are_sane;

use super::BatchMeans;

/// Mean horizontal velocity since a mark.
///
/// It is the duty of the caller to [`Transport::record`] at each [`Transport::due`] time.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct Transport {
    /// Start of the average \[s\].
    mark: f64,
    /// Position of each disk at the mark \[m\]; none before.
    positions: Vec<f64>,
    /// Work of the base on the disks until the mark \[J\].
    work: f64,
    /// Mean displacement since the mark, at the ends of batches.
    batches: BatchMeans,
}

clone_in_place!(Transport {
    mark,
    positions,
    work,
    batches
});

impl Transport {
    /// First duration of a batch \[s\]; it doubles as the average goes on.
    pub const FIRST_BATCH: f64 = 0.1;

    /// An average from `mark` \[s\] on.
    pub fn new(mark: f64) -> Self {
        Self {
            mark,
            positions: Vec::new(),
            work: 0.0,
            batches: BatchMeans::new(mark, Self::FIRST_BATCH),
        }
    }

    /// Becomes an average from `mark` \[s\] on, in the memory that it has.
    pub fn restart(&mut self, mark: f64) {
        let mut positions = std::mem::take(&mut self.positions);
        positions.clear();
        *self = Self {
            positions,
            ..Self::new(mark)
        };
    }

    /// Makes room for as many disks, so that nothing is allocated when they are recorded first.
    pub fn make_room(&mut self, disks: usize) {
        self.positions.reserve(disks.saturating_sub(self.positions.len()));
    }

    /// Time \[s\] at which the disks have to be recorded next; the first is the mark.
    pub fn due(&self) -> f64 {
        self.batches.due()
    }

    /// Whether the mark is past and was recorded.
    pub fn has_begun(&self) -> bool {
        !self.positions.is_empty()
    }

    /// Takes the positions \[m\] at the time that was due, and the work \[J\] of the base so far.
    pub fn record(&mut self, positions: impl ExactSizeIterator<Item = f64>, work: f64) {
        if self.positions.is_empty() {
            self.positions.extend(positions);
            self.work = work;
            self.batches.record(0.0);
        } else {
            let displacement = self.mean_displacement(positions);
            self.batches.record(displacement);
        }
    }

    /// Mean velocity \[m/s\] from the mark to `time` \[s\], when the disks are at `positions` \[m\]; 0 before and at the mark.
    pub fn velocity(&self, time: f64, positions: impl Iterator<Item = f64>) -> f64 {
        self.duration(time)
            .map_or(0.0, |duration| self.mean_displacement(positions) / duration)
    }

    /// Standard error of [`Transport::velocity`] \[m/s\]; 0 until there are enough batches.
    pub fn standard_error(&self, time: f64) -> f64 {
        self.duration(time).map_or(0.0, |_| self.batches.standard_error())
    }

    /// Standard deviation over the disks (n - 1) of each one's own mean velocity \[m/s\]; 0 for one disk.
    pub fn spread(&self, time: f64, positions: impl Iterator<Item = f64> + Clone) -> f64 {
        let Some(duration) = self.duration(time) else {
            return 0.0;
        };
        let displacement = self.mean_displacement(positions.clone());
        let squares: f64 = positions
            .zip(&self.positions)
            .map(|(position, start)| powi(position - start - displacement, 2))
            .sum();
        let others = self.positions.len().saturating_sub(1).max(1) as f64;
        (squares / others).sqrt() / duration
    }

    /// Mean power of the base \[W\] from the mark to `time` \[s\], when it has done `work` \[J\]; 0 before and at the mark.
    pub fn mean_power(&self, time: f64, work: f64) -> f64 {
        self.duration(time)
            .map_or(0.0, |duration| (work - self.work) / duration)
    }

    /// Time \[s\] since the mark, once it is past.
    fn duration(&self, time: f64) -> Option<f64> {
        let duration = time - self.mark;
        (self.has_begun() && duration > 0.0).then_some(duration)
    }

    /// Whether this can be the average of a run of `count` disks at `time` \[s\]: what is read back may be anything.
    pub fn is_sound(&self, count: usize, time: f64) -> bool {
        let begun = self.positions.len() == count && self.mark <= time && self.batches.due() > time;
        // At the mark itself the positions are taken by the step that begins there.
        let waits = self.positions.is_empty() && self.mark >= time;
        let numbers = self.positions.iter().copied().chain([self.mark, self.work]);
        let same_start = BatchMeans::new(self.mark, Self::FIRST_BATCH);
        (begun || waits) && are_sane(numbers) && self.batches.continues(&same_start, Self::FIRST_BATCH)
    }

    fn mean_displacement(&self, positions: impl Iterator<Item = f64>) -> f64 {
        let pairs = positions.zip(&self.positions);
        pairs.map(|(position, start)| position - start).sum::<f64>() / self.positions.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three disks at 1, 2 and 6 m/s: mean 3, deviations -2, -1 and 3, variance 14 / 2.
    #[test]
    fn means_and_spread_of_even_motion_are_exact() {
        let positions = |time: f64| [1.0, 2.0, 6.0].map(|velocity| 0.25 + velocity * time).into_iter();
        let mut transport = Transport::new(2.0);
        assert!(transport.is_sound(3, 1.0) && transport.is_sound(3, 2.0) && !transport.is_sound(3, 2.5));
        let averages = |transport: &Transport, time: f64, work: f64| {
            let (velocity, spread) = (
                transport.velocity(time, positions(time)),
                transport.spread(time, positions(time)),
            );
            let power = transport.mean_power(time, work);
            [velocity, transport.standard_error(time), spread, power]
        };
        assert_eq!(averages(&transport, 1.0, 5.0), [0.0; 4]);
        while transport.due() <= 12.0 {
            let due = transport.due();
            transport.record(positions(due), 7.0 * due);
        }
        assert!(transport.is_sound(3, 12.0) && !transport.is_sound(2, 12.0) && !transport.is_sound(3, 14.0));
        let [velocity, standard_error, spread, power] = averages(&transport, 12.0, 84.0);
        assert!((velocity - 3.0).abs() < 1e-14 && standard_error < 1e-13);
        assert!((spread - 7.0_f64.sqrt()).abs() < 1e-14 && (power - 7.0).abs() < 1e-14);
    }
}
