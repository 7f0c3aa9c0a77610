//! The disks of the front by position: finds the disks near x without going through the rest.
//!
//! Upright columns suffice, since the front is thin. Each octave of radii has columns of its own width, so that a few
//! large disks do not make every search as wide as they are.

use crate::elementary::powi;
use crate::geometry::Disk;

/// Front disks in columns.
#[derive(Debug)]
pub(super) struct Columns {
    left: f64,
    smallest: f64,
    levels: Vec<Level>,
}

/// Disks with radii within one factor of two.
#[derive(Debug)]
struct Level {
    largest: f64,
    column_width: f64,
    columns: Vec<Vec<u32>>,
}

impl Columns {
    /// Empty columns for disks of `radii` \[m\] between the walls.
    pub(super) fn new(radii: &[f64], width: f64) -> Self {
        let smallest = radii.iter().copied().fold(f64::INFINITY, f64::min);
        let mut counts: Vec<usize> = Vec::new();
        for &radius in radii {
            let level = level_of(smallest, radius);
            counts.resize(counts.len().max(level + 1), 0);
            counts[level] += 1;
        }
        let levels = counts.iter().enumerate().map(|(index, &count)| {
            let largest = smallest * powi(2f64, index as i32 + 1);
            // No more columns than disks: memory does not follow the width of an empty box.
            let column_width = (2.0 * largest).max(width / (count as f64 + 1.0));
            let columns = vec![Vec::new(); (width / column_width) as usize + 1];
            Level {
                largest,
                column_width,
                columns,
            }
        });
        Self {
            left: -0.5 * width,
            smallest,
            levels: levels.collect(),
        }
    }

    /// Adds disk `index`.
    pub(super) fn add(&mut self, disk: &Disk, index: u32) {
        self.column(disk).push(index);
    }

    /// Takes disk `index` out.
    pub(super) fn remove(&mut self, disk: &Disk, index: u32) {
        let column = self.column(disk);
        if let Some(position) = column.iter().position(|&member| member == index) {
            column.swap_remove(position);
        }
    }

    /// True if `wanted` holds for some disk whose surface may be within a distance \[m\] of `x`.
    pub(super) fn any_near(&self, x: f64, distance: f64, mut wanted: impl FnMut(u32) -> bool) -> bool {
        self.levels.iter().any(|level| {
            let span = distance + level.largest;
            let first = level.index(x - span - self.left);
            let last = level.index(x + span - self.left);
            level.columns[first..=last].iter().flatten().any(|&index| wanted(index))
        })
    }

    fn column(&mut self, disk: &Disk) -> &mut Vec<u32> {
        let level = &mut self.levels[level_of(self.smallest, disk.radius)];
        let index = level.index(disk.x - self.left);
        &mut level.columns[index]
    }
}

impl Level {
    /// Column at `offset` \[m\] from the left wall, the nearest one for points outside.
    fn index(&self, offset: f64) -> usize {
        // A negative number becomes 0.
        ((offset / self.column_width) as usize).min(self.columns.len() - 1)
    }
}

/// Octave of `radius` above the smallest one.
fn level_of(smallest: f64, radius: f64) -> usize {
    ((radius / smallest) as u64).max(1).ilog2() as usize
}
