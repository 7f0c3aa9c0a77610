//! What a run shows besides its state: momentum, impulses of the walls, energies. Looking changes nothing.

use crate::drive::Drive;

use super::{Integrator, MolecularDynamics};

/// Energies of the disks \[J\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energies {
    /// Translation and rotation.
    pub kinetic: f64,
    /// In gravity, zero at height zero.
    pub potential: f64,
    /// In springs and skins of closed contacts.
    pub elastic: f64,
}

impl<I: Integrator, D: Drive> MolecularDynamics<I, D> {
    /// Impulse (x, y) \[N.s\] that the wall has given to the disks since the start, at the time last asked for.
    pub fn impulse_of_wall(&self, wall: usize) -> [f64; 2] {
        let first = 3 * self.radii.len() + 2 * wall;
        let velocity = &self.now().velocity;
        [velocity[first], velocity[first + 1]]
    }

    /// Total momentum (x, y) \[kg.m/s\] at the time last asked for.
    pub fn momentum(&self) -> [f64; 2] {
        let rates = self.now().rates().iter().zip(&self.setup.masses);
        rates.fold([0.0; 2], |[x, y], (rate, mass)| {
            [x + mass * rate[0], y + mass * rate[1]]
        })
    }

    /// Energies at the time last asked for.
    pub fn energies(&self) -> Energies {
        let state = self.now();
        let (mut kinetic, mut height) = (0.0, 0.0);
        for (((place, rate), mass), radius) in state
            .places()
            .iter()
            .zip(state.rates())
            .zip(&self.setup.masses)
            .zip(&self.radii)
        {
            let [vx, vy, angular_velocity] = *rate;
            kinetic += 0.5 * mass * (vx * vx + vy * vy + 0.5 * (radius * angular_velocity).powi(2));
            height += mass * place[1];
        }
        let places = state.places();
        let laws = &self.setup.laws;
        let mut elastic = 0.0;
        for pair in &state.pairs {
            let (a, b) = (places[pair.first as usize], places[pair.second as usize]);
            let overlap = pair.reach - (a[0] - b[0]).hypot(a[1] - b[1]);
            elastic += laws.normal.energy(overlap.max(0.0)) + laws.skin.energy(pair.skin.stretch);
        }
        for near in &state.at_walls {
            let [x, y, _] = places[near.disk as usize];
            let distance = self.setup.walls[near.wall as usize].distance([x, y], state.base.displacement);
            let overlap = self.radii[near.disk as usize] - distance;
            elastic += laws.normal.energy(overlap.max(0.0)) + laws.skin.energy(near.skin.stretch);
        }
        Energies {
            kinetic,
            potential: self.setup.gravity * height,
            elastic,
        }
    }
}
