//! What inputs will be until the end of a communication step: samples of a quantity and its rates in, a polynomial out.
//!
//! Every candidate is the polynomial through the last few samples, with as many of their rates as are given (Hermite
//! interpolation by divided differences). When a sample arrives, each candidate is charged with the error of what it would
//! have predicted, as a multiple of the product that the error of interpolation is proportional to; so errors of steps of
//! different lengths compare. The next extrapolation is by the lowest of those that are expected to do well: a smooth
//! quantity is followed with degree five, and where it jumps, is noisy or knocked, the degree falls by itself.
//!
//! Sources: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, III.5 (variable-order formulas by
//! divided differences); J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, 2.1.5 (Hermite interpolation).

mod polynomial;

use crate::elementary::powi;
use serde::{Deserialize, Serialize};

use polynomial::Newton;
pub use polynomial::{Extrapolation, MOST_COEFFICIENTS};

/// Values of a sample at most: a quantity, its rate, and the rate of that.
pub const MOST_VALUES: usize = 3;
/// Samples that are kept.
const MOST_SAMPLES: usize = 6;
/// Part of its former errors that a candidate is still charged with when the next sample arrives. With this and the next
/// constant white noise is extrapolated no worse than by linear prediction, and a plate with a bouncing grain best.
const MEMORY: f64 = 0.8;
/// A lower candidate is preferred to the best one until its expected error is this many times greater.
const PREFERENCE: f64 = 1.5;

/// An input at a communication point.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct InputSample {
    /// Time \[s\].
    pub time: f64,
    /// The quantity and its first and second rate, in SI units; those that an importer never sets are zero.
    pub values: [f64; MOST_VALUES],
}

/// A polynomial through the last `points` samples and `values` values of each: 1 the quantity alone, 3 both rates too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Candidate {
    points: usize,
    values: usize,
}

impl Candidate {
    const fn coefficients(self) -> usize {
        self.points * self.values
    }
}

/// From low to high degree; of one degree those of fewer samples first, since they forget a jump sooner.
const CANDIDATES: [Candidate; 11] = [
    candidate(1, 1),
    candidate(1, 2),
    candidate(2, 1),
    candidate(1, 3),
    candidate(3, 1),
    candidate(2, 2),
    candidate(4, 1),
    candidate(5, 1),
    candidate(2, 3),
    candidate(3, 2),
    candidate(6, 1),
];

/// Index of the candidate that holds the last sample.
const CONSTANT: usize = index_of(1, 1);
/// Index of the candidate that goes on at the rate of the last sample.
const LINEAR: usize = index_of(1, 2);

const fn candidate(points: usize, values: usize) -> Candidate {
    Candidate { points, values }
}

/// Degree of extrapolation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Degree {
    /// The one that would have predicted the last samples well.
    Automatic,
    /// The highest that the samples support up to this one; 0 holds the input.
    AtMost(u8),
}

/// A rate that is not the rate of what it should be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contradiction {
    /// Which value of a sample it is: 1 or 2.
    pub rate: usize,
    /// Time of the last sample \[s\].
    pub time: f64,
    /// Mean of the rate in the last two samples.
    pub given: f64,
    /// Change between them over the time between them.
    pub found: f64,
}

/// The last samples of an input, and how well each candidate predicted them. Part of the state.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct InputHistory {
    /// The last one last.
    samples: [InputSample; MOST_SAMPLES],
    count: u8,
    /// Which rates are given: those that were not zero in every sample so far.
    given: [bool; MOST_VALUES - 1],
    /// The last sample was repeated and has been taken for one that is missing.
    missed: bool,
    /// Time \[s\] by which the extrapolation lags behind the samples: after a repetition of which it is not known whether the input
    /// has stopped or a sample is missing.
    lag: f64,
    /// Errors of each candidate, which fade, over the product of the times to its samples; below zero if it has predicted none yet.
    errors: [f64; CANDIDATES.len()],
    /// How far rates are from the differences of what they are rates of, and how large these are; sums that fade.
    contradictions: [[f64; 2]; MOST_VALUES - 1],
}

