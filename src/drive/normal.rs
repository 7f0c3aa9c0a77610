//! Standard normal numbers: a generator in, two independent numbers out.
//!
//! Marsaglia's polar method (SIAM Review 6, 260, 1964) with the logarithm of [`elementary`](crate::elementary), so that the
//! bits depend neither on the C library nor on what other crates of a program switch on. Both numbers of a draw are handed
//! out: nothing is kept, and the generator alone is the state.

use rand::Rng;

use crate::elementary::ln;

/// Two independent standard normal numbers.
///
/// A point evenly in the unit disk is at the angle of a normal pair, and its squared distance s gives the length
/// `sqrt(-2 ln s)` of that pair. Draws outside of the disk, 21 % of them, are thrown away.
#[inline]
pub fn normal_pair(generator: &mut impl Rng) -> [f64; 2] {
    loop {
        let [x, y] = [even(generator), even(generator)];
        let s = x * x + y * y;
        if s < 1.0 && s > 0.0 {
            let factor = (-2.0 * ln(s) / s).sqrt();
            return [x * factor, y * factor];
        }
    }
}

/// Even on \[-1, 1), a multiple of 2^-52.
#[inline]
fn even(generator: &mut impl Rng) -> f64 {
    (generator.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    use super::*;

    const PAIRS: usize = 200_000;

    fn pairs() -> Vec<[f64; 2]> {
        let mut generator = Pcg64::seed_from_u64(1);
        (0..PAIRS).map(|_| normal_pair(&mut generator)).collect()
    }

    /// Integral of the normal density from 0 to `x` by Simpson's rule, far finer than what is asked of it.
    fn distribution(x: f64) -> f64 {
        let pieces = 200;
        let step = x / f64::from(2 * pieces);
        let density = |n: i32| (-0.5 * (f64::from(n) * step).powi(2)).exp() / std::f64::consts::TAU.sqrt();
        let sum: f64 = (0..pieces)
            .map(|n| density(2 * n) + 4.0 * density(2 * n + 1) + density(2 * n + 2))
            .sum();
        0.5 + sum * step / 3.0
    }

    /// By Kolmogorov and Smirnov at the level 1e-4, each of the two numbers.
    #[test]
    fn both_numbers_are_distributed_normally() {
        for which in 0..2 {
            let mut numbers: Vec<f64> = pairs().iter().map(|pair| pair[which]).collect();
            numbers.sort_by(f64::total_cmp);
            let count = numbers.len() as f64;
            let distance = numbers
                .iter()
                .enumerate()
                .map(|(index, &number)| (distribution(number) - (index as f64 + 0.5) / count).abs())
                .fold(0.0, f64::max);
            assert!(distance < 2.23 / count.sqrt(), "{}", distance * count.sqrt());
        }
    }

    /// What is averaged.
    type Power<'a> = &'a dyn Fn(&[f64; 2]) -> f64;

    /// Means, products and powers within four standard errors of what a normal number has.
    #[test]
    fn moments_are_those_of_independent_normal_numbers() {
        let pairs = pairs();
        let mean = |power: Power<'_>| pairs.iter().map(power).sum::<f64>() / PAIRS as f64;
        // The moment, what it must be, and the variance of what is averaged.
        let moments: [(Power<'_>, f64, f64); 8] = [
            (&|[x, _]| *x, 0.0, 1.0),
            (&|[_, y]| *y, 0.0, 1.0),
            (&|[x, _]| x.powi(2), 1.0, 2.0),
            (&|[_, y]| y.powi(2), 1.0, 2.0),
            (&|[x, _]| x.powi(3), 0.0, 15.0),
            (&|[x, _]| x.powi(4), 3.0, 96.0),
            (&|[x, y]| x * y, 0.0, 1.0),
            (&|[x, y]| (x * y).powi(2), 1.0, 8.0),
        ];
        for (index, (power, expected, variance)) in moments.into_iter().enumerate() {
            let error = (mean(power) - expected) / (variance / PAIRS as f64).sqrt();
            assert!(error.abs() < 4.0, "moment {index} is off by {error} standard errors");
        }
    }

    /// A draw and its neighbour have nothing to do with each other, and far tails are reached.
    #[test]
    fn draws_follow_one_another_independently() {
        let numbers: Vec<f64> = pairs().into_iter().flatten().collect();
        for lag in [1, 2, 3] {
            let product: f64 = numbers.windows(lag + 1).map(|window| window[0] * window[lag]).sum();
            assert!(
                product.abs() < 4.0 * (numbers.len() as f64).sqrt(),
                "lag {lag}: {product}"
            );
        }
        let largest = numbers
            .iter()
            .fold(0.0_f64, |largest, number| largest.max(number.abs()));
        assert!((4.0..6.5).contains(&largest), "{largest}");
    }
}
