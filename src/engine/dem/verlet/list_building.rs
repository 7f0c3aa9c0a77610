//! When the neighbour list of a state is built anew, and how.

use crate::contact::NormalForce;
use crate::drive::Drive;
use crate::engine::dem::cell_grid::Cloud;
use crate::engine::dem::fixed_grid::GridState;
use crate::engine::dem::setup::Breakdown;
use crate::engine::threads::{Threads, share};

use super::neighbour_list::inner_margin;
use super::shared_motion::{Farthest, Fastest};
use super::shared_walls::NearWalls;
use super::{Disks, Integrator, PredictorCorrector};

impl<I: Integrator, N: NormalForce, T: Threads> PredictorCorrector<I, N, T> {
    /// Builds the neighbour list anew if a disk or the base has moved by half the margin since it was built.
    pub(super) fn build_list_if_due<D: Drive>(
        &mut self,
        state: &mut GridState<D, Disks>,
        time: f64,
        farthest: Option<f64>,
    ) -> Result<(), Breakdown> {
        let disks = &state.disks;
        let then = &disks.positions_at_list_build;
        let now = &disks.positions()[..then.len()];
        let farthest = farthest.unwrap_or_else(|| share(&self.threads, Farthest { now, then }));
        let base_moved = (state.base.displacement - disks.base_at_list_build).abs();
        let limit = 0.5 * disks.list_margin;
        if farthest < limit * limit && base_moved < limit {
            return Ok(());
        }
        if state.steps <= disks.step_of_list_build + 1 {
            self.constants.check_distance(farthest.sqrt(), time)?;
        }
        self.build_list(state);
        Ok(())
    }

    pub(super) fn build_list<D: Drive>(&mut self, state: &mut GridState<D, Disks>) {
        let (count, setup) = (self.constants.radii.len(), &self.constants.setup);
        let disks = &mut state.disks;
        disks.positions_at_list_build.clear();
        let positions = &disks.position.as_chunks().0[..count];
        disks.positions_at_list_build.extend_from_slice(positions);
        disks.base_at_list_build = state.base.displacement;
        disks.step_of_list_build = state.steps;
        let fastest = share(&self.threads, Fastest(&disks.velocities()[..count]));
        let fastest = fastest.sqrt().max(state.base.velocity.abs());
        disks.list_margin = inner_margin(fastest, setup.time_step, self.constants.smallest_radius);
        let cloud = Cloud {
            positions: &disks.positions_at_list_build,
            radii: &self.constants.radii,
            margin: disks.list_margin,
        };
        self.neighbours.find_pairs(&self.threads, cloud, &mut disks.pairs);
        let walls = NearWalls {
            cloud,
            walls: &setup.walls,
            base: disks.base_at_list_build,
        };
        self.neighbours
            .find_wall_contacts(&self.threads, walls, &mut disks.wall_contacts);
        self.drop_contacts_of_the_floor::<D>(disks);
        // A closed contact whose disks have jumped apart is not in the list any more.
        state.contacts = disks.closed_contacts();
    }
}
