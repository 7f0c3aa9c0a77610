//! Scene `three_disk`: one disk on two supports that it hardly ever leaves, turned by a torque or by vibration (P 4, 5).
//!
//! What turns it is a type; nothing of one is compiled into another.

mod drives;
mod equations;
mod observables;
mod outputs;
mod parameters;
mod rest;
mod sheet;

use serde::{Deserialize, Serialize};

use crate::drive::excitation::{HarmonicTorque, InputTorque, RandomSupports, SineSupports};
use crate::engine::Engine;
use crate::engine::disk_on_two_supports::contact::ContactForce;
use crate::engine::disk_on_two_supports::{
    DiskOnTwoSupports, Record, TwoSupportsSetup, TwoSupportsState, TwoSupportsStop,
};
use crate::error::are_sane;
use crate::measure::BatchMeans;

use super::disks_on_base::complete;
use super::work_limit::{self, WorkLimit};
use super::{
    Error, Listing, Model, ModelInfo, Reached, Result, Row, SceneInfo, StructuralParameters, Unit, Values, Warning,
    contact_list,
};
pub use drives::DiskOnTwoSupportsDrive;

/// [`DiskOnTwoSupportsScene`] under the torque of an input.
pub type DiskOnTwoSupportsOnInput = DiskOnTwoSupportsScene<InputTorque>;
/// [`DiskOnTwoSupportsScene`] under a harmonic torque (P 5.2).
pub type DiskOnTwoSupportsOnHarmonicTorque = DiskOnTwoSupportsScene<HarmonicTorque>;
/// [`DiskOnTwoSupportsScene`] on supports that vibrate randomly (P 5.3).
pub type DiskOnTwoSupportsOnRandomSupports = DiskOnTwoSupportsScene<RandomSupports>;
/// [`DiskOnTwoSupportsScene`] on supports that vibrate sinusoidally.
pub type DiskOnTwoSupportsOnSine = DiskOnTwoSupportsScene<SineSupports>;

const NAME: &str = "three_disk";

/// First duration of a batch of the running standard error \[s\] where no period is known; it doubles during a run.
const FIRST_BATCH: f64 = 1e-2;

/// A disk on two supports, driven by E.
#[derive(Debug)]
pub struct DiskOnTwoSupportsScene<E> {
    engine: DiskOnTwoSupports<E>,
    /// Forces at the time that the engine has reached: each step needs them once, many outputs show them.
    contacts: [ContactForce; 2],
    /// Energy at the start \[J\].
    start_energy: f64,
    work_limit: WorkLimit,
    start_time: f64,
    begun: Begun,
    report: DiskOnTwoSupportsReport,
}

/// Where the present or the last communication step began. No part of the state: no step is under way when one is
/// saved.
#[derive(Debug, Clone, Copy)]
struct Begun {
    /// \[s\]
    time: f64,
    /// Vertical velocity of the disk then \[m/s\].
    upward: f64,
}

/// What the last communication step reported, and what is taken since measure.start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiskOnTwoSupportsReport {
    /// Time reached \[s\].
    pub time: f64,
    /// Vertical force of the disk on the supports \[N\], mean over the last communication step.
    pub reaction_force: f64,
    /// The angle turned, read at the ends of batches.
    pub turning: BatchMeans,
    /// What the contacts had done at measure.start.
    pub before: Option<Record>,
}

/// State of a [`DiskOnTwoSupportsScene`]: the engine's, and the report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiskOnTwoSupportsState<E> {
    /// The engine's.
    pub engine: TwoSupportsState<E>,
    /// The last communication step and what is taken since measure.start.
    pub report: DiskOnTwoSupportsReport,
}

fn refusal(stop: TwoSupportsStop) -> Error {
    match stop {
        TwoSupportsStop::NoProgress { time } => Error::Step {
            model: NAME,
            time,
            what: "no progress: contacts change more than 1000 times in one time step".into(),
            remedy: "Lower time_step, or raise contact.normal_damping.".into(),
        },
        TwoSupportsStop::TooManySteps { time, steps } => {
            let reason = "A light disk, stiff contacts and fast drives make the time step small: see chosen_time_step.";
            work_limit::refusal(NAME, time, &format!("{steps:e} time steps"), reason)
        }
    }
}

