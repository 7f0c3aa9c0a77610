//! Scene `three_disk`: one disk on two supports that it hardly ever leaves, turned by a torque or by vibration (P 4, 5).
//!
//! What turns it is a type; nothing of one is compiled into another.

mod drives;
mod equations;
mod rows;

use serde::{Deserialize, Serialize};

use crate::drive::excitation::{HarmonicTorque, HeldTorque, Piece, RandomSupports, SineSupports};
use crate::engine::three_disk::{
    LOST, Look, Node, Phase, Record, Sense, Setup, SlidingPoint, State, Stuck, ThreeDisk as Engine, TimeStepLimits,
    WORK, equilibrium,
};
use crate::error::{Error, Result, are_sane};
use crate::measure::BatchMeans;

use super::{Card, Choice, OutputWriter, Reached, Scene, Values, Variable};
pub use drives::ThreeDiskDrive;

/// [`ThreeDisk`] under the torque of an input.
pub type ThreeDiskOnInput = ThreeDisk<HeldTorque>;
/// [`ThreeDisk`] under a harmonic torque (P 5.2).
pub type ThreeDiskOnHarmonicTorque = ThreeDisk<HarmonicTorque>;
/// [`ThreeDisk`] on supports that vibrate randomly (P 5.3).
pub type ThreeDiskOnRandomSupports = ThreeDisk<RandomSupports>;
/// [`ThreeDisk`] on supports that vibrate sinusoidally.
pub type ThreeDiskOnSine = ThreeDisk<SineSupports>;

const NAME: &str = "three_disk";

/// First duration of a batch of the running standard error \[s\] where no period is known; it doubles as the run goes on.
const FIRST_BATCH: f64 = 1e-2;

/// A disk on two supports, driven by E.
#[derive(Debug)]
pub struct ThreeDisk<E> {
    engine: Engine<E>,
    /// Energy at the start \[J\].
    energy: f64,
    report: Report,
}

/// What the last communication step reported, and what is taken since measure.start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Time reached \[s\].
    pub time: f64,
    /// Vertical force of the disk on the supports \[N\], mean over the last communication step.
    pub reaction_force: f64,
    /// The angle turned, read at the ends of batches.
    pub turning: BatchMeans,
    /// What the contacts had done at measure.start.
    pub before: Option<Record>,
}

/// State of a [`ThreeDisk`]: the engine's, and the report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ThreeDiskState<E> {
    /// The engine's.
    pub engine: State<E>,
    /// The last communication step and what is taken since measure.start.
    pub report: Report,
}

/// Energies \[J\].
struct Energies {
    kinetic: f64,
    potential: f64,
    elastic: f64,
}

fn energies<E: ThreeDiskDrive>(engine: &Engine<E>, look: &Look) -> Energies {
    let (setup, disk) = (engine.setup(), &engine.state().now.disk);
    let [_, y, _, vx, vy, spin, ..] = *disk;
    let stored = look.contacts.map(|contact| {
        let spring = if contact.overlap > 0.0 {
            setup.normal.energy(contact.overlap)
        } else {
            0.0
        };
        spring + setup.skin.energy(contact.stretch)
    });
    Energies {
        kinetic: 0.5 * (setup.mass * (vx * vx + vy * vy) + setup.inertia() * spin * spin),
        potential: setup.mass * setup.gravity * y,
        elastic: stored[0] + stored[1],
    }
}

/// Number of a contact's phase in the enumeration `contact_state`.
fn contact_state(phase: Phase) -> i64 {
    match phase {
        Phase::Apart | Phase::Relaxing => 1,
        Phase::Stick => 2,
        Phase::Slip(Sense::CounterClockwise) => 3,
        Phase::Slip(Sense::Clockwise) => 4,
    }
}

fn counted(count: u64) -> i64 {
    count.min(i32::MAX as u64) as i64
}

fn refusal(stuck: Stuck) -> Error {
    Error::Step {
        scene: NAME,
        time: stuck.time,
        what: "no progress: contacts change more than 1000 times in one time step".into(),
        remedy: "Lower time_step, or raise contact.normal_damping.".into(),
    }
}

fn chosen_time_step(given: f64, limits: &TimeStepLimits) -> Result<f64> {
    if given == 0.0 {
        return Ok(limits.default);
    }
    if given > limits.largest {
        return Err(Error::parameter(
            "time_step",
            format!("{given:e} s"),
            format!("0, or up to {:e} s with these contacts and this drive", limits.largest),
            "Leave it 0, or soften the contacts or slow the drive down.",
        ));
    }
    Ok(given)
}

