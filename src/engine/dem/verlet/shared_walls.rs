//! Disks that are near walls, by one thread or several.

use crate::engine::dem::candidates::near_walls;
use crate::engine::dem::cell_grid::Cloud;
use crate::engine::threads::{Threads, share_each};
use crate::geometry::Wall;

/// Disks of a part that several threads search.
const PART: usize = 1024;

/// Disks and walls that may be near each other.
#[derive(Clone, Copy)]
pub struct NearWalls<'a> {
    /// Disks.
    pub cloud: Cloud<'a>,
    /// Walls.
    pub walls: &'a [Wall],
    /// Displacement of the base \[m\].
    pub base: f64,
}

impl NearWalls<'_> {
    /// Replaces `near` by the indices of all disks and walls whose gap is less than the margin, in order. `parts` is scratch memory.
    pub fn find(self, threads: &impl Threads, near: &mut Vec<[u32; 2]>, parts: &mut Vec<Vec<[u32; 2]>>) {
        near.clear();
        let disks = self.cloud.radii.len();
        if threads.count() == 1 {
            near.extend(near_walls(self.cloud, self.walls, self.base, 0..disks));
            return;
        }
        parts.resize(disks.div_ceil(PART), Vec::new());
        share_each(threads, parts, |n, part| {
            let disks = n * PART..((n + 1) * PART).min(disks);
            part.clear();
            part.extend(near_walls(self.cloud, self.walls, self.base, disks));
        });
        parts.iter().for_each(|part| near.extend_from_slice(part));
    }
}
