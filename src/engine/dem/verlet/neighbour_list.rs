//! Two Verlet lists, one inside the other, the outer one from a grid of cells.
//!
//! The inner list is short and is built every few steps from the outer one, which lasts for hundreds of steps. It is
//! sorted by indices and holds all pairs closer than its margin, so that sums of forces, and with them all bits of a
//! trajectory, depend neither on when a list was built nor on how the cells lie. Source: Verlet 1967,
//! doi:10.1103/PhysRev.159.98.

use crate::engine::dem::candidates::{make_room, near_walls, renew};
use crate::engine::dem::cell_grid::{CellGrid, Cloud};
use crate::engine::dem::lanes::{F64x2, largest, transpose, xy};
use crate::geometry::Wall;

use super::contacts::{Pair, SpringMemory, WallContact};

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
    scratch: Vec<Pair>,
    wall_scratch: Vec<WallContact>,
}

impl NeighbourList {
    /// For so many disks, of which the smallest has this radius \[m\].
    pub fn new(smallest_radius: f64, disks: usize) -> Self {
        let mut list = Self {
            smallest_radius,
            ..Self::default()
        };
        make_room(&mut list.outer, disks);
        make_room(&mut list.scratch, disks);
        make_room(&mut list.wall_scratch, disks);
        list
    }

    /// Replaces `pairs` by all pairs whose gap is less than the margin; closed contacts keep their memory.
    pub fn find_pairs(&mut self, cloud: Cloud<'_>, pairs: &mut Vec<Pair>) {
        let margin = OUTER_MARGIN * self.smallest_radius;
        let slack = 0.5 * (margin - cloud.margin);
        let lasts = self.positions_at_build.len() == cloud.positions.len()
            && farthest_squared(cloud.positions, &self.positions_at_build) < slack * slack;
        if !lasts {
            self.grid.find(Cloud { margin, ..cloud }, &mut self.outer);
            self.positions_at_build.clear();
            self.positions_at_build.extend_from_slice(cloud.positions);
        }
        let inner = self.outer.iter().filter_map(|&[first, second]| {
            let (i, j) = (first as usize, second as usize);
            let radius_sum = cloud.radii[i] + cloud.radii[j];
            let ([x1, y1, _], [x2, y2, _]) = (cloud.positions[i], cloud.positions[j]);
            let ((dx, dy), range) = ((x1 - x2, y1 - y2), radius_sum + cloud.margin);
            let beyond = dx * dx + dy * dy >= range * range;
            (!beyond).then_some(Pair {
                first,
                second,
                radius_sum,
                spring: SpringMemory::OPEN,
            })
        });
        renew(pairs, &mut self.scratch, inner);
    }

    /// Replaces `contacts` by all disks whose gap to a wall is less than the margin.
    pub fn find_wall_contacts(
        &mut self,
        cloud: Cloud<'_>,
        walls: &[Wall],
        base_displacement: f64,
        contacts: &mut Vec<WallContact>,
    ) {
        let near = near_walls(cloud, walls, base_displacement).map(|[disk, wall]| WallContact {
            disk,
            wall,
            spring: SpringMemory::OPEN,
        });
        renew(contacts, &mut self.wall_scratch, near);
    }
}

/// Largest square of a distance \[m2\] between the positions in two lists.
pub fn farthest_squared(now: &[[f64; 3]], then: &[[f64; 3]]) -> f64 {
    let count = now.len().min(then.len());
    let (now, now_rest) = now[..count].as_chunks();
    let (then, then_rest) = then[..count].as_chunks();
    let mut farthest = F64x2::splat(0.0);
    for (now, then) in now.iter().zip(then) {
        farthest = distances_squared(now, then).fast_max(farthest);
    }
    if let ([now], [then]) = (now_rest, then_rest) {
        farthest = distances_squared(&[*now; 2], &[*then; 2]).fast_max(farthest);
    }
    largest(farthest)
}

#[inline(always)]
fn distances_squared(now: &[[f64; 3]; 2], then: &[[f64; 3]; 2]) -> F64x2 {
    let [dx, dy] = transpose([0, 1].map(|k| xy(&now[k]) - xy(&then[k])));
    dx * dx + dy * dy
}

#[cfg(test)]
mod tests {
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
            let mut pairs = Vec::new();
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
            let found: Vec<_> = pairs.iter().map(|pair| (pair.first, pair.second)).collect();
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
        let mut pairs = Vec::new();
        list.find_pairs(cloud, &mut pairs);
        assert_eq!(pairs.len(), 2);
        let spring = SpringMemory {
            direction: [1.0, 0.0],
            reference: 0.5,
            stretch: 0.25,
        };
        pairs[1].spring = spring;
        list.find_pairs(cloud, &mut pairs);
        assert_eq!(pairs[0].spring, SpringMemory::OPEN);
        assert_eq!(pairs[1].spring, spring);
    }
}
