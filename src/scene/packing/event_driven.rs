//! Scene `packing` by event-driven dynamics: hard disks in the same box, with the same variables (P 2.3, 3.3).
//!
//! Made for strong shaking, Gamma of 2 and more, where lasting contacts are rare (P 3.3).

use crate::drive::{FollowsInput, Motion};
use crate::engine::event_driven::{Counts, EventDrivenStop, Moving, Partner};
use crate::engine::{DiskMotion, WorkBudget};
use crate::error::are_sane;
use crate::scene::base_drive::BaseDrive;
use crate::scene::disks_on_base::{DisksOnBase, StepReport, Stretch, complete, radii};
use crate::scene::hard_disks::{self, EnergyRows, HardDisksOnBase};
use crate::scene::work_limit::WorkLimit;
use crate::scene::{
    Error, Model, ModelInfo, Reached, Result, Row, SceneInfo, StructuralParameters, Unit, Values, Warning, info,
    recommended,
};

use super::PackingState;
use super::either_base::EitherBase;
use super::equations;
use super::hard::{HardDisks, HardEngine};
use super::hard_law::hard_law;
use super::initial_packing::{self, NAME};
use super::rotation::{MeasuresRotation, RotationRecord};
use super::rows::{self, AtStart};
use super::settled::{self, Settled};
use super::sheet;

/// Event-driven packing whose base follows the inputs.
pub type HardPackingOnInput = HardPacking<HardDisks<Moving<FollowsInput>>>;

/// Event-driven packing on a sine, moving or in the random-phase approximation.
pub type HardPackingOnSine = HardPacking<EitherBase>;

/// Hard disks in a box, advanced by the engine E.
#[derive(Debug)]
pub struct HardPacking<E: HardEngine> {
    engine: E,
    /// The engine's state before the step under way.
    backup: E::State,
    masses: Vec<f64>,
    radii: Vec<f64>,
    friction: f64,
    gravity: f64,
    work_limit: WorkLimit,
    report: StepReport,
    /// Total energy at the start \[J\], with all that changes of gravity have added since.
    start_energy: f64,
    rotation: RotationRecord,
    /// What is doubtful about the start.
    warnings: Vec<Warning>,
}

impl<E: HardEngine> HardPacking<E> {
    /// The engine, to observe everything that is no output.
    pub fn engine(&self) -> &E {
        &self.engine
    }

    /// Advances to `end_time` \[s\] under the inputs among `values`; the state is as before if that cannot be done.
    fn advance_stretch(&mut self, stretch: Stretch, end_time: f64, values: &Values) -> Result<()> {
        self.engine.copy_state_to(&mut self.backup);
        let (from, impulse) = (self.report.time, self.counts().base_impulse);
        self.engine.set_target(from, end_time - from, values);
        self.rotation.back_up(end_time);
        let mut budget = self.work_limit.budget(self.engine.work_done(), end_time);
        let outcome = self.run_to(end_time, &mut budget);
        let outcome = outcome.map_err(refused_step).and_then(|()| self.check(NAME, end_time));
        if let Err(error) = outcome {
            self.rotation.go_back();
            self.engine.restore(&self.backup, from).map_err(refused_step)?;
            return Err(error);
        }
        let given = self.counts().base_impulse - impulse;
        self.report = self.report.after(stretch, end_time, -given);
        Ok(())
    }

    /// Handles the events until `end_time` \[s\] and takes the angles where they are due.
    fn run_to(&mut self, end_time: f64, budget: &mut WorkBudget) -> std::result::Result<(), EventDrivenStop> {
        // A sample of ten disks takes about as long as an event.
        let work_of_sample = self.radii.len().div_ceil(10) as u64;
        while self.rotation.now.due() <= end_time {
            let time = self.rotation.now.due();
            self.engine.advance_within(time, budget)?;
            if !budget.spend(work_of_sample) {
                let most = budget.most();
                return Err(EventDrivenStop::TooManyEvents { time, most });
            }
            let angles = (0..self.radii.len()).map(|disk| self.engine.disk_at(time, disk).angle);
            self.rotation.now.record(angles);
        }
        self.engine.advance_within(end_time, budget)
    }
}