impl<E: ThreeDiskDrive> ThreeDisk<E> {
    /// The engine, to look at everything that is no output.
    pub fn engine(&self) -> &Engine<E> {
        &self.engine
    }

    /// Runs to `end_time`, reading the angle wherever a batch ends, or if `stop` says so to the first event before. Says
    /// when it ended and whether an event ended it. Looking costs little and changes nothing.
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

    fn go(&mut self, end_time: f64, values: &Values, stop: bool) -> Result<Reached> {
        let backup = self.state();
        let from = self.report.time;
        let upward = self.engine.state().now.disk[4];
        self.engine.steer(|excitation| excitation.aim(from, values));
        let checked = |scene: &mut Self| {
            let reached = scene.run(end_time, stop)?;
            scene.check(reached.time).map(|()| reached)
        };
        let reached = match checked(self) {
            Ok(reached) => reached,
            Err(error) => {
                self.engine.restore(&backup.engine);
                self.report = backup.report;
                return Err(error);
            }
        };
        let (now, setup) = (&self.engine.state().now, self.engine.setup());
        let gained = (now.disk[4] - upward) / (reached.time - from);
        self.report.reaction_force = -setup.mass * (gained + setup.gravity);
        self.report.time = reached.time;
        Ok(reached)
    }

    /// Whether the disk, its energies and its forces are finite and far from overflow.
    fn is_sane(&self) -> bool {
        let look = self.engine.look();
        let Energies {
            kinetic,
            potential,
            elastic,
        } = energies(&self.engine, &look);
        let forces = look.contacts.iter().flat_map(|at| [at.normal, at.tangential]);
        self.engine.state().now.is_sane() && are_sane([kinetic, potential, elastic]) && are_sane(forces)
    }

    /// Whether the disk is still above its supports and everything is finite.
    fn check(&self, time: f64) -> Result<()> {
        let (now, setup) = (&self.engine.state().now, self.engine.setup());
        let refused = |what: String, remedy: &str| {
            Err(Error::Step {
                scene: NAME,
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
                format!("the disk has fallen off its supports: it is at x = {x} m, y = {y} m"),
                "Drive it less, tilt it less, or take support.shape walls.",
            );
        }
        Ok(())
    }

    fn write_skins(&self, outputs: &mut OutputWriter<'_>, look: &Look) {
        let setup = self.engine.setup();
        let [left, right] = look.contacts.map(|contact| contact.tangential);
        let per_angle = 2.0 * setup.skin.stiffness * setup.radius;
        outputs.real("skin.stretch", (right - left) / per_angle);
        outputs.real("skin.departure", -(left + right) / per_angle);
        let margin = look
            .contacts
            .map(|contact| (setup.skin.friction * contact.normal - contact.tangential.abs()).max(0.0));
        outputs.real("amonton_margin", margin[0].min(margin[1]));
    }

    fn write_contacts(&self, outputs: &mut OutputWriter<'_>, look: &Look, since: &Record) {
        let now = &self.engine.state().now;
        for index in 0..2 {
            let (force, number) = (&look.contacts[index], index + 1);
            let name = |name: &str| format!("contact[{number}].{name}");
            outputs.real(&name("normal_force"), force.normal);
            outputs.real(&name("tangential_force"), force.tangential);
            outputs.real(&name("overlap"), force.overlap);
            outputs.integer(&name("state"), contact_state(now.contacts[index].phase));
            outputs.real(&name("slip_time"), since.slipping[index]);
            outputs.real(&name("open_time"), since.open[index]);
        }
    }
}

fn write_slides(outputs: &mut OutputWriter<'_>, record: &Record) {
    let slid = |point: SlidingPoint| record.sliding[point as usize] > 0.0;
    let regime = 1 + i64::from(slid(SlidingPoint::S1)) + i64::from(slid(SlidingPoint::S2));
    outputs.integer("sliding_regime", regime);
    outputs.integer("slips", counted(record.slips));
    outputs.integer("detachments", counted(record.detachments));
    outputs.real("detachment.time", record.first_detachment.unwrap_or(-1.0));
    for (index, (point, _)) in rows::POINTS.iter().enumerate() {
        outputs.real(&format!("sliding.{point}.time"), record.sliding[index]);
        outputs.integer(&format!("sliding.{point}.count"), counted(record.slides[index]));
    }
}

impl<E: ThreeDiskDrive> Scene for ThreeDisk<E> {
    type State = ThreeDiskState<E>;

