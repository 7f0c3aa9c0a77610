//! Scene `ratchet`: disks in a periodic cell on a sawtooth that oscillates vertically, event-driven (F).

mod equations;
mod rows;
mod start;

use serde::{Deserialize, Serialize};

use crate::collision::{Coulomb, VelocityFloor};
use crate::drive::{BoundedDrive, FollowsInput, Sine};
use crate::engine::event_driven::{
    EventDriven, Gravity, Moving, Partner, PeriodicAcross, Sawtooth, Settings, State, Stop, VibratingBase,
};
use crate::engine::{MOST_WORK_IN_A_CALL, Work};
use crate::error::{Error, Result};

use super::base_drive::BaseDrive;
use super::packing::hard::PackingBase;
use super::{Card, Choice, OutputWriter, Scene, Values, Variable};

/// Ratchet whose base follows the inputs `base.displacement` and `base.velocity`.
pub type RatchetOnInput = Ratchet<FollowsInput>;

/// Ratchet whose base moves as a sine.
pub type RatchetOnSine = Ratchet<Sine>;

/// Engine of the ratchet with drive D.
pub type RatchetEngine<D> = EventDriven<VelocityFloor<Coulomb>, Sawtooth<D>, Gravity, PeriodicAcross>;

const NAME: &str = "ratchet";

/// Radius of a shell over that of its disk.
const SHELL: f64 = 2.0;

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
    /// Start of the average \[s\].
    mark: f64,
    /// Ceiling less the height of the teeth and the widest disk \[m\]: farther up the base would crush it.
    headroom: f64,
    /// Work that one call may do.
    most_work: u64,
    report: Report,
}

/// What the last communication step reported.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Time reached \[s\].
    pub time: f64,
    /// Vertical force of the disks on the base \[N\], mean over the last communication step.
    pub reaction_force: f64,
    /// Total energy at the start \[J\].
    pub start_energy: f64,
    /// Mean place of the disks \[m\], unwrapped, at the start of the average, once it is reached.
    pub marked_place: Option<f64>,
}

/// State of a [`Ratchet`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RatchetState<B> {
    /// The engine's.
    pub engine: State<B>,
    /// The last communication step.
    pub report: Report,
}

impl<D> Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: PackingBase + VibratingBase,
{
    /// The engine, to look at everything that is no output.
    pub fn engine(&self) -> &RatchetEngine<D> {
        &self.engine
    }

    /// Kinetic and potential energy \[J\] now.
    fn energies(&self) -> (f64, f64) {
        let (mut kinetic, mut potential) = (0.0, 0.0);
        for (disk, mass) in self.masses.iter().enumerate() {
            let ([_, y], [vx, vy], _, angular_velocity) = self.engine.seen(disk, self.report.time);
            let rim = self.engine.state().bodies[disk].radius * angular_velocity;
            kinetic += 0.5 * mass * (vx * vx + vy * vy + self.inertia_factor * rim * rim);
            potential += mass * self.gravity * y;
        }
        (kinetic, potential)
    }

    /// Mean place \[m\] of the disks at `time` \[s\], periods undone.
    fn mean_place(&self, time: f64) -> f64 {
        let count = self.masses.len();
        (0..count).map(|disk| self.engine.seen(disk, time).0[0]).sum::<f64>() / count as f64
    }

