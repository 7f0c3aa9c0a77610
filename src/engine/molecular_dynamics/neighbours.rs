//! Who may touch whom before anybody has moved far: two Verlet lists, one inside the other, the outer from a grid of cells.
//!
//! The inner list is short and made anew every few steps from the outer one, which lasts for hundreds. It is sorted by
//! indices and holds all pairs closer than its margin, so that sums of forces, and with them all bits of a trajectory,
//! depend neither on when a list was made nor on how the cells lie. Source: Verlet 1967, doi:10.1103/PhysRev.159.98.

use crate::geometry::Wall;

use super::contacts::{AtWall, Pair, SkinMemory};
use super::two_contacts::{Two, turned, vector};

/// Gap, in smallest radii, below which a pair is in the outer list: it lasts for long at rest and stays short.
const OUTER_MARGIN: f64 = 0.3;

/// Largest and smallest gap, in smallest radii, below which a pair is in the inner list.
const INNER_MARGINS: [f64; 2] = [1e-3, 0.15];

/// Steps that an inner list should last, at the speed of the fastest disk. A shorter list costs less a step, but is made
/// more often: 6 instead of 16 saves 9 % of the time with 60 disks at Gamma 4 and costs 4 % with 1,000; 48 costs 20 % and
/// nothing (`cargo bench --bench packing`).
const STEPS_TO_LAST: f64 = 16.0;

/// Margin of an inner list \[m\] for a speed \[m/s\] of the fastest disk or the base: two disks may come together.
pub fn inner_margin(fastest: f64, time_step: f64, smallest_radius: f64) -> f64 {
    let [least, most] = INNER_MARGINS;
    let way = 2.0 * STEPS_TO_LAST * fastest * time_step;
    // In this order, since a speed that is no number must not become a margin.
    way.max(least * smallest_radius).min(most * smallest_radius)
}

/// The outer list. Nothing of a trajectory depends on it: it can be dropped at any time.
#[derive(Debug, Clone, Default)]
pub struct Neighbours {
    smallest_radius: f64,
    grid: CellGrid,
    outer: Vec<[u32; 2]>,
    /// Places when the outer list was made.
    listed: Vec<[f64; 3]>,
    found: Vec<Pair>,
    found_at_walls: Vec<AtWall>,
}

impl Neighbours {
    /// For disks of which the smallest has this radius \[m\].
    pub fn new(smallest_radius: f64) -> Self {
        Self {
            smallest_radius,
            ..Self::default()
        }
    }

    /// Replaces `pairs` by all pairs whose gap is less than the margin; closed contacts keep their memory.
    pub fn find_pairs(&mut self, cloud: Cloud<'_>, pairs: &mut Vec<Pair>) {
        let margin = OUTER_MARGIN * self.smallest_radius;
        let slack = 0.5 * (margin - cloud.margin);
        let lasts =
            self.listed.len() == cloud.places.len() && farthest_squared(cloud.places, &self.listed) < slack * slack;
        if !lasts {
            self.grid.find(Cloud { margin, ..cloud }, &mut self.outer);
            self.listed.clear();
            self.listed.extend_from_slice(cloud.places);
        }
        self.found.clear();
        let mut old = pairs.iter().filter(|pair| pair.skin.is_closed()).peekable();
        for &[first, second] in &self.outer {
            let (i, j) = (first as usize, second as usize);
            let reach = cloud.radii[i] + cloud.radii[j];
            let (dx, dy) = (
                cloud.places[i][0] - cloud.places[j][0],
                cloud.places[i][1] - cloud.places[j][1],
            );
            if dx * dx + dy * dy >= (reach + cloud.margin) * (reach + cloud.margin) {
                continue;
            }
            let key = (first, second);
            while old.next_if(|pair| (pair.first, pair.second) < key).is_some() {}
            let kept = old.next_if(|pair| (pair.first, pair.second) == key);
            let skin = kept.map_or(SkinMemory::OPEN, |pair| pair.skin);
            self.found.push(Pair {
                first,
                second,
                reach,
                skin,
            });
        }
        std::mem::swap(pairs, &mut self.found);
    }

