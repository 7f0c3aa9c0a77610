//! Molecular dynamics of fourth order: steps on a fixed grid of time, and every change of a contact at its own instant.
//!
//! Touch, release, yield and hold of a contact are found inside the step and integrated for this contact alone; the
//! other contacts go on with the whole step. So the order survives what happens at contacts, and the cost of what happens
//! is that of one contact.
//!
//! A step predicts places and rates at its end, then twice: takes the relative motion of each contact as the cubic
//! between its ends, integrates its force along it (`passage`, `pieces`), and corrects the ends by the impulses.
//!
//! Needs: radii and masses, contact laws, walls, a drive. Guarantees: the trajectory lives on the grid
//! `start + n time_step` alone; a look between two grid points takes one short step on a copy. Momentum is kept to
//! rounding: a contact gives both its bodies the same impulse. Not here: how the base moves (`drive`).

mod extrapolation;
mod frame;
mod kinematics;
mod laws;
mod looks;
mod passage;
mod pieces;
mod polynomial;
mod push;
mod search;
mod state;
mod step;
mod time_step;

use crate::drive::{Drive, Motion};
use crate::error::are_sane;
use crate::geometry::Disk;

use super::molecular_dynamics::{Breakdown, Setup};

pub use state::{Contact, Kinematics, Phase, State};
pub use time_step::limits;

use kinematics::Disks;
use laws::Laws;
use search::Search;
use step::{Scenery, Work};

/// Work of a time step of one disk.
const WORK_OF_STEP: f64 = 1.0;

/// Grid points closer than this fraction of a time step to the end count as the end.
const SNAP: f64 = 1e-6;

/// The engine: motion of the base D.
#[derive(Debug, Clone)]
pub struct LocatedDynamics<D> {
    setup: Setup,
    laws: Laws,
    radii: Vec<f64>,
    /// 1/m, 1/m, 1/I of each disk.
    inverse_masses: Vec<[f64; 3]>,
    smallest_radius: f64,
    state: State<D>,
    /// The state at the last time that was asked for, if that is no grid point.
    between: Option<State<D>>,
    backup: State<D>,
    work: Work,
    search: Search,
}

impl<D: Drive> LocatedDynamics<D> {
    /// Disks at rest where they are, at `setup.start_time`, under the drive.
    pub fn new(setup: Setup, disks: &[Disk], drive: D) -> Self {
        let radii: Vec<f64> = disks.iter().map(|disk| disk.radius).collect();
        let inverse_masses = disks.iter().zip(&setup.masses).map(|(disk, mass)| {
            let inertia = 0.5 * mass * disk.radius * disk.radius;
            [1.0 / mass, 1.0 / mass, 1.0 / inertia]
        });
        let state = State {
            steps: 0,
            base: drive.motion(setup.start_time),
            drive,
            places: disks.iter().map(|disk| [disk.x, disk.y, 0.0]).collect(),
            rates: vec![[0.0; 3]; disks.len()],
            remainders: vec![[[0.0; 3]; 2]; disks.len()],
            wall_impulses: vec![[0.0; 2]; setup.walls.len()],
            pairs: Vec::new(),
            at_walls: Vec::new(),
            searched: Vec::new(),
            searched_base: 0.0,
            margin: 0.0,
            energy_input: 0.0,
            energy_lost: 0.0,
            contacts: 0,
            changes: 0,
        };
        let mut engine = Self {
            laws: Laws::new(setup.laws.normal, setup.laws.skin),
            inverse_masses: inverse_masses.collect(),
            smallest_radius: radii.iter().copied().fold(f64::INFINITY, f64::min),
            radii,
            setup,
            backup: state.clone(),
            between: None,
            state,
            work: Work::default(),
            search: Search::default(),
        };
        engine.set_motion(|_| ());
        engine
    }

    /// Changes places and rates by hand (initial states of tests and studies) and starts afresh from there, with the
    /// skins of overlapping bodies at rest.
    pub fn set_motion(&mut self, change: impl FnOnce(&mut State<D>)) {
        change(&mut self.state);
        self.state.remainders.fill([[0.0; 3]; 2]);
        self.state.pairs.clear();
        self.state.at_walls.clear();
        let margin = search::MARGIN * self.smallest_radius;
        self.search
            .renew(&mut self.state, &self.radii, &self.setup.walls, margin);
        let (mut pairs, mut at_walls) = self.take_contacts();
        step::close_overlapping(&self.scenery([self.state.base; 2], 0.0), &mut pairs, &mut at_walls);
        let overlapping = pairs
            .iter()
            .chain(&at_walls)
            .filter(|contact| contact.phase != Phase::Open);
        self.state.contacts = overlapping.count() as u32;
        (self.state.pairs, self.state.at_walls) = (pairs, at_walls);
        self.between = None;
    }

