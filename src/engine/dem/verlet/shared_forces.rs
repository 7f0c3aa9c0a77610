//! Contact forces by several threads, with the bits of one.
//!
//! Disks are divided into ranges. The forces on a disk are added up by the thread that has its range, in the order of the list, as one
//! thread does. First those groups of contacts are computed, into places of their own, that two ranges need. Then each range adds
//! what contacts with disks of lower ranges gave, computes its other groups and adds all of its own.

use fearless_simd::Simd;

use crate::contact::{ContactLaws, NormalForce};
use crate::engine::dem::lanes::{LaneWork, Lanes, in_lanes};
use crate::engine::threads::{Divisible, Threads, parts, share};

use super::contact_kinds::{BetweenDisks, DiskArrays, Geometry};
use super::contact_laws::LaneLaws;
use super::contact_list::ContactList;
use super::contacts::Pair;
use super::disk_ranges::{DiskRange, GROUP_PLACES, RangeSums, divide};
use super::eights::{BLOCK, Eights, GROUP};
use super::force_sums::{LaneSums, PartialSums};
use super::forces::{Found, compute_forces, compute_geometry};

/// Scratch memory of several threads, and how a list of pairs is divided among them. Empty where there is one thread.
#[derive(Debug, Clone, Default)]
pub struct Shares {
    found: Vec<Found>,
    sums: Vec<PartialSums>,
    ranges: Vec<DiskRange>,
    /// Whether two ranges need the forces of a group.
    is_common: Vec<bool>,
    /// Of the list that is divided.
    edition: u64,
}

/// What the forces of pairs are made of.
#[derive(Clone, Copy)]
pub struct PairForces<'a, N> {
    /// Contact laws.
    pub laws: ContactLaws<N>,
    /// Length of the step at whose end the forces are evaluated \[s\].
    pub step: f64,
    /// Disks.
    pub disks: DiskArrays<'a>,
}

impl Shares {
    /// Adds the forces of all pairs to `forces`, x, y and torque over radius of each disk \[N\]; gives their sums.
    pub fn add_forces<N: NormalForce, const SPRING: bool>(
        &mut self,
        threads: &impl Threads,
        of: PairForces<'_, N>,
        pairs: &mut ContactList<Pair>,
        forces: &mut [[f64; 3]],
    ) -> PartialSums {
        self.divide(threads, pairs, forces.len());
        share(
            threads,
            CommonForces::<N, SPRING> {
                of,
                pairs: pairs.eights_mut(),
                found: &mut self.found,
                sums: &mut self.sums,
                is_common: &self.is_common,
            },
        );
        share(
            threads,
            RangeForces::<N, SPRING> {
                of,
                ranges: &self.ranges,
                first_group: 0,
                pairs: pairs.eights_mut(),
                sums: &mut self.sums,
                is_common: &self.is_common,
                found: &self.found,
                forces,
            },
        );
        let mut total = PartialSums::default();
        self.sums.iter().for_each(|sums| total.add(sums));
        total
    }

    /// Divides a list, unless it is the one that is divided already.
    fn divide(&mut self, threads: &impl Threads, pairs: &mut ContactList<Pair>, disks: usize) {
        if self.edition == pairs.edition() && !self.ranges.is_empty() {
            return;
        }
        self.edition = pairs.edition();
        let groups = pairs.count().div_ceil(GROUP_PLACES);
        self.found.resize(groups * GROUP, Found::default());
        self.sums.resize(groups, PartialSums::default());
        self.ranges
            .resize(parts(threads).min(disks).max(1), DiskRange::default());
        divide(threads, &mut self.ranges, pairs, disks);
        self.is_common.clear();
        self.is_common.resize(groups, true);
        for range in &self.ranges {
            range.groups.clone().for_each(|group| self.is_common[group] = false);
        }
        for range in &self.ranges {
            range
                .needed
                .iter()
                .for_each(|group| self.is_common[*group as usize] = true);
        }
    }
}

/// Forces of the groups that two ranges need.
struct CommonForces<'a, N, const SPRING: bool> {
    of: PairForces<'a, N>,
    pairs: Eights<'a>,
    /// One for each eight, and for those that the last group lacks.
    found: &'a mut [Found],
    /// One for each group.
    sums: &'a mut [PartialSums],
    is_common: &'a [bool],
}

impl<N: NormalForce, const SPRING: bool> Divisible for CommonForces<'_, N, SPRING> {
    type Output = ();

    fn units(&self) -> usize {
        self.sums.len()
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let (pairs, pairs_after) = self.pairs.split_at(units * GROUP);
        let (found, found_after) = self.found.split_at_mut(units * GROUP);
        let (sums, sums_after) = self.sums.split_at_mut(units);
        let (is_common, is_common_after) = self.is_common.split_at(units);
        let one = Self {
            of: self.of,
            pairs,
            found,
            sums,
            is_common,
        };
        let other = Self {
            of: self.of,
            pairs: pairs_after,
            found: found_after,
            sums: sums_after,
            is_common: is_common_after,
        };
        (one, other)
    }

    fn run(self) {
        if self.is_common.contains(&true) {
            in_lanes(self);
        }
    }

    fn merged((): (), (): ()) {}
}

