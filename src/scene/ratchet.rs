//! Scene `ratchet`: disks in a periodic cell on a sawtooth that oscillates vertically, event-driven (F).

mod equations;
mod fields;
mod initial;
mod rows;
mod start;

use serde::{Deserialize, Serialize};

use crate::collision::{Coulomb, VelocityFloor};
use crate::drive::{BoundedDrive, FollowsInput, Sine};
use crate::engine::event_driven::{
    EventDriven, Gravity, Moving, Observer, Partner, PeriodicAcross, Sawtooth, Settings, State, Stop, Unobserved,
    VibratingBase,
};
use crate::engine::{MOST_WORK_IN_A_CALL, WorkBudget};
use crate::error::{Error, Result, are_sane};
use crate::measure::Transport;

use super::base_drive::BaseDrive;
use super::hard_disks::{Energies, HardBase, Matter, Report};
pub use fields::Resolution;

use super::{Card, Choice, OutputWriter, Scene, Values, Variable};

/// Ratchet whose base follows the inputs `base.displacement` and `base.velocity`.
pub type RatchetOnInput = Ratchet<FollowsInput>;

/// Ratchet whose base moves as a sine.
pub type RatchetOnSine = Ratchet<Sine>;

/// Engine of the ratchet with drive D.
pub type RatchetEngine<D> = EventDriven<VelocityFloor<Coulomb>, Sawtooth<D>, Gravity, PeriodicAcross>;

const NAME: &str = "ratchet";

/// Greatest acceleration \[m/s2\] of the base, beyond which searches for first hits take ever smaller steps. The sine of the
/// greatest amplitude and frequency has 4e13.
const MOST_ACCELERATION: f64 = 1e14;

/// Disks above this many rows over the base belong to the topmost cells.
const REGION_ROWS: f64 = 12.0;

/// Disks on a sawtooth with drive D.
#[derive(Debug)]
pub struct Ratchet<D: BoundedDrive> {
    engine: RatchetEngine<D>,
    masses: Vec<f64>,
    gravity: f64,
    inertia_factor: f64,
    layers: f64,
    /// Ceiling less the height of the teeth and the widest disk \[m\]: farther up the base would crush it.
    headroom: f64,
    /// Work that one call may do.
    most_work: u64,
    report: Report,
    averages: Averages,
}

/// State of a [`Ratchet`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RatchetState<B> {
    /// The engine's.
    pub engine: State<B>,
    /// The last communication step.
    pub report: Report,
    /// Running averages.
    pub averages: Averages,
}

/// Averages since `measure.start` or the last change of `measure.mark`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Averages {
    /// The averages.
    pub transport: Transport,
    /// `measure.mark` in the last communication step.
    pub mark: f64,
}

impl<D> Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: HardBase + VibratingBase,
{
    /// The engine, to look at everything that is no output.
    pub fn engine(&self) -> &RatchetEngine<D> {
        &self.engine
    }

    fn energies(&self) -> Energies {
        let matter = Matter {
            masses: &self.masses,
            gravity: self.gravity,
            inertia_factor: self.inertia_factor,
        };
        let seen = self.engine.state().bodies.iter().enumerate().map(|(disk, body)| {
            let (place, velocity, _, angular_velocity) = self.engine.seen(disk, self.report.time);
            (body.radius, place, velocity, angular_velocity)
        });
        Energies::of(matter, seen)
    }

    /// As [`Scene::advance_to`], to the bit, and shows the flights of the disks.
    ///
    /// # Errors
    /// As [`Scene::advance_to`]; what was shown then does not count.
    pub fn advance_observed(&mut self, end_time: f64, values: &Values, observer: &mut impl Observer) -> Result<()> {
        let backup = self.saved();
        let (from, impulse) = (self.report.time, self.engine.state().counts.base_impulse);
        if let Err(error) = self.run_to(end_time, values, observer) {
            self.go_back(&backup);
            return Err(error);
        }
        if !self.is_sane(end_time) {
            self.go_back(&backup);
            return Err(Error::Step {
                scene: NAME,
                time: end_time,
                what: "a disk or the base is beyond 1e100 or no longer finite".into(),
                remedy: "Check the base's amplitude and the inputs.".into(),
            });
        }
        let given = self.engine.state().counts.base_impulse - impulse;
        self.report.time = end_time;
        self.report.reaction_force = -given / (end_time - from);
        Ok(())
    }

