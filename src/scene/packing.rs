//! Scene `packing`: disks in a box on a vibrating bottom, by molecular dynamics (P 2.1, 2.2, 3.2, 4.2).

mod equations;
pub mod event_driven;
pub mod hard;
mod initial;
mod rows;
pub mod soft;

use serde::{Deserialize, Serialize};

use crate::contact::{ContactLaws, LinearDashpot, TangentialSpring};
use crate::drive::{FollowsInput, Sine};
use crate::engine::dem::event_located::EventStepper;
use crate::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};
use crate::engine::dem::{Breakdown, FixedGrid, Observables, Setup, State, TimeStepLimits};
use crate::engine::{Engine, MOST_WORK_IN_A_CALL, WorkBudget};
use crate::error::{Error, Result, are_sane};
use crate::geometry::{Disk, Wall};
use crate::packing::{RadiusClass, RadiusDistribution, advancing_front};

use super::base_drive::BaseDrive;
use super::{Card, Choice, Scene};
use crate::scene::{OutputWriter, Values, Variable};
use soft::SoftMethod;

/// Packing whose base follows the inputs `base.displacement` and `base.velocity`.
pub type PackingOnInput = SoftPacking<PredictorCorrector<VelocityVerlet>, FollowsInput>;

/// Packing whose base moves as a sine.
pub type PackingOnSine = SoftPacking<PredictorCorrector<VelocityVerlet>, Sine>;

/// The same on inputs and on a sine, of fourth order with located contact events.
pub type LocatedPackingOnInput = SoftPacking<EventStepper, FollowsInput>;
/// See [`LocatedPackingOnInput`].
pub type LocatedPackingOnSine = SoftPacking<EventStepper, Sine>;

const NAME: &str = "packing";

/// Index of the vibrating floor among the walls.
const FLOOR: usize = 0;

/// Disks in a box of two walls and a floor that vibrates with the drive D, advanced by the method M.
#[derive(Debug)]
pub struct SoftPacking<M: SoftMethod, D> {
    engine: FixedGrid<M, D>,
    limits: TimeStepLimits,
    /// Work that one call may do.
    most_work: u64,
    report: Report,
}

/// What the last communication step reported.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Time reached \[s\].
    pub time: f64,
    /// Vertical impulse of the base on the disks up to `time` \[N.s\].
    pub impulse: f64,
    /// Vertical force of the disks on the base \[N\], mean over the last communication step.
    pub reaction_force: f64,
    /// Total energy at the start \[J\], which depends on where the inputs had the base; for the residual.
    pub start_energy: f64,
}

/// State of a [`SoftPacking`]: the engine's, and the report of the last communication step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PackingState<S> {
    /// Disks, contacts and base on the time grid.
    pub engine: S,
    /// The last communication step.
    pub report: Report,
}

impl<M: SoftMethod, D: BaseDrive> SoftPacking<M, D> {
    /// A packing of given `disks` at rest, in a box of the width that `values` tell.
    ///
    /// # Errors
    /// A time step that the contacts do not allow, by name.
    pub fn of_disks(disks: &[Disk], start_time: f64, values: &Values) -> Result<Self> {
        let drive = D::new(start_time, values)?;
        let normal = LinearDashpot {
            stiffness: values.real("contact.normal_stiffness"),
            damping: values.real("contact.normal_damping"),
        };
        let tangential = TangentialSpring {
            stiffness: values.real("contact.stiffness_ratio") * normal.stiffness,
            friction: values.real("contact.friction"),
        };
        let laws = ContactLaws { normal, tangential };
        let masses = masses_of(disks, values);
        let limits = M::limits(&laws, &masses, drive.frequency(), values);
        let time_step = chosen_time_step(values.real("time_step"), &limits)?;
        let half_width = 0.5 * values.real("box.width");
        let walls = vec![
            Wall::vibrating_floor(),
            Wall::left(-half_width),
            Wall::right(half_width),
        ];

        // The packing starts on the floor, wherever the drive has it.
        let lift = drive.motion(start_time).displacement;
        let disks: Vec<Disk> = disks.iter().map(|disk| disk.raised(lift)).collect();
        let gravity = values.real("gravity");
        let setup = Setup {
            laws,
            walls,
            masses,
            gravity,
            time_step,
            start_time,
        };
        let engine = FixedGrid::new(setup, &disks, drive);
        let energies = engine.energies();
        let start_energy = energies.kinetic + energies.potential + energies.elastic;
        let report = Report {
            time: start_time,
            impulse: 0.0,
            reaction_force: 0.0,
            start_energy,
        };
        Ok(Self {
            engine,
            limits,
            most_work: MOST_WORK_IN_A_CALL,
            report,
        })
    }

