//! Candidates for contact as the forces go through them: eight by eight, each property of eight together, so that registers load and
//! store it as it lies.

use crate::engine::dem::lanes::MOST_LANES;

use super::contacts::SpringMemory;

/// Eight candidates.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub struct Eight {
    /// Indices of both bodies.
    pub bodies: [[u32; 2]; MOST_LANES],
    /// [`Listed::length`] \[m\].
    pub length: [f64; MOST_LANES],
    /// What they remember.
    pub springs: EightSprings,
}

impl Eight {
    /// Eight that have no bodies yet.
    pub const NONE: Self = Self {
        bodies: [[0; 2]; MOST_LANES],
        length: [0.0; MOST_LANES],
        springs: EightSprings {
            direction_x: [0.0; MOST_LANES],
            direction_y: [0.0; MOST_LANES],
            reference: [0.0; MOST_LANES],
            stretch: [0.0; MOST_LANES],
        },
    };
}

/// Eights that go through the loop over contacts together.
pub const BLOCK: usize = 8;

/// Eights whose sums of energies are one term of the whole sum: see [`force_sums`](super::force_sums). A multiple of [`BLOCK`].
pub const GROUP: usize = 64;

/// So many candidates, eight by eight.
#[derive(Default)]
pub struct Eights<'a> {
    /// Candidates, without those that fill up the last eight.
    pub count: usize,
    /// All of them.
    pub eights: &'a mut [Eight],
}

impl Eights<'_> {
    /// Blocks of [`BLOCK`] eights, the last one perhaps of fewer.
    #[inline(always)]
    pub fn blocks(&self) -> usize {
        self.eights.len().div_ceil(BLOCK)
    }

    /// One of them, nothing behind the last.
    #[inline(always)]
    pub fn block(&mut self, n: usize) -> Eights<'_> {
        self.part(n * BLOCK, BLOCK)
    }

    /// Groups of [`GROUP`] eights, the last one perhaps of fewer.
    #[inline(always)]
    pub fn groups(&self) -> usize {
        self.eights.len().div_ceil(GROUP)
    }

    /// One of them, nothing behind the last.
    #[inline(always)]
    pub fn group(&mut self, n: usize) -> Eights<'_> {
        self.part(n * GROUP, GROUP)
    }

    #[inline(always)]
    fn part(&mut self, start: usize, length: usize) -> Eights<'_> {
        let start = start.min(self.eights.len());
        let end = (start + length).min(self.eights.len());
        Eights {
            count: self
                .count
                .saturating_sub(start * MOST_LANES)
                .min((end - start) * MOST_LANES),
            eights: &mut self.eights[start..end],
        }
    }

    /// The candidates of the first `eights` eights, and the others.
    pub fn split_at(self, eights: usize) -> (Self, Self) {
        let eights = eights.min(self.eights.len());
        let (first, others) = self.eights.split_at_mut(eights);
        let count = self.count.min(eights * MOST_LANES);
        let others = Self {
            count: self.count - count,
            eights: others,
        };
        (Self { count, eights: first }, others)
    }

    /// Candidates in the `n`-th eight: what only fills it up can be left out.
    #[inline(always)]
    pub fn in_eight(&self, n: usize) -> usize {
        self.count.saturating_sub(n * MOST_LANES).min(MOST_LANES)
    }
}

/// [`SpringMemory`] of eight contacts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub struct EightSprings {
    /// Remembered directions, x.
    pub direction_x: [f64; MOST_LANES],
    /// Remembered directions, y.
    pub direction_y: [f64; MOST_LANES],
    /// lambda* \[m\].
    pub reference: [f64; MOST_LANES],
    /// Stretch \[m\].
    pub stretch: [f64; MOST_LANES],
}

impl EightSprings {
    /// One of them.
    pub fn get(&self, k: usize) -> SpringMemory {
        SpringMemory {
            direction: [self.direction_x[k], self.direction_y[k]],
            reference: self.reference[k],
            stretch: self.stretch[k],
        }
    }

    /// Replaces one of them.
    pub fn set(&mut self, k: usize, spring: SpringMemory) {
        [self.direction_x[k], self.direction_y[k]] = spring.direction;
        (self.reference[k], self.stretch[k]) = (spring.reference, spring.stretch);
    }
}
