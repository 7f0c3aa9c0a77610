//! Scene `wedge`: one disk that bounces in a vibrated wedge and turns when the wedge is tilted (P 6).
//!
//! Three engines, each a type behind the same variables: the map with its random phase, the exact wedge from impact to
//! impact, and molecular dynamics. Nothing of one is compiled into another.

mod engine;
mod equations;
mod rigid;
mod rows;
mod sheet;
mod soft;

use serde::{Deserialize, Serialize};

use crate::drive::{FollowsInput, Motion, Sine};
use crate::engine::DiskMotion;
use crate::error::are_sane;
use crate::measure::BatchMeans;

use super::disks_on_base::{
    BaseRows, DisksOnBase, StepReport, Stretch, complete, heights, horizontal_positions, mean_angular_velocity,
    mean_velocity, names, rotations, velocities,
};
use super::work_limit::WorkLimit;
use super::{
    Error, Listing, Model, ModelInfo, Reached, Result, Row, SceneInfo, StructuralParameters, Unit, Values, Warning,
};
use engine::AtStart;
pub use engine::{SpecificEnergies, WedgeEngine};
pub use rigid::{EventDriven, Map};
use rows::NAME;
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

/// First duration of a batch of the running standard error \[s\]; it doubles as the run goes on.
const FIRST_BATCH: f64 = 1e-3;

/// Height up the bisector and the bisector itself.
const PLACE: &[&str] = &["wedge.aperture", "wedge.tilt", "disk.radius", "disk.drop_height"];

/// What the velocity of the disk at the start depends on.
const VELOCITY: &[&str] = &["gravity", "seed", "wedge.aperture", "wedge.tilt", "disk.drop_height"];

/// One disk in a wedge, advanced by the engine E.
#[derive(Debug)]
pub struct Wedge<E: WedgeEngine> {
    engine: E,
    /// The engine's state before the step under way.
    backup: E::State,
    /// m \[kg\].
    mass: f64,
    /// R / (A omega_b) \[s\]: what scales an angular velocity.
    scale: f64,
    work_limit: WorkLimit,
    report: StepReport,
    /// The angle turned, read at the ends of batches.
    turning: BatchMeans,
}

/// State of a [`Wedge`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WedgeState<S> {
    /// The engine's.
    pub engine: S,
    /// The last communication step.
    pub report: StepReport,
    /// The running mean of the angular velocity.
    pub turning: BatchMeans,
}

impl<E: WedgeEngine> AsRef<E> for Wedge<E> {
    fn as_ref(&self) -> &E {
        &self.engine
    }
}

impl<E: WedgeEngine> DisksOnBase for Wedge<E> {
    fn report(&self) -> &StepReport {
        &self.report
    }

    fn disk_count(&self) -> usize {
        1
    }

    fn disk_at(&self, time: f64, _disk: usize) -> DiskMotion {
        self.engine.disk_at(time)
    }

    fn base_at(&self, time: f64) -> Motion {
        self.engine.base_at(time)
    }

    fn base_impulse(&self) -> f64 {
        -self.mass * self.engine.impulse()
    }
}

impl<E: WedgeEngine> Wedge<E> {
    /// The engine, to observe everything that is no output.
    pub fn engine(&self) -> &E {
        &self.engine
    }

    /// Advances to `end_time` \[s\] under the inputs among `values`; the state is as before if that cannot be done.
    fn advance_stretch(&mut self, stretch: Stretch, end_time: f64, values: &Values) -> Result<()> {
        self.engine.copy_state_to(&mut self.backup);
        let turning = self.turning.clone();
        let from = self.report.time;
        let impulse = self.engine.impulse() * self.mass;
        self.engine.set_target(from, end_time - from, values);
        if let Err(error) = self.run_sanely(end_time) {
            self.engine.restore(&self.backup, from).map_err(E::refused_step)?;
            self.turning = turning;
            return Err(error);
        }
        let given = impulse - self.engine.impulse() * self.mass;
        self.report = self.report.after(stretch, end_time, given);
        Ok(())
    }

