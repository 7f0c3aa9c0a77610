//! Spectral density of a record at some frequencies: its mean is taken away, then Fourier sums at the frequencies asked for.
//!
//! One-sided, so that the sum of all densities times the frequency step is the variance. The sums are plain: no fast transform, whose
//! order of operations would depend on the processor.

use std::f64::consts::TAU;

/// How a record is cut and weighted.
pub struct Spectrum {
    /// Of the record \[Hz\].
    pub rate: f64,
    /// Length of a segment; those of Welch's method overlap by half.
    pub segment: usize,
    /// Weights of Hann, periodic; otherwise all weigh the same.
    pub hann: bool,
}

impl Spectrum {
    /// Frequencies \[Hz\] from `low` to `high` and the densities at them, averaged over the segments of `record`.
    pub fn densities(&self, record: &[f64], low: f64, high: f64) -> Vec<(f64, f64)> {
        let count = self.segment;
        let (sines, cosines): (Vec<f64>, Vec<f64>) =
            (0..count).map(|n| libm::sincos(TAU * n as f64 / count as f64)).unzip();
        let weights: Vec<f64> = cosines
            .iter()
            .map(|cosine| if self.hann { 0.5 - 0.5 * cosine } else { 1.0 })
            .collect();
        let power: f64 = weights.iter().map(|weight| weight * weight).sum();
        let step = self.rate / count as f64;
        let bins = (0..=count / 2).filter(|&bin| (low..=high).contains(&(bin as f64 * step)));
        let mut found: Vec<(usize, f64)> = bins.map(|bin| (bin, 0.0)).collect();
        let mut segments = 0_u32;
        for segment in record
            .windows(count)
            .step_by(if self.hann { count - count / 2 } else { count })
        {
            let mean = segment.iter().sum::<f64>() / count as f64;
            let weighted: Vec<f64> = segment
                .iter()
                .zip(&weights)
                .map(|(x, weight)| (x - mean) * weight)
                .collect();
            for (bin, total) in &mut found {
                let (mut real, mut imaginary, mut angle) = (0.0, 0.0, 0);
                for x in &weighted {
                    real += x * cosines[angle];
                    imaginary += x * sines[angle];
                    angle += *bin;
                    if angle >= count {
                        angle -= count;
                    }
                }
                *total += real * real + imaginary * imaginary;
            }
            segments += 1;
        }
        let scale = 1.0 / (self.rate * power * f64::from(segments.max(1)));
        let density = |(bin, total): (usize, f64)| {
            // The other frequencies stand for their negatives too.
            let both = if bin == 0 || 2 * bin == count { 1.0 } else { 2.0 };
            (bin as f64 * step, both * scale * total)
        };
        found.into_iter().map(density).collect()
    }
}