impl<E: DiskOnTwoSupportsDrive> DiskOnTwoSupportsScene<E> {
    /// The engine, for everything that is no output.
    pub fn engine(&self) -> &DiskOnTwoSupports<E> {
        &self.engine
    }

    /// Runs to `end_time`, reading the angle wherever a batch ends, or if `stop` asks for it to the first event before. Returns
    /// when it ended and whether an event ended it. Reading costs little and changes nothing.
    fn run(&mut self, end_time: f64, stop: bool) -> Result<Reached> {
        loop {
            let due = self.report.turning.due();
            let end = due.min(end_time);
            if self.engine.advance(end, stop).map_err(refusal)? {
                let time = self.engine.state().time;
                return Ok(Reached { time, event: true });
            }
            if due > end_time {
                return Ok(Reached {
                    time: end_time,
                    event: false,
                });
            }
            let now = &self.engine.state().now;
            self.report.before.get_or_insert(now.record);
            self.report.turning.record(now.angle());
        }
    }

    /// A step, or its beginning.
    fn step(&mut self, end_time: f64, values: &Values, stop: bool) -> Result<Reached> {
        self.check_work(end_time)?;
        let (backup, from) = (self.state(), self.report.time);
        self.begun = Begun {
            time: from,
            upward: self.engine.state().now.disk[4],
        };
        self.engine
            .steer(|excitation| excitation.set_target(from, end_time, values));
        self.resume(end_time, stop, backup)
    }

    /// Continues under the present drive; goes back to `backup` if that cannot be done.
    fn resume(&mut self, end_time: f64, stop: bool, backup: DiskOnTwoSupportsState<E>) -> Result<Reached> {
        let checked = |scene: &mut Self| {
            let reached = scene.run(end_time, stop)?;
            scene.contacts = scene.engine.observe().contacts;
            scene.check(reached.time).map(|()| reached)
        };
        let reached = match checked(self) {
            Ok(reached) => reached,
            Err(error) => {
                self.resume_engine(&backup.engine);
                self.report = backup.report;
                return Err(error);
            }
        };
        let Begun { time, upward } = self.begun;
        // A step of one bit reports the second of two contacts: the disk has not moved, and the mean stays that before.
        if reached.time > time.next_up() {
            let (now, setup) = (&self.engine.state().now, self.engine.setup());
            let gained = (now.disk[4] - upward) / (reached.time - time);
            self.report.reaction_force = -setup.mass * (gained + setup.gravity);
        }
        self.report.time = reached.time;
        Ok(reached)
    }

    fn resume_engine(&mut self, state: &TwoSupportsState<E>) {
        self.engine.resume(state);
        self.contacts = self.engine.observe().contacts;
    }

    fn check_work(&self, end_time: f64) -> Result<()> {
        let mut budget = self.work_limit.budget(0, end_time);
        self.engine.spend(end_time, &mut budget).map_err(refusal)
    }

    /// Whether the disk, its energies and its forces are finite and far from overflow.
    fn is_sane(&self) -> bool {
        let forces = self.contacts.map(|contact| [contact.normal, contact.tangential]);
        let energies = [self.kinetic_energy(), self.potential_energy(), self.elastic_energy()];
        self.now().is_sane() && are_sane(energies) && are_sane(forces.into_iter().flatten())
    }

    /// Whether the disk is still above its supports and everything is finite.
    fn check(&self, time: f64) -> Result<()> {
        let (now, setup) = (&self.engine.state().now, self.engine.setup());
        let refused = |what: String, remedy: &str| {
            Err(Error::Step {
                model: NAME,
                time,
                what,
                remedy: remedy.into(),
            })
        };
        if !self.is_sane() {
            return refused(
                "the disk is beyond 1e100 or no longer finite".into(),
                "Check the amplitudes and the inputs.",
            );
        }
        let [x, y, ..] = now.disk;
        if setup.curvature > 0.0 && (y < -setup.radius || x.abs() > 2.0 * setup.radius) {
            return refused(
                format!(
                    "the disk has fallen off its supports: it is at x = {}, y = {}",
                    Unit::METRE.format(x),
                    Unit::METRE.format(y)
                ),
                "Drive it less, tilt it less, or take support.shape walls.",
            );
        }
        Ok(())
    }
}

