//! A state on a fixed grid of times, advanced by a [`Stepper`].

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::contact::NormalForce;
use crate::drive::{Drive, Motion};
use crate::engine::threads::Threads;
use crate::engine::{ContactNow, Engine, WorkBudget};
use crate::error::are_sane;
use crate::geometry::Disk;

use super::sampler::{Sampler, Unsampled};
use super::setup::{Breakdown, SoftDiskSetup, SoftDisks};

/// State at one point of the grid of time.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct GridState<D, M> {
    /// Steps done: the time is `start + steps * time_step`, never a running sum.
    pub steps: u64,
    /// Motion of the base as a function of time.
    pub drive: D,
    /// Motion of the base now.
    pub base: Motion,
    /// Disks and their contacts.
    pub disks: M,
    /// Work \[J\] that the base has done on the disks.
    pub energy_input: f64,
    /// Energy \[J\] lost in dashpots and by slip.
    pub energy_lost: f64,
    /// Closed contacts now.
    pub contacts: u32,
}

impl<D: Clone, M: Clone> Clone for GridState<D, M> {
    fn clone(&self) -> Self {
        Self {
            drive: self.drive.clone(),
            disks: self.disks.clone(),
            ..*self
        }
    }

    /// Copies without allocating where there is room.
    fn clone_from(&mut self, source: &Self) {
        self.drive.clone_from(&source.drive);
        self.disks.clone_from(&source.disks);
        Self {
            steps: self.steps,
            base: self.base,
            energy_input: self.energy_input,
            energy_lost: self.energy_lost,
            contacts: self.contacts,
            ..
        } = *source;
    }
}

/// How soft disks are advanced by one step.
pub trait Stepper: Sized + std::fmt::Debug + Clone + Send + 'static {
    /// Normal force of its contacts.
    type Normal: NormalForce;
    /// Threads that its steps can use.
    type Threads: Threads;
    /// Disks and their contacts: what changes with time beside the base.
    type Disks: std::fmt::Debug + Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static;

    /// Work of a step of one disk, in units of [`WorkBudget`].
    const WORK_OF_STEP: f64;

    /// `disks` at rest, without contacts yet.
    fn at_rest(setup: SoftDiskSetup<Self::Normal>, disks: &[Disk]) -> (Self, Self::Disks);

    /// Shares the work of the steps to come among `threads`; no bit depends on them.
    fn use_threads(&mut self, threads: Self::Threads);

    /// What stays constant.
    fn constants(&self) -> &SoftDisks<Self::Normal>;

    /// Starts from positions and velocities that were set from outside: overlapping disks have just touched.
    fn start<D: Drive>(&mut self, state: &mut GridState<D, Self::Disks>);

    /// Makes room for all the contacts that the disks may have, so that no step allocates for them.
    fn make_room(disks: &mut Self::Disks);

    /// Advances by one step of `duration` \[s\] that ends at `time` \[s\]; does not count it.
    ///
    /// # Errors
    /// The step cannot be done. The state is then of no use.
    fn step<D: Drive>(
        &mut self,
        state: &mut GridState<D, Self::Disks>,
        duration: f64,
        time: f64,
    ) -> Result<(), Breakdown>;

    /// Advances on the grid until `target` steps are done.
    ///
    /// # Errors
    /// As [`Self::step`].
    fn run<D: Drive>(&mut self, state: &mut GridState<D, Self::Disks>, target: u64) -> Result<(), Breakdown> {
        while state.steps < target {
            let time = self.constants().time_of(state.steps + 1);
            self.step(state, self.constants().setup.time_step, time)?;
            state.steps += 1;
        }
        Ok(())
    }

    /// Goes on from `state` with this friction coefficient and gravity \[m/s2\]. What springs hold beyond the new limit of friction is
    /// lost.
    fn tune<D: Drive>(&mut self, state: &mut GridState<D, Self::Disks>, friction: f64, gravity: f64);

    /// Positions (x, y, angle) and velocities of the disks.
    fn motion<'s>(&self, disks: &'s Self::Disks) -> (&'s [[f64; 3]], &'s [[f64; 3]]);

    /// Gives all disks the velocity (x, y) \[m/s\] and no rotation.
    fn set_velocity(&self, disks: &mut Self::Disks, velocity: [f64; 2]);

    /// Vertical force \[N\] of the walls that follow the base on the disks, with the base at `base`.
    fn base_force(&self, disks: &Self::Disks, base: Motion) -> f64;

    /// Impulse (x, y) \[N.s\] that the wall has given to the disks since the start.
    fn impulse_of_wall(&self, disks: &Self::Disks, wall: usize) -> [f64; 2];

    /// Energy \[J\] in the springs of closed contacts.
    fn elastic_energy(&self, disks: &Self::Disks, base: Motion) -> f64;

    /// The closed contacts, disks with disks first.
    fn contacts(&self, disks: &Self::Disks, base: Motion) -> Vec<ContactNow>;

    /// Whether all numbers of the motion are finite and far from overflow.
    fn is_sane(disks: &Self::Disks) -> bool;

    /// Whether `state` has the lengths, indices and contacts of a state of this run, of which `own` is one.
    fn fits<D>(&self, own: &Self::Disks, state: &GridState<D, Self::Disks>) -> bool;
}

