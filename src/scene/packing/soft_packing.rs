//! The packing of soft disks: rows, steps and states for any engine of soft disks.

use crate::drive::Motion;
use crate::engine::dem::{FixedGrid, GridState, SoftDiskSetup, TimeStepLimits};
use crate::engine::{DiskMotion, Engine};
use crate::error::are_sane;
use crate::geometry::Disk;
use crate::scene::base_drive::{BaseDrive, TERMINAL};
use crate::scene::disks_on_base::{DisksOnBase, StepReport, Stretch, complete, names, radii};
use crate::scene::soft_disks::{SceneNormalForce, check_tuned_time_step, chosen_time_step, contact_laws, refused_step};
use crate::scene::work_limit::WorkLimit;
use crate::scene::{
    Error, Listing, Model, ModelInfo, Reached, Result, Row, SceneInfo, StructuralParameters, Unit, Values, Warning,
    contact_list, info, recommended,
};

use super::initial_packing::{self, NAME};
use super::rotation::{MeasuresRotation, RotationRecord};
use super::rows::{self, AtStart};
use super::settled::{self, Settled};
use super::{PackingState, equations, sheet, soft::SoftMethod};

/// What the largest time step depends on besides the radii and the drive.
const STIFFEST: &[&str] = &[
    "disk.surface_density",
    "contact.normal_stiffness",
    "contact.stiffness_ratio",
    "contact.normal_damping",
    "contact.friction",
];

/// Disks in a box of two walls and a floor that vibrates with the drive D, advanced by the method S.
#[derive(Debug)]
pub struct SoftPacking<S: SoftMethod, D> {
    engine: FixedGrid<S, D>,
    limits: TimeStepLimits,
    work_limit: WorkLimit,
    report: StepReport,
    /// Total energy at the start \[J\], which depends on where the inputs had the base, with all that changes of gravity have added
    /// since; for the residual.
    start_energy: f64,
    rotation: RotationRecord,
    /// What is doubtful about the start.
    warnings: Vec<Warning>,
}

impl<S: SoftMethod, D: BaseDrive> SoftPacking<S, D> {
    /// A packing of given `disks` at rest relative to the base, in a box of the width that `values` say.
    ///
    /// # Errors
    /// A time step that the contacts do not allow, by name.
    pub fn of_disks(disks: &[Disk], start_time: f64, values: &Values) -> Result<Self> {
        Self::of_disks_on(S::threads(disks.len(), values)?, disks, start_time, values)
    }

    fn of_disks_on(threads: S::Threads, disks: &[Disk], start_time: f64, values: &Values) -> Result<Self> {
        let mut drive = D::new(start_time, values)?;
        let laws = contact_laws(values);
        let mut masses = initial_packing::masses(disks, values);
        let limits = S::limits(&laws, &masses, drive.frequency(), values);
        let mut warnings: Vec<Warning> = initial_packing::warning(disks, false, values).into_iter().collect();
        if D::MOVES_DISKS {
            let bottom = initial_packing::bottom_row(disks, values);
            bottom.iter().for_each(|disk| masses[disk.index as usize] = 0.0);
            drive.hold(&bottom);
            warnings.extend(initial_packing::bottom_warning(&bottom, disks.len()));
        }
        // The packing starts on the floor, wherever the drive has it.
        let lift = drive.motion(start_time).displacement;
        let disks: Vec<Disk> = disks.iter().map(|disk| disk.raised(lift)).collect();
        let setup = SoftDiskSetup {
            laws,
            walls: initial_packing::walls(values),
            masses,
            gravity: values.real("gravity"),
            time_step: chosen_time_step(values, &limits)?,
            start_time,
        };
        let mut packing = Self {
            engine: FixedGrid::new(setup, &disks, drive),
            limits,
            work_limit: WorkLimit::new(start_time, disks.len(), values),
            warnings,
            report: StepReport::at_start(start_time),
            start_energy: 0.0,
            rotation: RotationRecord::new(disks.len(), start_time, values),
        };
        packing.engine.use_threads(threads);
        packing.start_energy = packing.energy();
        Ok(packing)
    }

    /// The engine, to observe everything that is no output.
    pub fn engine(&self) -> &FixedGrid<S, D> {
        &self.engine
    }

    /// Gives all disks the velocity of the base.
    fn move_with_base(&mut self) {
        let velocity = self.engine.observables().base.velocity;
        self.engine.set_velocity([0.0, velocity]);
        self.start_energy = self.energy();
    }

    /// Vertical impulse \[N.s\] that the walls that move with the base have given to the disks since the start.
    fn impulse_of_base(&self) -> f64 {
        let walls = self.engine.setup().walls.iter().enumerate();
        walls
            .map(|(index, wall)| wall.follows_base * self.engine.impulse_of_wall(index)[1])
            .sum()
    }

