//! Scene `ratchet`: disks in a periodic cell on a sawtooth that oscillates vertically, event-driven (F).

mod averages;
mod equations;
mod fields;
mod outputs;
mod parameters;
mod refusals;
mod sheet;
mod start;

use serde::{Deserialize, Serialize};

use crate::collision::{Coulomb, VelocityFloor};
use crate::drive::{BaseMotion, BoundedDrive, FollowsInput, Motion, Sine};
use crate::engine::event_driven::{
    self, Counts, EventDriven, EventDrivenState, Moving, Observer, PeriodicAcross, Sawtooth, Settings, ToothImpacts,
    Unobserved, VibratingBase,
};
use crate::engine::{DiskMotion, Engine};
use crate::error::are_sane;
use crate::measure::Transport;

use super::base_drive::BaseDrive;
use super::disks_on_base::{DisksOnBase, StepReport, Stretch, complete};
use super::hard_disks::{HardBase, HardDisksOnBase};
use super::work_limit::WorkLimit;
use super::{Error, Model, ModelInfo, Reached, Result, Row, SceneInfo, StructuralParameters, Values, Warning, info};
pub use averages::Averages;
pub use fields::Resolution;
use refusals::{impossible_motion, refusal};

/// Ratchet whose base follows the inputs `base.displacement` and `base.velocity`.
pub type RatchetOnInput = Ratchet<FollowsInput>;

/// Ratchet whose base moves as a sine.
pub type RatchetOnSine = Ratchet<Sine>;

/// Engine of the ratchet with drive D.
pub type RatchetEngine<D> = EventDriven<VelocityFloor<Coulomb>, Sawtooth<D>, PeriodicAcross>;

const NAME: &str = "ratchet";

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
    work_limit: WorkLimit,
    /// Total energy at the start \[J\], with all that changes of gravity have added since.
    start_energy: f64,
    report: StepReport,
    averages: Averages,
    /// The state before the step under way.
    backup: RatchetState<Sawtooth<D>>,
}

/// State of a [`Ratchet`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RatchetState<B> {
    /// The engine's.
    pub engine: EventDrivenState<B>,
    /// The last communication step.
    pub report: StepReport,
    /// Total energy at the start \[J\]: it depends on where inputs had the base then, and on changes of gravity since.
    pub start_energy: f64,
    /// Running averages.
    pub averages: Averages,
}

impl<D> Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: HardBase<Drive = D>,
{
    /// The engine, for everything that is no output.
    pub fn engine(&self) -> &RatchetEngine<D> {
        &self.engine
    }

    /// As [`Model::advance_to`], to the bit, and shows the flights of the disks to an observer, from the last impact or change of
    /// gravity on.
    ///
    /// # Errors
    /// As [`Model::advance_to`]; what was shown then does not count.
    pub fn advance_observed(&mut self, end_time: f64, values: &Values, observer: &mut impl Observer) -> Result<()> {
        self.advance_stretch(Stretch::Beginning, end_time, values, observer)
    }

    fn advance_stretch(
        &mut self,
        stretch: Stretch,
        end_time: f64,
        values: &Values,
        observer: &mut impl Observer,
    ) -> Result<()> {
        self.back_up();
        let impulse = self.engine.state().counts.base_impulse;
        let outcome = self.run_to(end_time, values, observer);
        if let Err(error) = outcome.and_then(|()| self.check(NAME, end_time)) {
            self.go_back(&self.backup.clone())?;
            return Err(error);
        }
        let given = self.engine.state().counts.base_impulse - impulse;
        self.report = self.report.after(stretch, end_time, -given);
        Ok(())
    }