    /// Takes the inputs for a step to `end_time` \[s\] and handles its events, reading places where batches end.
    fn run_to(&mut self, end_time: f64, values: &Values, observer: &mut impl Observer) -> Result<()> {
        let from = self.report.time;
        let mut base = self.engine.state().boundary.base().clone();
        if base.aim(from, end_time - from, values) {
            let acceleration = base.drive.greatest_acceleration();
            if !(acceleration <= MOST_ACCELERATION && base.farthest < self.headroom) {
                return Err(impossible(from, acceleration, base.farthest, self.headroom));
            }
            let change = |boundary: &mut Sawtooth<D>| boundary.set_base(base);
            self.engine.change_boundary_observed(from, change, observer);
        }
        let mut work = WorkBudget::at_most(self.most_work);
        let mark = values.real("measure.mark");
        if mark != self.averages.mark {
            let transport = Transport::new(from);
            self.averages = Averages { transport, mark };
        }
        while self.averages.transport.due() <= end_time {
            let due = self.averages.transport.due();
            self.engine.advance_within(due, observer, &mut work).map_err(refusal)?;
            let places = (0..self.masses.len()).map(|disk| self.engine.seen(disk, due).0[0]);
            let input = self.engine.state().counts.energy_input;
            self.averages.transport.record(places, input);
        }
        self.engine
            .advance_within(end_time, observer, &mut work)
            .map_err(refusal)
    }

    /// Whether everything at `time` \[s\] is finite and far from overflow.
    fn is_sane(&self, time: f64) -> bool {
        let state = self.engine.state();
        let (counts, base) = (&state.counts, state.boundary.base().motion(time));
        let disks_hold = (0..self.masses.len()).all(|disk| {
            let (place, velocity, angle, angular_velocity) = self.engine.seen(disk, time);
            are_sane(place) && are_sane(velocity) && are_sane([angle, angular_velocity])
        });
        disks_hold
            && are_sane([counts.energy_lost, counts.energy_input, counts.base_impulse])
            && are_sane([base.displacement, base.velocity, base.acceleration])
    }

    fn saved(&self) -> RatchetState<Sawtooth<D>> {
        RatchetState {
            engine: self.engine.state().clone(),
            report: self.report,
            averages: self.averages.clone(),
        }
    }

    fn go_back(&mut self, state: &RatchetState<Sawtooth<D>>) {
        self.engine.restore(&state.engine);
        self.report = state.report;
        self.averages.clone_from(&state.averages);
    }
}

fn refusal(stop: Stop) -> Error {
    let stop = match stop {
        Stop::NoHeadway(stop) => stop,
        Stop::TooManyEvents { time, most } => {
            return Error::too_much_work(NAME, time, format!("more than {most} events"));
        }
    };
    let disk = stop.last.0 + 1;
    let partner = match stop.last.1 {
        Partner::Disk(other) => format!("disk {}", other + 1),
        Partner::Wall(0) => "the base".into(),
        Partner::Wall(_) => "the ceiling".into(),
        Partner::Shell => "nobody: it is too fast".into(),
    };
    Error::Step {
        scene: NAME,
        time: stop.time,
        what: format!(
            "no headway: {} events in {:e} s, the last of disk {disk} with {partner}",
            stop.events, stop.took
        ),
        remedy: "Inelastic collapse? Raise collision.minimum_normal_velocity or collision.restitution.".into(),
    }
}

fn impossible(time: f64, acceleration: f64, farthest: f64, headroom: f64) -> Error {
    let (what, remedy) = if farthest < headroom {
        (
            format!(
                "the inputs accelerate the base by {acceleration:e} m/s2, and {MOST_ACCELERATION:e} m/s2 is the most"
            ),
            "Let base.displacement and base.velocity fit each other and the communication step.",
        )
    } else {
        (
            format!("the inputs move the base up by {farthest} m, and {headroom} m are left below the ceiling"),
            "Keep base.displacement smaller or raise cell.height.",
        )
    };
    Error::Step {
        scene: NAME,
        time,
        what,
        remedy: remedy.into(),
    }
}

impl<D> Scene for Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: HardBase<Drive = D> + VibratingBase,
{
    type State = RatchetState<Sawtooth<D>>;

    fn card() -> Card {
        Card {
            scene: NAME,
            identifier: if D::NAME == "input" {
                "jostle_ratchet"
            } else {
                "jostle_ratchet_sine"
            },
            engine: "event-driven",
            drive: D::NAME,
            description: "Granular ratchet: hard frictional disks on a sawtooth that vibrates vertically, event-driven",
            equations: equations::HTML,
            disks: 1..=100_000,
            default_disks: 20,
            stop_time: 10.0,
            step_size: 1e-2,
        }
    }

    fn variables(choice: Choice) -> Vec<Variable> {
        rows::rows(choice, D::variables())
    }