impl<E: HardEngine> AsRef<E> for HardPacking<E> {
    fn as_ref(&self) -> &E {
        &self.engine
    }
}

impl<E: HardEngine> DisksOnBase for HardPacking<E> {
    fn report(&self) -> &StepReport {
        &self.report
    }

    fn disk_count(&self) -> usize {
        self.radii.len()
    }

    fn disk_at(&self, time: f64, disk: usize) -> DiskMotion {
        self.engine.disk_at(time, disk)
    }

    fn base_at(&self, time: f64) -> Motion {
        self.engine.base_at(time)
    }

    fn base_impulse(&self) -> f64 {
        -self.counts().base_impulse
    }
}

impl<E: HardEngine> HardDisksOnBase for HardPacking<E> {
    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn radius(&self, disk: usize) -> f64 {
        self.radii[disk]
    }

    fn gravity(&self) -> f64 {
        self.gravity
    }

    fn inertia_factor(&self) -> f64 {
        0.5
    }

    fn counts(&self) -> Counts {
        self.engine.counts()
    }

    fn start_energy(&self) -> f64 {
        self.start_energy
    }
}

fn refused_step(stop: EventDrivenStop) -> Error {
    let partner = |partner| match partner {
        Partner::Wall(0) => "the base",
        Partner::Wall(1) => "the left wall",
        Partner::Wall(_) => "the right wall",
        _ => "nobody in a flight too fast to follow",
    };
    let remedy = "Does the base throw disks too fast? Check its amplitude and the inputs. Inelastic collapse? Raise \
                  collision.contact_time or lower contact.normal_damping, or use the engine molecular-dynamics, which \
                  knows lasting contacts.";
    let crowded = "Disks that touch all the time collide again and again: where they fill the width of the box exactly, where \
                   they lie still, or where light ones are between heavy ones. Change box.width or the radii a little, raise \
                   collision.contact_time, or use the engine molecular-dynamics, which knows lasting contacts.";
    hard_disks::refused_step(NAME, stop, partner, remedy, crowded)
}

impl<E: HardEngine> MeasuresRotation for HardPacking<E> {
    fn rotation(&self) -> &RotationRecord {
        &self.rotation
    }
}

impl<E: HardEngine> Model for HardPacking<E> {
    type State = PackingState<E::State>;

    const INPUT_PARTS: u32 = E::Drive::INPUT_PARTS;

    fn info() -> ModelInfo {
        SceneInfo {
            scene: NAME,
            identifier: "jostle_packing_event_driven",
            unnamed_drive: "input",
            engine: "event-driven",
            drive: E::Drive::NAME,
            description: "Packing of hard frictional disks on a vibrating bottom between side walls that stand still unless \
                          wall.motion says otherwise, event-driven",
            equations: equations::HARD_HTML,
            disks: 1..=100_000,
            default_disks: 60,
            stop_time: 10.0,
            step_size: if E::Drive::STEERED { 1e-3 } else { 1e-2 },
            sheet: sheet::of("event-driven", E::Drive::NAME),
        }
        .into()
    }