    /// Takes the inputs for a step to `end_time` \[s\] and handles its events, recording positions where batches end.
    fn run_to(&mut self, end_time: f64, values: &Values, observer: &mut impl Observer) -> Result<()> {
        let from = self.report.time;
        let mut base = self.engine.state().boundary.base().clone();
        if base.set_target(from, end_time - from, values) {
            let acceleration = base.drive.greatest_acceleration();
            if !(acceleration <= refusals::MOST_ACCELERATION && base.farthest < self.headroom) {
                return Err(impossible_motion(from, acceleration, base.farthest, self.headroom));
            }
            let change = |boundary: &mut Sawtooth<D>| boundary.set_base(base);
            self.engine.change_boundary(from, observer, change);
        }
        let mut budget = self.work_limit.budget(self.engine.work_done(), end_time);
        let mark = values.real("measure.mark");
        if mark != self.averages.mark {
            self.averages.transport.restart(from);
            self.averages.mark = mark;
        }
        while self.averages.transport.due() <= end_time {
            let due = self.averages.transport.due();
            self.engine
                .advance_observed(due, observer, &mut budget)
                .map_err(refusal)?;
            let positions = (0..self.masses.len()).map(|disk| self.engine.sample_at(due, disk).position.x);
            let EventDrivenState { counts, boundary, .. } = self.engine.state();
            let input = counts.energy_input;
            if !self.averages.transport.has_begun() {
                self.averages.teeth = *boundary.tooth_impacts();
            }
            self.averages.transport.record(positions, input);
        }
        self.engine
            .advance_observed(end_time, observer, &mut budget)
            .map_err(refusal)
    }

    fn saved(&self) -> RatchetState<Sawtooth<D>> {
        RatchetState {
            engine: self.engine.state().clone(),
            report: self.report,
            start_energy: self.start_energy,
            averages: self.averages.clone(),
        }
    }

    /// As [`Self::saved`], into memory that is there: every step does it.
    fn back_up(&mut self) {
        let RatchetState {
            engine,
            report,
            start_energy,
            averages,
        } = &mut self.backup;
        self.engine.copy_state_to(engine);
        averages.clone_from(&self.averages);
        (*report, *start_energy) = (self.report, self.start_energy);
    }

    fn go_back(&mut self, state: &RatchetState<Sawtooth<D>>) -> Result<()> {
        self.engine.restore(&state.engine, state.report.time).map_err(refusal)?;
        (self.report, self.start_energy) = (state.report, state.start_energy);
        self.averages.clone_from(&state.averages);
        Ok(())
    }
}

/// The impact law that the parameters describe.
fn law(values: &Values) -> Result<VelocityFloor<Coulomb>> {
    let coulomb = Coulomb::new(values.real("collision.restitution"), values.real("collision.friction"))?;
    Ok(VelocityFloor::new(
        coulomb,
        values.real("collision.minimum_normal_velocity"),
    )?)
}

impl<D> Model for Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: HardBase<Drive = D>,
{
    type State = RatchetState<Sawtooth<D>>;

    const INPUT_PARTS: u32 = D::INPUT_PARTS;

    fn info() -> ModelInfo {
        SceneInfo {
            scene: NAME,
            identifier: "jostle_ratchet",
            unnamed_drive: "input",
            engine: "event-driven",
            drive: D::NAME,
            description: "Granular ratchet: hard frictional disks on a sawtooth that vibrates vertically, event-driven",
            equations: equations::HTML,
            disks: 1..=100_000,
            default_disks: 20,
            stop_time: 10.0,
            step_size: if D::STEERED { 1e-3 } else { 1e-2 },
            sheet: sheet::of(D::NAME),
        }
        .into()
    }

    fn variables(structure: &StructuralParameters) -> Vec<Row<Self>> {
        let mut rows = parameters::rows::<D, Self>();
        rows.extend(Self::computed_rows(info::disks(structure)));
        complete(rows)
    }

