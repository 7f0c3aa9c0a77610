//! Two Verlet lists, one inside the other, the outer one from a grid of cells.
//!
//! The inner list is short and is built every few steps from the outer one, which lasts for hundreds of steps. It is
//! sorted by indices and holds all pairs closer than its margin, so that sums of forces, and with them all bits of a
//! trajectory, depend neither on when a list was built nor on how the cells lie. Source: Verlet 1967,
//! doi:10.1103/PhysRev.159.98.

use fearless_simd::{Simd, SimdBase, f64x2};

use crate::engine::dem::candidates::{make_room, near_walls, room_for};
use crate::engine::dem::cell_grid::{CellGrid, Cloud};
use crate::engine::dem::lanes::{LaneWork, Lanes, MOST_LANES, in_lanes, largest, xy};
use crate::geometry::Wall;

use super::contact_list::ContactList;
use super::contacts::{Pair, WallContact};

/// Gap, in smallest radii, below which a pair is in the outer list: it lasts for long at rest and stays short.
const OUTER_MARGIN: f64 = 0.3;

/// Largest and smallest gap, in smallest radii, below which a pair is in the inner list.
const INNER_MARGINS: [f64; 2] = [1e-3, 0.15];

/// Steps that an inner list should last, at the speed of the fastest disk. A shorter list costs less a step, but is built
/// more often: 6 instead of 16 saves 9 % of the time with 60 disks at Gamma 4 and costs 4 % with 1,000; 48 costs 20 % and
/// nothing (`cargo bench --bench packing`).
const STEPS_TO_LAST: f64 = 16.0;

/// Margin of an inner list \[m\] for a speed \[m/s\] of the fastest disk or the base: two disks may approach each other.
pub fn inner_margin(fastest: f64, time_step: f64, smallest_radius: f64) -> f64 {
    let [least, most] = INNER_MARGINS;
    let distance = 2.0 * STEPS_TO_LAST * fastest * time_step;
    // In this order, since a speed that is no number must not become a margin.
    distance.max(least * smallest_radius).min(most * smallest_radius)
}

/// The outer list. Nothing of a trajectory depends on it: it can be dropped at any time.
#[derive(Debug, Clone, Default)]
pub struct NeighbourList {
    smallest_radius: f64,
    grid: CellGrid,
    outer: Vec<[u32; 2]>,
    /// Positions when the outer list was built.
    positions_at_build: Vec<[f64; 3]>,
    /// Pairs of the outer list that are in the inner one, and the sums of their radii.
    near: Vec<[u32; 2]>,
    near_sums: Vec<f64>,
    scratch: ContactList<Pair>,
    wall_scratch: ContactList<WallContact>,
}

impl NeighbourList {
    /// For so many disks, of which the smallest has this radius \[m\].
    pub fn new(smallest_radius: f64, disks: usize) -> Self {
        let mut list = Self {
            smallest_radius,
            ..Self::default()
        };
        make_room(&mut list.outer, disks);
        make_room(&mut list.near, disks);
        make_room(&mut list.near_sums, disks);
        list.scratch.reserve(room_for(disks));
        list.wall_scratch.reserve(room_for(disks));
        list
    }

    /// Replaces `pairs` by all pairs whose gap is less than the margin; closed contacts keep their memory.
    pub fn find_pairs(&mut self, cloud: Cloud<'_>, pairs: &mut ContactList<Pair>) {
        let margin = OUTER_MARGIN * self.smallest_radius;
        let slack = 0.5 * (margin - cloud.margin);
        let lasts = self.positions_at_build.len() == cloud.positions.len()
            && farthest_squared(cloud.positions, &self.positions_at_build) < slack * slack;
        if !lasts {
            self.grid.find(Cloud { margin, ..cloud }, &mut self.outer);
            self.positions_at_build.clear();
            self.positions_at_build.extend_from_slice(cloud.positions);
        }
        // Without a branch on whether a pair is near: it would be wrong too often.
        let Self {
            outer, near, near_sums, ..
        } = self;
        near.resize(outer.len(), [0; 2]);
        near_sums.resize(outer.len(), 0.0);
        let mut count = 0;
        for &[first, second] in &*outer {
            let (i, j) = (first as usize, second as usize);
            let radius_sum = cloud.radii[i] + cloud.radii[j];
            let ([x1, y1, _], [x2, y2, _]) = (cloud.positions[i], cloud.positions[j]);
            let ((dx, dy), range) = ((x1 - x2, y1 - y2), radius_sum + cloud.margin);
            let beyond = dx * dx + dy * dy >= range * range;
            (near[count], near_sums[count]) = ([first, second], radius_sum);
            count += usize::from(!beyond);
        }
        pairs.renew(&near[..count], &near_sums[..count], &mut self.scratch);
    }