    /// Replaces `at_walls` by all disks whose gap to a wall is less than the margin.
    pub fn find_at_walls(
        &mut self,
        cloud: Cloud<'_>,
        walls: &[Wall],
        base_displacement: f64,
        at_walls: &mut Vec<AtWall>,
    ) {
        self.found_at_walls.clear();
        let mut old = at_walls.iter().filter(|near| near.skin.is_closed()).peekable();
        for (disk, (&[x, y, _], radius)) in cloud.places.iter().zip(cloud.radii).enumerate() {
            for (index, wall) in walls.iter().enumerate() {
                if wall.distance([x, y], base_displacement) >= radius + cloud.margin {
                    continue;
                }
                let key = (disk as u32, index as u32);
                while old.next_if(|near| (near.disk, near.wall) < key).is_some() {}
                let kept = old.next_if(|near| (near.disk, near.wall) == key);
                let skin = kept.map_or(SkinMemory::OPEN, |near| near.skin);
                self.found_at_walls.push(AtWall {
                    disk: key.0,
                    wall: key.1,
                    skin,
                });
            }
        }
        std::mem::swap(at_walls, &mut self.found_at_walls);
    }
}

/// Largest square of a distance \[m2\] between the places in two lists.
pub fn farthest_squared(now: &[[f64; 3]], then: &[[f64; 3]]) -> f64 {
    let count = now.len().min(then.len());
    let (now, now_rest) = now[..count].as_chunks();
    let (then, then_rest) = then[..count].as_chunks();
    let mut farthest = Two::splat(0.0);
    for (now, then) in now.iter().zip(then) {
        farthest = way_squared(now, then).fast_max(farthest);
    }
    if let ([now], [then]) = (now_rest, then_rest) {
        farthest = way_squared(&[*now; 2], &[*then; 2]).fast_max(farthest);
    }
    let [one, other] = farthest.to_array();
    one.max(other)
}

#[inline(always)]
fn way_squared(now: &[[f64; 3]; 2], then: &[[f64; 3]; 2]) -> Two {
    let [dx, dy] = turned([0, 1].map(|k| vector(&now[k]) - vector(&then[k])));
    dx * dx + dy * dy
}

/// Disks by cell, by counting sort. Scratch memory of a search: nothing in it outlives the search.
#[derive(Debug, Clone, Default)]
pub struct CellGrid {
    columns: usize,
    rows: usize,
    /// Cell of each disk.
    cell_of: Vec<u32>,
    /// Where each cell starts in `members`; one more entry than cells.
    starts: Vec<u32>,
    members: Vec<u32>,
    near: Vec<u32>,
}

/// Disks as a search sees them.
#[derive(Clone, Copy)]
pub struct Cloud<'a> {
    /// x, y and angle of each disk.
    pub places: &'a [[f64; 3]],
    /// Radii \[m\].
    pub radii: &'a [f64],
    /// Gap below which a pair is a candidate \[m\].
    pub margin: f64,
}

impl CellGrid {
    /// Replaces `pairs` by the indices of all pairs whose gap is less than the margin, in order.
    pub fn find(&mut self, cloud: Cloud<'_>, pairs: &mut Vec<[u32; 2]>) {
        self.sort_into_cells(cloud);
        pairs.clear();
        for first in 0..cloud.places.len() {
            self.collect_near(cloud, first);
            pairs.extend(self.near.iter().map(|&second| [first as u32, second]));
        }
    }

