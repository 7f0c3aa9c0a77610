//! Scene `wedge`: one disk that bounces in a vibrated wedge and turns when the wedge is tilted (P 6).
//!
//! Three engines, each a type behind the same variables: the map with its random phase, the exact wedge from impact to
//! impact, and molecular dynamics. Nothing of one is compiled into another.

mod engine;
mod equations;
mod initial;
mod rigid;
mod rows;
mod soft;

use serde::{Deserialize, Serialize};

use crate::drive::{FollowsInput, Sine};
use crate::engine::{MOST_WORK_IN_A_CALL, WorkBudget};
use crate::error::{Error, Result, are_sane};
use crate::measure::BatchMeans;

use super::{Card, Choice, Scene};
use crate::scene::{OutputWriter, Values, Variable};
pub use engine::{Engine, Look};
pub use rigid::{EventDriven, Map};
pub use soft::Soft;

/// Disk in a wedge by the map of P 6.3: walls at rest, base velocities at a random phase.
pub type WedgeMap = Wedge<Map>;

/// Disk in a wedge that truly moves with the drive D, from impact to impact.
pub type WedgeEventDriven<D> = Wedge<EventDriven<D>>;

/// Disk in a wedge that moves with the drive D, by molecular dynamics.
pub type WedgeMolecularDynamics<D> = Wedge<Soft<D>>;

/// [`WedgeEventDriven`] on a sine.
pub type WedgeEventDrivenOnSine = WedgeEventDriven<Sine>;
/// [`WedgeEventDriven`] on the inputs.
pub type WedgeEventDrivenOnInput = WedgeEventDriven<FollowsInput>;
/// [`WedgeMolecularDynamics`] on a sine.
pub type WedgeMolecularDynamicsOnSine = WedgeMolecularDynamics<Sine>;
/// [`WedgeMolecularDynamics`] on the inputs.
pub type WedgeMolecularDynamicsOnInput = WedgeMolecularDynamics<FollowsInput>;

const NAME: &str = "wedge";

/// First duration of a batch of the running standard error \[s\]; it doubles as the run goes on.
const FIRST_BATCH: f64 = 1e-3;

/// One disk in a wedge, advanced by the engine E.
#[derive(Debug)]
pub struct Wedge<E> {
    engine: E,
    /// m \[kg\].
    mass: f64,
    /// R / (A omega_b) \[s\]: what scales an angular velocity.
    scale: f64,
    /// Work that one call may do.
    most_work: u64,
    report: Report,
}

/// What the last communication step reported, and the running mean of the angular velocity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Time reached \[s\].
    pub time: f64,
    /// Vertical impulse of the base on the disk up to `time` \[N.s\].
    pub impulse: f64,
    /// Vertical force of the disk on the base \[N\], mean over the last communication step.
    pub reaction_force: f64,
    /// The angle turned, read at the ends of batches.
    pub turning: BatchMeans,
}

/// State of a [`Wedge`]: the engine's, and the report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WedgeState<S> {
    /// The engine's.
    pub engine: S,
    /// The last communication step and the running mean.
    pub report: Report,
}

impl<E: Engine> Wedge<E> {
    /// The engine, to look at everything that is no output.
    pub fn engine(&self) -> &E {
        &self.engine
    }

    /// Runs to `end_time`, reading the angle wherever a batch ends. Engines look at no cost to what follows.
    fn run(&mut self, end_time: f64) -> Result<()> {
        let mut work = WorkBudget::at_most(self.most_work);
        while self.report.turning.due() <= end_time {
            let due = self.report.turning.due();
            self.engine.advance_to(due, &mut work)?;
            self.report.turning.record(self.engine.look(due).angle);
        }
        self.engine.advance_to(end_time, &mut work)
    }
}

impl<E: Engine> Scene for Wedge<E> {
    type State = WedgeState<E::State>;

    fn card() -> Card {
        Card {
            scene: NAME,
            identifier: E::IDENTIFIER,
            engine: E::NAME,
            drive: E::DRIVE,
            description: E::DESCRIPTION,
            equations: equations::HTML,
            disks: 1..=1,
            default_disks: 1,
            stop_time: 100.0,
            step_size: 1e-2,
        }
    }