    fn new(structure: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        let law = law(values)?;
        let profile = start::profile(values)?;
        let base = <Moving<D> as HardBase>::from_values(start_time, values)?;
        let lift = base.motion(start_time).displacement;
        let disks = start::disks(info::disks(structure) as usize, values, profile.top() + lift)?;
        let masses = start::masses(&disks, values);
        let headroom = start::headroom(values, profile.top(), base.farthest())?;
        let space = start::space(values, disks.len(), profile.top(), base.farthest());
        let boundary = Sawtooth::new(profile, base, values.real("cell.height"), start_time);
        let gravity = values.real("gravity");
        let inertia_factor = values.real("disk.inertia_factor");
        let settings = Settings {
            shell: start::shell(disks.len(), values),
            start_time,
            inertia_factor,
        };
        let model = event_driven::Model {
            law,
            boundary,
            gravity,
            space,
        };
        let engine = EventDriven::new(model, &disks, &masses, &vec![[0.0; 3]; disks.len()], settings);
        let report = StepReport::at_start(start_time);
        let mut transport = Transport::new(values.real("measure.start").max(start_time));
        transport.make_room(disks.len());
        let averages = Averages {
            transport,
            mark: values.real("measure.mark"),
            teeth: ToothImpacts::default(),
        };
        let mut backup = RatchetState {
            engine: engine.state().clone(),
            report,
            start_energy: 0.0,
            averages: averages.clone(),
        };
        backup.averages.transport.make_room(disks.len());
        let mut ratchet = Self {
            engine,
            backup,
            layers: start::layers(disks.len(), values),
            masses,
            gravity,
            inertia_factor,
            headroom,
            work_limit: WorkLimit::new(start_time, disks.len(), values),
            start_energy: 0.0,
            report,
            averages,
        };
        ratchet.start_energy = ratchet.energies().total();
        Ok(ratchet)
    }

    fn tune(&mut self, values: &Values) -> Result<()> {
        self.engine.set_law(law(values)?);
        let gravity = values.real("gravity");
        if gravity != self.gravity {
            self.start_energy += (gravity - self.gravity) * self.height_moment();
            self.engine.set_gravity(self.report.time, gravity, &mut Unobserved);
            self.gravity = gravity;
        }
        Ok(())
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        self.advance_observed(end_time, values, &mut Unobserved)
    }

    fn resume_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.advance_stretch(Stretch::Rest, end_time, values, &mut Unobserved)?;
        Ok(Reached {
            time: end_time,
            event: false,
        })
    }

    fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        self.engine.state().boundary.base().warning(told).into_iter().collect()
    }

    fn limit_work(&mut self, most: u64) {
        self.work_limit.replace(most);
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
        let report_holds = state.report.is_sane() && are_sane([state.start_energy, averages.mark]);
        let counts_hold = averages::teeth_hold(
            &averages.teeth,
            &state.engine.boundary,
            state.engine.counts.wall_impacts,
        );
        let remedy = "Restore states of the same scene, disk count and parameters only.";
        if !(averages_hold && report_holds && counts_hold && self.engine.fits(&state.engine, state.report.time)) {
            return Err(Error::state("it is not a state of this run", remedy));
        }
        let former = self.saved();
        self.go_back(state)?;
        if !self.is_sane(state.report.time) {
            self.go_back(&former)?;
            return Err(Error::state("it holds numbers that no ratchet has", remedy));
        }
        Ok(())
    }
}

impl<D> DisksOnBase for Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: HardBase<Drive = D>,
{
    fn report(&self) -> &StepReport {
        &self.report
    }

    fn disk_count(&self) -> usize {
        self.masses.len()
    }

    #[inline(always)]
    fn disk_at(&self, time: f64, disk: usize) -> DiskMotion {
        self.engine.sample_at(time, disk)
    }

    fn base_at(&self, time: f64) -> Motion {
        self.engine.state().boundary.base().motion(time)
    }

    fn base_impulse(&self) -> f64 {
        -self.engine.state().counts.base_impulse
    }
}

impl<D> HardDisksOnBase for Ratchet<D>
where
    D: BaseDrive + BoundedDrive,
    Moving<D>: HardBase<Drive = D>,
{
    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn radius(&self, disk: usize) -> f64 {
        self.engine.state().bodies[disk].radius
    }

    fn gravity(&self) -> f64 {
        self.gravity
    }

    fn inertia_factor(&self) -> f64 {
        self.inertia_factor
    }

    fn counts(&self) -> Counts {
        self.engine.state().counts
    }

    fn start_energy(&self) -> f64 {
        self.start_energy
    }
}