    fn variables(structure: &StructuralParameters) -> Vec<Row<Self>> {
        let disks = info::disks(structure);
        let at_start = AtStart::of::<E::Drive>(&["base.model"], rows::HARD_SETTLING);
        let energies = EnergyRows {
            nominal: 1e-3,
            potential: "Energy in gravity, zero at the height of the base at rest",
            lost: "Energy lost in the dashpots and by slip since the start",
            residual: "Change of energy less work of the base plus losses: the integration's own error. What a change of gravity adds \
                       to the potential energy does not count",
            kinetic_at_start: &at_start.kinetic_energy,
            potential_at_start: &at_start.potential_energy,
        };
        let impacts = "Impacts so far, of disks and on walls";
        let collisions = Row::output("collisions", Unit::ONE, 1e4, impacts, |packing: &Self| {
            let counts = packing.counts();
            (counts.disk_impacts + counts.wall_impacts) as f64
        });
        let mut rows = rows::parameters();
        rows.extend(E::parameters());
        // P 3.3: lasting contacts are rare from Gamma = 2 on; near 1 they are the rule.
        let shaken = |row| {
            let reason = "hard disks that hardly leave the base collide again and again, and the step is refused. Shake more, or use the \
                          engine molecular-dynamics.";
            recommended::shaken_enough(row, 1.2, reason)
        };
        rows.extend(E::Drive::rows().into_iter().map(shaken));
        // Hard disks on a base at rest collapse in no time.
        rows.push(settled::parameter(false));
        rows.extend(radii(disks, 0.02, &at_start.radii, Self::radius));
        rows.extend(rows::means_and_base(&at_start));
        rows.extend(energies.rows());
        rows.push(collisions);
        rows.extend(E::own_outputs());
        rows.extend(rows::each_disk(disks, &at_start));
        complete(rows)
    }

    fn new(structure: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        let disks = initial_packing::disks(info::disks(structure), values, settled::gap_of_hard_disks(values))?;
        let Settled { disks, warning } = settled::hard(disks, values)?;
        let seed = initial_packing::warning(&disks, E::draws(values), values);
        let warnings = warning.into_iter().chain(seed).collect();
        let masses = initial_packing::masses(&disks, values);
        let engine = E::from_values(&disks, &masses, start_time, values)?;
        let mut packing = Self {
            backup: engine.copied_state(),
            engine,
            masses,
            radii: disks.iter().map(|disk| disk.radius).collect(),
            friction: values.real("contact.friction"),
            gravity: values.real("gravity"),
            work_limit: WorkLimit::new(start_time, disks.len(), values),
            warnings,
            report: StepReport::at_start(start_time),
            start_energy: 0.0,
            rotation: RotationRecord::new(disks.len(), start_time, values),
        };
        packing.start_energy = packing.energies().total();
        Ok(packing)
    }

    fn tune(&mut self, values: &Values) -> Result<()> {
        let (friction, gravity) = (values.real("contact.friction"), values.real("gravity"));
        if friction != self.friction {
            self.engine.set_law(hard_law(&self.masses, values)?);
            self.friction = friction;
        }
        if gravity != self.gravity {
            self.start_energy += (gravity - self.gravity) * self.height_moment();
            self.engine.set_gravity(self.report.time, gravity);
            self.gravity = gravity;
        }
        Ok(())
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
        let new = |warning: &&Warning| !told.contains(&warning.topic);
        let inputs = self.engine.warning(told);
        self.warnings.iter().filter(new).cloned().chain(inputs).collect()
    }

    fn limit_work(&mut self, most: u64) {
        self.work_limit.replace(most);
    }

    fn state(&self) -> Self::State {
        PackingState {
            engine: self.engine.copied_state(),
            report: self.report,
            start_energy: self.start_energy,
            rotation: self.rotation.now.clone(),
        }
    }

    fn time_of(state: &Self::State) -> f64 {
        state.report.time
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let time = state.report.time;
        let remedy = "Restore states of the same scene, disk count and parameters only.";
        let report_holds = state.report.is_sane() && are_sane([state.start_energy]);
        let rotation_holds = state.rotation.continues(&self.rotation.now, time);
        if !(self.engine.fits(&state.engine, time) && report_holds && rotation_holds) {
            return Err(Error::state("it is not a state of this run", remedy));
        }
        let former = self.engine.copied_state();
        self.engine.restore(&state.engine, time).map_err(refused_step)?;
        if !self.is_sane(time) {
            self.engine.restore(&former, self.report.time).map_err(refused_step)?;
            return Err(Error::state("it holds numbers that no packing has", remedy));
        }
        (self.report, self.start_energy) = (state.report, state.start_energy);
        self.rotation.now.clone_from(&state.rotation);
        Ok(())
    }
}