impl<E: DiskOnTwoSupportsDrive> Model for DiskOnTwoSupportsScene<E> {
    type State = DiskOnTwoSupportsState<E>;

    const EVENTS: bool = true;

    fn info() -> ModelInfo {
        SceneInfo {
            scene: NAME,
            identifier: "jostle_three_disk",
            unnamed_drive: "input",
            engine: "molecular-dynamics",
            drive: E::NAME,
            description: E::DESCRIPTION,
            equations: equations::HTML,
            disks: 1..=1,
            default_disks: 1,
            stop_time: 10.0,
            step_size: 1e-2,
            sheet: sheet::of(E::NAME),
        }
        .into()
    }

    fn variables(_structure: &StructuralParameters) -> Vec<Row<Self>> {
        let mut rows = parameters::rows(E::TILT);
        rows.extend(E::rows());
        rows.extend(Self::computed_rows());
        complete(rows)
    }

    fn listings() -> Vec<Listing<Self>> {
        let contacts = |scene: &Self, numbers: &mut Vec<f64>| contact_list::append(scene.closed_contacts(), numbers);
        vec![contact_list::listing(contacts)]
    }

    fn new(_structure: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        let rest = rest::of::<E>(start_time, values)?;
        let rig = parameters::rig(values)?;
        let time_step = rest::time_step::<E>(&rig, values)?;
        let excitation = E::new(start_time, time_step, values);
        let place = [rest[0], rest[1] + values.real("disk.drop_height"), 0.0];
        let rates = [0.0, 0.0, values.real("disk.initial_angular_velocity")];
        let engine = DiskOnTwoSupports::new(
            TwoSupportsSetup::new(rig, time_step),
            excitation,
            start_time,
            place,
            rates,
        );
        let begin = start_time.max(values.real("measure.start"));
        let mut scene = Self {
            contacts: engine.observe().contacts,
            engine,
            start_energy: 0.0,
            work_limit: WorkLimit::new(start_time, 1, values),
            start_time,
            begun: Begun {
                time: start_time,
                upward: 0.0,
            },
            report: DiskOnTwoSupportsReport {
                time: start_time,
                reaction_force: 0.0,
                turning: BatchMeans::new(begin, E::batch(values).unwrap_or(FIRST_BATCH)),
                before: None,
            },
        };
        scene.start_energy = scene.energy();
        scene.run(start_time, false)?;
        Ok(scene)
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        self.step(end_time, values, false).map(|_| ())
    }

    fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        self.engine.state().excitation.warning(told).into_iter().collect()
    }

    fn limit_work(&mut self, most: u64) {
        self.work_limit.replace(most);
    }

    fn advance_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.step(end_time, values, true)
    }

    fn resume_to_event(&mut self, end_time: f64, _values: &Values) -> Result<Reached> {
        self.check_work(end_time)?;
        let backup = self.state();
        self.resume(end_time, true, backup)
    }

    fn state(&self) -> Self::State {
        DiskOnTwoSupportsState {
            engine: self.engine.state().clone(),
            report: self.report.clone(),
        }
    }

    fn time_of(state: &Self::State) -> f64 {
        state.report.time
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let refused = || {
            let remedy = "Restore states of the same scene and parameters only.";
            Error::state("it cannot be that of this disk on two supports", remedy)
        };
        let DiskOnTwoSupportsReport {
            time,
            reaction_force,
            turning,
            before,
        } = &state.report;
        let engine = &state.engine;
        let drives = engine.excitation.continues(&self.engine.state().excitation);
        let means = turning.continues(&self.report.turning, 0.0) && turning.due() > *time;
        let record = before.is_none_or(|record| record.is_sane());
        if !(self.engine.fits(engine, *time) && drives && means && record && are_sane([*reaction_force])) {
            return Err(refused());
        }
        let former = self.engine.state().clone();
        self.resume_engine(engine);
        if !self.is_sane() {
            self.resume_engine(&former);
            return Err(refused());
        }
        self.report = state.report.clone();
        Ok(())
    }
}
