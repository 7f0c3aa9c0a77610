//! Butterworth low-pass of any order on samples of a fixed rate: unfiltered samples in, filtered ones out.
//!
//! The bilinear transform of the analog filter, with the frequency of -3 dB put right (prewarped), as second-order sections
//! in transposed direct form II; each has the gain 1 at rest. Source: A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing, 7.

use serde::{Deserialize, Serialize};

/// A section y = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2) x with what it remembers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
    kept: [f64; 2],
}

/// The filter and its state.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct LowPass(Vec<Section>);

impl LowPass {
    /// A filter with -3 dB at `bandwidth` \[Hz\], below half of the `rate` \[Hz\] of its samples.
    pub fn new(order: u32, bandwidth: f64, rate: f64) -> Self {
        let warped = libm::tan(std::f64::consts::PI * bandwidth / rate);
        let pair = |number: u32| {
            // Poles of the analog filter: -sin(angle) +- i cos(angle) times the bandwidth.
            let angle = std::f64::consts::PI * f64::from(2 * number + 1) / f64::from(2 * order);
            let (square, damping) = (warped * warped, 2.0 * libm::sin(angle) * warped);
            let norm = 1.0 / (1.0 + damping + square);
            let b = square * norm;
            Section {
                b: [b, 2.0 * b, b],
                a: [2.0 * (square - 1.0) * norm, (1.0 - damping + square) * norm],
                kept: [0.0; 2],
            }
        };
        let mut sections: Vec<Section> = (0..order / 2).map(pair).collect();
        if order % 2 == 1 {
            let b = warped / (1.0 + warped);
            sections.push(Section {
                b: [b, b, 0.0],
                a: [(warped - 1.0) / (warped + 1.0), 0.0],
                kept: [0.0; 2],
            });
        }
        Self(sections)
    }

    /// Goes to the rest at a constant `value`.
    pub fn rest_at(&mut self, value: f64) {
        for Section { b, a, kept } in &mut self.0 {
            *kept = [(1.0 - b[0]) * value, (b[2] - a[1]) * value];
        }
    }

    /// The filtered sample.
    pub fn filter(&mut self, sample: f64) -> f64 {
        self.0.iter_mut().fold(sample, |x, Section { b, a, kept }| {
            let y = b[0] * x + kept[0];
            *kept = [b[1] * x - a[0] * y + kept[1], b[2] * x - a[1] * y];
            y
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// The definition of the filter: |H|² = 1 / (1 + (tan(pi f / rate) / tan(pi f_3dB / rate))^2n).
    #[test]
    fn amplitudes_are_those_of_a_butterworth_filter() {
        let (bandwidth, rate) = (100.0, 4800.0);
        for order in [1, 2, 3, 4, 7, 8] {
            for frequency in [10.0_f64, 80.0, 100.0, 300.0] {
                let mut filter = LowPass::new(order, bandwidth, rate);
                filter.rest_at(0.0);
                let (mut sine, mut cosine) = (0.0, 0.0);
                for n in 0..96_000 {
                    let phase = TAU * frequency * f64::from(n) / rate;
                    let y = filter.filter(phase.sin());
                    if n >= 48_000 {
                        sine += y * phase.sin();
                        cosine += y * phase.cos();
                    }
                }
                let gain = 2.0 * sine.hypot(cosine) / 48_000.0;
                let warped = |f: f64| (TAU / 2.0 * f / rate).tan();
                let ratio: f64 = warped(frequency) / warped(bandwidth);
                let exact = 1.0 / (1.0 + ratio.powi(2 * i32::try_from(order).unwrap())).sqrt();
                assert!(
                    (gain - exact).abs() < 1e-9,
                    "order {order}, {frequency} Hz: {gain}, exact {exact}"
                );
            }
        }
    }

    #[test]
    fn at_rest_nothing_changes() {
        let mut filter = LowPass::new(5, 100.0, 4800.0);
        filter.rest_at(-0.999);
        for _ in 0..1000 {
            assert!((filter.filter(-0.999) + 0.999).abs() < 1e-12);
        }
    }
}
