//! Mean rate of a growing quantity with its standard error, in memory that does not grow.
//!
//! A quantity such as an angle is read at the ends of batches of equal duration. When there are [`BatchMeans::MOST`] of
//! them they are merged in pairs and the next ones last twice as long, so that after a short while there are always
//! between half of that and all of it, each much longer than the memory of the process. Their scatter gives the error of
//! the mean: `s / sqrt(n)` with s the standard deviation of n batch means.
//! Source: batch means, S. Asmussen and P. Glynn, Stochastic Simulation (Springer 2007), section IV.5.

use std::ops::Deref;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::elementary::powi;
use crate::error::are_sane;

/// Running mean rate and its standard error.
///
/// It is the duty of the caller to [`BatchMeans::record`] the quantity at each [`BatchMeans::due`] time, which are
/// multiples of the first duration after the start and depend on nothing else.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BatchMeans {
    start: f64,
    /// Duration of a batch \[s\].
    duration: f64,
    /// The quantity at the start and at the end of each batch.
    readings: Readings,
}

/// Most readings: one more than batches, whereupon these are merged.
const MOST_READINGS: usize = BatchMeans::MOST + 1;

/// Numbers in place, so that a copy of the means, which every step makes, allocates nothing. Saved as a sequence.
#[derive(Clone, Copy)]
struct Readings {
    numbers: [f64; MOST_READINGS],
    count: usize,
}

impl Readings {
    const NONE: Self = Self {
        numbers: [0.0; MOST_READINGS],
        count: 0,
    };

    fn push(&mut self, number: f64) {
        self.numbers[self.count] = number;
        self.count += 1;
    }

    /// Keeps the first and every second one after it.
    fn halve(&mut self) {
        self.count = self.count.div_ceil(2);
        for index in 0..self.count {
            self.numbers[index] = self.numbers[2 * index];
        }
    }
}

impl Deref for Readings {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
}

impl PartialEq for Readings {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl std::fmt::Debug for Readings {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        (**self).fmt(formatter)
    }
}

impl Serialize for Readings {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (**self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Readings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let given = Vec::<f64>::deserialize(deserializer)?;
        if given.len() > MOST_READINGS {
            return Err(serde::de::Error::invalid_length(given.len(), &"readings of batches"));
        }
        let mut readings = Self::NONE;
        given.into_iter().for_each(|number| readings.push(number));
        Ok(readings)
    }
}

impl BatchMeans {
    /// Largest number of batches.
    pub const MOST: usize = 64;
    /// Batches that a standard error needs.
    pub const FEWEST: usize = 8;

    /// Batches from `start` \[s\] on, the first ones of `duration` \[s\].
    pub fn new(start: f64, duration: f64) -> Self {
        Self {
            start,
            duration,
            readings: Readings::NONE,
        }
    }

    /// Time \[s\] at which the quantity has to be recorded next.
    #[inline]
    pub fn due(&self) -> f64 {
        self.start + self.readings.len() as f64 * self.duration
    }

    /// Takes the quantity at the time that was due.
    pub fn record(&mut self, quantity: f64) {
        self.readings.push(quantity);
        if self.readings.len() > Self::MOST {
            self.readings.halve();
            self.duration *= 2.0;
        }
    }

    /// Mean rate from the start until `time` \[s\], when the quantity is `quantity`. 0 before and at the start.
    pub fn mean(&self, time: f64, quantity: f64) -> f64 {
        match self.readings.first() {
            Some(first) if time > self.start => (quantity - first) / (time - self.start),
            _ => 0.0,
        }
    }

    /// Standard error of the mean rate; 0 before [`BatchMeans::FEWEST`] batches are complete.
    pub fn standard_error(&self) -> f64 {
        let count = self.readings.len().saturating_sub(1);
        if count < Self::FEWEST {
            return 0.0;
        }
        let rate = |pair: &[f64]| (pair[1] - pair[0]) / self.duration;
        let mean = self.readings.windows(2).map(rate).sum::<f64>() / count as f64;
        let squares = self
            .readings
            .windows(2)
            .map(|pair| powi(rate(pair) - mean, 2))
            .sum::<f64>();
        (squares / (count as f64 * (count as f64 - 1.0))).sqrt()
    }

    /// Whether these can be batches at all: what is read back from bytes may be anything.
    pub fn is_sound(&self) -> bool {
        let finite = self
            .readings
            .iter()
            .chain([&self.start])
            .all(|number| number.is_finite());
        finite && self.readings.len() <= Self::MOST && self.duration > 0.0 && self.duration.is_finite()
    }

    /// Whether these can be later or earlier batches of the same run as `own`, whose first ones lasted `first` \[s\].
    pub fn continues(&self, own: &Self, first: f64) -> bool {
        let sane = are_sane(self.readings.iter().copied().chain([self.duration]));
        self.is_sound() && sane && self.start == own.start && self.duration >= first
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    /// Mean and standard error of an AR(1) series `x' = rho x + noise` (uniform noise, variance 1/3) of `length` steps.
    fn of_series(memory: f64, length: u32, seed: u64) -> (f64, f64) {
        let mut generator = rand_pcg::Pcg64::seed_from_u64(seed);
        let (mut value, mut sum) = (0.0, 0.0);
        let mut batches = BatchMeans::new(0.0, 1.0);
        batches.record(0.0);
        for step in 1..=length {
            value = memory * value + generator.random_range(-1.0..1.0);
            sum += value;
            if f64::from(step) == batches.due() {
                batches.record(sum);
            }
        }
        (batches.mean(f64::from(length), sum), batches.standard_error())
    }

    /// The mean of n steps has the variance `sigma^2 / (n (1 - rho)^2)`; independent samples would give less by
    /// `(1 + rho) / (1 - rho)`.
    #[test]
    fn errors_of_a_series_with_memory_are_right() {
        for memory in [0.0, 0.9] {
            let length = 40_000;
            let runs: Vec<(f64, f64)> = (1..=60).map(|seed| of_series(memory, length, seed)).collect();
            let known = (1.0 / 3.0 / f64::from(length)).sqrt() / (1.0 - memory);
            let estimated = (runs.iter().map(|(_, error)| error * error).sum::<f64>() / 60.0).sqrt();
            let scatter = (runs.iter().map(|(mean, _)| mean * mean).sum::<f64>() / 60.0).sqrt();
            assert!(
                (estimated / known - 1.0).abs() < 0.1,
                "memory {memory}: {estimated} for {known}"
            );
            assert!(
                (scatter / known - 1.0).abs() < 0.3,
                "memory {memory}: {scatter} for {known}"
            );
        }
    }

    #[test]
    fn memory_is_flat_and_merging_loses_nothing() {
        let mut batches = BatchMeans::new(3.0, 0.5);
        let quantity = |time: f64| 2.0 * (time - 3.0) + 0.1 * (40.0 * time).sin();
        assert_eq!((batches.mean(3.0, 1.0), batches.standard_error()), (0.0, 0.0));
        while batches.due() < 5000.0 {
            batches.record(quantity(batches.due()));
            assert!(batches.readings.len() <= BatchMeans::MOST && batches.is_sound());
        }
        assert!(batches.readings.len() > BatchMeans::MOST / 2);
        assert!((batches.mean(5000.0, quantity(5000.0)) - 2.0).abs() < 1e-4);
        assert!(batches.standard_error() < 1e-3);
    }
}
