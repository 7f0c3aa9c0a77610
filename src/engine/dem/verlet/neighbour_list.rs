//! Two Verlet lists, one inside the other, the outer one from a grid of cells.
//!
//! The inner list is short and is built every few steps from the outer one, which lasts for hundreds of steps. It is
//! sorted by indices and holds all pairs closer than its margin, so that sums of forces, and with them all bits of a
//! trajectory, depend neither on when a list was built nor on how the cells lie. Source: Verlet 1967,
//! doi:10.1103/PhysRev.159.98.

use crate::engine::dem::candidates::{make_room, room_for};
use crate::engine::dem::cell_grid::{CellGrid, Cloud};
use crate::engine::threads::{Threads, share};

use super::contact_list::ContactList;
use super::contacts::{Pair, WallContact};
use super::shared_list::NearPairs;
use super::shared_motion::Farthest;
use super::shared_walls::NearWalls;

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
    /// Pairs of the outer list that are in the inner one.
    near: NearPairs,
    scratch: ContactList<Pair>,
    walls: WallScratch,
}

/// Memory for the search of walls.
#[derive(Debug, Clone, Default)]
struct WallScratch {
    bodies: Vec<[u32; 2]>,
    /// Zero.
    lengths: Vec<f64>,
    parts: Vec<Vec<[u32; 2]>>,
    scratch: ContactList<WallContact>,
}

impl NeighbourList {
    /// For so many disks, of which the smallest has this radius \[m\].
    pub fn new(smallest_radius: f64, disks: usize) -> Self {
        let mut list = Self {
            smallest_radius,
            ..Self::default()
        };
        make_room(&mut list.outer, disks);
        list.near.make_room(disks);
        list.scratch.reserve(room_for(disks));
        list.walls.scratch.reserve(room_for(disks));
        make_room(&mut list.walls.bodies, disks);
        make_room(&mut list.walls.lengths, disks);
        list
    }

    /// Replaces `pairs` by all pairs whose gap is less than the margin; closed contacts keep their memory.
    pub fn find_pairs(&mut self, threads: &impl Threads, cloud: Cloud<'_>, pairs: &mut ContactList<Pair>) {
        let margin = OUTER_MARGIN * self.smallest_radius;
        let slack = 0.5 * (margin - cloud.margin);
        let lasts = self.positions_at_build.len() == cloud.positions.len()
            && self.farthest_squared(threads, cloud) < slack * slack;
        if !lasts {
            self.grid.find(threads, Cloud { margin, ..cloud }, &mut self.outer);
            self.positions_at_build.clear();
            self.positions_at_build.extend_from_slice(cloud.positions);
        }
        let (outer, near) = (&self.outer, &mut self.near);
        near.pick(threads, cloud, outer);
        if threads.count() == 1 {
            let (bodies, lengths) = near.only_part();
            pairs.renew(bodies, lengths, &mut self.scratch);
        } else {
            near.renew(threads, pairs, &mut self.scratch);
        }
    }

    /// Largest square of a distance \[m2\] from the positions for which the outer list was built.
    fn farthest_squared(&self, threads: &impl Threads, cloud: Cloud<'_>) -> f64 {
        let (now, then) = (cloud.positions, &self.positions_at_build[..]);
        share(threads, Farthest { now, then })
    }

    /// Replaces `contacts` by all disks whose gap to a wall is less than the margin.
    pub fn find_wall_contacts(
        &mut self,
        threads: &impl Threads,
        search: NearWalls<'_>,
        contacts: &mut ContactList<WallContact>,
    ) {
        let Self { walls: near, .. } = self;
        search.find(threads, &mut near.bodies, &mut near.parts);
        near.lengths.resize(near.bodies.len(), 0.0);
        contacts.renew(&near.bodies, &near.lengths, &mut near.scratch);
    }
}

#[cfg(test)]
mod tests {
    use super::super::contacts::SpringMemory;
    use super::*;
    use crate::engine::threads::OneThread;
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
                &OneThread,
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
        list.find_pairs(&OneThread, cloud, &mut pairs);
        let mut found: Vec<Pair> = pairs.iter().collect();
        assert_eq!(found.len(), 2);
        let spring = SpringMemory {
            direction: [1.0, 0.0],
            reference: 0.5,
            stretch: 0.25,
        };
        found[1].spring = spring;
        pairs = found.into();
        list.find_pairs(&OneThread, cloud, &mut pairs);
        let springs: Vec<_> = pairs.iter().map(|pair| pair.spring).collect();
        assert_eq!(springs, [SpringMemory::OPEN, spring]);
    }
}
