//! Disks that the drive moves: they belong to the floor. Where a drive moves none, nothing of this is compiled.

use crate::contact::NormalForce;
use crate::drive::Drive;
use crate::engine::dem::fixed_grid::GridState;
use crate::engine::threads::Threads;

use super::{Disks, Integrator, PredictorCorrector};

impl<I: Integrator, N: NormalForce, T: Threads> PredictorCorrector<I, N, T> {
    /// Puts them where the drive has them at `time` \[s\], in place of what was predicted.
    #[inline(always)]
    pub(super) fn place_moved_disks<D: Drive>(&self, state: &mut GridState<D, Disks>, time: f64) {
        if !D::MOVES_DISKS {
            return;
        }
        let Disks { position, velocity, .. } = &mut state.disks;
        let (positions, velocities) = (position.as_chunks_mut().0, velocity.as_chunks_mut().0);
        let count = self.constants.radii.len();
        let (positions, velocities) = (&mut positions[..count], &mut velocities[..count]);
        state.drive.move_disks(time, |disk, [x, y], [vx, vy]| {
            if let (Some(position), Some(velocity)) = (positions.get_mut(disk), velocities.get_mut(disk)) {
                *position = [x, y, 0.0];
                *velocity = [vx, vy, 0.0];
            }
        });
    }

    /// Takes the contacts of moved disks with each other and with walls off the list: they are inside of the floor.
    #[inline(always)]
    pub(super) fn drop_contacts_of_the_floor<D: Drive>(&self, disks: &mut Disks) {
        if !D::MOVES_DISKS {
            return;
        }
        let is_free = |disk: u32| self.constants.setup.masses[disk as usize] != 0.0;
        disks.pairs.retain(|pair| is_free(pair.first) || is_free(pair.second));
        disks.wall_contacts.retain(|contact| is_free(contact.disk));
    }

    /// Hands the forces on them to the floor, and counts the work that they do on the other disks in a step of `duration` \[s\]
    /// by their motion relative to the base.
    #[inline(always)]
    pub(super) fn carry_moved_disks<D: Drive>(&mut self, state: &mut GridState<D, Disks>, duration: f64) {
        if !D::MOVES_DISKS {
            return;
        }
        let GridState {
            disks,
            base,
            energy_input,
            ..
        } = state;
        let masses = &self.constants.setup.masses;
        let (on_disks, from_walls) = self.force.split_at_mut(3 * masses.len());
        let (forces, velocities) = (on_disks.as_chunks::<3>().0, disks.velocity.as_chunks::<3>().0);
        let (mut floor, mut power) = ([0.0; 2], 0.0);
        for ((mass, [fx, fy, _]), [vx, vy, _]) in masses.iter().zip(forces).zip(velocities) {
            if *mass == 0.0 {
                floor = [floor[0] - fx, floor[1] - fy];
                power -= fx * vx + fy * (vy - base.velocity);
            }
        }
        from_walls[0] += floor[0];
        from_walls[1] += floor[1];
        disks.base_force += floor[1];
        *energy_input += 0.5 * duration * (disks.moved_power + power);
        disks.moved_power = power;
    }
}
