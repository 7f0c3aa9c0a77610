//! White noise of a sensor: a seed in, one standard normal number after the other out.
//!
//! By Marsaglia's polar method (SIAM Review 6, 260, 1964) on the generator PCG 64, with the logarithm of the crate `libm`: the same numbers
//! on every system. Of each pair the first is taken, so that the generator is all of the state.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

/// A source of noise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Noise(Pcg64);

impl Noise {
    /// The noise of `seed`.
    pub fn new(seed: u64) -> Self {
        Self(Pcg64::seed_from_u64(seed))
    }

    /// A standard normal number.
    pub fn next(&mut self) -> f64 {
        loop {
            let [x, y] = [self.even(), self.even()];
            let s = x * x + y * y;
            if s > 0.0 && s < 1.0 {
                return x * (-2.0 * libm::log(s) / s).sqrt();
            }
        }
    }

    /// Even on \[-1, 1), a multiple of 2^-52.
    fn even(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

impl Default for Noise {
    fn default() -> Self {
        Self::new(0)
    }
}
