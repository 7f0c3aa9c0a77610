//! The wedge by molecular dynamics: the same disk on two vibrating slopes.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::contact::{ContactLaws, LinearDashpot, TangentialSpring};
use crate::engine::dem::{Breakdown, Setup, State, TimeStepLimits, Verlet, verlet};
use crate::engine::wedge::{Frame, Side};
use crate::engine::{Engine as _, WorkBudget};
use crate::error::{Error, Result};
use crate::geometry::{Disk, Wall};
use crate::scene::base_drive::BaseDrive;
use crate::scene::packing::{chosen_time_step, refusal_of};
use crate::scene::{OutputWriter, Unit, Values, Variable};

use super::engine::{Energy, Engine, Look};
use super::initial::AtStart;
use super::{NAME, rows};

/// A soft disk in a wedge that moves with the drive D.
#[derive(Debug)]
pub struct Soft<D> {
    engine: Verlet<D>,
    mass: f64,
}

fn refusal(breakdown: Breakdown) -> Error {
    refusal_of(NAME, breakdown)
}

impl<D: BaseDrive> Soft<D> {
    /// Time step in use \[s\].
    pub fn time_step(&self) -> f64 {
        self.engine.setup().time_step
    }
}

impl<D: BaseDrive> Engine for Soft<D> {
    type State = State<D, verlet::Disks>;
    const NAME: &'static str = "molecular-dynamics";
    const DRIVE: &'static str = D::NAME;
    const IDENTIFIER: &'static str = if D::STEERED {
        "jostle_wedge_molecular_dynamics_input"
    } else {
        "jostle_wedge_molecular_dynamics"
    };
    const DESCRIPTION: &'static str = "Disk that bounces in a vibrating wedge, by molecular dynamics";
    const AT_START: AtStart = AtStart {
        place: &[],
        displacement: D::DISPLACEMENT_AT_START,
        acceleration: D::ACCELERATION_AT_START,
        frequency: D::FREQUENCY,
    };

    fn parameters() -> Vec<Variable> {
        vec![
            Variable::parameter(
                "contact.normal_stiffness",
                Unit::NewtonPerMetre,
                1e-3..=1e15,
                4.5e6,
                "Normal stiffness k_n of the contacts with the walls",
            ),
            Variable::parameter(
                "contact.normal_damping",
                Unit::KilogramPerSecond,
                0.0..=1e9,
                9.84,
                "Normal damping gamma_n of the contacts with the walls",
            ),
            Variable::parameter(
                "time_step",
                Unit::Second,
                0.0..=1.0,
                0.0,
                "Time step of the integration; 0: a hundredth of the shortest contact period",
            )
            .with_nominal(1e-7),
        ]
    }

    fn drive() -> Vec<Variable> {
        rows::drive::<D>()
    }

    fn counts() -> Vec<Variable> {
        let elastic = "Energy in the springs and skins of closed contacts";
        vec![
            Variable::calculated("chosen_time_step", Unit::Second, 1e-7, "Time step in use"),
            Variable::output("energy.elastic", Unit::Joule, 1e-3, elastic),
            Variable::count_output("contacts", "Walls that the disk touches"),
        ]
    }

    fn new(start_time: f64, values: &Values) -> Result<Self> {
        let (frame, radius, mass) = (
            rows::frame(values),
            values.real("disk.radius"),
            values.real("disk.mass"),
        );
        let stiffness = values.real("contact.normal_stiffness");
        let laws = ContactLaws {
            normal: LinearDashpot {
                stiffness,
                damping: values.real("contact.normal_damping"),
            },
            tangential: TangentialSpring {
                stiffness: values.real("contact.stiffness_ratio") * stiffness,
                friction: values.real("contact.friction"),
            },
        };
        let drive = D::new(start_time, values)?;
        let limits = TimeStepLimits::verlet(&laws, &[mass], drive.frequency());
        let slopes = rows::slopes(values);
        let setup = Setup {
            laws,
            walls: vec![Wall::vibrating_slope(-slopes[0]), Wall::vibrating_slope(slopes[1])],
            masses: vec![mass],
            gravity: values.real("gravity"),
            time_step: chosen_time_step(values.real("time_step"), &limits)?,
            start_time,
        };
        let mut generator = Pcg64::seed_from_u64(values.integer("seed") as u64);
        let (height, sideways) = rows::throw(values, &mut generator);
        let [up_x, up_y] = up_bisector(&frame);
        let reach = height + radius / frame.bisector().above;
        let disk = Disk {
            x: reach * up_x,
            y: reach * up_y + drive.motion(start_time).displacement,
            radius,
        };
        let mut engine = Verlet::new(setup, &[disk], drive);
        engine.set_motion(|disks| {
            disks.velocity[0] = sideways * up_y;
            disks.velocity[1] = -sideways * up_x;
        });
        Ok(Self { engine, mass })
    }

    fn aim(&mut self, time: f64, duration: f64, values: &Values) {
        self.engine.drive_mut().aim(time, duration, values);
    }

    fn advance_to(&mut self, end_time: f64, work: &mut WorkBudget) -> Result<()> {
        self.engine.advance_within(end_time, work).map_err(refusal)
    }

    fn look(&self, _time: f64) -> Look {
        let (now, energies) = (self.engine.observables(), self.engine.energies());
        let ([x, y, angle], [vx, vy, angular_velocity]) = (now.positions[0], now.velocities[0]);
        let impulse: f64 = (0..2).map(|wall| self.engine.impulse_of_wall(wall)[1]).sum();
        Look {
            place: [x, y],
            velocity: [vx, vy],
            angle,
            angular_velocity,
            base: now.base,
            impulse: impulse / self.mass,
            energy: Energy {
                kinetic: energies.kinetic / self.mass,
                potential: energies.potential / self.mass,
                input: now.energy_input / self.mass,
                lost: now.energy_lost / self.mass,
            },
        }
    }

    fn write_counts(&self, outputs: &mut OutputWriter<'_>) {
        outputs.real("chosen_time_step", self.time_step());
        outputs.real("energy.elastic", self.engine.energies().elastic);
        outputs.integer("contacts", i64::from(self.engine.now().contacts));
    }

    fn state(&self) -> Self::State {
        self.engine.state().clone()
    }

    fn restore(&mut self, state: &Self::State, time: f64) -> Result<()> {
        if !self.engine.fits(state, time) {
            return Err(Error::state(
                "it is not that of one disk and two walls",
                "Restore states of the same scene and parameters only.",
            ));
        }
        self.engine.restore(state, time).map_err(refusal)
    }
}

/// The unit vector up the bisector in the laboratory.
fn up_bisector(frame: &Frame) -> [f64; 2] {
    frame.laboratory(Side::Left, frame.bisector())
}
