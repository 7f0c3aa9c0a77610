//! How new inputs are made: libFuzzer changes an old one, or now and then all bytes are drawn afresh.
//!
//! What libFuzzer keeps is near to what it has kept before. Lives of an instance that need many arguments to be right at
//! once, none of which adds coverage by itself, are found sooner by chance.

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// One input in so many is drawn afresh.
const AFRESH: u32 = 3;

/// Turns `data[..size]` into a new input in place and gives its length.
pub fn mutate(data: &mut [u8], size: usize, most: usize, seed: u32) -> usize {
    if !seed.is_multiple_of(AFRESH) {
        return libfuzzer_sys::fuzzer_mutate(data, size, most);
    }
    let mut random = Pcg64::seed_from_u64(seed.into());
    let length = random.random_range(0..=most.min(data.len()));
    random.fill_bytes(&mut data[..length]);
    length
}