/// Grid points closer than this fraction of a time step to a time count as that time.
const SNAP: f64 = 1e-6;

/// Soft disks on the grid of times `start + n time_step`.
///
/// Guarantees: the trajectory lives on the grid alone. An observation between two grid points takes one short step on a
/// copy, so that when and how often the disks are observed changes no bit of what follows.
#[derive(Debug, Clone)]
pub struct FixedGrid<S: Stepper, D> {
    pub(super) stepper: S,
    state: GridState<D, S::Disks>,
    /// The state at the time last asked for, if that is no grid point.
    between: GridState<D, S::Disks>,
    is_between: bool,
    /// Memory for the next such state.
    spare: GridState<D, S::Disks>,
    backup: GridState<D, S::Disks>,
}

impl<S: Stepper, D: Drive> FixedGrid<S, D> {
    /// Disks at rest where they are, at `setup.start_time`, under the drive.
    pub fn new(setup: SoftDiskSetup<S::Normal>, disks: &[Disk], drive: D) -> Self {
        let base = drive.motion(setup.start_time);
        let (mut stepper, disks) = S::at_rest(setup, disks);
        let mut state = GridState {
            steps: 0,
            drive,
            base,
            disks,
            energy_input: 0.0,
            energy_lost: 0.0,
            contacts: 0,
        };
        stepper.start(&mut state);
        S::make_room(&mut state.disks);
        let copy = || {
            let mut copy = state.clone();
            S::make_room(&mut copy.disks);
            copy
        };
        Self {
            stepper,
            between: copy(),
            is_between: false,
            spare: copy(),
            backup: copy(),
            state,
        }
    }

    /// Shares the work of the steps to come among `threads`; no bit depends on them.
    pub fn use_threads(&mut self, threads: S::Threads) {
        self.stepper.use_threads(threads);
    }

    /// Changes positions and velocities from outside (initial states of tests and studies) and starts afresh from there.
    pub fn set_motion(&mut self, change: impl FnOnce(&mut S::Disks)) {
        change(&mut self.state.disks);
        self.start_afresh();
    }

    /// Gives all disks the velocity (x, y) \[m/s\] and no rotation, and starts afresh from there.
    pub fn set_velocity(&mut self, velocity: [f64; 2]) {
        self.stepper.set_velocity(&mut self.state.disks, velocity);
        self.start_afresh();
    }

    fn start_afresh(&mut self) {
        self.stepper.start(&mut self.state);
        self.is_between = false;
    }

    /// Changes friction coefficient and gravity \[m/s2\] at the present grid point. What is observed stays until the next
    /// observation.
    pub fn tune(&mut self, friction: f64, gravity: f64) {
        self.stepper.tune(&mut self.state, friction, gravity);
    }

    /// Sum of mass times height of the disks \[kg.m\] at the present grid point: their energy in gravity over gravity.
    pub fn height_moment(&self) -> f64 {
        let (positions, _) = self.stepper.motion(&self.state.disks);
        let disks = positions.iter().zip(&self.setup().masses);
        disks.fold(0.0, |sum, (position, mass)| sum + mass * position[1])
    }

    /// The drive, to be given new inputs.
    pub fn drive_mut(&mut self) -> &mut D {
        &mut self.state.drive
    }

    /// Observes at `time` \[s\]: takes one short step on a copy, unless `time` is a grid point.
    fn sample_at(&mut self, time: f64) -> Result<(), Breakdown> {
        self.is_between = self.reach(time)?;
        if self.is_between {
            std::mem::swap(&mut self.between, &mut self.spare);
        }
        Ok(())
    }

    /// Whether `time` \[s\] is no grid point, so that the state at that time is the spare one, made by one short step.
    fn reach(&mut self, time: f64) -> Result<bool, Breakdown> {
        let ahead = time - self.time();
        if ahead.abs() <= SNAP * self.setup().time_step {
            check::<S, D>(&self.state, time)?;
            return Ok(false);
        }
        self.spare.clone_from(&self.state);
        self.stepper.step(&mut self.spare, ahead, time)?;
        check::<S, D>(&self.spare, time)?;
        Ok(true)
    }

    /// Steps from the start to the last grid point until `time` \[s\].
    fn steps_until(&self, time: f64) -> f64 {
        let elapsed = (time - self.setup().start_time) / self.setup().time_step;
        (elapsed + SNAP).floor().max(0.0)
    }

