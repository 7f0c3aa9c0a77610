//! All pairs of disks that are closer than a margin, by a grid of cells.

use std::ops::Range;

use crate::engine::threads::{Threads, share_each};

/// Disks sorted into cells by counting. Scratch memory: nothing in it outlives a search.
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
    /// What several threads find, each part for so many disks.
    parts: Vec<Part>,
}

/// Disks of a part that several threads search.
const PART: usize = 512;

/// Pairs that one part of the disks has.
#[derive(Debug, Clone, Default)]
struct Part {
    near: Vec<u32>,
    pairs: Vec<[u32; 2]>,
}

/// Disks of which neighbours are searched.
#[derive(Clone, Copy)]
pub struct Cloud<'a> {
    /// x, y and angle of each disk.
    pub positions: &'a [[f64; 3]],
    /// Radii \[m\].
    pub radii: &'a [f64],
    /// Gap below which a pair is a candidate \[m\].
    pub margin: f64,
}

impl CellGrid {
    /// Replaces `pairs` by the indices of all pairs whose gap is less than the margin, in order.
    pub fn find(&mut self, threads: &impl Threads, cloud: Cloud<'_>, pairs: &mut Vec<[u32; 2]>) {
        self.sort_into_cells(cloud);
        let disks = cloud.positions.len();
        pairs.clear();
        if threads.count() == 1 {
            let mut near = std::mem::take(&mut self.near);
            near.reserve(disks);
            self.find_of(cloud, 0..disks, &mut near, pairs);
            self.near = near;
            return;
        }
        let mut parts = std::mem::take(&mut self.parts);
        parts.resize(disks.div_ceil(PART), Part::default());
        share_each(threads, &mut parts, |n, Part { near, pairs }| {
            pairs.clear();
            self.find_of(cloud, n * PART..((n + 1) * PART).min(disks), near, pairs);
        });
        parts.iter().for_each(|part| pairs.extend_from_slice(&part.pairs));
        self.parts = parts;
    }

    /// Adds the pairs of which the first is one of these `disks`.
    fn find_of(&self, cloud: Cloud<'_>, disks: Range<usize>, near: &mut Vec<u32>, pairs: &mut Vec<[u32; 2]>) {
        for first in disks {
            self.collect_near(cloud, first, near);
            pairs.extend(near.iter().map(|&second| [first as u32, second]));
        }
    }

    /// Cells as wide as the largest sum of radii and margin, but no more of them than a few per disk, however far one disk
    /// has flown. (Even to infinity: the engine refuses that at the end of the step.)
    fn sort_into_cells(&mut self, cloud: Cloud<'_>) {
        let count = cloud.positions.len();
        let largest = cloud.radii.iter().copied().fold(0.0, f64::max);
        let side = 2.0 * largest + cloud.margin;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &[x, y, _] in cloud.positions {
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
        self.starts.reserve(most as usize + 1);
        self.starts.resize(self.columns * self.rows + 1, 0);
        for &[x, y, _] in cloud.positions {
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

    /// Replaces `near` by the disks after `first`, in order, whose gap to it is less than the margin.
    fn collect_near(&self, cloud: Cloud<'_>, first: usize, near: &mut Vec<u32>) {
        near.clear();
        let [x, y, _] = cloud.positions[first];
        let cell = self.cell_of[first] as usize;
        let (row, column) = (cell / self.columns, cell % self.columns);
        let columns = column.saturating_sub(1)..(column + 2).min(self.columns);
        for row in row.saturating_sub(1)..(row + 2).min(self.rows) {
            let from = self.starts[row * self.columns + columns.start] as usize;
            let to = self.starts[row * self.columns + columns.end] as usize;
            for &second in &self.members[from..to] {
                let other = second as usize;
                let range = cloud.radii[first] + cloud.radii[other] + cloud.margin;
                let (dx, dy) = (x - cloud.positions[other][0], y - cloud.positions[other][1]);
                if other > first && dx * dx + dy * dy < range * range {
                    near.push(second);
                }
            }
        }
        near.sort_unstable();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::threads::OneThread;

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
                    positions: &places,
                    radii: &radii,
                    margin,
                };
                CellGrid::default().find(&OneThread, cloud, &mut pairs);
                assert!(
                    pairs.iter().all(|pair| pair[0] > 0 || place[0] == 1e300),
                    "{places:?}: {pairs:?}"
                );
            }
        }
    }
}
