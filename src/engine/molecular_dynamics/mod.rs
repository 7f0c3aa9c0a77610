//! Molecular dynamics: disks with soft contacts, stepped on a fixed grid of time.
//!
//! Needs: radii and masses, contact laws, walls, a drive. Guarantees: the trajectory lives on the grid
//! `start + n time_step` alone. A look between two grid points takes one short step on a copy, so that where and how
//! often one looks changes no bit of what follows. Momentum is kept to rounding: the walls' impulses obey the recursion
//! of the momenta. Not here: what forces are (`contact`), how the base moves (`drive`).

mod contacts;
mod fits;
mod forces;
mod integrator;
mod looks;
pub(crate) mod neighbours;
mod setup;
mod state;
mod time_step;
mod two_contacts;

use std::marker::PhantomData;

use super::Work;
use crate::drive::{Drive, Motion};
use crate::error::are_sane;
use crate::geometry::Disk;

pub use contacts::{AtWall, Pair, SkinMemory};
pub use forces::ContactLaws;
pub use integrator::{Coordinates, Gear5, Integrator, VelocityVerlet};
pub use looks::Energies;
pub use setup::{Breakdown, Setup};
pub use state::State;
pub use time_step::TimeStepLimits;

use forces::{Bodies, Tally, at_walls, between_disks};
use neighbours::{Cloud, Neighbours, farthest_squared, inner_margin};
use two_contacts::{Laws, Sums};

/// Work of a time step of one disk.
const WORK_OF_STEP: f64 = 0.1;

/// Grid points closer than this fraction of a time step to the end count as the end.
const SNAP: f64 = 1e-6;

/// The engine: integrator I, motion of the base D.
#[derive(Debug, Clone)]
pub struct MolecularDynamics<I, D> {
    setup: Setup,
    radii: Vec<f64>,
    /// 1/m, 1/m, R/I of each disk, then 1 for each impulse of a wall.
    inverse_mass: Vec<f64>,
    /// Weight as a flat force.
    weight: Vec<f64>,
    smallest_radius: f64,
    state: State<D>,
    /// The state at the last time that was asked for, if that is no grid point.
    between: Option<State<D>>,
    backup: State<D>,
    /// Flat: x, y and torque over radius of each disk, then x and y of each wall \[N\].
    force: Vec<f64>,
    /// Radius times angle of each disk \[m\]. Scratch memory of an evaluation.
    rims: Vec<f64>,
    neighbours: Neighbours,
    integrator: PhantomData<I>,
}

impl<I: Integrator, D: Drive> MolecularDynamics<I, D> {
    /// Disks at rest where they are, at `setup.start_time`, under the drive.
    pub fn new(setup: Setup, disks: &[Disk], drive: D) -> Self {
        let (mut position, mut inverse_mass, mut weight) = (Vec::new(), Vec::new(), Vec::new());
        for (disk, mass) in disks.iter().zip(&setup.masses) {
            position.extend([disk.x, disk.y, 0.0]);
            // The moment of inertia is m R^2 / 2, the force that turns one along the surface.
            inverse_mass.extend([1.0 / mass, 1.0 / mass, 2.0 / (mass * disk.radius)]);
            weight.extend([0.0, -mass * setup.gravity, 0.0]);
        }
        let length = position.len() + 2 * setup.walls.len();
        position.resize(length, 0.0);
        inverse_mass.resize(length, 1.0);
        weight.resize(length, 0.0);
        let radii: Vec<f64> = disks.iter().map(|disk| disk.radius).collect();
        let smallest_radius = radii.iter().copied().fold(f64::INFINITY, f64::min);
        let state = State {
            steps: 0,
            base: drive.motion(setup.start_time),
            drive,
            velocity: vec![0.0; length],
            acceleration: vec![0.0; length],
            higher: vec![0.0; length * I::HIGHER_DERIVATIVES],
            position,
            pairs: Vec::new(),
            at_walls: Vec::new(),
            searched: Vec::new(),
            searched_base: 0.0,
            searched_step: 0,
            searched_margin: 0.0,
            base_force: 0.0,
            dissipated_power: 0.0,
            energy_input: 0.0,
            energy_lost: 0.0,
            contacts: 0,
        };
        let mut engine = Self {
            setup,
            rims: vec![0.0; radii.len()],
            radii,
            inverse_mass,
            force: vec![0.0; length],
            weight,
            smallest_radius,
            backup: state.clone(),
            between: None,
            state,
            neighbours: Neighbours::new(smallest_radius),
            integrator: PhantomData,
        };
        engine.set_motion(|_| ());
        engine
    }

    /// Changes positions and velocities by hand (initial states of tests and studies) and starts afresh from there.
    pub fn set_motion(&mut self, change: impl FnOnce(&mut State<D>)) {
        change(&mut self.state);
        self.search();
        let tally = self.evaluate(0.0);
        for (acceleration, (force, inverse)) in self
            .state
            .acceleration
            .iter_mut()
            .zip(self.force.iter().zip(&self.inverse_mass))
        {
            *acceleration = force * inverse;
        }
        self.state.dissipated_power = tally.dissipated_power;
        self.state.contacts = tally.contacts;
        self.between = None;
    }