impl InputHistory {
    /// The samples, the last one last.
    pub fn samples(&self) -> &[InputSample] {
        // States come from outside: no count may lead beyond the array.
        &self.samples[..usize::from(self.count).min(MOST_SAMPLES)]
    }

    /// Takes a sample. One at the time of the last sample, or before, replaces it.
    ///
    /// A first repetition of a sample bit by bit, although it has a rate, is a sample that is missing: what moves does not
    /// stay. It is left out, and the extrapolation goes on from those before. Where no rate is given the input may have stopped as
    /// well, or be at a crest: if it was expected to move on by half of its last move, the extrapolation goes on as if the time
    /// since the last sample had not passed.
    pub fn record(&mut self, sample: InputSample) {
        let last = self.samples().last().copied();
        if let Some(last) = last
            && sample.time > last.time
        {
            let repeated = !self.missed && sample.values == last.values;
            let has_rate = sample.values[1] != 0.0;
            self.missed = repeated && (has_rate || !self.given[0] && self.was_to_move_on(sample.time));
            self.lag = if self.missed && !has_rate {
                sample.time - last.time
            } else {
                0.0
            };
            if self.missed {
                return;
            }
        }
        for (given, rate) in self.given.iter_mut().zip(&sample.values[1..]) {
            *given |= *rate != 0.0;
        }
        match last {
            Some(last) if sample.time <= last.time => self.count -= 1,
            Some(last) => {
                self.charge(&sample);
                self.compare_rates(&last, &sample);
            }
            None => self.errors = [-1.0; CANDIDATES.len()],
        }
        self.push(sample);
    }

    /// Whether the input was expected to move on until `time` \[s\] by half at least of what it moved between the last samples.
    fn was_to_move_on(&self, time: f64) -> bool {
        let [.., before, last] = self.samples() else {
            return false;
        };
        let moved = (last.values[0] - before.values[0]).abs();
        let expected = self.extrapolate(time, Degree::Automatic);
        expected.is_some_and(|expected| (expected.at(time)[0] - last.values[0]).abs() > 0.5 * moved && moved > 0.0)
    }

    fn push(&mut self, sample: InputSample) {
        let count = self.samples().len();
        if count == MOST_SAMPLES {
            self.samples.rotate_left(1);
            self.samples[MOST_SAMPLES - 1] = sample;
        } else {
            self.samples[count] = sample;
            self.count = count as u8 + 1;
        }
    }

    /// Charges every candidate with the error of what it would have predicted at the time of `sample`.
    fn charge(&mut self, sample: &InputSample) {
        for values in 1..=self.values_given() {
            let newton = Newton::through(self.samples(), values, MOST_COEFFICIENTS);
            let step = sample.time - newton.origin;
            let (mut value, mut slope, mut product, mut product_slope) = (0.0, 0.0, 1.0, 0.0);
            for (index, coefficient) in newton.coefficients[..newton.count].iter().enumerate() {
                value += coefficient * product;
                slope += coefficient * product_slope;
                let distance = step - newton.nodes[index];
                (product, product_slope) = (product * distance, product_slope * distance + product);
                if (index + 1) % values != 0 {
                    continue;
                }
                let mut error = (value - sample.values[0]).abs() / step;
                if self.given[0] {
                    error += (slope - sample.values[1]).abs();
                }
                let charged = &mut self.errors[index_of((index + 1) / values, values)];
                *charged = error / product + MEMORY * charged.max(0.0);
            }
        }
    }

    /// Compares each rate with the difference of what it is the rate of.
    fn compare_rates(&mut self, last: &InputSample, sample: &InputSample) {
        let step = sample.time - last.time;
        for (rate, sums) in (1..MOST_VALUES).zip(&mut self.contradictions) {
            if !self.given[rate - 1] {
                continue;
            }
            let difference = (sample.values[rate - 1] - last.values[rate - 1]) / step;
            let (before, now) = (last.values[rate], sample.values[rate]);
            let sizes = [
                (difference - 0.5 * (before + now)).abs(),
                difference.abs().max(before.abs()).max(now.abs()),
            ];
            for (sum, size) in sums.iter_mut().zip(sizes) {
                *sum = 0.9 * *sum + size;
            }
        }
    }

