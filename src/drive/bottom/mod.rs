//! Drives that hold the bottom row of a packing: fixed to the base, or vibrating at random about its places (P 1.3).

mod fixed;
mod random;

use serde::{Deserialize, Serialize};

pub use fixed::FixedBottom;
pub use random::{RandomBottom, RandomVibration};

/// A disk that a drive moves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeldDisk {
    /// Its index.
    pub index: u32,
    /// Its place while the base is at rest \[m\].
    pub place: [f64; 2],
}