    /// Runs to `end_time`, reading the angle wherever a batch ends. Observing costs nothing of what follows.
    fn run(&mut self, end_time: f64) -> Result<()> {
        let mut budget = self.work_limit.budget(0, end_time);
        while self.turning.due() <= end_time {
            let due = self.turning.due();
            self.engine.advance_within(due, &mut budget).map_err(E::refused_step)?;
            self.turning.record(self.engine.disk_at(due).angle);
        }
        self.engine
            .advance_within(end_time, &mut budget)
            .map_err(E::refused_step)
    }

    /// Runs to `end_time` and checks the result. After an error the state is of no use.
    fn run_sanely(&mut self, end_time: f64) -> Result<()> {
        self.run(end_time)?;
        if self.is_sane(end_time) {
            return Ok(());
        }
        Err(Error::Step {
            model: NAME,
            time: end_time,
            what: "the disk or the base is beyond 1e100 or no longer finite".into(),
            remedy: "Check the base's amplitude and the inputs.".into(),
        })
    }

    /// Whether all numbers at `time` \[s\] are finite and far from overflow.
    fn is_sane(&self, time: f64) -> bool {
        self.motions_are_sane(time) && self.engine.energies_at(time).are_sane() && are_sane([self.engine.impulse()])
    }

    /// Energies per mass now.
    fn energies(&self) -> SpecificEnergies {
        self.engine.energies_at(self.report.time)
    }

    fn means() -> [Row<Self>; 4] {
        let scaled = |name, description, read| Row::output(name, Unit::ONE, 0.01, description, read);
        [
            mean_velocity(0.1, "Horizontal velocity of the disk now").depending_on(&VELOCITY.into()),
            mean_angular_velocity(1.0, "Angular velocity of the disk now, counter-clockwise"),
            scaled(
                "scaled_angular_velocity",
                "Mean angular velocity since measure.start, scaled: R omega / (A omega_b)",
                |wedge: &Self| wedge.scale * wedge.turning.mean(wedge.report.time, wedge.disk(0).angle),
            ),
            scaled(
                "scaled_angular_velocity.standard_error",
                "Standard error of scaled_angular_velocity by batch means; 0 until there are eight batches",
                |wedge| wedge.scale * wedge.turning.standard_error(),
            ),
        ]
    }

    fn base_rows() -> [Row<Self>; 5] {
        let base = BaseRows {
            force: 0.1,
            bodies: "disk on the base",
            note: "; the map holds it at 0",
            position_at_start: &E::AT_START.displacement.into(),
            velocity_at_start: &E::AT_START.velocity.into(),
            acceleration_at_start: &E::AT_START.acceleration.into(),
        };
        base.rows()
    }

    fn energy_rows() -> [Row<Self>; 4] {
        let energy = |name, description, read| Row::output(name, Unit::JOULE, 1e-6, description, read);
        let height = [PLACE, E::AT_START.place, E::AT_START.displacement].concat();
        [
            energy(
                "energy.kinetic",
                "Kinetic energy of translation and rotation",
                |wedge: &Self| wedge.mass * wedge.energies().kinetic,
            )
            .depending_on(&names(&[VELOCITY, &["disk.mass"]])),
            energy(
                "energy.potential",
                "Energy in gravity, zero at the height of the vertex with the base at rest",
                |wedge| wedge.mass * wedge.energies().potential,
            )
            .depending_on(&names(&[&height, &["gravity", "disk.mass"]])),
            energy(
                "energy.input",
                "Work done by the base on the disk since the start",
                |wedge| wedge.mass * wedge.energies().input,
            ),
            energy("energy.lost", "Energy lost in collisions since the start", |wedge| {
                wedge.mass * wedge.energies().lost
            }),
        ]
    }

