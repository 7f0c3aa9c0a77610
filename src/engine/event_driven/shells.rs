//! Neighbour lists that are renewed disk by disk.
//!
//! Each disk has a shell around its position when its list was made, wider than its radius by the slack. Two disks are
//! neighbours if their shells touch; as long as both stay in their shells, disks that are no neighbours cannot touch. Only
//! a disk that leaves its shell gets a new list, with the help of a grid of cells. Source: Donev, Torquato and Stillinger
//! 2005, doi:10.1016/j.jcp.2004.08.014, near-neighbour lists.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::clone_in_place::clone_in_place;
use crate::error::are_sane;
use crate::geometry::Disk;

use super::space::{Region, Space};

const NONE: u32 = u32::MAX;

/// Shell of a disk, its links in the grid of cells, and what else predictions need: one cache line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[repr(align(64))]
pub struct ShellEntry {
    /// Centre of the shell \[m\]: position of the disk when its list was made.
    pub centre: Vector2<f64>,
    /// Radius of the disk \[m\].
    radius: f64,
    /// 1/m \[1/kg\].
    pub inverse_mass: f64,
    /// Impacts of the partner when the next event was predicted.
    pub partner_impacts: u32,
    /// Walls that the disk may hit while it is in its shell, as bits.
    pub walls: u32,
    cell: u32,
    next: u32,
    previous: u32,
    /// In a cell at the edge of a periodic region, whose neighbours may be images.
    pub at_edge: bool,
}

/// Neighbour lists and the cells behind them.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct Shells {
    /// One for each disk.
    pub entries: Vec<ShellEntry>,
    /// Rows of `stride` numbers: how many neighbours, then which.
    rows: Vec<u32>,
    stride: usize,
    /// First disk of each cell.
    heads: Vec<u32>,
    columns: usize,
    lines: usize,
    /// Radius of a shell over the radius of its disk.
    factor: f64,
    corner: Vector2<f64>,
    /// Cells per metre across and up.
    cells_per_metre: Vector2<f64>,
}

clone_in_place!(Shells {
    entries,
    rows,
    stride,
    heads,
    columns,
    lines,
    factor,
    corner,
    cells_per_metre
});

impl Shells {
    /// Shells of disks of these masses \[kg\], `factor` > 1 times as wide as disks.
    pub fn new<S: Space>(space: &S, disks: &[Disk], masses: &[f64], factor: f64) -> Self {
        let Region { corner, size } = space.region();
        let side = 2.0 * factor * disks.iter().map(|disk| disk.radius).fold(0.0, f64::max);
        let most = (4 * disks.len() + 16) as f64;
        let columns = (size.x / side).clamp(1.0, most) as usize;
        let lines = (size.y / side).clamp(1.0, (most / columns as f64).max(1.0)) as usize;
        let entries = disks.iter().zip(masses).map(|(disk, mass)| ShellEntry {
            centre: disk.centre(),
            radius: disk.radius,
            inverse_mass: 1.0 / mass,
            partner_impacts: 0,
            walls: 0,
            cell: 0,
            next: NONE,
            previous: NONE,
            at_edge: false,
        });
        let stride = 16;
        let mut shells = Self {
            entries: entries.collect(),
            rows: vec![0; stride * disks.len()],
            stride,
            heads: vec![NONE; columns * lines],
            columns,
            lines,
            factor,
            corner,
            cells_per_metre: Vector2::new(columns as f64, lines as f64).component_div(&size),
        };
        for disk in 0..disks.len() as u32 {
            shells.link::<S>(disk);
            shells.add_neighbours(space, disk);
        }
        shells
    }

    /// Neighbours of a disk.
    #[inline]
    pub fn neighbours(&self, disk: u32) -> &[u32] {
        let row = &self.rows[disk as usize * self.stride..][..self.stride];
        &row[1..=row[0] as usize]
    }

    /// How far a disk of this radius may be from the centre of its shell \[m\].
    #[inline]
    pub fn slack(&self, radius: f64) -> f64 {
        (self.factor - 1.0) * radius
    }

    /// Gives a disk a new shell around `position` \[m\] and a new list.
    pub fn renew<S: Space>(&mut self, space: &S, disk: u32, position: Vector2<f64>) {
        self.unlink(disk);
        self.remove_neighbours(disk);
        self.entries[disk as usize].centre = position;
        self.link::<S>(disk);
        self.add_neighbours(space, disk);
    }

    /// Whether these can be shells of the same disks as `own`: every index exists and every list ends.
    pub fn is_sound(&self, own: &Self) -> bool {
        let disks = own.entries.len();
        let known = |disk: u32| disk == NONE || (disk as usize) < disks;
        let rows_hold = self.stride > 1
            && disks.checked_mul(self.stride) == Some(self.rows.len())
            && self.rows.chunks_exact(self.stride).all(|row| {
                let count = row[0] as usize;
                count < self.stride && row[1..=count].iter().all(|&disk| (disk as usize) < disks)
            });
        let entries_hold = self.entries.len() == disks
            && self
                .entries
                .iter()
                .all(|entry| known(entry.next) && known(entry.previous) && (entry.cell as usize) < own.heads.len())
            && self.entries.iter().zip(&own.entries).all(|(entry, own)| {
                let same = (entry.radius, entry.inverse_mass) == (own.radius, own.inverse_mass);
                same && are_sane(entry.centre.iter().copied())
            });
        let same_scale =
            (self.factor, self.corner, self.cells_per_metre) == (own.factor, own.corner, own.cells_per_metre);
        let same_grid = (self.columns, self.lines, self.heads.len()) == (own.columns, own.lines, own.heads.len());
        let heads_hold = self.heads.iter().all(|&head| known(head));
        rows_hold && entries_hold && same_grid && same_scale && heads_hold && self.chains_hold()
    }

