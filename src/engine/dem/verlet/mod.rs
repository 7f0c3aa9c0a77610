//! One evaluation of the forces a step, at predicted positions and velocities: velocity Verlet and Gear's method.
//!
//! Momentum is conserved to rounding: the impulses of the walls obey the recursion of the momenta.

mod closed_contacts;
mod contact_kinds;
mod contact_laws;
mod contact_list;
pub(super) mod contacts;
mod disk_ranges;
mod eights;
mod evaluation;
mod force_sums;
mod forces;
mod gear;
mod integrator;
mod list_building;
mod moved_disks;
mod neighbour_list;
mod shared_forces;
mod shared_list;
mod shared_motion;
mod shared_walls;
mod state;
mod tuning;

use std::marker::PhantomData;

use crate::contact::{LinearDashpot, NormalForce};
use crate::drive::{Drive, Motion};
use crate::elementary::hypot;
use crate::engine::ContactNow;
use crate::engine::threads::{OneThread, Threads, share};
use crate::error::are_sane;
use crate::geometry::Disk;

use super::candidates;
use super::fixed_grid::{GridState, Stepper};
use super::setup::{Breakdown, SoftDiskSetup, SoftDisks};

pub use contact_list::{ContactList, Listed};
pub use contacts::{Pair, SpringMemory, WallContact};
pub use gear::Gear5;
pub use integrator::{Constants, Coordinates, Integrator, VelocityVerlet};
pub use state::Disks;

use closed_contacts::Closed;
use forces::Workspace;
use neighbour_list::NeighbourList;
use shared_forces::Shares;
use shared_motion::Advance;

/// Steps by the integrator I, with the normal force N, on the threads T.
#[derive(Debug, Clone)]
pub struct PredictorCorrector<I, N = LinearDashpot, T = OneThread> {
    constants: SoftDisks<N>,
    /// 1/m, 1/m, R/I of each disk, then 1 for each impulse of a wall.
    inverse_mass: Vec<f64>,
    /// Weight as a flat force.
    weight: Vec<f64>,
    /// Flat: x, y and torque over radius of each disk, then x and y of each wall \[N\]. An evaluation adds to the weights that it
    /// finds here.
    force: Vec<f64>,
    /// Radius times angle of each disk \[m\]. Scratch memory of an evaluation.
    arc_lengths: Vec<f64>,
    neighbours: NeighbourList,
    workspace: Box<Workspace>,
    threads: T,
    shares: Shares,
    integrator: PhantomData<I>,
}

impl<I: Integrator, N: NormalForce, T: Threads> Stepper for PredictorCorrector<I, N, T> {
    type Normal = N;
    type Threads = T;
    type Disks = Disks;

    const WORK_OF_STEP: f64 = 0.1;

    fn at_rest(setup: SoftDiskSetup<N>, disks: &[Disk]) -> (Self, Disks) {
        let (mut position, mut inverse_mass, mut weight) = (Vec::new(), Vec::new(), Vec::new());
        for (disk, mass) in disks.iter().zip(&setup.masses) {
            position.extend([disk.x, disk.y, 0.0]);
            // The moment of inertia is m R^2 / 2, the force that turns one along the surface.
            inverse_mass.extend(match *mass {
                0.0 => [0.0; 3], // no force moves what the drive moves
                mass => [1.0 / mass, 1.0 / mass, 2.0 / (mass * disk.radius)],
            });
            weight.extend([0.0, -mass * setup.gravity, 0.0]);
        }
        let length = position.len() + 2 * setup.walls.len();
        position.resize(length, 0.0);
        inverse_mass.resize(length, 1.0);
        weight.resize(length, 0.0);
        let constants = SoftDisks::new(setup, disks);
        let stepper = Self {
            inverse_mass,
            weight,
            force: vec![0.0; length],
            arc_lengths: vec![0.0; disks.len()],
            workspace: Box::default(),
            threads: T::default(),
            shares: Shares::default(),
            neighbours: NeighbourList::new(constants.smallest_radius, disks.len()),
            constants,
            integrator: PhantomData,
        };
        let disks = Disks {
            position,
            velocity: vec![0.0; length],
            acceleration: vec![0.0; length],
            higher: vec![0.0; length * I::HIGHER_DERIVATIVES],
            ..Disks::default()
        };
        (stepper, disks)
    }

    fn use_threads(&mut self, threads: T) {
        (self.threads, self.shares) = (threads, Shares::default());
    }

