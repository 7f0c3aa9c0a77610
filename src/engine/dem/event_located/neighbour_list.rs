//! The Verlet list, built anew at the start of the first step that could outrun it.

use crate::elementary::hypot;
use crate::engine::dem::candidates::{make_room, near_walls, renew};
use crate::engine::dem::cell_grid::{CellGrid, Cloud};
use crate::engine::dem::fixed_grid::GridState;
use crate::engine::dem::setup::{Breakdown, SoftDisks};
use crate::engine::threads::OneThread;

use super::state::{Contact, Disks};

/// Gap, in smallest radii, below which disks are in the list.
const MARGIN: f64 = 0.15;

/// Part of the margin that two bodies may use up together before the list is built anew: the rest is for what forces add
/// to a step beyond its velocity.
const USED: f64 = 0.9;

/// Scratch memory of a search.
#[derive(Debug, Clone, Default)]
pub struct NeighbourList {
    grid: CellGrid,
    pairs: Vec<[u32; 2]>,
    scratch: Vec<Contact>,
}

impl NeighbourList {
    /// For so many disks.
    pub fn new(disks: usize) -> Self {
        let mut list = Self::default();
        make_room(&mut list.pairs, disks);
        make_room(&mut list.scratch, disks);
        list
    }

    /// Builds the list of all candidates at the start of a run.
    pub fn build<D>(&mut self, state: &mut GridState<D, Disks>, constants: &SoftDisks) {
        self.build_with(state, constants, MARGIN * constants.smallest_radius);
    }

    /// Puts all candidates with a gap below `margin` \[m\] into the list; contacts that are not open keep their memory.
    fn build_with<D>(&mut self, state: &mut GridState<D, Disks>, constants: &SoftDisks, margin: f64) {
        let (disks, base) = (&mut state.disks, state.base.displacement);
        disks.list_margin = margin;
        disks.positions_at_list_build.clone_from(&disks.positions);
        disks.base_at_list_build = base;
        let cloud = Cloud {
            positions: &disks.positions_at_list_build,
            radii: &constants.radii,
            margin,
        };
        self.grid.find(&OneThread, cloud, &mut self.pairs);
        let open = |[first, second]: [u32; 2]| Contact::open(first, second);
        renew(
            &mut disks.pairs,
            &mut self.scratch,
            self.pairs.iter().copied().map(open),
        );
        let near = near_walls(cloud, &constants.setup.walls, base, 0..cloud.radii.len());
        renew(&mut disks.wall_contacts, &mut self.scratch, near.map(open));
    }

    /// Builds the list anew before a step of `duration` \[s\] that could bring bodies together that are not in it.
    ///
    /// # Errors
    /// A body moves too far in one step.
    pub fn build_if_due<D>(
        &mut self,
        state: &mut GridState<D, Disks>,
        constants: &SoftDisks,
        duration: f64,
        end: EndOfStep,
    ) -> Result<(), Breakdown> {
        let disks = &state.disks;
        let mut farthest = 0.0;
        let moving = disks.positions.iter().zip(&disks.velocities);
        for ((now, velocity), then) in moving.zip(&disks.positions_at_list_build) {
            let (dx, dy) = (
                now[0] + duration * velocity[0] - then[0],
                now[1] + duration * velocity[1] - then[1],
            );
            let squared = dx * dx + dy * dy;
            farthest = if squared > farthest { squared } else { farthest };
        }
        let limit = 0.5 * USED * disks.list_margin;
        if farthest < limit * limit && (end.base - disks.base_at_list_build).abs() < limit {
            return Ok(());
        }
        let speeds = disks.velocities.iter().map(|velocity| hypot(velocity[0], velocity[1]));
        let base_moves = (end.base - state.base.displacement).abs();
        let distance = (duration * speeds.fold(0.0, f64::max)).max(base_moves);
        constants.check_distance(distance, end.time)?;
        // A list must last for one step at least.
        let margin = (MARGIN * constants.smallest_radius).max(4.0 * distance / USED);
        self.build_with(state, constants, margin);
        Ok(())
    }
}

/// Time \[s\] and displacement of the base \[m\] at the end of a step.
#[derive(Clone, Copy)]
pub struct EndOfStep {
    /// Time \[s\].
    pub time: f64,
    /// Displacement of the base \[m\].
    pub base: f64,
}
