//! What a run shows besides its state, and whether a state can be one of this run. Looking changes nothing.

use crate::drive::Drive;
use crate::engine::molecular_dynamics::Energies;
use crate::error::are_sane;

use super::LocatedDynamics;
use super::kinematics::Disks;
use super::state::{Contact, Kinematics, Phase, State};

impl<D: Drive> LocatedDynamics<D> {
    /// Impulse (x, y) \[N.s\] that the wall has given to the disks since the start, at the time last asked for.
    pub fn impulse_of_wall(&self, wall: usize) -> [f64; 2] {
        self.now().wall_impulses[wall]
    }

    /// Total momentum (x, y) \[kg.m/s\] at the time last asked for.
    pub fn momentum(&self) -> [f64; 2] {
        let rates = self.now().rates.iter().zip(&self.setup.masses);
        rates.fold([0.0; 2], |[x, y], (rate, mass)| {
            [x + mass * rate[0], y + mass * rate[1]]
        })
    }

    /// Energies at the time last asked for.
    pub fn energies(&self) -> Energies {
        let state = self.now();
        let (mut kinetic, mut height) = (0.0, 0.0);
        let disks = state
            .places
            .iter()
            .zip(&state.rates)
            .zip(&self.radii)
            .zip(&self.setup.masses);
        for (((place, [vx, vy, spin]), radius), mass) in disks {
            kinetic += 0.5 * mass * (vx * vx + vy * vy + 0.5 * (radius * spin).powi(2));
            height += mass * place[1];
        }
        let disks = Disks {
            places: &state.places,
            rates: &state.rates,
            radii: &self.radii,
        };
        let of_pair = |contact: &Contact| disks.of_pair((contact.first as usize, contact.second as usize)).overlap;
        let of_wall = |contact: &Contact| {
            let wall = &self.setup.walls[contact.second as usize];
            disks.of_wall(contact.first as usize, wall, &state.base).overlap
        };
        let pairs: f64 = state
            .pairs
            .iter()
            .map(|contact| self.elastic(contact, of_pair(contact)))
            .sum();
        let at_walls: f64 = state
            .at_walls
            .iter()
            .map(|contact| self.elastic(contact, of_wall(contact)))
            .sum();
        Energies {
            kinetic,
            potential: self.setup.gravity * height,
            elastic: pairs + at_walls,
        }
    }

    /// Energy \[J\] in the spring and the skin of a contact with this overlap \[m\].
    fn elastic(&self, contact: &Contact, overlap: f64) -> f64 {
        let laws = &self.laws;
        if contact.phase == Phase::Open {
            return 0.0;
        }
        let stretch = match contact.phase {
            Phase::Stick => contact.kinematics.surface - contact.reference,
            Phase::SlipForward | Phase::SlipBackward => {
                laws.slip_compliance * laws.normal_force(overlap, contact.kinematics.closing)
            }
            Phase::Open | Phase::Unpressed => 0.0,
        };
        laws.normal.energy(overlap) + laws.skin.energy(stretch)
    }

    /// Whether `state`, seen at `time` \[s\], can be one of this run: as many disks, indices that exist, and a
    /// grid point just before the time.
    pub fn fits(&self, state: &State<D>, time: f64) -> bool {
        let own = &self.state;
        let lengths = |state: &State<D>| {
            [
                state.places.len(),
                state.rates.len(),
                state.remainders.len(),
                state.wall_impulses.len(),
                state.searched.len(),
            ]
        };
        let (disks, walls) = (self.radii.len() as u32, self.setup.walls.len() as u32);
        let pairs_hold = state
            .pairs
            .iter()
            .all(|pair| pair.first < pair.second && pair.second < disks && is_sane(pair));
        let walls_hold = state
            .at_walls
            .iter()
            .all(|near| near.first < disks && near.second < walls && is_sane(near));
        let (step, ahead) = (self.setup.time_step, time - self.time_of(state.steps));
        let rounding = 4.0 * f64::EPSILON * (time.abs() + self.setup.start_time.abs());
        lengths(state) == lengths(own)
            && pairs_hold
            && walls_hold
            && ahead >= -step - rounding
            && ahead <= 2.0 * step + rounding
            && state.margin > 0.0
            && are_sane(state.searched.iter().flatten().copied())
            && are_sane(state.remainders.iter().flatten().flatten().copied())
            && are_sane([state.searched_base, state.margin])
    }
}

/// Numbers that a contact can have: finite, a direction no longer than one.
fn is_sane(contact: &Contact) -> bool {
    let Kinematics {
        overlap,
        closing,
        surface,
        sliding,
        normal,
        turning,
        lever,
    } = contact.kinematics;
    let unit = |vector: [f64; 2]| vector.iter().all(|part| part.abs() <= 1.0 + 1e-9);
    are_sane([overlap, closing, surface, sliding, turning, lever])
        && are_sane([contact.reference, contact.closing_rate])
        && unit(normal)
        && unit(contact.direction)
}