    /// Replaces `contacts` by all disks whose gap to a wall is less than the margin.
    pub fn find_wall_contacts(
        &mut self,
        cloud: Cloud<'_>,
        walls: &[Wall],
        base_displacement: f64,
        contacts: &mut ContactList<WallContact>,
    ) {
        let Self { near, near_sums, .. } = self;
        near.clear();
        near.extend(near_walls(cloud, walls, base_displacement));
        near_sums.clear();
        near_sums.resize(near.len(), 0.0);
        contacts.renew(near, near_sums, &mut self.wall_scratch);
    }
}

/// Largest square of a distance \[m2\] between the positions in two lists.
pub fn farthest_squared(now: &[[f64; 3]], then: &[[f64; 3]]) -> f64 {
    let count = now.len().min(then.len());
    in_lanes(Farthest {
        now: &now[..count],
        then: &then[..count],
    })
}

struct Farthest<'a> {
    now: &'a [[f64; 3]],
    then: &'a [[f64; 3]],
}

impl LaneWork for Farthest<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<S: Simd, V: Lanes<S>>(self, simd: S) -> f64 {
        let (now, then) = (self.now.chunks_exact(V::LEN), self.then.chunks_exact(V::LEN));
        let rest = now.remainder().iter().zip(then.remainder());
        let mut farthest = V::splat(simd, 0.0);
        for (now, then) in now.zip(then) {
            let mut moved = [f64x2::splat(simd, 0.0); MOST_LANES];
            for k in 0..V::LEN {
                moved[k] = xy(simd, &now[k]) - xy(simd, &then[k]);
            }
            let [dx, dy] = V::columns(&moved);
            farthest = (dx * dx + dy * dy).max(farthest);
        }
        let squares = rest.map(|(now, then)| [now[0] - then[0], now[1] - then[1]]);
        squares
            .map(|[dx, dy]| dx * dx + dy * dy)
            .fold(largest(farthest), f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::super::contacts::SpringMemory;
    use super::*;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    fn uniform(random: &mut Pcg64) -> f64 {
        (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The grid finds what comparing all pairs finds, in clouds of every density, with one disk far away.
    #[test]
    fn the_neighbour_list_finds_what_brute_force_finds() {
        let mut random = Pcg64::seed_from_u64(7);
        for extent in [0.01, 0.3, 3.0, 100.0] {
            let count = 150;
            let mut places: Vec<[f64; 3]> = (0..count)
                .map(|_| [extent * uniform(&mut random), extent * uniform(&mut random), 0.0])
                .collect();
            places[17] = [0.0, 1e6, 0.0];
            let radii: Vec<f64> = (0..count).map(|_| 0.01 + 0.02 * uniform(&mut random)).collect();
            let margin = 0.003;
            let mut pairs = ContactList::default();
            NeighbourList::new(0.01, 100).find_pairs(
                Cloud {
                    positions: &places,
                    radii: &radii,
                    margin,
                },
                &mut pairs,
            );
            let mut expected = Vec::new();
            for i in 0..count {
                for j in i + 1..count {
                    let gap = (places[i][0] - places[j][0]).hypot(places[i][1] - places[j][1]) - radii[i] - radii[j];
                    if gap < margin {
                        expected.push((i as u32, j as u32));
                    }
                }
            }
            let found: Vec<_> = pairs.iter().map(|pair: Pair| (pair.first, pair.second)).collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn closed_contacts_keep_their_memory() {
        let places = [[0.0, 0.0, 0.0], [0.02, 0.0, 0.0], [0.04, 0.0, 0.0]];
        let cloud = Cloud {
            positions: &places,
            radii: &[0.01; 3],
            margin: 0.002,
        };
        let mut list = NeighbourList::new(0.01, 100);
        let mut pairs = ContactList::default();
        list.find_pairs(cloud, &mut pairs);
        let mut found: Vec<Pair> = pairs.iter().collect();
        assert_eq!(found.len(), 2);
        let spring = SpringMemory {
            direction: [1.0, 0.0],
            reference: 0.5,
            stretch: 0.25,
        };
        found[1].spring = spring;
        pairs = found.into();
        list.find_pairs(cloud, &mut pairs);
        let springs: Vec<_> = pairs.iter().map(|pair| pair.spring).collect();
        assert_eq!(springs, [SpringMemory::OPEN, spring]);
    }
}