    /// Advances to `end_time` \[s\] under the inputs among `values`; the state is as before if that cannot be done.
    fn advance_stretch(&mut self, stretch: Stretch, end_time: f64, values: &Values) -> Result<()> {
        let from = self.report.time;
        let duration = end_time - from;
        let impulse = self.impulse_of_base();
        // Other drives change only in the steps of the engine, which brings them back itself.
        let steered = D::STEERED.then(|| self.engine.drive_mut().clone());
        self.engine.drive_mut().set_target(from, duration, values);
        self.rotation.back_up(end_time);
        let mut budget = self.work_limit.budget(0, end_time);
        let outcome = self
            .engine
            .advance_sampled(end_time, &mut budget, &mut self.rotation.now);
        if let Err(breakdown) = outcome {
            if let Some(drive) = steered {
                *self.engine.drive_mut() = drive;
            }
            self.rotation.go_back();
            return Err(refused_step(NAME, breakdown));
        }
        self.report = self.report.after(stretch, end_time, impulse - self.impulse_of_base());
        Ok(())
    }

    /// Kinetic, potential and elastic energy \[J\] together.
    fn energy(&self) -> f64 {
        let energies = self.engine.energies();
        energies.kinetic + energies.potential + energies.elastic
    }

    fn time_steps() -> [Row<Self>; 2] {
        let frequency = D::FREQUENCY;
        let choice = &["tolerance", "time_step"];
        let step = |name, nominal, what, read| Row::calculated(name, Unit::SECOND, nominal, what, read);
        [
            step(
                "chosen_time_step",
                1e-5,
                "Time step in use, chosen at the start",
                |packing: &Self| packing.engine.setup().time_step,
            )
            .depending_on(&names(&[
                &rows::RADII,
                STIFFEST,
                S::Normal::PARAMETERS,
                frequency,
                choice,
            ])),
            step(
                "largest_time_step",
                1e-4,
                "Largest time step that would be accepted",
                |packing| packing.limits.largest,
            )
            .depending_on(&names(&[&rows::RADII, STIFFEST, S::Normal::PARAMETERS, frequency])),
        ]
    }

    /// The force that is no mean over a step: zero at the start unless disks overlap, which the damping then feels too.
    fn force_now(at_start: &AtStart) -> Row<Self> {
        let description =
            "Vertical force of the disks on the base now, up; base.reaction_force is its mean over the last step";
        let force = Row::output(
            "base.reaction_force_now",
            Unit::NEWTON,
            1.0,
            description,
            |packing: &Self| -packing.engine.base_force(),
        );
        force
            .in_terminal(TERMINAL, "reaction_force_now")
            .depending_on(&names(&[&at_start.touching, &at_start.base_velocity]))
    }

    /// Energies, and the closed contacts. Whether disks touch at the start, and how much energy that is, is a matter of
    /// rounding and thus of where the base is.
    fn energies_and_contacts(at_start: &AtStart) -> [Row<Self>; 7] {
        let energy = |name, description, read| Row::output(name, Unit::JOULE, 1e-3, description, read);
        [
            energy(
                "energy.kinetic",
                "Kinetic energy of translation and rotation",
                |packing: &Self| packing.engine.kinetic_energy(),
            )
            .depending_on(&at_start.kinetic_energy),
            energy(
                "energy.potential",
                "Energy in gravity, zero at the height of the base at rest",
                |packing| packing.engine.potential_energy(),
            )
            .depending_on(&at_start.potential_energy),
            energy(
                "energy.elastic",
                "Energy in the normal and tangential springs of closed contacts",
                |packing| packing.engine.elastic_energy(),
            )
            .depending_on(&at_start.touching),
            energy(
                "energy.input",
                "Work done by the base on the disks since the start",
                |packing| packing.engine.observables().energy_input,
            ),
            energy(
                "energy.lost",
                "Energy lost in the dashpots and by slip since the start",
                |packing| packing.engine.observables().energy_lost,
            ),
            energy(
                "energy.residual",
                "Change of energy less work of the base plus losses: the integration's own error. What a change of gravity adds to the \
                 potential energy does not count",
                |packing| {
                    let now = packing.engine.observables();
                    packing.energy() - packing.start_energy - now.energy_input + now.energy_lost
                },
            ),
            Row::count_output(
                "contacts",
                "Closed contacts, with the walls and the base",
                |packing: &Self| i64::from(packing.engine.observables().contacts),
            )
            .depending_on(&at_start.touching),
        ]
    }
}

impl<S: SoftMethod, D: BaseDrive> DisksOnBase for SoftPacking<S, D> {
    fn report(&self) -> &StepReport {
        &self.report
    }

    fn disk_count(&self) -> usize {
        self.engine.radii().len()
    }

    fn disk_at(&self, _time: f64, disk: usize) -> DiskMotion {
        self.engine.observables().disk(disk)
    }

    fn base_at(&self, _time: f64) -> Motion {
        self.engine.observables().base
    }

