//! Changes of friction and gravity during a run, at a point of the grid of time.

use crate::contact::NormalForce;
use crate::drive::Drive;
use crate::engine::dem::fixed_grid::GridState;
use crate::engine::threads::Threads;

use super::{Disks, Integrator, PredictorCorrector, SpringMemory};

impl<I: Integrator, N: NormalForce, T: Threads> PredictorCorrector<I, N, T> {
    /// From the state on with this friction coefficient and gravity \[m/s2\].
    ///
    /// The forces are those of the state under the new laws. A tangential spring that is stretched beyond the new limit of friction
    /// slips at once, and what it held more is lost. Surfaces that begin to feel each other have unstretched springs.
    pub(super) fn retune<D: Drive>(&mut self, state: &mut GridState<D, Disks>, friction: f64, gravity: f64) {
        let setup = &mut self.constants.setup;
        let acted = setup.laws.tangential.acts();
        setup.laws.tangential.friction = friction;
        setup.gravity = gravity;
        for (weight, mass) in self.weight.as_chunks_mut::<3>().0.iter_mut().zip(&setup.masses) {
            weight[1] = -mass * gravity;
        }
        let tangential = setup.laws.tangential;
        if acted && !tangential.acts() {
            let mut released = 0.0;
            let mut release = |spring: &mut SpringMemory| {
                released += tangential.energy(spring.stretch);
                *spring = SpringMemory::OPEN;
            };
            state.disks.pairs.change_springs(&mut release);
            state.disks.wall_contacts.change_springs(&mut release);
            state.energy_lost += released;
        }
        if !acted && tangential.acts() {
            // Without springs no contact remembers that it is closed: each closes now.
            state.contacts = 0;
        }
        self.force.copy_from_slice(&self.weight);
        let sums = self.evaluate(state, 0.0, false);
        self.carry_moved_disks(state, 0.0);
        let accelerations = state.disks.acceleration.iter_mut();
        for (acceleration, (force, inverse)) in accelerations.zip(self.force.iter().zip(&self.inverse_mass)) {
            *acceleration = force * inverse;
        }
        state.energy_lost += sums.slip_heat;
        state.disks.dissipated_power = sums.dissipated_power;
        state.contacts = sums.contacts;
    }
}
