//! Polynomials through samples: Newton's form by divided differences, and powers of time.

use serde::{Deserialize, Serialize};

use super::{InputSample, MOST_VALUES};

/// Coefficients of a polynomial at most: degree five.
pub const MOST_COEFFICIENTS: usize = 6;

/// A polynomial in Newton's form about the last sample: its first coefficients are those of the polynomials through fewer.
pub(super) struct Newton {
    /// Time of the last sample \[s\].
    pub(super) origin: f64,
    /// Times of the values less `origin` \[s\], the last sample first, so that they keep their digits in long runs.
    pub(super) nodes: [f64; MOST_COEFFICIENTS],
    pub(super) coefficients: [f64; MOST_COEFFICIENTS],
    pub(super) count: usize,
}

impl Newton {
    /// Through `values` values of each of the last samples, with at most `most` coefficients.
    pub(super) fn through(samples: &[InputSample], values: usize, most: usize) -> Self {
        let count = most.min(values * samples.len());
        let origin = samples.last().map_or(0.0, |sample| sample.time);
        let sample = |index: usize| &samples[samples.len() - 1 - index / values];
        let (mut nodes, mut differences) = ([0.0; MOST_COEFFICIENTS], [0.0; MOST_COEFFICIENTS]);
        for index in 0..count {
            nodes[index] = sample(index).time - origin;
            differences[index] = sample(index).values[0];
        }
        for order in 1..count {
            for index in (order..count).rev() {
                // Values of one sample: the rate over the factorial of its order.
                differences[index] = if index / values == (index - order) / values {
                    sample(index).values[order] / if order == 2 { 2.0 } else { 1.0 }
                } else {
                    (differences[index] - differences[index - 1]) / (nodes[index] - nodes[index - order])
                };
            }
        }
        Self {
            origin,
            nodes,
            coefficients: differences,
            count,
        }
    }

    /// The same in powers of the time since the last sample.
    pub(super) fn expanded(&self) -> Extrapolation {
        let mut coefficients = [0.0; MOST_COEFFICIENTS];
        for index in (0..self.count).rev() {
            for power in (0..MOST_COEFFICIENTS).rev() {
                let lower = if power > 0 {
                    coefficients[power - 1]
                } else {
                    self.coefficients[index]
                };
                coefficients[power] = lower - self.nodes[index] * coefficients[power];
            }
        }
        Extrapolation {
            since: self.origin,
            coefficients,
        }
    }
}

/// A polynomial in time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Extrapolation {
    /// Time of the last sample \[s\].
    pub since: f64,
    /// Coefficients of 1, t, ..., t^5 with t the time since then \[s\].
    pub coefficients: [f64; MOST_COEFFICIENTS],
}

impl Extrapolation {
    /// Coefficients of 1, t, ..., t^5 with t the time since `origin` \[s\].
    pub fn counted_from(&self, origin: f64) -> [f64; MOST_COEFFICIENTS] {
        let shift = origin - self.since;
        let mut coefficients = self.coefficients;
        // Horner's scheme again and again: division by (t' - shift).
        for first in 0..MOST_COEFFICIENTS - 1 {
            for index in (first..MOST_COEFFICIENTS - 1).rev() {
                coefficients[index] += shift * coefficients[index + 1];
            }
        }
        coefficients
    }

    /// The quantity and its first and second rate at `time` \[s\].
    pub fn at(&self, time: f64) -> [f64; MOST_VALUES] {
        let t = time - self.since;
        let (mut value, mut slope, mut half_curvature) = (0.0, 0.0, 0.0);
        for coefficient in self.coefficients.iter().rev() {
            half_curvature = half_curvature * t + slope;
            slope = slope * t + value;
            value = value * t + coefficient;
        }
        [value, slope, 2.0 * half_curvature]
    }
}