    /// Advances to `end_time` \[s\]. On a breakdown the state is as before the call.
    ///
    /// # Errors
    /// What stops a run, or more steps than one call may do.
    pub fn advance_to(&mut self, end_time: f64) -> Result<(), Breakdown> {
        self.advance_within(end_time, &mut super::Work::default())
    }

    /// As [`Self::advance_to`], with the work that it takes taken off `work`.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn advance_within(&mut self, end_time: f64, work: &mut super::Work) -> Result<(), Breakdown> {
        let elapsed = (end_time - self.setup.start_time) / self.setup.time_step;
        let target = (elapsed + SNAP).floor().max(0.0);
        let steps = target - self.state.steps as f64;
        let work_of_step = WORK_OF_STEP * self.radii().len() as f64;
        if !work.spend((steps.max(0.0) * work_of_step) as u64) {
            let (time, most) = (self.time(), work.most() as f64 / work_of_step);
            return Err(Breakdown::TooManySteps { time, steps, most });
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
        while self.state.steps < target {
            self.step(self.setup.time_step, self.time_of(self.state.steps + 1))?;
            self.state.steps += 1;
        }
        Ok(())
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
        let base = [self.state.base, self.state.drive.motion(time)];
        self.search_if_due(step, time, base[1].displacement)?;
        let mut work = std::mem::take(&mut self.work);
        let scenery = self.scenery(base, step);
        let (pairs, at_walls) = (&self.state.pairs, &self.state.at_walls);
        work.predict(&scenery, pairs, at_walls);
        work.refine::<false>(&scenery, pairs, at_walls);
        work.refine::<true>(&scenery, pairs, at_walls);
        self.work = work;
        self.take_over(base[1], time)
    }

    /// Makes the end of the step the state.
    fn take_over(&mut self, base: Motion, time: f64) -> Result<(), Breakdown> {
        let (state, work) = (&mut self.state, &mut self.work);
        let (tally, allowed) = (work.tally, 0.5 * self.smallest_radius);
        if tally.deepest > allowed {
            return Err(Breakdown::TooDeep {
                time,
                overlap: tally.deepest,
                allowed,
            });
        }
        work.commit(&mut state.pairs, &mut state.at_walls);
        std::mem::swap(&mut state.places, &mut work.places);
        std::mem::swap(&mut state.rates, &mut work.rates);
        std::mem::swap(&mut state.remainders, &mut work.remainders);
        for (sum, new) in state.wall_impulses.iter_mut().zip(&work.wall_impulses) {
            sum[0] += new[0];
            sum[1] += new[1];
        }
        state.base = base;
        state.energy_input += tally.work;
        state.energy_lost += tally.lost;
        state.contacts = tally.contacts;
        state.changes += u64::from(tally.changes);
        Ok(())
    }

    fn scenery(&self, base: [Motion; 2], step: f64) -> Scenery<'_> {
        Scenery {
            laws: &self.laws,
            inverse_masses: &self.inverse_masses,
            walls: &self.setup.walls,
            gravity: self.setup.gravity,
            start: Disks {
                places: &self.state.places,
                rates: &self.state.rates,
                radii: &self.radii,
            },
            base,
            remainders: &self.state.remainders,
            step,
        }
    }

    fn take_contacts(&mut self) -> (Vec<Contact>, Vec<Contact>) {
        let state = &mut self.state;
        (std::mem::take(&mut state.pairs), std::mem::take(&mut state.at_walls))
    }

    /// Comparisons with what is no number are false and trip no other check.
    fn check_finite(&self, time: f64) -> Result<(), Breakdown> {
        let now = self.now();
        let Motion {
            displacement,
            velocity,
            acceleration,
        } = now.base;
        let motion = now.places.iter().chain(&now.rates).flatten().copied();
        let impulses = now.wall_impulses.iter().flatten().copied();
        let scalars = [displacement, velocity, acceleration, now.energy_input, now.energy_lost];
        if are_sane(motion.chain(impulses).chain(scalars)) {
            Ok(())
        } else {
            Err(Breakdown::NotFinite { time })
        }
    }
}
