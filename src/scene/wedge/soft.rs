//! The wedge by molecular dynamics: the same disk on two vibrating slopes.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::contact::LinearDashpot;
use crate::drive::Motion;
use crate::engine::DiskMotion;
use crate::engine::dem::{Breakdown, FixedGrid, SoftDiskSetup, TimeStepLimits, Verlet};
use crate::engine::wedge::{Side, WedgeFrame};
use crate::geometry::{Disk, Vector2, Wall, clockwise};
use crate::scene::base_drive::BaseDrive;
use crate::scene::disks_on_base::names;
use crate::scene::soft_disks::{STEP_OF_ONE_DISK, check_tuned_time_step, chosen_time_step, contact_laws, refused_step};
use crate::scene::{Error, Listing, Result, Row, Unit, Values, Warning, contact_list, recommended};

use super::engine::{AtStart, SpecificEnergies, WedgeEngine};
use super::rows::{self, NAME};

/// A soft disk in a wedge that moves with the drive D.
pub type Soft<D> = Verlet<D>;

/// The mass of the only disk \[kg\].
fn mass<D: BaseDrive>(engine: &Soft<D>) -> f64 {
    engine.setup().masses[0]
}

impl<D: BaseDrive> WedgeEngine for Soft<D> {
    const NAME: &'static str = "molecular-dynamics";
    const DRIVE: &'static str = D::NAME;
    const IDENTIFIER: &'static str = "jostle_wedge_molecular_dynamics";
    const DESCRIPTION: &'static str = "Disk that bounces in a vibrating wedge, by molecular dynamics";
    const INPUT_PARTS: u32 = D::INPUT_PARTS;
    const AT_START: AtStart = AtStart {
        place: &[],
        displacement: D::DISPLACEMENT_AT_START,
        velocity: D::VELOCITY_AT_START,
        acceleration: D::ACCELERATION_AT_START,
    };

    fn contact_rows<M>() -> Vec<Row<M>> {
        let rows = vec![
            Row::parameter(
                "contact.normal_stiffness",
                Unit::NEWTON_PER_METRE,
                1e-3..=1e15,
                4.5e6,
                "Normal stiffness k_n of the contacts with the walls",
            ),
            Row::parameter(
                "contact.normal_damping",
                Unit::KILOGRAM_PER_SECOND,
                0.0..=1e9,
                9.84,
                "Normal damping gamma_n of the contacts with the walls",
            ),
            Row::parameter(
                "time_step",
                Unit::SECOND,
                0.0..=1.0,
                0.0,
                "Time step of the integration; 0: a hundredth of the shortest contact period",
            )
            .with_nominal(1e-7),
        ];
        rows.into_iter().map(recommended::one_soft_disk).collect()
    }

    fn drive_rows<M>() -> Vec<Row<M>> {
        rows::drive::<M, D>()
            .into_iter()
            .map(recommended::one_soft_disk)
            .collect()
    }

    fn own_outputs<M: AsRef<Self>>() -> Vec<Row<M>> {
        let elastic = "Energy in the normal and tangential springs of closed contacts";
        vec![
            Row::calculated(
                "chosen_time_step",
                Unit::SECOND,
                1e-7,
                "Time step in use, chosen at the start",
                |scene: &M| scene.as_ref().setup().time_step,
            )
            .depending_on(&names(&[STEP_OF_ONE_DISK, D::FREQUENCY])),
            Row::output("energy.elastic", Unit::JOULE, 1e-3, elastic, |scene: &M| {
                scene.as_ref().elastic_energy()
            }),
            Row::count_output("contacts", "Walls that the disk touches", |scene: &M| {
                i64::from(scene.as_ref().now().contacts)
            }),
        ]
    }

    fn listings<M: AsRef<Self>>() -> Vec<Listing<M>> {
        let contacts = |scene: &M, numbers: &mut Vec<f64>| contact_list::append(scene.as_ref().contacts(), numbers);
        vec![contact_list::listing(contacts)]
    }

    fn from_values(start_time: f64, values: &Values) -> Result<Self> {
        let (frame, radius, mass) = (
            rows::frame(values),
            values.real("disk.radius"),
            values.real("disk.mass"),
        );
        let laws = contact_laws(values);
        let drive = D::new(start_time, values)?;
        let limits = TimeStepLimits::verlet(&laws, &[mass], drive.frequency());
        let slopes = rows::slopes(values);
        let setup = SoftDiskSetup {
            laws,
            walls: vec![Wall::vibrating_slope(-slopes[0]), Wall::vibrating_slope(slopes[1])],
            masses: vec![mass],
            gravity: values.real("gravity"),
            time_step: chosen_time_step(values, &limits)?,
            start_time,
        };
        let mut generator = Pcg64::seed_from_u64(values.integer("seed") as u64);
        let (height, sideways) = rows::throw(values, &mut generator);
        let up = up_bisector(&frame);
        let distance = height + radius / frame.bisector().y;
        let lift = drive.motion(start_time).displacement;
        let disk = Disk::new(distance * up, radius).raised(lift);
        let mut engine = Verlet::new(setup, &[disk], drive);
        engine.set_motion(|disks| {
            [disks.velocity[0], disks.velocity[1]] = (sideways * clockwise(&up)).into();
        });
        Ok(engine)
    }

    fn tune(&mut self, _time: f64, values: &Values) -> Result<()> {
        let laws = contact_laws::<LinearDashpot>(values);
        let (gravity, setup) = (values.real("gravity"), self.setup());
        if laws.tangential == setup.laws.tangential && gravity == setup.gravity {
            return Ok(());
        }
        let limits = TimeStepLimits::verlet(&laws, &setup.masses, self.state().drive.frequency());
        check_tuned_time_step(values, &limits, setup.time_step)?;
        FixedGrid::tune(self, laws.tangential.friction, gravity);
        Ok(())
    }

    fn set_target(&mut self, time: f64, duration: f64, values: &Values) {
        self.drive_mut().set_target(time, duration, values);
    }

    fn warning(&self, told: &[&'static str]) -> Option<Warning> {
        self.state().drive.warning(told)
    }

    fn refused_step(breakdown: Breakdown) -> Error {
        refused_step(NAME, breakdown)
    }

    fn disk_at(&self, _time: f64) -> DiskMotion {
        self.observables().disk(0)
    }

    fn base_at(&self, _time: f64) -> Motion {
        self.now().base
    }

    fn energies_at(&self, _time: f64) -> SpecificEnergies {
        let (now, mass) = (self.now(), mass(self));
        SpecificEnergies {
            kinetic: self.kinetic_energy() / mass,
            potential: self.potential_energy() / mass,
            input: now.energy_input / mass,
            lost: now.energy_lost / mass,
        }
    }

    fn impulse(&self) -> f64 {
        let impulse: f64 = (0..2).map(|wall| self.impulse_of_wall(wall)[1]).sum();
        impulse / mass(self)
    }
}

/// The unit vector up the bisector in the laboratory.
fn up_bisector(frame: &WedgeFrame) -> Vector2<f64> {
    frame.to_laboratory(Side::Left, frame.bisector())
}
