//! One evaluation of the forces, by one thread or several.

use crate::contact::NormalForce;
use crate::drive::Motion;
use crate::engine::dem::fixed_grid::GridState;
use crate::engine::threads::{Threads, share};

use super::contact_kinds::{DiskArrays, ForceArrays, MovingWalls};
use super::eights::Eights;
use super::force_sums::{ForceSums, PartialSums};
use super::forces::{self, AddForces};
use super::shared_forces::PairForces;
use super::shared_motion::ArcLengths;
use super::{Disks, Integrator, PredictorCorrector};

impl<I: Integrator, N: NormalForce, T: Threads> PredictorCorrector<I, N, T> {
    /// Forces at the present positions, velocities and base motion, into `self.force`, with the arcs of the present angles if
    /// `has_arcs`. Compiled with tangential springs and without, so that the loops hold no branch on it.
    pub(super) fn evaluate<D>(&mut self, state: &mut GridState<D, Disks>, duration: f64, has_arcs: bool) -> ForceSums {
        if self.constants.setup.laws.tangential.acts() {
            if !has_arcs {
                self.measure_arcs(&state.disks);
            }
            self.evaluate_with::<true>(&mut state.disks, state.base, duration, state.contacts)
        } else {
            self.evaluate_with::<false>(&mut state.disks, state.base, duration, state.contacts)
        }
    }

    fn measure_arcs(&mut self, disks: &Disks) {
        let radii = &self.constants.radii;
        let arcs = ArcLengths {
            arc_lengths: &mut self.arc_lengths,
            radii,
            positions: &disks.positions()[..radii.len()],
        };
        share(&self.threads, arcs);
    }

    #[inline(never)]
    fn evaluate_with<const SPRING: bool>(
        &mut self,
        disks: &mut Disks,
        base: Motion,
        duration: f64,
        closed_before: u32,
    ) -> ForceSums {
        let (setup, radii) = (&self.constants.setup, &self.constants.radii);
        let (on_disks, from_walls) = self.force.split_at_mut(3 * radii.len());
        let from_walls = from_walls.as_chunks_mut().0;
        let (positions, velocities) = (disks.position.as_chunks().0, disks.velocity.as_chunks().0);
        let arrays = DiskArrays::new(positions, velocities, radii, &self.arc_lengths);
        let on_disks = on_disks.as_chunks_mut().0;
        let mut before = PartialSums::default();
        let mut pairs = disks.pairs.eights_mut();
        if self.threads.count() > 1 {
            let of = PairForces {
                laws: setup.laws,
                step: duration,
                disks: arrays,
            };
            let shares = &mut self.shares;
            before = shares.add_forces::<N, SPRING>(&self.threads, of, &mut disks.pairs, on_disks);
            pairs = Eights::default();
        }
        let sums = forces::add(AddForces::<N, SPRING> {
            laws: &setup.laws,
            step: duration,
            disks: arrays,
            walls: MovingWalls {
                walls: &setup.walls,
                base,
            },
            pairs,
            wall_contacts: disks.wall_contacts.eights_mut(),
            closed: closed_before,
            before,
            forces: ForceArrays { on_disks, from_walls },
            workspace: &mut self.workspace,
        });
        let vertical = from_walls.iter().zip(&setup.walls);
        disks.base_force = vertical.map(|(force, wall)| wall.follows_base * force[1]).sum();
        sums
    }
}