    fn variables(_choice: Choice) -> Vec<Variable> {
        rows::rows(E::parameters(), E::drive(), E::counts())
    }

    fn initial_dependencies(name: &str) -> Option<Vec<&'static str>> {
        Some(initial::dependencies(name, E::AT_START))
    }

    fn new(_choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
        rows::check(values)?;
        let speed = rows::base_speed(values);
        let engine = E::new(start_time, values)?;
        let since = start_time.max(values.real("measure.start"));
        let mut scene = Self {
            engine,
            mass: values.real("disk.mass"),
            most_work: MOST_WORK_IN_A_CALL,
            scale: values.real("disk.radius") / speed,
            report: Report {
                time: start_time,
                impulse: 0.0,
                reaction_force: 0.0,
                turning: BatchMeans::new(since, FIRST_BATCH),
            },
        };
        scene.run(start_time)?;
        Ok(scene)
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        let backup = self.state();
        let from = self.report.time;
        self.engine.aim(from, end_time - from, values);
        if let Err(error) = self.run(end_time) {
            self.engine.restore(&backup.engine, from)?;
            self.report = backup.report;
            return Err(error);
        }
        let look = self.engine.look(end_time);
        if !look.is_sane() {
            self.engine.restore(&backup.engine, from)?;
            self.report = backup.report;
            return Err(Error::Step {
                scene: NAME,
                time: end_time,
                what: "the disk or the base is beyond 1e100 or no longer finite".into(),
                remedy: "Check the base's amplitude and the inputs.".into(),
            });
        }
        let impulse = look.impulse * self.mass;
        self.report.reaction_force = (self.report.impulse - impulse) / (end_time - from);
        (self.report.impulse, self.report.time) = (impulse, end_time);
        Ok(())
    }

    fn limit_work(&mut self, most: u64) {
        self.most_work = most;
    }

    fn write_outputs(&self, mut outputs: OutputWriter<'_>) {
        let Report { time, turning, .. } = &self.report;
        let look = self.engine.look(*time);
        let energy = look.energy;
        outputs.real("mean_velocity", look.velocity[0]);
        outputs.real("mean_angular_velocity", look.angular_velocity);
        outputs.real("scaled_angular_velocity", self.scale * turning.mean(*time, look.angle));
        outputs.real(
            "scaled_angular_velocity.standard_error",
            self.scale * turning.standard_error(),
        );
        outputs.real("base.reaction_force", self.report.reaction_force);
        outputs.real("base.position", look.base.displacement);
        outputs.real("base.acceleration", look.base.acceleration);
        outputs.real("energy.kinetic", self.mass * energy.kinetic);
        outputs.real("energy.potential", self.mass * energy.potential);
        outputs.real("energy.input", self.mass * energy.input);
        outputs.real("energy.lost", self.mass * energy.lost);
        self.engine.write_counts(&mut outputs);
        outputs.real("disk.angle[1]", look.angle);
        outputs.real("disk.angular_velocity[1]", look.angular_velocity);
        outputs.real("disk.x[1]", look.place[0]);
        outputs.real("disk.y[1]", look.place[1]);
        outputs.finish();
    }

    fn state(&self) -> Self::State {
        WedgeState {
            engine: self.engine.state(),
            report: self.report.clone(),
        }
    }

    fn time_of(state: &Self::State) -> f64 {
        state.report.time
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let Report {
            time,
            impulse,
            reaction_force,
            turning,
        } = &state.report;
        let remedy = "Restore states of the same scene and parameters only.";
        let report_holds = are_sane([*time, *impulse, *reaction_force]);
        if !(report_holds && turning.continues(&self.report.turning, FIRST_BATCH) && turning.due() > *time) {
            return Err(Error::state("its running means cannot be those of a wedge", remedy));
        }
        let former = self.engine.state();
        self.engine.restore(&state.engine, *time)?;
        if !self.engine.look(*time).is_sane() {
            self.engine.restore(&former, self.report.time)?;
            return Err(Error::state("it holds numbers that no wedge has", remedy));
        }
        self.report = state.report.clone();
        Ok(())
    }
}
