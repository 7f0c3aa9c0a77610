//! Lists of candidates for contact as the forces go through them: eight by eight, each property of eight together, so that
//! registers load and store it as it lies.

use std::marker::PhantomData;

use serde::{Deserialize, Serialize};

use crate::engine::dem::candidates::Candidate;
use crate::engine::dem::lanes::MOST_LANES;

use super::contacts::{Pair, SpringMemory, WallContact};

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

/// Eights that go through the loop over contacts together.
pub const BLOCK: usize = 8;

/// So many candidates, eight by eight.
#[derive(Default)]
pub struct Eights<'a> {
    /// Candidates, without those that fill up the last eight.
    count: usize,
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
        let start = (n * BLOCK).min(self.eights.len());
        let end = (start + BLOCK).min(self.eights.len());
        Eights {
            count: self
                .count
                .saturating_sub(start * MOST_LANES)
                .min((end - start) * MOST_LANES),
            eights: &mut self.eights[start..end],
        }
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

/// A candidate that can stand in such a list.
pub trait Listed: Candidate {
    /// Length \[m\] that fills up the last eight, with the bodies of the last candidate: such a candidate never touches.
    const LENGTH_OF_NONE: f64;

    /// The candidate.
    fn new(bodies: [u32; 2], length: f64, spring: SpringMemory) -> Self;

    /// What the forces need of its lengths \[m\].
    fn length(&self) -> f64;

    /// What it remembers.
    fn spring(&self) -> SpringMemory;
}

impl Listed for Pair {
    /// Disks without radii.
    const LENGTH_OF_NONE: f64 = 0.0;

    fn new([first, second]: [u32; 2], radius_sum: f64, spring: SpringMemory) -> Self {
        Self {
            first,
            second,
            radius_sum,
            spring,
        }
    }

    fn length(&self) -> f64 {
        self.radius_sum
    }

    fn spring(&self) -> SpringMemory {
        self.spring
    }
}

impl Listed for WallContact {
    /// Distance by which a disk is farther away than it is.
    const LENGTH_OF_NONE: f64 = f64::INFINITY;

    fn new([disk, wall]: [u32; 2], _: f64, spring: SpringMemory) -> Self {
        Self { disk, wall, spring }
    }

    fn length(&self) -> f64 {
        0.0
    }

    fn spring(&self) -> SpringMemory {
        self.spring
    }
}

/// Candidates in the order of their indices.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    from = "Vec<C>",
    into = "Vec<C>",
    bound = "C: Listed + Serialize + serde::de::DeserializeOwned"
)]
pub struct ContactList<C: Listed> {
    count: usize,
    eights: Vec<Eight>,
    listed: PhantomData<C>,
}

impl<C: Listed> Default for ContactList<C> {
    fn default() -> Self {
        Self {
            count: 0,
            eights: Vec::new(),
            listed: PhantomData,
        }
    }
}

impl<C: Listed> Clone for ContactList<C> {
    fn clone(&self) -> Self {
        Self {
            count: self.count,
            eights: self.eights.clone(),
            listed: PhantomData,
        }
    }

    fn clone_from(&mut self, source: &Self) {
        self.count = source.count;
        self.eights.clone_from(&source.eights);
    }
}

impl<C: Listed> ContactList<C> {
    /// One by one.
    pub fn iter(&self) -> impl Iterator<Item = C> {
        (0..self.count).map(|k| self.get(k))
    }

    /// Changes what they remember, one by one.
    pub fn change_springs(&mut self, mut change: impl FnMut(&mut SpringMemory)) {
        let mut left = self.count;
        for eight in &mut self.eights {
            for k in 0..left.min(MOST_LANES) {
                let mut spring = eight.springs.get(k);
                change(&mut spring);
                eight.springs.set(k, spring);
            }
            left = left.saturating_sub(MOST_LANES);
        }
    }

    /// How many of them remember that they are closed.
    pub fn closed(&self) -> usize {
        self.iter().filter(Candidate::remembers).count()
    }

    /// Makes room for so many, so that no step allocates for them.
    pub fn reserve(&mut self, room: usize) {
        let eights = room.div_ceil(MOST_LANES);
        self.eights.reserve(eights.saturating_sub(self.eights.len()));
    }