    fn disk_rows() -> impl Iterator<Item = Row<Self>> {
        let AtStart {
            place, displacement, ..
        } = E::AT_START;
        let across = "Distance of the centre to the right of the wedge's vertex";
        let up = "Height of the centre above the wedge's vertex with the base at rest";
        let angle = "Angle turned, counter-clockwise and unwrapped";
        rotations(1, angle, 1.0, "Angular velocity, counter-clockwise")
            .chain(horizontal_positions(1, 0.01, across).map(move |row| row.depending_on(&names(&[PLACE, place]))))
            .chain(heights(1, 0.01, up).map(move |row| row.depending_on(&names(&[PLACE, place, displacement]))))
            .chain(velocities(1, 0.1, VELOCITY, VELOCITY))
    }
}

impl<E: WedgeEngine> Model for Wedge<E> {
    type State = WedgeState<E::State>;

    const INPUT_PARTS: u32 = E::INPUT_PARTS;

    fn info() -> ModelInfo {
        SceneInfo {
            scene: NAME,
            identifier: E::IDENTIFIER,
            unnamed_drive: "sine",
            engine: E::NAME,
            drive: E::DRIVE,
            description: E::DESCRIPTION,
            equations: equations::HTML,
            disks: 1..=1,
            default_disks: 1,
            stop_time: if E::INPUT_PARTS > 0 { 10.0 } else { 100.0 },
            step_size: if E::INPUT_PARTS > 0 { 1e-3 } else { 1e-2 },
            sheet: sheet::of(E::NAME, E::DRIVE),
        }
        .into()
    }

    fn variables(_structure: &StructuralParameters) -> Vec<Row<Self>> {
        let mut rows = rows::geometry();
        rows.extend(E::contact_rows());
        rows.extend(rows::friction());
        rows.extend(E::drive_rows());
        rows.extend(Self::means());
        rows.extend(Self::base_rows());
        rows.extend(Self::energy_rows());
        rows.extend(E::own_outputs());
        rows.extend(Self::disk_rows());
        complete(rows)
    }

    fn listings() -> Vec<Listing<Self>> {
        E::listings()
    }

    fn new(_structure: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        rows::check(values)?;
        let speed = rows::base_speed(values);
        let engine = E::from_values(start_time, values)?;
        let since = start_time.max(values.real("measure.start"));
        let mut scene = Self {
            backup: engine.copied_state(),
            engine,
            mass: values.real("disk.mass"),
            work_limit: WorkLimit::new(start_time, 1, values),
            scale: values.real("disk.radius") / speed,
            report: StepReport::at_start(start_time),
            turning: BatchMeans::new(since, FIRST_BATCH),
        };
        scene.run(start_time)?;
        Ok(scene)
    }

    fn tune(&mut self, values: &Values) -> Result<()> {
        self.engine.tune(self.report.time, values)
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        self.advance_stretch(Stretch::Beginning, end_time, values)
    }

    fn resume_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.advance_stretch(Stretch::Rest, end_time, values)?;
        Ok(Reached {
            time: end_time,
            event: false,
        })
    }

    fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        self.engine.warning(told).into_iter().collect()
    }

    fn limit_work(&mut self, most: u64) {
        self.work_limit.replace(most);
    }

    fn state(&self) -> Self::State {
        WedgeState {
            engine: self.engine.copied_state(),
            report: self.report,
            turning: self.turning.clone(),
        }
    }

    fn time_of(state: &Self::State) -> f64 {
        state.report.time
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let WedgeState { report, turning, .. } = state;
        let time = report.time;
        let remedy = "Restore states of the same scene and parameters only.";
        if !(report.is_sane() && turning.continues(&self.turning, FIRST_BATCH) && turning.due() > time) {
            return Err(Error::state("its running means cannot be those of a wedge", remedy));
        }
        if !self.engine.fits(&state.engine, time) {
            return Err(Error::state(
                "its engine's part is no state of one disk in this wedge",
                remedy,
            ));
        }
        let former = self.engine.copied_state();
        self.engine.restore(&state.engine, time).map_err(E::refused_step)?;
        if !self.is_sane(time) {
            self.engine
                .restore(&former, self.report.time)
                .map_err(E::refused_step)?;
            return Err(Error::state("it holds numbers that no wedge has", remedy));
        }
        (self.report, self.turning) = (*report, turning.clone());
        Ok(())
    }
}