    /// Advances to `end_time` \[s\] as [`Engine::advance_within`], to the bit, and shows the disks to `sampler` on the way.
    ///
    /// # Errors
    /// As [`Engine::advance_within`]; what was shown then does not count.
    pub fn advance_sampled(
        &mut self,
        end_time: f64,
        budget: &mut WorkBudget,
        sampler: &mut impl Sampler,
    ) -> Result<(), Breakdown> {
        let steps = (self.steps_until(end_time) - self.state.steps as f64).max(0.0) + sampler.samples_until(end_time);
        let work_of_step = S::WORK_OF_STEP * self.radii().len() as f64;
        if !budget.spend((steps * work_of_step) as u64) {
            let (time, most) = (self.time(), budget.most() as f64 / work_of_step);
            return Err(Breakdown::TooManySteps { time, steps, most });
        }
        self.backup.clone_from(&self.state);
        let outcome = self.run_sampled(end_time, sampler, budget);
        if outcome.is_err() {
            std::mem::swap(&mut self.state, &mut self.backup);
        }
        outcome
    }

    /// What the sampler sees is never the state that outputs show: that stays where it is if the step is refused.
    fn run_sampled(&mut self, end_time: f64, sampler: &mut impl Sampler, budget: &WorkBudget) -> Result<(), Breakdown> {
        while sampler.due() <= end_time {
            let time = sampler.due();
            let target = self.steps_until(time) as u64;
            self.run(target, budget)?;
            let state = if self.reach(time)? { &self.spare } else { &self.state };
            sampler.take(self.stepper.motion(&state.disks).0);
        }
        let target = self.steps_until(end_time) as u64;
        self.run(target, budget)?;
        self.sample_at(end_time)
    }

    /// Runs until `target` steps are done, in parts if somebody may want it to end.
    fn run(&mut self, target: u64, budget: &WorkBudget) -> Result<(), Breakdown> {
        let Some(work) = budget.work_between_questions() else {
            return self.stepper.run(&mut self.state, target);
        };
        let work_of_step = S::WORK_OF_STEP * self.radii().len() as f64;
        let steps = (work as f64 / work_of_step).max(1.0) as u64;
        while self.state.steps < target {
            let part = target.min(self.state.steps.saturating_add(steps));
            self.stepper.run(&mut self.state, part)?;
            if self.state.steps < target && budget.is_interrupted() {
                let (time, left) = (self.time(), (target - self.state.steps) as f64);
                let most = budget.most() as f64 / work_of_step;
                return Err(Breakdown::TooManySteps {
                    time,
                    steps: left,
                    most,
                });
            }
        }
        Ok(())
    }
}

impl<S: Stepper, D> FixedGrid<S, D> {
    /// The state at the time last asked for.
    pub fn now(&self) -> &GridState<D, S::Disks> {
        if self.is_between { &self.between } else { &self.state }
    }

    /// What stays constant.
    pub fn setup(&self) -> &SoftDiskSetup<S::Normal> {
        &self.stepper.constants().setup
    }

    /// Radii \[m\].
    pub fn radii(&self) -> &[f64] {
        &self.stepper.constants().radii
    }

    /// All that the future depends on.
    pub fn state(&self) -> &GridState<D, S::Disks> {
        &self.state
    }

    /// Time of the present grid point \[s\].
    pub fn time(&self) -> f64 {
        self.stepper.constants().time_of(self.state.steps)
    }
}

impl<S: Stepper, D: Drive> Engine for FixedGrid<S, D> {
    type State = GridState<D, S::Disks>;
    type Stop = Breakdown;

    fn advance_within(&mut self, end_time: f64, budget: &mut WorkBudget) -> Result<(), Breakdown> {
        self.advance_sampled(end_time, budget, &mut Unsampled)
    }

    fn copied_state(&self) -> Self::State {
        self.state.clone()
    }

    fn copy_state_to(&self, state: &mut Self::State) {
        state.clone_from(&self.state);
    }

    fn fits(&self, state: &Self::State, time: f64) -> bool {
        let SoftDiskSetup {
            time_step, start_time, ..
        } = *self.setup();
        let ahead = time - self.stepper.constants().time_of(state.steps);
        let rounding = 4.0 * f64::EPSILON * (time.abs() + start_time.abs());
        (-time_step - rounding..=2.0 * time_step + rounding).contains(&ahead)
            && self.stepper.fits(&self.state.disks, state)
    }

    fn restore(&mut self, state: &Self::State, time: f64) -> Result<(), Breakdown> {
        self.backup.clone_from(state);
        std::mem::swap(&mut self.state, &mut self.backup);
        let outcome = self.sample_at(time);
        if outcome.is_err() {
            std::mem::swap(&mut self.state, &mut self.backup);
        }
        outcome
    }
}

/// Comparisons with what is no number are false and trip no other check.
fn check<S: Stepper, D>(state: &GridState<D, S::Disks>, time: f64) -> Result<(), Breakdown> {
    let Motion {
        displacement,
        velocity,
        acceleration,
    } = state.base;
    let base = [displacement, velocity, acceleration];
    if S::is_sane(&state.disks) && are_sane(base) && are_sane([state.energy_input, state.energy_lost]) {
        Ok(())
    } else {
        Err(Breakdown::NotFinite { time })
    }
}