    /// Eight by eight, for the forces.
    pub fn eights_mut(&mut self) -> Eights<'_> {
        Eights {
            count: self.count,
            eights: &mut self.eights,
        }
    }

    /// Keeps those that are `wanted`, in their order, without allocating.
    pub fn retain(&mut self, wanted: impl Fn(&C) -> bool) {
        let mut kept = 0;
        for k in 0..self.count {
            let contact = self.get(k);
            if wanted(&contact) {
                self.put(kept, contact.key(), contact.length(), contact.spring());
                kept += 1;
            }
        }
        self.count = kept;
        self.eights.truncate(kept.div_ceil(MOST_LANES));
        if let Some(last) = kept.checked_sub(1) {
            let bodies = self.get(last).key();
            for k in kept..self.eights.len() * MOST_LANES {
                self.put(k, bodies, C::LENGTH_OF_NONE, SpringMemory::OPEN);
            }
        }
    }

    fn get(&self, k: usize) -> C {
        let (eight, k) = (&self.eights[k / MOST_LANES], k % MOST_LANES);
        C::new(eight.bodies[k], eight.length[k], eight.springs.get(k))
    }

    fn put(&mut self, k: usize, bodies: [u32; 2], length: f64, spring: SpringMemory) {
        let (eight, k) = (&mut self.eights[k / MOST_LANES], k % MOST_LANES);
        (eight.bodies[k], eight.length[k]) = (bodies, length);
        eight.springs.set(k, spring);
    }

    /// Replaces them by these bodies and lengths, which are sorted as they are; closed contacts keep their memory.
    pub fn renew(&mut self, bodies: &[[u32; 2]], lengths: &[f64], scratch: &mut Self) {
        scratch.open_all(bodies, lengths);
        let (mut fresh, key) = (0, |bodies: [u32; 2]| {
            (u64::from(bodies[0]) << 32) | u64::from(bodies[1])
        });
        for eight in &self.eights {
            for k in 0..MOST_LANES {
                if eight.springs.direction_x[k] == 0.0 && eight.springs.direction_y[k] == 0.0 {
                    continue;
                }
                let wanted = key(eight.bodies[k]);
                while bodies.get(fresh).is_some_and(|&other| key(other) < wanted) {
                    fresh += 1;
                }
                if bodies.get(fresh).is_some_and(|&other| key(other) == wanted) {
                    let renewed = &mut scratch.eights[fresh / MOST_LANES].springs;
                    renewed.set(fresh % MOST_LANES, eight.springs.get(k));
                }
            }
        }
        std::mem::swap(self, scratch);
    }

    /// Replaces them by these, without memory.
    fn open_all(&mut self, bodies: &[[u32; 2]], lengths: &[f64]) {
        self.count = bodies.len();
        self.eights.clear();
        let (bodies, last_bodies) = bodies.as_chunks();
        let (lengths, last_lengths) = lengths.as_chunks();
        let springs = EightSprings::default();
        self.eights
            .extend(bodies.iter().zip(lengths).map(|(&bodies, &length)| Eight {
                bodies,
                length,
                springs,
            }));
        if let Some(&last) = last_bodies.last() {
            let mut eight = Eight {
                bodies: [last; MOST_LANES],
                length: [C::LENGTH_OF_NONE; MOST_LANES],
                springs,
            };
            eight.bodies[..last_bodies.len()].copy_from_slice(last_bodies);
            eight.length[..last_bodies.len()].copy_from_slice(last_lengths);
            self.eights.push(eight);
        }
    }
}

impl<C: Listed> From<Vec<C>> for ContactList<C> {
    fn from(contacts: Vec<C>) -> Self {
        let bodies: Vec<_> = contacts.iter().map(Candidate::key).collect();
        let lengths: Vec<_> = contacts.iter().map(Listed::length).collect();
        let mut list = Self::default();
        list.open_all(&bodies, &lengths);
        for (k, contact) in contacts.iter().enumerate() {
            list.eights[k / MOST_LANES]
                .springs
                .set(k % MOST_LANES, contact.spring());
        }
        list
    }
}

impl<C: Listed> From<ContactList<C>> for Vec<C> {
    fn from(list: ContactList<C>) -> Self {
        list.iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(first: u32) -> Pair {
        let spring = SpringMemory {
            direction: [1.0, 0.0],
            reference: f64::from(first),
            stretch: 0.5,
        };
        Pair::new([first, first + 1], 0.1 * f64::from(first), spring)
    }

    #[test]
    fn what_is_kept_is_the_list_of_what_is_wanted() {
        for count in 0..20 {
            let all: Vec<Pair> = (0..count).map(pair).collect();
            for divisor in 1..4 {
                let mut list = ContactList::from(all.clone());
                list.retain(|pair| pair.first % divisor == 0);
                let wanted = all.iter().copied().filter(|pair| pair.first % divisor == 0);
                assert_eq!(list, wanted.collect::<Vec<_>>().into(), "{count} pairs, {divisor}");
            }
        }
    }
}