    /// Takes the inputs for a step to `end_time` \[s\], handles its events and sets the mark if it lies in it.
    fn run_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        let from = self.report.time;
        let mut base = self.engine.state().boundary.base.clone();
        if base.aim(from, end_time - from, values) {
            if base.farthest >= self.headroom {
                return Err(crushed(from, base.farthest, self.headroom));
            }
            // Towards where the base goes is searched in steps: a base that leaves for the stars has no end of them.
            let travel = base.drive.greatest_acceleration() * (end_time - from).powi(2);
            if travel.is_nan() || travel > MOST_TRAVEL {
                return Err(too_far(from, travel));
            }
            self.engine.change_boundary(from, |boundary| boundary.base = base);
        }
        let mut work = Work::at_most(self.most_work);
        if self.report.marked_place.is_none() && self.mark <= end_time {
            self.engine.advance_within(self.mark, &mut work).map_err(refusal)?;
            self.report.marked_place = Some(self.mean_place(self.mark));
        }
        self.engine.advance_within(end_time, &mut work).map_err(refusal)
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

/// Change of the base's motion within a step \[m\] that is followed.
const MOST_TRAVEL: f64 = 1e4;

fn too_far(time: f64, travel: f64) -> Error {
    Error::Step {
        scene: NAME,
        time,
        what: format!(
            "the inputs change the way of the base by {travel:e} m within the step, and at most {MOST_TRAVEL:e} m are followed"
        ),
        remedy: "Check base.displacement and base.velocity, or take a shorter step.".into(),
    }
}

fn crushed(time: f64, farthest: f64, headroom: f64) -> Error {
    Error::Step {
        scene: NAME,
        time,
        what: format!("the inputs move the base up by {farthest} m, and {headroom} m are left below the ceiling"),
        remedy: "Keep base.displacement smaller or raise cell.height.".into(),
    }
}

impl<D> Scene for Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: PackingBase<Drive = D> + VibratingBase,
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

    fn new(choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
        let law = VelocityFloor::new(
            Coulomb::new(values.real("collision.restitution"), values.real("collision.friction"))?,
            values.real("collision.minimum_normal_velocity"),
        )?;
        let profile = start::profile(values)?;
        let base = <Moving<D> as PackingBase>::from_values(start_time, values)?;
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
        let boundary = Sawtooth {
            profile,
            base,
            ceiling,
            origin: start_time,
            ceiling_hits: 0,
        };
        let gravity = values.real("gravity");
        let inertia_factor = values.real("disk.inertia_factor");
        let settings = Settings {
            shell: SHELL,
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
            mark: values.real("measure.start").max(start_time),
            headroom,
            most_work: MOST_WORK_IN_A_CALL,
            report: Report {
                time: start_time,
                reaction_force: 0.0,
                start_energy: 0.0,
                marked_place: None,
            },
        };
        ratchet.report.start_energy = ratchet.energies().1;
        Ok(ratchet)
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        let backup = self.state();
        let (from, impulse) = (self.report.time, self.engine.state().counts.base_impulse);
        if let Err(error) = self.run_to(end_time, values) {
            self.engine.restore(&backup.engine);
            self.report = backup.report;
            return Err(error);
        }
        let given = self.engine.state().counts.base_impulse - impulse;
        self.report.time = end_time;
        self.report.reaction_force = -given / (end_time - from);
        Ok(())
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
        let (kinetic, potential) = self.energies();
        let (counts, base) = (&state.counts, state.boundary.base.motion(time));
        let ceiling_hits = state.boundary.ceiling_hits;
        let since = time - self.mark;
        let transport = match self.report.marked_place {
            Some(place) if since > 0.0 => (self.mean_place(time) - place) / since,
            _ => 0.0,
        };
        outputs.real("layers", self.layers);
        outputs.reals("disk.radius", state.bodies.iter().map(|body| body.radius));
        outputs.real("mean_velocity", seen.iter().map(|disk| disk.1[0]).sum::<f64>() / count);
        outputs.real("transport_velocity", transport);
        outputs.real(
            "mean_angular_velocity",
            seen.iter().map(|disk| disk.3).sum::<f64>() / count,
        );
        outputs.real("base.reaction_force", self.report.reaction_force);
        outputs.real("base.position", base.displacement);
        outputs.real("base.acceleration", base.acceleration);
        outputs.real("energy.kinetic", kinetic);
        outputs.real("energy.potential", potential);
        outputs.real("energy.input", counts.energy_input);
        outputs.real("energy.lost", counts.energy_lost);
        let change = kinetic + potential - self.report.start_energy;
        outputs.real("energy.residual", change - counts.energy_input + counts.energy_lost);
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
        RatchetState {
            engine: self.engine.state().clone(),
            report: self.report,
        }
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let own = &self.engine.state().boundary;
        let same = (own.profile, own.ceiling) == (state.engine.boundary.profile, state.engine.boundary.ceiling);
        if !same || !self.engine.fits(&state.engine) {
            return Err(Error::state(
                "it is not a state of this run",
                "Restore states of the same scene, disk count and parameters only.",
            ));
        }
        self.engine.restore(&state.engine);
        self.report = state.report;
        Ok(())
    }
}
