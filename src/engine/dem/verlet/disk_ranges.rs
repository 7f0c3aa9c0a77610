//! Ranges of disks, of which each thread adds up the forces on some, and the pairs that they need.

use std::ops::Range;

use fearless_simd::{Simd, SimdBase, f64x2};

use crate::engine::dem::lanes::{MOST_LANES, xy};
use crate::engine::threads::{Threads, share_each};

use super::contact_list::ContactList;
use super::contacts::Pair;
use super::eights::{Eights, GROUP};
use super::forces::Found;

/// Places of a list in a group.
pub const GROUP_PLACES: usize = GROUP * MOST_LANES;

/// Disks in a row, and what in the list of pairs belongs to them.
#[derive(Debug, Clone, Default)]
pub struct DiskRange {
    /// The disks.
    pub disks: Range<u32>,
    /// Groups of which every pair has its first disk here.
    pub groups: Range<usize>,
    /// Pairs of groups before those, in order: first such whose second disk alone is here, since its first has a smaller index, then
    /// such whose first is here.
    pub before: Vec<ListedPair>,
    /// Pairs of the group after those whose first disk is here.
    pub after: Vec<ListedPair>,
    /// Groups of others of which this range needs a pair.
    pub needed: Vec<u32>,
}

/// A pair and its place in the list.
#[derive(Debug, Clone, Copy)]
pub struct ListedPair {
    place: u32,
    bodies: [u32; 2],
}

/// Divides so many disks evenly among the ranges and finds the pairs of each.
pub fn divide(threads: &impl Threads, ranges: &mut [DiskRange], pairs: &ContactList<Pair>, disks: usize) {
    let count = ranges.len();
    let start = |n: usize| (n * disks / count) as u32;
    for (n, range) in ranges.iter_mut().enumerate() {
        range.disks = start(n)..start(n + 1);
    }
    share_each(threads, ranges, |_, range| range.find_pairs(pairs));
}

impl DiskRange {
    fn find_pairs(&mut self, pairs: &ContactList<Pair>) {
        let own = pairs.places_of(self.disks.clone());
        // The last group of the list may be shorter than others: it is whole if it ends with the list.
        let first = own.start.div_ceil(GROUP_PLACES);
        let last = match own.end == pairs.count() {
            true => own.end.div_ceil(GROUP_PLACES),
            false => own.end / GROUP_PLACES,
        };
        self.groups = first..last.max(first);
        self.needed.clear();
        let (before, after, needed) = (&mut self.before, &mut self.after, &mut self.needed);
        let listed = |place: usize, bodies| ListedPair {
            place: place as u32,
            bodies,
        };
        before.clear();
        after.clear();
        pairs.each_of(0..own.start, |place, bodies| {
            if self.disks.contains(&bodies[1]) {
                before.push(listed(place, bodies));
                let group = (place / GROUP_PLACES) as u32;
                if needed.last() != Some(&group) {
                    needed.push(group);
                }
            }
        });
        let inside = (first * GROUP_PLACES).clamp(own.start, own.end);
        let outside = (self.groups.end * GROUP_PLACES).clamp(inside, own.end);
        pairs.each_of(own.start..inside, |place, bodies| before.push(listed(place, bodies)));
        pairs.each_of(outside..own.end, |place, bodies| after.push(listed(place, bodies)));
    }
}

/// Where the forces on the disks of a range are added.
pub struct RangeSums<'a, S> {
    simd: S,
    start: u32,
    forces: &'a mut [[f64; 3]],
}

impl<'a, S: Simd> RangeSums<'a, S> {
    /// Of the disks from `start` on.
    #[inline(always)]
    pub fn new(simd: S, start: u32, forces: &'a mut [[f64; 3]]) -> Self {
        Self { simd, start, forces }
    }

    /// Adds the forces of all pairs of these eights. Those that are INSIDE have both disks in the range.
    #[inline(always)]
    pub fn add_all<const SPRING: bool, const INSIDE: bool>(&mut self, eights: &Eights<'_>, found: &[Found]) {
        for (n, (eight, found)) in eights.eights.iter().zip(found).enumerate() {
            let found = found.forces.iter().zip(&found.tangential);
            for (bodies, (force, tangential)) in eight.bodies.iter().zip(found).take(eights.in_eight(n)) {
                if INSIDE {
                    let [first, second] = bodies.map(|body| (body - self.start) as usize);
                    let force = f64x2::load_array(self.simd, *force);
                    add_to::<S, SPRING>(&mut self.forces[first], self.simd, force, *tangential);
                    subtract_from::<S, SPRING>(&mut self.forces[second], self.simd, force, *tangential);
                } else {
                    self.add::<SPRING>(*bodies, *force, *tangential);
                }
            }
        }
    }

    /// Adds the forces of a pair.
    #[inline(always)]
    pub fn add_listed<const SPRING: bool>(&mut self, pair: &ListedPair, found: &[Found]) {
        let (eight, k) = (pair.place as usize / MOST_LANES, pair.place as usize % MOST_LANES);
        self.add::<SPRING>(pair.bodies, found[eight].forces[k], found[eight].tangential[k]);
    }

    /// To those of both disks that are in the range.
    #[inline(always)]
    fn add<const SPRING: bool>(&mut self, [first, second]: [u32; 2], force: [f64; 2], tangential: f64) {
        let force = f64x2::load_array(self.simd, force);
        if let Some(on_first) = self.forces.get_mut(first.wrapping_sub(self.start) as usize) {
            add_to::<S, SPRING>(on_first, self.simd, force, tangential);
        }
        if let Some(on_second) = self.forces.get_mut(second.wrapping_sub(self.start) as usize) {
            subtract_from::<S, SPRING>(on_second, self.simd, force, tangential);
        }
    }
}

#[inline(always)]
fn add_to<S: Simd, const SPRING: bool>(on_first: &mut [f64; 3], simd: S, force: f64x2<S>, tangential: f64) {
    [on_first[0], on_first[1]] = (xy(simd, on_first) + force).to_array();
    if SPRING {
        on_first[2] += tangential;
    }
}

/// The torque has one sign for both.
#[inline(always)]
fn subtract_from<S: Simd, const SPRING: bool>(on_second: &mut [f64; 3], simd: S, force: f64x2<S>, tangential: f64) {
    [on_second[0], on_second[1]] = (xy(simd, on_second) - force).to_array();
    if SPRING {
        on_second[2] += tangential;
    }
}