    /// Cells as wide as the largest reach, but no more of them than a few per disk, however far one disk has flown. (Also to
    /// infinity: who takes the step looks at that when it is done.)
    fn sort_into_cells(&mut self, cloud: Cloud<'_>) {
        let count = cloud.places.len();
        let largest = cloud.radii.iter().copied().fold(0.0, f64::max);
        let side = 2.0 * largest + cloud.margin;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &[x, y, _] in cloud.places {
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        let most = (2 * count + 16) as f64;
        // `max` before `min`, since it takes the number where the other is none; `clamp` would not.
        let cells = |extent: f64, most: f64| (extent / side).max(1.0).min(most) as usize;
        self.columns = cells(high[0] - low[0], most);
        self.rows = cells(high[1] - low[1], (most / self.columns as f64).max(1.0));
        let scale = |cells: usize, extent: f64| if extent > 0.0 { cells as f64 / extent } else { 0.0 };
        let per_metre = [
            scale(self.columns, high[0] - low[0]),
            scale(self.rows, high[1] - low[1]),
        ];

        self.cell_of.clear();
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        for &[x, y, _] in cloud.places {
            let column = (((x - low[0]) * per_metre[0]) as usize).min(self.columns - 1);
            let row = (((y - low[1]) * per_metre[1]) as usize).min(self.rows - 1);
            let cell = row * self.columns + column;
            self.cell_of.push(cell as u32);
            self.starts[cell] += 1;
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        self.members.clear();
        self.members.resize(count, 0);
        for disk in (0..count).rev() {
            let start = &mut self.starts[self.cell_of[disk] as usize];
            *start -= 1;
            self.members[*start as usize] = disk as u32;
        }
    }

    /// Fills `near` with the disks after `first`, in order, whose gap to it is less than the margin.
    fn collect_near(&mut self, cloud: Cloud<'_>, first: usize) {
        self.near.clear();
        let [x, y, _] = cloud.places[first];
        let cell = self.cell_of[first] as usize;
        let (row, column) = (cell / self.columns, cell % self.columns);
        let columns = column.saturating_sub(1)..(column + 2).min(self.columns);
        for row in row.saturating_sub(1)..(row + 2).min(self.rows) {
            let from = self.starts[row * self.columns + columns.start] as usize;
            let to = self.starts[row * self.columns + columns.end] as usize;
            for &second in &self.members[from..to] {
                let other = second as usize;
                let reach = cloud.radii[first] + cloud.radii[other] + cloud.margin;
                let (dx, dy) = (x - cloud.places[other][0], y - cloud.places[other][1]);
                if other > first && dx * dx + dy * dy < reach * reach {
                    self.near.push(second);
                }
            }
        }
        self.near.sort_unstable();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    fn uniform(random: &mut Pcg64) -> f64 {
        (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A step may throw disks to infinity before it is refused.
    #[test]
    fn disks_beyond_all_numbers_have_no_neighbours() {
        let (far, none) = (f64::INFINITY, f64::NAN);
        for place in [
            [far, 0.0, 0.0],
            [-far, far, 0.0],
            [none, 1.0, 0.0],
            [1e300, -1e300, 0.0],
        ] {
            for places in [vec![place], vec![place, [0.0; 3], [0.01, 0.0, 0.0]], vec![place; 2]] {
                let radii = vec![0.01; places.len()];
                let (mut pairs, margin) = (Vec::new(), 0.003);
                let cloud = Cloud {
                    places: &places,
                    radii: &radii,
                    margin,
                };
                CellGrid::default().find(cloud, &mut pairs);
                assert!(
                    pairs.iter().all(|pair| pair[0] > 0 || place[0] == 1e300),
                    "{places:?}: {pairs:?}"
                );
            }
        }
    }

    /// The grid finds what comparing all pairs finds, in clouds of every density, with one disk far away.
    #[test]
    fn finds_what_brute_force_finds() {
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
            Neighbours::new(0.01).find_pairs(
                Cloud {
                    places: &places,
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
            places: &places,
            radii: &[0.01; 3],
            margin: 0.002,
        };
        let mut grid = Neighbours::new(0.01);
        let mut pairs = Vec::new();
        grid.find_pairs(cloud, &mut pairs);
        assert_eq!(pairs.len(), 2);
        let skin = SkinMemory {
            direction: [1.0, 0.0],
            reference: 0.5,
            stretch: 0.25,
        };
        pairs[1].skin = skin;
        grid.find_pairs(cloud, &mut pairs);
        assert_eq!(pairs[0].skin, SkinMemory::OPEN);
        assert_eq!(pairs[1].skin, skin);
    }
}