    fn constants(&self) -> &SoftDisks<N> {
        &self.constants
    }

    fn start<D: Drive>(&mut self, state: &mut GridState<D, Disks>) {
        self.force.copy_from_slice(&self.weight);
        self.place_moved_disks(state, self.constants.time_of(state.steps));
        self.build_list(state);
        let sums = self.evaluate(state, 0.0, false);
        self.carry_moved_disks(state, 0.0);
        let accelerations = state.disks.acceleration.iter_mut();
        for (acceleration, (force, inverse)) in accelerations.zip(self.force.iter().zip(&self.inverse_mass)) {
            *acceleration = force * inverse;
        }
        state.disks.dissipated_power = sums.dissipated_power;
        state.contacts = sums.contacts;
    }

    fn make_room(disks: &mut Disks) {
        let count = disks.positions_at_list_build.len();
        disks.pairs.reserve(candidates::room_for(count));
        disks.wall_contacts.reserve(candidates::room_for(count));
    }

    fn step<D: Drive>(&mut self, state: &mut GridState<D, Disks>, duration: f64, time: f64) -> Result<(), Breakdown> {
        self.force.copy_from_slice(&self.weight);
        I::predict(coordinates(&mut state.disks), duration);
        self.evaluate_prediction(state, duration, time, None)?;
        I::correct(coordinates(&mut state.disks), &self.force, &self.inverse_mass, duration);
        Ok(())
    }

    fn run<D: Drive>(&mut self, state: &mut GridState<D, Disks>, target: u64) -> Result<(), Breakdown> {
        if state.steps >= target {
            return Ok(());
        }
        let threads = self.threads.clone();
        threads.within(|| self.run_steps(state, target))
    }

    fn tune<D: Drive>(&mut self, state: &mut GridState<D, Disks>, friction: f64, gravity: f64) {
        self.retune(state, friction, gravity);
    }

    fn motion<'s>(&self, disks: &'s Disks) -> (&'s [[f64; 3]], &'s [[f64; 3]]) {
        let count = self.constants.radii.len();
        (&disks.positions()[..count], &disks.velocities()[..count])
    }

    fn set_velocity(&self, disks: &mut Disks, [x, y]: [f64; 2]) {
        let (velocities, _) = disks.velocity.as_chunks_mut();
        velocities[..self.constants.radii.len()].fill([x, y, 0.0]);
    }

    fn base_force(&self, disks: &Disks, _base: Motion) -> f64 {
        disks.base_force
    }

    fn impulse_of_wall(&self, disks: &Disks, wall: usize) -> [f64; 2] {
        let first = 3 * self.constants.radii.len() + 2 * wall;
        [disks.velocity[first], disks.velocity[first + 1]]
    }

    fn elastic_energy(&self, disks: &Disks, base: Motion) -> f64 {
        let (positions, setup) = (disks.positions(), &self.constants.setup);
        let energy = |overlap: f64, spring: &SpringMemory| {
            setup.laws.normal.energy(overlap.max(0.0)) + setup.laws.tangential.energy(spring.stretch)
        };
        let mut elastic = 0.0;
        for pair in disks.pairs.iter() {
            let (a, b) = (positions[pair.first as usize], positions[pair.second as usize]);
            elastic += energy(pair.radius_sum - hypot(a[0] - b[0], a[1] - b[1]), &pair.spring);
        }
        for contact in disks.wall_contacts.iter() {
            let [x, y, _] = positions[contact.disk as usize];
            let distance = setup.walls[contact.wall as usize].distance([x, y], base.displacement);
            elastic += energy(self.constants.radii[contact.disk as usize] - distance, &contact.spring);
        }
        elastic
    }

    fn contacts(&self, disks: &Disks, base: Motion) -> Vec<ContactNow> {
        let closed = Closed {
            constants: &self.constants,
            disks,
            base,
        };
        closed.all()
    }

    fn is_sane(disks: &Disks) -> bool {
        let vectors = disks.position.iter().chain(&disks.velocity).chain(&disks.acceleration);
        are_sane(
            vectors
                .copied()
                .chain([disks.base_force, disks.dissipated_power, disks.moved_power]),
        )
    }

    fn fits<D>(&self, own: &Disks, state: &GridState<D, Disks>) -> bool {
        let lengths = |disks: &Disks| {
            [
                disks.position.len(),
                disks.velocity.len(),
                disks.acceleration.len(),
                disks.higher.len(),
                disks.positions_at_list_build.len(),
            ]
        };
        let (disks, radii) = (&state.disks, &self.constants.radii);
        let (count, walls) = (radii.len() as u32, self.constants.setup.walls.len() as u32);
        let pair_fits = |pair: Pair| {
            pair.first < pair.second
                && pair.second < count
                && pair.radius_sum == radii[pair.first as usize] + radii[pair.second as usize]
                && pair.spring.is_sane()
        };
        let wall_fits = |contact: WallContact| contact.disk < count && contact.wall < walls && contact.spring.is_sane();
        let build = disks.positions_at_list_build.iter().flatten().copied();
        lengths(disks) == lengths(own)
            && disks.pairs.iter().all(pair_fits)
            && disks.wall_contacts.iter().all(wall_fits)
            // The count goes from step to step by the contacts that close and open.
            && (!self.constants.setup.laws.tangential.acts() || state.contacts == disks.closed_contacts())
            && disks.step_of_list_build <= state.steps
            && are_sane(build.chain([disks.base_at_list_build]))
            && (0.0..=self.constants.smallest_radius).contains(&disks.list_margin)
    }
}