    fn initial_dependencies(name: &str) -> Option<Vec<&'static str>> {
        Some(initial::dependencies::<D>(name))
    }

    fn new(choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
        let law = VelocityFloor::new(
            Coulomb::new(values.real("collision.restitution"), values.real("collision.friction"))?,
            values.real("collision.minimum_normal_velocity"),
        )?;
        let profile = start::profile(values)?;
        let base = <Moving<D> as HardBase>::from_values(start_time, values)?;
        let lift = base.motion(start_time).displacement;
        let disks = start::disks(choice, values, profile.top() + lift)?;
        let masses = start::masses(&disks, values);
        let radius_max = values.real("disk.radius_max");
        let ceiling = values.real("cell.height");
        let headroom = ceiling - profile.top() - 2.0 * radius_max;
        if base.farthest() >= headroom {
            return Err(Error::parameter(
                "cell.height",
                format!("{ceiling} m"),
                format!(
                    "more than {} m, above the base at its highest and a disk",
                    ceiling - headroom + base.farthest()
                ),
                "Raise the ceiling or move the base less.",
            ));
        }
        let space = PeriodicAcross {
            width: start::cell_width(values),
            bottom: -base.farthest(),
            height: profile.top()
                + base.farthest()
                + (REGION_ROWS + 2.0 * start::layers(disks.len(), values)) * radius_max,
        };
        let boundary = Sawtooth::new(profile, base, ceiling, start_time);
        let gravity = values.real("gravity");
        let inertia_factor = values.real("disk.inertia_factor");
        let settings = Settings {
            shell: start::shell(disks.len(), values),
            start_time,
            inertia_factor,
        };
        let types = (law, boundary, Gravity(gravity), space);
        let engine = EventDriven::new(types, &disks, &masses, &vec![[0.0; 3]; disks.len()], settings);
        let mut ratchet = Self {
            engine,
            layers: start::layers(disks.len(), values),
            masses,
            gravity,
            inertia_factor,
            headroom,
            most_work: MOST_WORK_IN_A_CALL,
            report: Report::at_start(start_time),
            averages: Averages {
                transport: Transport::new(values.real("measure.start").max(start_time)),
                mark: values.real("measure.mark"),
            },
        };
        ratchet.report.start_energy = ratchet.energies().total();
        Ok(ratchet)
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        self.advance_observed(end_time, values, &mut Unobserved)
    }

    fn limit_work(&mut self, most: u64) {
        self.most_work = most;
    }

    fn write_outputs(&self, mut outputs: OutputWriter<'_>) {
        let time = self.report.time;
        let state = self.engine.state();
        let seen: Vec<_> = (0..self.masses.len())
            .map(|disk| self.engine.seen(disk, time))
            .collect();
        let count = seen.len() as f64;
        let (counts, base) = (&state.counts, state.boundary.base().motion(time));
        let ceiling_hits = state.boundary.ceiling_hits();
        let places = seen.iter().map(|disk| disk.0[0]);
        let told = self.averages.transport.told(time, places, counts.energy_input);
        outputs.real("layers", self.layers);
        outputs.reals("disk.radius", state.bodies.iter().map(|body| body.radius));
        outputs.real("mean_velocity", seen.iter().map(|disk| disk.1[0]).sum::<f64>() / count);
        outputs.real("transport_velocity", told.velocity);
        outputs.real("transport_velocity.standard_error", told.standard_error);
        outputs.real("transport_velocity.spread", told.spread);
        outputs.real(
            "mean_angular_velocity",
            seen.iter().map(|disk| disk.3).sum::<f64>() / count,
        );
        outputs.real("base.reaction_force", self.report.reaction_force);
        outputs.real("base.position", base.displacement);
        outputs.real("base.acceleration", base.acceleration);
        outputs.real("base.mean_power", told.power);
        self.energies().write(&mut outputs, counts, self.report.start_energy);
        outputs.real("collisions", (counts.disk_impacts + counts.wall_impacts) as f64);
        outputs.real("collisions.disks", counts.disk_impacts as f64);
        outputs.real("collisions.base", (counts.wall_impacts - ceiling_hits) as f64);
        outputs.real("collisions.ceiling", ceiling_hits as f64);
        outputs.reals("disk.angle", seen.iter().map(|disk| disk.2));
        outputs.reals("disk.x", seen.iter().map(|disk| disk.0[0]));
        outputs.reals("disk.y", seen.iter().map(|disk| disk.0[1]));
        outputs.finish();
    }

    fn state(&self) -> Self::State {
        self.saved()
    }

    fn time_of(state: &Self::State) -> f64 {
        state.report.time
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let averages = &state.averages;
        let averages_hold = averages.transport.is_sound(self.masses.len(), state.report.time);
        let report_holds = state.report.is_sane() && are_sane([averages.mark]);
        let counts_hold = state.engine.boundary.ceiling_hits() <= state.engine.counts.wall_impacts;
        let remedy = "Restore states of the same scene, disk count and parameters only.";
        if !(averages_hold && report_holds && counts_hold && self.engine.fits(&state.engine)) {
            return Err(Error::state("it is not a state of this run", remedy));
        }
        let former = self.saved();
        self.go_back(state);
        if !self.is_sane(state.report.time) {
            self.go_back(&former);
            return Err(Error::state("it holds numbers that no ratchet has", remedy));
        }
        Ok(())
    }
}