    /// Advances to `end_time` \[s\]. On a breakdown the state is as before the call.
    ///
    /// # Errors
    /// What stops a run, or more steps than one call may do.
    pub fn advance_to(&mut self, end_time: f64) -> Result<(), Breakdown> {
        self.advance_within(end_time, &mut Work::default())
    }

    /// As [`Self::advance_to`], with the work that it takes taken off `work`.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn advance_within(&mut self, end_time: f64, work: &mut Work) -> Result<(), Breakdown> {
        let step = self.setup.time_step;
        let elapsed = (end_time - self.setup.start_time) / step;
        let target = (elapsed + SNAP).floor().max(0.0);
        let asked = target - self.state.steps as f64;
        let work_of_step = WORK_OF_STEP * self.radii.len() as f64;
        if !work.spend((asked.max(0.0) * work_of_step) as u64) {
            return Err(Breakdown::TooManySteps {
                time: self.time(),
                steps: asked,
                most: work.most() as f64 / work_of_step,
            });
        }
        self.backup.clone_from(&self.state);
        let outcome = self
            .run_to(target as u64)
            .and_then(|()| self.look(end_time))
            .and_then(|()| self.check_finite(end_time));
        if outcome.is_err() {
            std::mem::swap(&mut self.state, &mut self.backup);
        }
        outcome
    }

    /// The state at the time last asked for.
    pub fn now(&self) -> &State<D> {
        self.between.as_ref().unwrap_or(&self.state)
    }

    /// The state on the time grid: all that the future depends on.
    pub fn state(&self) -> &State<D> {
        &self.state
    }

    /// Continues from `state`, seen at `time` \[s\]. On a breakdown the engine is as before the call.
    pub fn restore(&mut self, state: &State<D>, time: f64) -> Result<(), Breakdown> {
        let mut former = std::mem::replace(&mut self.state, state.clone());
        let former_look = self.between.clone();
        let outcome = self.look(time).and_then(|()| self.check_finite(time));
        if outcome.is_err() {
            std::mem::swap(&mut self.state, &mut former);
            self.between = former_look;
        }
        outcome
    }

    /// The drive, to be aimed at new inputs.
    pub fn drive_mut(&mut self) -> &mut D {
        &mut self.state.drive
    }

    /// What stays as it is.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Radii \[m\].
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Time of the present grid point \[s\].
    pub fn time(&self) -> f64 {
        self.time_of(self.state.steps)
    }

    fn time_of(&self, steps: u64) -> f64 {
        self.setup.start_time + steps as f64 * self.setup.time_step
    }

    fn run_to(&mut self, target: u64) -> Result<(), Breakdown> {
        if self.state.steps >= target {
            return Ok(());
        }
        let step = self.setup.time_step;
        I::predict(coordinates(&mut self.state), step);
        loop {
            self.arrive(step, self.time_of(self.state.steps + 1))?;
            self.state.steps += 1;
            let done = self.state.steps == target;
            let coordinates = coordinates(&mut self.state);
            if done {
                I::correct(coordinates, &self.force, &self.inverse_mass, step);
                return Ok(());
            }
            I::correct_and_predict(coordinates, &self.force, &self.inverse_mass, step);
        }
    }

    /// Takes one short step on a copy if `time` lies between grid points; else there is nothing to copy.
    fn look(&mut self, time: f64) -> Result<(), Breakdown> {
        let ahead = time - self.time();
        if ahead.abs() <= SNAP * self.setup.time_step {
            self.between = None;
            return Ok(());
        }
        let mut copy = self.between.take().unwrap_or_else(|| self.state.clone());
        copy.clone_from(&self.state);
        std::mem::swap(&mut self.state, &mut copy);
        let outcome = self.step(ahead, time);
        std::mem::swap(&mut self.state, &mut copy);
        self.between = Some(copy);
        outcome
    }

    /// One step of length `step` \[s\] that ends at `time` \[s\].
    fn step(&mut self, step: f64, time: f64) -> Result<(), Breakdown> {
        I::predict(coordinates(&mut self.state), step);
        self.arrive(step, time)?;
        I::correct(coordinates(&mut self.state), &self.force, &self.inverse_mass, step);
        Ok(())
    }

    /// What lies between prediction and correction of a step: base, neighbours, forces and the balance of energy.
    fn arrive(&mut self, step: f64, time: f64) -> Result<(), Breakdown> {
        let base_before = self.state.base.displacement;
        self.state.base = self.state.drive.motion(time);
        self.search_if_due(time)?;

        let base_force_before = self.state.base_force;
        let tally = self.evaluate(step);
        if tally.deepest > 0.5 * self.smallest_radius {
            let allowed = 0.5 * self.smallest_radius;
            return Err(Breakdown::TooDeep {
                time,
                overlap: tally.deepest,
                allowed,
            });
        }
        let state = &mut self.state;
        state.energy_input += 0.5 * (base_force_before + state.base_force) * (state.base.displacement - base_before);
        state.energy_lost += 0.5 * step * (state.dissipated_power + tally.dissipated_power) + tally.slip_heat;
        state.dissipated_power = tally.dissipated_power;
        state.contacts = tally.contacts;
        Ok(())
    }

    /// Forces at the present positions, velocities and base motion, into `self.force`. Compiled with skins and without, so
    /// that the loops hold no branch on it.
    fn evaluate(&mut self, step: f64) -> Tally {
        if self.setup.laws.skin.acts() {
            self.evaluate_with::<true>(step)
        } else {
            self.evaluate_with::<false>(step)
        }
    }

    #[inline(never)]
    fn evaluate_with<const SKIN: bool>(&mut self, step: f64) -> Tally {
        let count = self.radii.len();
        let state = &mut self.state;
        self.force.copy_from_slice(&self.weight);
        let (on_disks, from_walls) = self.force.split_at_mut(3 * count);
        let (on_disks, _) = on_disks.as_chunks_mut();
        let (places, rates) = (state.position.as_chunks().0, state.velocity.as_chunks().0);
        if SKIN {
            let turns = self.radii.iter().zip(places);
            self.rims
                .iter_mut()
                .zip(turns)
                .for_each(|(rim, (radius, place))| *rim = radius * place[2]);
        }
        let bodies = Bodies::new(places, rates, &self.radii, &self.rims);
        let laws = Laws::new(&self.setup.laws, step);
        let walls = &self.setup.walls;
        let mut sums = Sums::default();
        between_disks::<SKIN>(&laws, &mut state.pairs, bodies, on_disks, &mut sums);
        let ours = (on_disks, &mut *from_walls);
        at_walls::<SKIN>(&laws, &mut state.at_walls, (walls, state.base), bodies, ours, &mut sums);
        let vertical = from_walls.chunks_exact(2).zip(walls);
        state.base_force = vertical.map(|(force, wall)| wall.follows_base * force[1]).sum();
        sums.tally::<SKIN>(state.contacts)
    }

    /// Searches anew if a disk or the base has moved by half the margin since the last search.
    fn search_if_due(&mut self, time: f64) -> Result<(), Breakdown> {
        let state = &self.state;
        let farthest = farthest_squared(state.places(), &state.searched);
        let base_moved = (state.base.displacement - state.searched_base).abs();
        let limit = 0.5 * state.searched_margin;
        if farthest < limit * limit && base_moved < limit {
            return Ok(());
        }
        self.check_pace(farthest.sqrt(), time)?;
        self.search();
        Ok(())
    }

    /// A list that lasts for one step only and is outrun by half a radius can miss contacts.
    fn check_pace(&self, farthest: f64, time: f64) -> Result<(), Breakdown> {
        let allowed = 0.5 * self.smallest_radius;
        if self.state.steps <= self.state.searched_step + 1 && farthest > allowed {
            return Err(Breakdown::TooFast {
                time,
                distance: farthest,
                allowed,
            });
        }
        Ok(())
    }

    /// Comparisons with what is no number are false and trip no other check.
    fn check_finite(&self, time: f64) -> Result<(), Breakdown> {
        let now = self.now();
        let sums = [now.energy_input, now.energy_lost, now.base_force, now.dissipated_power];
        let Motion {
            displacement,
            velocity,
            acceleration,
        } = now.base;
        let vectors = now.position.iter().chain(&now.velocity).chain(&now.acceleration);
        let base = [displacement, velocity, acceleration];
        if are_sane(vectors.copied().chain(sums).chain(base)) {
            Ok(())
        } else {
            Err(Breakdown::NotFinite { time })
        }
    }

    fn search(&mut self) {
        let count = self.radii.len();
        let state = &mut self.state;
        state.searched.clear();
        state.searched.extend_from_slice(&state.position.as_chunks().0[..count]);
        state.searched_base = state.base.displacement;
        state.searched_step = state.steps;
        let rates = state.rates()[..count].iter();
        let squares = rates.map(|[vx, vy, _]| vx * vx + vy * vy);
        let fastest = squares.fold(0.0, f64::max).sqrt().max(state.base.velocity.abs());
        state.searched_margin = inner_margin(fastest, self.setup.time_step, self.smallest_radius);
        let cloud = Cloud {
            places: &state.searched,
            radii: &self.radii,
            margin: state.searched_margin,
        };
        self.neighbours.find_pairs(cloud, &mut state.pairs);
        self.neighbours
            .find_at_walls(cloud, &self.setup.walls, state.searched_base, &mut state.at_walls);
        // A closed one whose disks have jumped apart is not listed any more.
        state.contacts = state.remembered();
    }
}

fn coordinates<D>(state: &mut State<D>) -> Coordinates<'_> {
    Coordinates {
        position: &mut state.position,
        velocity: &mut state.velocity,
        acceleration: &mut state.acceleration,
        higher: &mut state.higher,
    }
}
