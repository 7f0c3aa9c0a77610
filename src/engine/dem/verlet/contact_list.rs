//! Lists of candidates for contact, in [`Eights`] for the forces.

use std::marker::PhantomData;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use serde::{Deserialize, Serialize};

use crate::engine::dem::candidates::Candidate;
use crate::engine::dem::lanes::MOST_LANES;

use super::contacts::{Pair, SpringMemory, WallContact};
use super::eights::{Eight, EightSprings, Eights};

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
#[derive(Debug, Serialize, Deserialize)]
#[serde(
    from = "Vec<C>",
    into = "Vec<C>",
    bound = "C: Listed + Serialize + serde::de::DeserializeOwned"
)]
pub struct ContactList<C: Listed> {
    count: usize,
    eights: Vec<Eight>,
    /// The same for lists of the same bodies alone: see [`Self::edition`].
    edition: u64,
    listed: PhantomData<C>,
}

/// Editions of lists so far in this process; that of an empty list is 0.
static EDITIONS: AtomicU64 = AtomicU64::new(0);

fn next_edition() -> u64 {
    EDITIONS.fetch_add(1, Ordering::Relaxed) + 1
}

impl<C: Listed> PartialEq for ContactList<C> {
    fn eq(&self, other: &Self) -> bool {
        self.count == other.count && self.eights == other.eights
    }
}

impl<C: Listed> Default for ContactList<C> {
    fn default() -> Self {
        Self {
            count: 0,
            eights: Vec::new(),
            edition: 0,
            listed: PhantomData,
        }
    }
}

impl<C: Listed> Clone for ContactList<C> {
    fn clone(&self) -> Self {
        Self {
            count: self.count,
            eights: self.eights.clone(),
            edition: self.edition,
            listed: PhantomData,
        }
    }

    fn clone_from(&mut self, source: &Self) {
        (self.count, self.edition) = (source.count, source.edition);
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
        let closed = |eight: &Eight| {
            let [x, y] = [&eight.springs.direction_x, &eight.springs.direction_y];
            x.iter().zip(y).filter(|(x, y)| **x != 0.0 || **y != 0.0).count()
        };
        // What fills up the last eight is open.
        self.eights.iter().map(closed).sum()
    }

    /// A number that two lists of one process share only if they have the same bodies: for what is derived from the bodies.
    pub fn edition(&self) -> u64 {
        self.edition
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Bodies of the candidate at this place, counted from 0.
    pub fn bodies(&self, place: usize) -> [u32; 2] {
        self.eights[place / MOST_LANES].bodies[place % MOST_LANES]
    }

    /// Calls `see` with place and bodies of the candidates at these places, in order.
    pub fn each_of(&self, places: Range<usize>, mut see: impl FnMut(usize, [u32; 2])) {
        let eights = places.start / MOST_LANES..places.end.div_ceil(MOST_LANES);
        for (n, eight) in eights.clone().zip(&self.eights[eights]) {
            for (k, bodies) in eight.bodies.iter().enumerate() {
                let place = n * MOST_LANES + k;
                if places.contains(&place) {
                    see(place, *bodies);
                }
            }
        }
    }

    /// Places of the candidates whose first bodies are in the range.
    pub fn places_of(&self, first: Range<u32>) -> Range<usize> {
        let place = |body: u32| self.partition_point(|[first, _]| first < body);
        place(first.start)..place(first.end)
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
        self.edition = next_edition();
        self.eights.truncate(kept.div_ceil(MOST_LANES));
        if let Some(last) = kept.checked_sub(1) {
            let bodies = self.get(last).key();
            for k in kept..self.eights.len() * MOST_LANES {
                self.put(k, bodies, C::LENGTH_OF_NONE, SpringMemory::OPEN);
            }
        }
    }

    /// Replaces them by `renewed`, which has the place of the former ones.
    pub(super) fn replace(&mut self, renewed: &mut Self) {
        renewed.edition = next_edition();
        std::mem::swap(self, renewed);
    }

    /// Makes it as long as `count` candidates need, whatever they are.
    pub(super) fn resize(&mut self, count: usize) -> &mut [Eight] {
        self.count = count;
        self.eights.resize(count.div_ceil(MOST_LANES), Eight::NONE);
        &mut self.eights
    }

    /// What the candidate at this place remembers.
    pub(super) fn spring(&self, place: usize) -> SpringMemory {
        self.eights[place / MOST_LANES].springs.get(place % MOST_LANES)
    }

    /// The first place at which `is_before` does not hold for the bodies, which it holds for up to there.
    pub(super) fn partition_point(&self, is_before: impl Fn([u32; 2]) -> bool) -> usize {
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low + (high - low) / 2;
            match is_before(self.bodies(middle)) {
                true => low = middle + 1,
                false => high = middle,
            }
        }
        low
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
        self.edition = next_edition();
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
