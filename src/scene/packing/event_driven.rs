//! Scene `packing` by event-driven dynamics: hard disks in the same box, with the same variables (P 2.3, 3.3).
//!
//! Made for strong shaking, Gamma of 2 and more, where lasting contacts are rare (P 3.3).

use serde::{Deserialize, Serialize};

use crate::drive::FollowsInput;
use crate::engine::event_driven::{Moving, Partner, Stop};
use crate::engine::{MOST_WORK_IN_A_CALL, WorkBudget};
use crate::error::{Error, Result, are_sane};
use crate::scene::base_drive::BaseDrive;
use crate::scene::hard_disks::{Energies, Matter, Report};
use crate::scene::{Card, Choice, Scene};
use crate::scene::{OutputWriter, Values, Variable};

use super::hard::{EitherModel, HardDisks, HardRun, START_GAP};
use super::{NAME, disks_of, equations, initial, masses_of, rows};

/// Event-driven packing whose base follows the inputs.
pub type HardPackingOnInput = HardPacking<HardDisks<Moving<FollowsInput>>>;

/// Event-driven packing on a sine, moving or in the random-phase approximation.
pub type HardPackingOnSine = HardPacking<EitherModel>;

/// Hard disks in a box, run by R.
#[derive(Debug)]
pub struct HardPacking<R> {
    run: R,
    masses: Vec<f64>,
    radii: Vec<f64>,
    gravity: f64,
    /// Work that one call may do.
    most_work: u64,
    report: Report,
}

/// State of a [`HardPacking`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HardPackingState<S> {
    /// The engine's.
    pub engine: S,
    /// The last communication step.
    pub report: Report,
}

impl<R: HardRun> HardPacking<R> {
    /// The engine, to look at everything that is no output.
    pub fn run(&self) -> &R {
        &self.run
    }

    /// Whether everything at `time` \[s\] is finite and far from overflow.
    fn is_sane(&self, time: f64) -> bool {
        let (counts, base) = (self.run.counts(), self.run.base(time));
        let disks_hold = (0..self.radii.len()).all(|disk| {
            let (place, velocity, angle, angular_velocity) = self.run.seen(disk, time);
            are_sane(place) && are_sane(velocity) && are_sane([angle, angular_velocity])
        });
        disks_hold
            && are_sane([counts.energy_lost, counts.energy_input, counts.base_impulse])
            && are_sane([base.displacement, base.velocity, base.acceleration])
    }

    fn energies(&self) -> Energies {
        let matter = Matter {
            masses: &self.masses,
            gravity: self.gravity,
            inertia_factor: 0.5,
        };
        let seen = self.radii.iter().enumerate().map(|(disk, radius)| {
            let (place, velocity, _, angular_velocity) = self.run.seen(disk, self.report.time);
            (*radius, place, velocity, angular_velocity)
        });
        Energies::of(matter, seen)
    }
}

fn refusal(stop: Stop) -> Error {
    let stop = match stop {
        Stop::NoHeadway(stop) => stop,
        Stop::TooManyEvents { time, most } => {
            return Error::too_much_work(NAME, time, format!("more than {most} events"));
        }
    };
    let (disk, partner) = (stop.last.0 + 1, stop.last.1);
    let partner = match partner {
        Partner::Disk(other) => format!("disk {}", other + 1),
        Partner::Shell => "nobody in a flight too fast to follow".into(),
        Partner::Wall(0) => "the base".into(),
        Partner::Wall(1) => "the left wall".into(),
        Partner::Wall(_) => "the right wall".into(),
    };
    Error::Step {
        scene: NAME,
        time: stop.time,
        what: format!(
            "no headway: {} events in {:e} s, the last of disk {disk} with {partner}",
            stop.events, stop.took
        ),
        remedy: "Does the base throw disks too fast? Check its amplitude and the inputs. Inelastic collapse? Raise \
                 collision.contact_time or lower contact.normal_damping, or use the engine \
                 molecular-dynamics, which knows lasting contacts."
            .into(),
    }
}

impl<R: HardRun> Scene for HardPacking<R> {
    type State = HardPackingState<R::State>;