impl<I: Integrator, N: NormalForce, T: Threads> PredictorCorrector<I, N, T> {
    /// Advances by one step of the grid or more.
    fn run_steps<D: Drive>(&mut self, state: &mut GridState<D, Disks>, target: u64) -> Result<(), Breakdown> {
        let step = self.constants.setup.time_step;
        self.force.copy_from_slice(&self.weight);
        I::predict(coordinates(&mut state.disks), step);
        let mut farthest = None;
        loop {
            let time = self.constants.time_of(state.steps + 1);
            self.evaluate_prediction(state, step, time, farthest)?;
            state.steps += 1;
            if state.steps == target {
                I::correct(coordinates(&mut state.disks), &self.force, &self.inverse_mass, step);
                return Ok(());
            }
            farthest = self.correct_and_predict::<D>(&mut state.disks, step);
        }
    }

    /// Ends a step and begins the next. Several threads do at once what comes next with each disk, unless the drive moves some before:
    /// they give the largest square of a distance \[m2\] since the list was built.
    fn correct_and_predict<D: Drive>(&mut self, disks: &mut Disks, step: f64) -> Option<f64> {
        let constants = Constants {
            weight: &self.weight,
            inverse_mass: &self.inverse_mass,
        };
        if self.threads.count() == 1 || D::MOVES_DISKS || I::HIGHER_DERIVATIVES > 0 {
            I::correct_and_predict(coordinates(disks), &mut self.force, constants, step);
            return None;
        }
        let Disks {
            position,
            velocity,
            acceleration,
            higher,
            positions_at_list_build,
            ..
        } = disks;
        let advance = Advance::<I> {
            coordinates: Coordinates {
                position,
                velocity,
                acceleration,
                higher,
            },
            force: &mut self.force,
            constants,
            step,
            arc_lengths: &mut self.arc_lengths,
            radii: &self.constants.radii,
            then: positions_at_list_build,
            integrator: PhantomData,
        };
        Some(share(&self.threads, advance))
    }

    /// What lies between prediction and correction of a step: base, neighbours, forces and the balance of energy. `farthest` is what
    /// [`Self::correct_and_predict`] gave.
    fn evaluate_prediction<D: Drive>(
        &mut self,
        state: &mut GridState<D, Disks>,
        duration: f64,
        time: f64,
        farthest: Option<f64>,
    ) -> Result<(), Breakdown> {
        let base_before = state.base.displacement;
        state.base = state.drive.motion(time);
        self.place_moved_disks(state, time);
        self.build_list_if_due(state, time, farthest)?;

        let base_force_before = state.disks.base_force;
        let sums = self.evaluate(state, duration, farthest.is_some());
        self.carry_moved_disks(state, duration);
        self.constants.check_overlap(sums.deepest, time)?;
        let disks = &mut state.disks;
        state.energy_input += 0.5 * (base_force_before + disks.base_force) * (state.base.displacement - base_before);
        state.energy_lost += 0.5 * duration * (disks.dissipated_power + sums.dissipated_power) + sums.slip_heat;
        disks.dissipated_power = sums.dissipated_power;
        state.contacts = sums.contacts;
        Ok(())
    }
}

fn coordinates(disks: &mut Disks) -> Coordinates<'_> {
    Coordinates {
        position: &mut disks.position,
        velocity: &mut disks.velocity,
        acceleration: &mut disks.acceleration,
        higher: &mut disks.higher,
    }
}