impl<N: NormalForce, const SPRING: bool> LaneWork for CommonForces<'_, N, SPRING> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd, V: Lanes<S>>(mut self, simd: S) {
        let PairForces { laws, step, disks } = self.of;
        let laws = LaneLaws::<S, V, N>::new(simd, &laws, step);
        // Once more, since the compiler does not see from farther away that the lengths are one.
        let kind = BetweenDisks { disks: disks.again() };
        let mut geometries = [Geometry::default(); BLOCK];
        let groups = self.found.chunks_mut(GROUP).zip(self.sums).zip(self.is_common);
        for (n, ((found, group_sums), _)) in groups.enumerate().filter(|(_, (_, is_common))| **is_common) {
            let mut group = self.pairs.group(n);
            let mut sums = LaneSums::new(simd);
            for (n, found) in (0..group.blocks()).zip(found.chunks_mut(BLOCK)) {
                let mut block = group.block(n);
                compute_geometry::<S, V, _, SPRING>(simd, kind, &block, &mut geometries);
                compute_forces::<S, V, N, _, SPRING>(&laws, kind, &mut block, &geometries, found, &mut sums);
            }
            *group_sums = sums.partial();
        }
    }
}

/// All forces on the disks of ranges, of which those of common groups are there.
struct RangeForces<'a, N, const SPRING: bool> {
    of: PairForces<'a, N>,
    ranges: &'a [DiskRange],
    /// Number of the first group among `pairs` and `sums`.
    first_group: usize,
    pairs: Eights<'a>,
    sums: &'a mut [PartialSums],
    is_common: &'a [bool],
    /// Of all groups.
    found: &'a [Found],
    /// On the disks of the ranges.
    forces: &'a mut [[f64; 3]],
}

impl<N: NormalForce, const SPRING: bool> Divisible for RangeForces<'_, N, SPRING> {
    type Output = ();

    fn units(&self) -> usize {
        self.ranges.len()
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let (ranges, ranges_after) = self.ranges.split_at(units);
        let disks: usize = ranges.iter().map(|range| range.disks.len()).sum();
        let first_after = ranges_after
            .first()
            .map_or(self.first_group, |range| range.groups.start);
        let groups = first_after - self.first_group;
        let (pairs, pairs_after) = self.pairs.split_at(groups * GROUP);
        let (sums, sums_after) = self.sums.split_at_mut(groups.min(self.sums.len()));
        let (forces, forces_after) = self.forces.split_at_mut(disks);
        let one = Self {
            ranges,
            pairs,
            sums,
            forces,
            ..self
        };
        let other = Self {
            ranges: ranges_after,
            first_group: first_after,
            pairs: pairs_after,
            sums: sums_after,
            forces: forces_after,
            ..one
        };
        (one, other)
    }

    fn run(self) {
        in_lanes(self);
    }

    fn merged((): (), (): ()) {}
}

impl<N: NormalForce, const SPRING: bool> LaneWork for RangeForces<'_, N, SPRING> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd, V: Lanes<S>>(mut self, simd: S) {
        let PairForces { laws, step, disks } = self.of;
        let laws = LaneLaws::<S, V, N>::new(simd, &laws, step);
        let kind = BetweenDisks { disks: disks.again() };
        let (mut geometries, mut local) = ([Geometry::default(); BLOCK], [Found::default(); BLOCK]);
        let mut forces = self.forces;
        for range in self.ranges {
            let (here, others) = forces.split_at_mut(range.disks.len());
            forces = others;
            let mut on = RangeSums::<S>::new(simd, range.disks.start, here);
            range
                .before
                .iter()
                .for_each(|pair| on.add_listed::<SPRING>(pair, self.found));
            for number in range.groups.clone() {
                let mut group = self.pairs.group(number - self.first_group);
                if self.is_common[number] {
                    let found = &self.found[number * GROUP..];
                    on.add_all::<SPRING, false>(&group, found);
                    continue;
                }
                let mut sums = LaneSums::new(simd);
                for n in 0..group.blocks() {
                    let mut block = group.block(n);
                    compute_geometry::<S, V, _, SPRING>(simd, kind, &block, &mut geometries);
                    compute_forces::<S, V, N, _, SPRING>(&laws, kind, &mut block, &geometries, &mut local, &mut sums);
                    on.add_all::<SPRING, true>(&block, &local);
                }
                self.sums[number - self.first_group] = sums.partial();
            }
            range
                .after
                .iter()
                .for_each(|pair| on.add_listed::<SPRING>(pair, self.found));
        }
    }
}