    /// The engine, to observe everything that is no output.
    pub fn engine(&self) -> &FixedGrid<M, D> {
        &self.engine
    }
}

/// The packing that the parameters tell, with a gap between neighbours of `gap` times the sum of their radii.
fn disks_of(choice: Choice, values: &Values, gap: f64) -> Result<Vec<Disk>> {
    let radii: Vec<f64> = rows::RADII.iter().map(|name| values.real(name)).collect();
    let width = values.real("box.width");
    for (name, radius) in rows::RADII.iter().zip(&radii) {
        if 2.0 * radius * (1.0 + gap) > width {
            return Err(Error::parameter(
                *name,
                format!("{radius} m"),
                format!("at most half of box.width less gaps, {} m", 0.5 * width / (1.0 + gap)),
                "Take smaller disks or a wider box.",
            ));
        }
    }
    let classes = radii.iter().map(|&radius| RadiusClass { radius, parts: 1 });
    let distribution = RadiusDistribution::Classes(classes.collect());
    let radii = distribution.sample(choice.disks as usize, values.integer("seed") as u64)?;
    let wider: Vec<f64> = radii.iter().map(|radius| radius * (1.0 + gap)).collect();
    let places = advancing_front(&wider, width)?;
    Ok(places
        .into_iter()
        .zip(radii)
        .map(|(place, radius)| Disk { radius, ..place })
        .collect())
}

/// Mass of each disk \[kg\].
fn masses_of(disks: &[Disk], values: &Values) -> Vec<f64> {
    let surface_density = values.real("disk.surface_density");
    disks
        .iter()
        .map(|disk| surface_density * std::f64::consts::PI * disk.radius.powi(2))
        .collect()
}

/// The time step that a value of `time_step` asks for: 0 asks for the default.
pub(super) fn chosen_time_step(asked: f64, limits: &TimeStepLimits) -> Result<f64> {
    if asked == 0.0 {
        return Ok(limits.default);
    }
    if asked <= limits.largest {
        return Ok(asked);
    }
    Err(Error::parameter(
        "time_step",
        format!("{asked:e} s"),
        format!("at most {:e} s for these contacts, masses and drive", limits.largest),
        format!("Give a smaller step, or 0 for the default of {:e} s.", limits.default),
    ))
}

fn refusal(breakdown: Breakdown) -> Error {
    refusal_of(NAME, breakdown)
}

/// What a scene of molecular dynamics says of a breakdown.
pub(super) fn refusal_of(scene: &'static str, breakdown: Breakdown) -> Error {
    let smaller = "Check the base's amplitude and the inputs, or take a smaller time_step";
    let (time, what, remedy) = match breakdown {
        Breakdown::TooDeep { time, overlap, allowed } => (
            time,
            format!("an overlap of {overlap:e} m, more than the {allowed:e} m (half of the smallest radius) allowed"),
            format!("{smaller} or a larger contact.normal_stiffness."),
        ),
        Breakdown::TooFast {
            time,
            distance,
            allowed,
        } => (
            time,
            format!("a disk moved {distance:e} m in one time step, more than the {allowed:e} m allowed"),
            format!("{smaller}."),
        ),
        Breakdown::NotFinite { time } => (
            time,
            "a position, a velocity or the base is beyond 1e100 or no longer finite".into(),
            format!("{smaller}."),
        ),
        Breakdown::TooManySteps { time, steps, most } => {
            let asked = format!("{steps:e} time steps (at most {most:e} for these disks)");
            return Error::too_much_work(scene, time, asked);
        }
    };
    Error::Step {
        scene,
        time,
        what,
        remedy,
    }
}