    /// Each disk is in one chain, that of its cell, links lead back as they lead on, and no chain is a ring.
    fn chains_hold(&self) -> bool {
        let mut visited = 0;
        for (cell, &head) in self.heads.iter().enumerate() {
            let (mut before, mut disk) = (NONE, head);
            while disk != NONE {
                let entry = &self.entries[disk as usize];
                if visited == self.entries.len() || entry.cell as usize != cell || entry.previous != before {
                    return false;
                }
                visited += 1;
                (before, disk) = (disk, entry.next);
            }
        }
        visited == self.entries.len()
    }

    fn link<S: Space>(&mut self, disk: u32) {
        let entry = &mut self.entries[disk as usize];
        let index = |axis: usize, count: usize| {
            // A negative or huge place saturates to the cells at the edge.
            (((entry.centre[axis] - self.corner[axis]) * self.cells_per_metre[axis]) as usize).min(count - 1)
        };
        let (column, line) = (index(0, self.columns), index(1, self.lines));
        entry.at_edge = (S::PERIODIC[0] && (column == 0 || column + 1 == self.columns))
            || (S::PERIODIC[1] && (line == 0 || line + 1 == self.lines));
        let cell = line * self.columns + column;
        entry.cell = cell as u32;
        entry.next = self.heads[cell];
        entry.previous = NONE;
        let next = entry.next;
        if next != NONE {
            self.entries[next as usize].previous = disk;
        }
        self.heads[cell] = disk;
    }

    fn unlink(&mut self, disk: u32) {
        let ShellEntry {
            cell, next, previous, ..
        } = self.entries[disk as usize];
        if previous == NONE {
            self.heads[cell as usize] = next;
        } else {
            self.entries[previous as usize].next = next;
        }
        if next != NONE {
            self.entries[next as usize].previous = previous;
        }
    }

    fn remove_neighbours(&mut self, disk: u32) {
        let start = disk as usize * self.stride;
        for entry in 1..=self.rows[start] as usize {
            let other = self.rows[start + entry] as usize * self.stride;
            let row = &mut self.rows[other..other + self.stride];
            let count = row[0] as usize;
            if let Some(found) = row[1..=count].iter().position(|&neighbour| neighbour == disk) {
                row[1 + found] = row[count];
                row[0] -= 1;
            }
        }
        self.rows[start] = 0;
    }

    fn add_neighbours<S: Space>(&mut self, space: &S, disk: u32) {
        let ShellEntry {
            centre,
            radius,
            cell,
            at_edge,
            ..
        } = self.entries[disk as usize];
        let (line, column) = (cell as usize / self.columns, cell as usize % self.columns);
        for (line, first_line) in around(line, self.lines, S::PERIODIC[1]) {
            for (column, first_column) in around(column, self.columns, S::PERIODIC[0]) {
                // In a periodic region of one or two cells across, a cell would be visited more than once.
                if !(first_line && first_column) {
                    continue;
                }
                let mut other = self.heads[line * self.columns + column];
                while other != NONE {
                    let there = &self.entries[other as usize];
                    let mut separation = centre - there.centre;
                    if at_edge {
                        separation = space.nearest_image(separation);
                    }
                    let radius_sum = self.factor * (radius + there.radius);
                    let next = there.next;
                    if separation.norm_squared() < radius_sum * radius_sum && other != disk {
                        self.add(disk, other);
                        self.add(other, disk);
                    }
                    other = next;
                }
            }
        }
    }

    #[inline]
    fn add(&mut self, disk: u32, neighbour: u32) {
        let mut start = disk as usize * self.stride;
        let count = self.rows[start] as usize + 1;
        if count == self.stride {
            self.widen();
            start = disk as usize * self.stride;
        }
        self.rows[start] = count as u32;
        self.rows[start + count] = neighbour;
    }

    /// Twice as much room in every row: some disk has more neighbours than rows hold.
    #[cold]
    fn widen(&mut self) {
        let mut rows = vec![0; 2 * self.rows.len()];
        for (new, old) in rows
            .chunks_exact_mut(2 * self.stride)
            .zip(self.rows.chunks_exact(self.stride))
        {
            new[..self.stride].copy_from_slice(old);
        }
        self.rows = rows;
        self.stride *= 2;
    }
}

/// The up to three indices around `centre` below `count`, each with whether it is visited for the first time.
#[inline]
fn around(centre: usize, count: usize, periodic: bool) -> impl Iterator<Item = (usize, bool)> {
    let before = if centre > 0 {
        Some(centre - 1)
    } else {
        (periodic && count > 1).then(|| count - 1)
    };
    let after = if centre + 1 < count {
        Some(centre + 1)
    } else {
        (periodic && count > 1).then_some(0)
    };
    let after_is_new = after != before;
    [(before, true), (Some(centre), true), (after, after_is_new)]
        .into_iter()
        .filter_map(|(index, first)| index.map(|index| (index, first)))
}