    fn base_impulse(&self) -> f64 {
        -self.impulse_of_base()
    }
}

impl<S: SoftMethod, D> MeasuresRotation for SoftPacking<S, D> {
    fn rotation(&self) -> &RotationRecord {
        &self.rotation
    }
}

impl<S: SoftMethod, D: BaseDrive> Model for SoftPacking<S, D> {
    type State = PackingState<GridState<D, S::Disks>>;

    const INPUT_PARTS: u32 = D::INPUT_PARTS;

    fn info() -> ModelInfo {
        SceneInfo {
            scene: NAME,
            identifier: S::IDENTIFIER,
            unnamed_drive: "input",
            engine: S::NAME,
            drive: D::NAME,
            description: S::DESCRIPTION,
            equations: equations::HTML,
            disks: 1..=100_000,
            default_disks: 60,
            stop_time: 10.0,
            step_size: 1e-3,
            sheet: sheet::of(S::NAME, D::NAME),
        }
        .into()
    }

    fn variables(structure: &StructuralParameters) -> Vec<Row<Self>> {
        let disks = info::disks(structure);
        let at_start = AtStart::of::<D>(&[], &[rows::SETTLING, S::Normal::PARAMETERS].concat());
        let mut rows = rows::parameters();
        rows.extend(S::Normal::rows());
        rows.extend(S::parameters());
        rows.extend(D::rows());
        rows.push(settled::parameter(D::STEERED));
        let mut rows: Vec<Row<Self>> = rows.into_iter().map(recommended::soft_packing).collect();
        rows.extend(Self::time_steps());
        rows.extend(radii(disks, 0.02, &at_start.radii, |packing: &Self, disk| {
            packing.engine.radii()[disk]
        }));
        rows.extend(rows::means_and_base(&at_start));
        rows.push(Self::force_now(&at_start));
        rows.extend(Self::energies_and_contacts(&at_start));
        rows.extend(rows::each_disk(disks, &at_start));
        complete(rows)
    }

    fn listings() -> Vec<Listing<Self>> {
        let contacts = |packing: &Self, numbers: &mut Vec<f64>| {
            contact_list::append(packing.engine.contacts(), numbers);
        };
        vec![contact_list::listing(contacts)]
    }

    fn new(structure: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        let disks = initial_packing::disks(info::disks(structure), values, 0.0)?;
        let (threads, normal) = (S::threads(disks.len(), values)?, S::Normal::from_values(values));
        let Settled { disks, warning } = settled::soft(&threads, disks, normal, values)?;
        let mut packing = Self::of_disks_on(threads, &disks, start_time, values)?;
        packing.warnings.extend(warning);
        if settled::is_wanted(values) {
            packing.move_with_base();
        }
        Ok(packing)
    }

    fn tune(&mut self, values: &Values) -> Result<()> {
        let laws = contact_laws::<S::Normal>(values);
        let gravity = values.real("gravity");
        let setup = self.engine.setup();
        if laws.tangential == setup.laws.tangential && gravity == setup.gravity {
            return Ok(());
        }
        let masses = initial_packing::masses_of(self.engine.radii().iter().copied(), values);
        let limits = S::limits(&laws, &masses, self.engine.state().drive.frequency(), values);
        check_tuned_time_step(values, &limits, setup.time_step)?;
        // The energy that disks gain or lose by this is not the work of anything.
        self.start_energy += (gravity - setup.gravity) * self.engine.height_moment();
        self.engine.tune(laws.tangential.friction, gravity);
        self.limits = limits;
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
        let inputs = self.engine.state().drive.warning(told);
        self.warnings.iter().filter(new).cloned().chain(inputs).collect()
    }

    fn limit_work(&mut self, most: u64) {
        self.work_limit.replace(most);
    }

    fn state(&self) -> Self::State {
        PackingState {
            engine: self.engine.state().clone(),
            report: self.report,
            start_energy: self.start_energy,
            rotation: self.rotation.now.clone(),
        }
    }

    fn time_of(state: &Self::State) -> f64 {
        state.report.time
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        let report_holds = state.report.is_sane() && are_sane([state.start_energy]);
        let rotation_holds = state.rotation.continues(&self.rotation.now, state.report.time);
        let drive = &self.engine.state().drive;
        let drive_holds = drive.continues(&state.engine.drive, state.report.time);
        let fits = report_holds && rotation_holds && drive_holds;
        if !(fits && self.engine.fits(&state.engine, state.report.time)) {
            return Err(Error::state(
                "it has other numbers of disks or contacts, or numbers that no packing has",
                "Restore states of the same scene, disk count and parameters only.",
            ));
        }
        self.engine
            .restore(&state.engine, state.report.time)
            .map_err(|breakdown| refused_step(NAME, breakdown))?;
        (self.report, self.start_energy) = (state.report, state.start_energy);
        self.rotation.now.clone_from(&state.rotation);
        Ok(())
    }
}