impl<M: SoftMethod, D: BaseDrive> Scene for SoftPacking<M, D> {
    type State = PackingState<State<D, M::Disks>>;

    fn card() -> Card {
        Card {
            scene: NAME,
            identifier: M::IDENTIFIERS[usize::from(!D::STEERED)],
            engine: M::NAME,
            drive: D::NAME,
            description: M::DESCRIPTION,
            equations: equations::HTML,
            disks: 1..=100_000,
            default_disks: 60,
            stop_time: 10.0,
            step_size: 1e-3,
        }
    }

    fn variables(choice: Choice) -> Vec<Variable> {
        rows::rows(choice, M::parameters(), D::variables())
    }

    fn initial_dependencies(name: &str) -> Option<Vec<&'static str>> {
        Some(initial::of_soft::<D>(name))
    }

    fn new(choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
        let disks = disks_of(choice, values, 0.0)?;
        Self::of_disks(&disks, start_time, values)
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        let from = self.report;
        let duration = end_time - from.time;
        let drive = self.engine.drive_mut().clone();
        self.engine.drive_mut().aim(from.time, duration, values);
        if let Err(breakdown) = self
            .engine
            .advance_within(end_time, &mut WorkBudget::at_most(self.most_work))
        {
            *self.engine.drive_mut() = drive;
            return Err(refusal(breakdown));
        }
        let impulse = self.engine.impulse_of_wall(FLOOR)[1];
        let reaction_force = (from.impulse - impulse) / duration;
        self.report = Report {
            time: end_time,
            impulse,
            reaction_force,
            ..from
        };
        Ok(())
    }

    fn limit_work(&mut self, most: u64) {
        self.most_work = most;
    }

    fn write_outputs(&self, mut outputs: OutputWriter<'_>) {
        let (engine, now) = (&self.engine, self.engine.observables());
        let Observables {
            positions, velocities, ..
        } = now;
        let mean =
            |axis: usize| velocities.iter().map(|velocity| velocity[axis]).sum::<f64>() / velocities.len() as f64;
        let energies = engine.energies();
        let total = energies.kinetic + energies.potential + energies.elastic;
        outputs.real("chosen_time_step", engine.setup().time_step);
        outputs.real("largest_time_step", self.limits.largest);
        outputs.reals("disk.radius", engine.radii().iter().copied());
        outputs.real("mean_velocity", mean(0));
        outputs.real("mean_angular_velocity", mean(2));
        outputs.real("base.reaction_force", self.report.reaction_force);
        outputs.real("base.position", now.base.displacement);
        outputs.real("base.acceleration", now.base.acceleration);
        outputs.real("energy.kinetic", energies.kinetic);
        outputs.real("energy.potential", energies.potential);
        outputs.real("energy.elastic", energies.elastic);
        outputs.real("energy.input", now.energy_input);
        outputs.real("energy.lost", now.energy_lost);
        outputs.real(
            "energy.residual",
            total - self.report.start_energy - now.energy_input + now.energy_lost,
        );
        outputs.integer("contacts", i64::from(now.contacts));
        outputs.reals("disk.angle", positions.iter().map(|position| position[2]));
        outputs.reals("disk.angular_velocity", velocities.iter().map(|velocity| velocity[2]));
        outputs.reals("disk.x", positions.iter().map(|position| position[0]));
        outputs.reals("disk.y", positions.iter().map(|position| position[1]));
        outputs.finish();
    }

    fn state(&self) -> Self::State {
        PackingState {
            engine: self.engine.state().clone(),
            report: self.report,
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
            start_energy,
        } = state.report;
        let report_holds = are_sane([time, impulse, reaction_force, start_energy]);
        if !(report_holds && self.engine.fits(&state.engine, time)) {
            return Err(Error::state(
                "it has other numbers of disks or contacts, or numbers that no packing has",
                "Restore states of the same scene, disk count and parameters only.",
            ));
        }
        self.engine.restore(&state.engine, time).map_err(refusal)?;
        self.report = state.report;
        Ok(())
    }
}