    /// The first rate that has not been the rate of what it should be for some time: its mean over steps is off by more than
    /// half of its size.
    pub fn contradiction(&self) -> Option<Contradiction> {
        let [.., last, now] = self.samples() else { return None };
        let full = self.samples().len() == MOST_SAMPLES;
        let contradicts = |&rate: &usize| {
            let [error, size] = self.contradictions[rate - 1];
            full && error > 0.5 * size
        };
        let rate = (1..MOST_VALUES).find(contradicts)?;
        Some(Contradiction {
            rate,
            time: now.time,
            given: 0.5 * (last.values[rate] + now.values[rate]),
            found: (now.values[rate - 1] - last.values[rate - 1]) / (now.time - last.time),
        })
    }

    /// How many values of a sample may be used: a rate of an unknown one is of no use. Of a single sample all are, since
    /// nothing else says how it goes on.
    fn values_given(&self) -> usize {
        match self.given {
            _ if self.samples().len() == 1 => MOST_VALUES,
            [false, _] => 1,
            [true, false] => 2,
            [true, true] => 3,
        }
    }

    fn supports(&self, candidate: Candidate) -> bool {
        candidate.points <= self.samples().len() && candidate.values <= self.values_given()
    }

    /// The polynomial that the input is expected to follow until `time` \[s\]. None before the first sample.
    pub fn extrapolate(&self, time: f64, degree: Degree) -> Option<Extrapolation> {
        let Candidate { points, values } = match degree {
            Degree::Automatic => self.best(time - self.lag)?,
            Degree::AtMost(degree) => self.highest(usize::from(degree))?,
        };
        let mut extrapolation = Newton::through(self.samples(), values, points * values).expanded();
        extrapolation.since += self.lag;
        Some(extrapolation)
    }

    /// Of the candidates of the highest degree up to `degree` the one of fewest samples.
    fn highest(&self, degree: usize) -> Option<Candidate> {
        let fits = |candidate: &&Candidate| self.supports(**candidate) && candidate.coefficients() <= degree + 1;
        let highest_first = CANDIDATES.iter().rev().filter(fits);
        highest_first.max_by_key(|candidate| candidate.coefficients()).copied()
    }

    /// Whether going on at the rate of the last sample did about as well so far as holding its value.
    fn rate_is_as_good(&self) -> bool {
        let [.., before, last] = self.samples() else {
            return false;
        };
        let step = last.time - before.time;
        let [held, linear] = [self.errors[CONSTANT], self.errors[LINEAR] * step];
        self.supports(CANDIDATES[LINEAR]) && linear >= 0.0 && linear <= PREFERENCE * held
    }

    /// The lowest candidate whose expected error at `time` is not far from the least; before any has predicted a sample, the
    /// highest through one sample.
    fn best(&self, time: f64) -> Option<Candidate> {
        let samples = self.samples();
        let expected = |index: usize| {
            let (candidate, error) = (CANDIDATES[index], self.errors[index]);
            // Beside a negative error also what is not finite is none.
            if !(self.supports(candidate) && error >= 0.0) {
                return f64::INFINITY;
            }
            let used = &samples[samples.len() - candidate.points..];
            let to_samples: f64 = used.iter().map(|sample| time - sample.time).product();
            error * powi(to_samples, candidate.values as i32)
        };
        let errors: [f64; CANDIDATES.len()] = std::array::from_fn(expected);
        let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
        let does_well = |index: &usize| errors[*index] <= PREFERENCE * least;
        if least < f64::INFINITY {
            let lowest = (0..CANDIDATES.len()).find(does_well)?;
            // Where an input has jumped, all have failed alike: a rate that is given counts.
            let chosen = if lowest == CONSTANT && self.rate_is_as_good() {
                LINEAR
            } else {
                lowest
            };
            return Some(CANDIDATES[chosen]);
        }
        let of_one = |candidate: &&Candidate| candidate.points == 1 && self.supports(**candidate);
        CANDIDATES.iter().rfind(of_one).copied()
    }
}

const fn index_of(points: usize, values: usize) -> usize {
    let mut index = 0;
    while index + 1 < CANDIDATES.len() && !(CANDIDATES[index].points == points && CANDIDATES[index].values == values) {
        index += 1;
    }
    index
}

#[cfg(test)]
mod tests;