    fn card() -> Card {
        let on_input = R::Base::NAME == "input";
        Card {
            scene: NAME,
            identifier: if on_input {
                "jostle_packing_event_driven"
            } else {
                "jostle_packing_event_driven_sine"
            },
            engine: "event-driven",
            drive: R::Base::NAME,
            description: "Packing of hard frictional disks in a box on a vibrating bottom, event-driven",
            equations: equations::HARD_HTML,
            disks: 1..=100_000,
            default_disks: 60,
            stop_time: 10.0,
            step_size: 1e-2,
        }
    }

    fn variables(choice: Choice) -> Vec<Variable> {
        rows::hard_rows(choice, R::Base::variables(), R::variables())
    }

    fn initial_dependencies(name: &str) -> Option<Vec<&'static str>> {
        Some(initial::of_hard::<R::Base>(name))
    }

    fn new(choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
        let disks = disks_of(choice, values, START_GAP)?;
        let masses = masses_of(&disks, values);
        let run = R::new(&disks, &masses, start_time, values)?;
        let radii = disks.iter().map(|disk| disk.radius).collect();
        let mut packing = Self {
            run,
            masses,
            radii,
            gravity: values.real("gravity"),
            report: Report::at_start(start_time),
            most_work: MOST_WORK_IN_A_CALL,
        };
        packing.report.start_energy = packing.energies().total();
        Ok(packing)
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        let backup = self.run.state();
        let (from, impulse) = (self.report.time, self.run.counts().base_impulse);
        self.run.aim(from, end_time - from, values);
        if let Err(stop) = self.run.advance_to(end_time, &mut WorkBudget::at_most(self.most_work)) {
            self.run.restore(&backup);
            return Err(refusal(stop));
        }
        if !self.is_sane(end_time) {
            self.run.restore(&backup);
            return Err(Error::Step {
                scene: NAME,
                time: end_time,
                what: "a disk or the base is beyond 1e100 or no longer finite".into(),
                remedy: "Check the base's amplitude and the inputs.".into(),
            });
        }
        let given = self.run.counts().base_impulse - impulse;
        self.report = Report {
            time: end_time,
            reaction_force: -given / (end_time - from),
            ..self.report
        };
        Ok(())
    }

    fn limit_work(&mut self, most: u64) {
        self.most_work = most;
    }

    fn write_outputs(&self, mut outputs: OutputWriter<'_>) {
        let time = self.report.time;
        let seen: Vec<_> = (0..self.radii.len()).map(|disk| self.run.seen(disk, time)).collect();
        let count = seen.len() as f64;
        let (counts, base) = (self.run.counts(), self.run.base(time));
        outputs.reals("disk.radius", self.radii.iter().copied());
        outputs.real("mean_velocity", seen.iter().map(|disk| disk.1[0]).sum::<f64>() / count);
        outputs.real(
            "mean_angular_velocity",
            seen.iter().map(|disk| disk.3).sum::<f64>() / count,
        );
        outputs.real("base.reaction_force", self.report.reaction_force);
        outputs.real("base.position", base.displacement);
        outputs.real("base.acceleration", base.acceleration);
        self.energies().write(&mut outputs, &counts, self.report.start_energy);
        outputs.real("collisions", (counts.disk_impacts + counts.wall_impacts) as f64);
        outputs.reals("disk.angle", seen.iter().map(|disk| disk.2));
        outputs.reals("disk.angular_velocity", seen.iter().map(|disk| disk.3));
        outputs.reals("disk.x", seen.iter().map(|disk| disk.0[0]));
        outputs.reals("disk.y", seen.iter().map(|disk| disk.0[1]));
        outputs.finish();
    }

    fn state(&self) -> Self::State {
        HardPackingState {
            engine: self.run.state(),
            report: self.report,
        }
    }

    fn time_of(state: &Self::State) -> f64 {
        state.report.time
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let remedy = "Restore states of the same scene, disk count and parameters only.";
        if !(self.run.fits(&state.engine) && state.report.is_sane()) {
            return Err(Error::state("it is not a state of this run", remedy));
        }
        let former = self.run.state();
        self.run.restore(&state.engine);
        if !self.is_sane(state.report.time) {
            self.run.restore(&former);
            return Err(Error::state("it holds numbers that no packing has", remedy));
        }
        self.report = state.report;
        Ok(())
    }
}
