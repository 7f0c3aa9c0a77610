//! Renewal of a sorted list of candidates for contact, in which closed contacts keep their memory.

use std::ops::Range;

use crate::geometry::Wall;

use super::cell_grid::Cloud;

/// Two bodies that may touch before the list is built again.
pub trait Candidate: Copy {
    /// Indices of the bodies, by which lists are sorted.
    fn key(&self) -> [u32; 2];
    /// Whether the contact holds anything that the next list must take over.
    fn remembers(&self) -> bool;
}

/// Makes room in a list for the candidates of so many disks, so that no step allocates for them.
///
/// Equal disks with gaps below 0.8 radii have no more than three pairs a disk, since lines between neighbours cannot cross; with
/// two walls and a base a disk has three walls. Disks of very different radii, or more walls, may have more: then lists grow.
pub fn make_room<T>(list: &mut Vec<T>, disks: usize) {
    list.reserve(room_for(disks).saturating_sub(list.len()));
}

/// The same as a number of candidates.
pub fn room_for(disks: usize) -> usize {
    3 * disks + 8
}

/// Replaces `list` by the candidates of `fresh`, which are sorted; those that `list` remembers stay as they are.
pub fn renew<C: Candidate>(list: &mut Vec<C>, scratch: &mut Vec<C>, fresh: impl Iterator<Item = C>) {
    scratch.clear();
    let mut old = list.iter().filter(|candidate| candidate.remembers()).peekable();
    for candidate in fresh {
        let key = candidate.key();
        while old.next_if(|former| former.key() < key).is_some() {}
        scratch.push(old.next_if(|former| former.key() == key).copied().unwrap_or(candidate));
    }
    std::mem::swap(list, scratch);
}

/// Indices of all of these disks and of walls whose gap is less than the margin, in order.
pub fn near_walls<'a>(
    cloud: Cloud<'a>,
    walls: &'a [Wall],
    base: f64,
    disks: Range<usize>,
) -> impl Iterator<Item = [u32; 2]> + 'a {
    disks.flat_map(move |disk| {
        let [x, y, _] = cloud.positions[disk];
        let range = cloud.radii[disk] + cloud.margin;
        let near = walls.iter().enumerate();
        let near = near.filter(move |(_, wall)| wall.distance([x, y], base) < range);
        near.map(move |(wall, _)| [disk as u32, wall as u32])
    })
}