    const EVENTS: bool = true;

    fn card() -> Card {
        Card {
            scene: NAME,
            identifier: E::IDENTIFIER,
            engine: "molecular-dynamics",
            drive: E::NAME,
            description: E::DESCRIPTION,
            equations: equations::HTML,
            disks: 1..=1,
            default_disks: 1,
            stop_time: 10.0,
            step_size: 1e-2,
        }
    }

    fn variables(_choice: Choice) -> Vec<Variable> {
        rows::rows(E::variables(), E::outputs())
    }

    fn new(_choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
        let bench = rows::bench(values)?;
        let limits = TimeStepLimits::of(&bench, E::period(values));
        let time_step = chosen_time_step(values.real("time_step"), &limits)?;
        let excitation = E::new(start_time, time_step, values);
        let rest = equilibrium(&bench, &excitation.piece(start_time).supports(0.0)).map_err(|_| {
            let weight = bench.mass * bench.gravity;
            Error::parameter(
                "contact.normal_stiffness",
                format!("{} N/m", bench.normal.stiffness),
                format!(
                    "so large that the weight {weight} N rests on both contacts with overlaps far below the radius"
                ),
                "Raise it, or lower disk.mass, tilt or the amplitude of the supports.",
            )
        })?;
        let place = [rest[0], rest[1] + values.real("disk.drop_height"), 0.0];
        let rates = [0.0, 0.0, values.real("disk.initial_angular_velocity")];
        let engine = Engine::new(Setup::new(bench, time_step), excitation, start_time, place, rates);
        let begin = start_time.max(values.real("measure.start"));
        let Energies {
            kinetic,
            potential,
            elastic,
        } = energies(&engine, &engine.look());
        let mut scene = Self {
            engine,
            energy: kinetic + potential + elastic,
            report: Report {
                time: start_time,
                reaction_force: 0.0,
                turning: BatchMeans::new(begin, E::batch(values).unwrap_or(FIRST_BATCH)),
                before: None,
            },
        };
        scene.run(start_time, false)?;
        Ok(scene)
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        self.go(end_time, values, false).map(|_| ())
    }

    fn advance_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.go(end_time, values, true)
    }

    fn write_outputs(&self, mut outputs: OutputWriter<'_>) {
        let (look, now) = (self.engine.look(), &self.engine.state().now);
        let Report { time, turning, .. } = &self.report;
        let Node { disk, .. } = now;
        let record = now.record.since(self.report.before.as_ref().unwrap_or(&now.record));
        outputs.real("chosen_time_step", self.engine.setup().time_step);
        outputs.real("mean_velocity", disk[3]);
        outputs.real("mean_angular_velocity", disk[5]);
        outputs.real("time_averaged_angular_velocity", turning.mean(*time, now.angle()));
        outputs.real(
            "time_averaged_angular_velocity.standard_error",
            turning.standard_error(),
        );
        outputs.real("base.reaction_force", self.report.reaction_force);
        let (torque, supports) = self.engine.driven();
        E::write(&mut outputs, torque, &supports);
        let Energies {
            kinetic,
            potential,
            elastic,
        } = energies(&self.engine, &look);
        let (input, lost) = (disk[WORK], disk[LOST]);
        outputs.real("energy.kinetic", kinetic);
        outputs.real("energy.potential", potential);
        outputs.real("energy.elastic", elastic);
        outputs.real("energy.input", input);
        outputs.real("energy.lost", lost);
        outputs.real(
            "energy.residual",
            kinetic + potential + elastic + lost - input - self.energy,
        );
        self.write_skins(&mut outputs, &look);
        self.write_contacts(&mut outputs, &look, &record);
        write_slides(&mut outputs, &record);
        outputs.real("disk.angle[1]", now.angle());
        outputs.real("disk.angular_velocity[1]", disk[5]);
        outputs.real("disk.x[1]", disk[0]);
        outputs.real("disk.y[1]", disk[1]);
        outputs.finish();
    }

    fn state(&self) -> Self::State {
        ThreeDiskState {
            engine: self.engine.state().clone(),
            report: self.report.clone(),
        }
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let refused = || {
            let remedy = "Restore states of the same scene and parameters only.";
            Error::state("it cannot be that of this disk on two supports", remedy)
        };
        let Report {
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
        self.engine.restore(engine);
        if !self.is_sane() {
            self.engine.restore(&former);
            return Err(refused());
        }
        self.report = state.report.clone();
        Ok(())
    }
}
