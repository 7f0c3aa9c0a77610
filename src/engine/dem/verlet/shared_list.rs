//! The inner neighbour list from the outer one, by one thread or several: the pairs that are near are picked part by part, and the
//! list that they make is written part by part.

use crate::engine::dem::candidates::make_room;
use crate::engine::dem::cell_grid::Cloud;
use crate::engine::dem::lanes::MOST_LANES;
use crate::engine::threads::{Divisible, Threads, share};

use super::contact_list::{ContactList, Listed};
use super::contacts::Pair;
use super::eights::{Eight, EightSprings};

/// Pairs of the outer list of which several threads pick those that are near.
const PART: usize = 2048;

/// Pairs that are near, in order, with gaps between those of different parts of the outer list.
#[derive(Debug, Clone, Default)]
pub struct NearPairs {
    bodies: Vec<[u32; 2]>,
    /// Sums of radii \[m\].
    radius_sums: Vec<f64>,
    /// Length of the parts, of which each begins where its part of the outer list does.
    part: usize,
    /// How many each part has.
    counts: Vec<usize>,
    /// How many are in the parts before each.
    starts: Vec<usize>,
}

impl NearPairs {
    /// Makes room for so many disks.
    pub fn make_room(&mut self, disks: usize) {
        make_room(&mut self.bodies, disks);
        make_room(&mut self.radius_sums, disks);
        self.counts.reserve(1);
        self.starts.reserve(1);
    }

    /// Picks the pairs of the outer list whose gap is less than the margin.
    pub fn pick(&mut self, threads: &impl Threads, cloud: Cloud<'_>, outer: &[[u32; 2]]) {
        self.part = match threads.count() {
            1 => outer.len().max(1),
            _ => PART,
        };
        self.bodies.resize(outer.len(), [0; 2]);
        self.radius_sums.resize(outer.len(), 0.0);
        self.counts.clear();
        self.counts.resize(outer.len().div_ceil(self.part).max(1), 0);
        let pick = Pick {
            cloud,
            part: self.part,
            outer,
            bodies: &mut self.bodies,
            radius_sums: &mut self.radius_sums,
            counts: &mut self.counts,
        };
        share(threads, pick);
    }

    /// What one thread has picked: bodies and sums of radii.
    pub fn only_part(&self) -> (&[[u32; 2]], &[f64]) {
        let count = self.counts[0];
        (&self.bodies[..count], &self.radius_sums[..count])
    }

    /// Replaces `pairs` by what was picked, as [`ContactList::renew`].
    pub fn renew(&mut self, threads: &impl Threads, pairs: &mut ContactList<Pair>, scratch: &mut ContactList<Pair>) {
        let mut count = 0;
        self.starts.clear();
        for of_part in &self.counts {
            self.starts.push(count);
            count += of_part;
        }
        let renew = Renew {
            near: self,
            former: pairs,
            count,
            start: 0,
            eights: scratch.resize(count),
        };
        share(threads, renew);
        pairs.replace(scratch);
    }

    /// Bodies and sums of radii from this place on, counted over all parts.
    fn from(&self, place: usize) -> impl Iterator<Item = ([u32; 2], f64)> {
        let part = self.starts.partition_point(|start| *start <= place).saturating_sub(1);
        let mut skipped = place - self.starts[part];
        (part..self.counts.len()).flat_map(move |part| {
            let (from, to) = (part * self.part + skipped, part * self.part + self.counts[part]);
            skipped = 0;
            let lengths = self.radius_sums[from..to].iter().copied();
            self.bodies[from..to].iter().copied().zip(lengths)
        })
    }
}

/// Picks near pairs, part by part.
struct Pick<'a> {
    cloud: Cloud<'a>,
    part: usize,
    outer: &'a [[u32; 2]],
    bodies: &'a mut [[u32; 2]],
    radius_sums: &'a mut [f64],
    counts: &'a mut [usize],
}

impl Divisible for Pick<'_> {
    type Output = ();

    fn units(&self) -> usize {
        self.counts.len()
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let at = (units * self.part).min(self.outer.len());
        let (outer, outer_after) = self.outer.split_at(at);
        let (bodies, bodies_after) = self.bodies.split_at_mut(at);
        let (radius_sums, radius_sums_after) = self.radius_sums.split_at_mut(at);
        let (counts, counts_after) = self.counts.split_at_mut(units);
        let one = Self {
            outer,
            bodies,
            radius_sums,
            counts,
            ..self
        };
        let other = Self {
            outer: outer_after,
            bodies: bodies_after,
            radius_sums: radius_sums_after,
            counts: counts_after,
            ..one
        };
        (one, other)
    }

    fn run(self) {
        let cloud = self.cloud;
        let parts = self.outer.chunks(self.part).zip(self.bodies.chunks_mut(self.part));
        let parts = parts.zip(self.radius_sums.chunks_mut(self.part)).zip(self.counts);
        for (((outer, bodies), radius_sums), picked) in parts {
            let mut count = 0;
            // Without a branch on whether a pair is near: it would be wrong too often.
            for &[first, second] in outer {
                let (i, j) = (first as usize, second as usize);
                let radius_sum = cloud.radii[i] + cloud.radii[j];
                let ([x1, y1, _], [x2, y2, _]) = (cloud.positions[i], cloud.positions[j]);
                let ((dx, dy), range) = ((x1 - x2, y1 - y2), radius_sum + cloud.margin);
                let beyond = dx * dx + dy * dy >= range * range;
                (bodies[count], radius_sums[count]) = ([first, second], radius_sum);
                count += usize::from(!beyond);
            }
            *picked = count;
        }
    }

    fn merged((): (), (): ()) {}
}

/// Writes the renewed list, eight by eight.
struct Renew<'a> {
    near: &'a NearPairs,
    former: &'a ContactList<Pair>,
    /// Pairs of the whole list.
    count: usize,
    /// Place of the first of these.
    start: usize,
    eights: &'a mut [Eight],
}

impl Divisible for Renew<'_> {
    type Output = ();

    fn units(&self) -> usize {
        self.eights.len()
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let (eights, eights_after) = self.eights.split_at_mut(units);
        let one = Self { eights, ..self };
        let other = Self {
            start: one.start + units * MOST_LANES,
            eights: eights_after,
            ..one
        };
        (one, other)
    }

    fn run(self) {
        let Some(first) = self.near.from(self.start).next() else {
            return;
        };
        let mut fresh = self.near.from(self.start);
        let mut old = self.former.partition_point(|bodies| bodies < first.0);
        let (mut last, count) = (first.0, self.former.count());
        for (n, eight) in self.eights.iter_mut().enumerate() {
            eight.springs = EightSprings::default();
            for k in 0..MOST_LANES {
                if self.start + n * MOST_LANES + k >= self.count {
                    (eight.bodies[k], eight.length[k]) = (last, Pair::LENGTH_OF_NONE);
                    continue;
                }
                let Some((bodies, radius_sum)) = fresh.next() else {
                    return;
                };
                (eight.bodies[k], eight.length[k], last) = (bodies, radius_sum, bodies);
                while old < count && self.former.bodies(old) < bodies {
                    old += 1;
                }
                if old < count && self.former.bodies(old) == bodies {
                    eight.springs.set(k, self.former.spring(old));
                }
            }
        }
    }

    fn merged((): (), (): ()) {}
}
