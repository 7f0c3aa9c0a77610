//! The wedge from impact to impact: the map and the truly moving walls.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::collision::{CollisionLaw, Dashpot, TabulatedDashpot, VelocityFloor};
use crate::contact::LinearDashpot;
use crate::drive::{FirstHit, RandomPhase, Sine};
use crate::engine::WorkBudget;
use crate::engine::wedge::{DiskInWedge, Moving, NO_PROGRESS, Resting, Setup, Side, State, Stop, Stuck, WallMotion};
use crate::error::{Error, Result};
use crate::scene::base_drive::BaseDrive;
use crate::scene::{Kind, OutputWriter, Unit, Values, Variable};

use super::engine::{Energy, Engine, Look};
use super::initial::AtStart;
use super::{NAME, rows};

/// The map of P 6.3.
///
/// There is no velocity floor: a slow disk meets the base near its top, with `v_b` of order `sqrt(|v_n| A omega_b)`, and
/// is thrown up again, so that impacts do not pile up whatever the restitution.
#[derive(Debug)]
pub struct Map(DiskInWedge<TabulatedDashpot, Resting>);

/// The wedge that moves with a drive D.
///
/// A disk that comes to rest on a moving wall does so by infinitely many impacts in finite time. The velocity floor ends
/// that: no impact leaves slower than `collision.minimum_normal_velocity`, and how many it concerned is an output. A
/// disk at rest is thus one that bounces by v^2 / (2 g); its friction and the force on the base are right in the mean.
#[derive(Debug)]
pub struct EventDriven<D>(DiskInWedge<VelocityFloor<TabulatedDashpot>, Moving<D>>);

/// The impact law of a disk of unit mass at a wall, which depends on e_n, kappa and mu alone.
fn law(values: &Values) -> Result<TabulatedDashpot> {
    let ratio = LinearDashpot::damping_ratio_for(values.real("collision.restitution"));
    let (kappa, friction) = (values.real("contact.stiffness_ratio"), values.real("contact.friction"));
    let law = Dashpot::of_damping_ratio(1.0, ratio, 1.0, kappa, friction)?;
    Ok(TabulatedDashpot::new(law, &[1.0], 0.5))
}

fn setup(values: &Values, slow: f64) -> Setup {
    Setup {
        frame: rows::frame(values),
        radius: values.real("disk.radius"),
        gravity: values.real("gravity"),
        slow,
    }
}

fn restitution() -> Variable {
    Variable::parameter(
        "collision.restitution",
        Unit::One,
        0.01..=1.0,
        0.9,
        "Coefficient of normal restitution e_n",
    )
}

fn collisions() -> Variable {
    Variable::count_output("collisions", "Collisions since the start; stops counting at 2147483647")
}

fn counted(count: u64) -> i64 {
    count.min(i32::MAX as u64) as i64
}

fn refusal(stop: Stop, remedy: &str) -> Error {
    let Stuck {
        time,
        side,
        along,
        collisions,
    } = match stop {
        Stop::Stuck(stuck) => stuck,
        Stop::TooManyImpacts { time, most } => {
            return Error::too_much_work(NAME, time, format!("more than {most} collisions"));
        }
    };
    let wall = match side {
        Side::Left => "left",
        Side::Right => "right",
    };
    let what = if collisions == 1 {
        format!("the disk does not get off the {wall} wall, {along:e} m up from its lowest place")
    } else {
        format!(
            "no progress: {collisions} collisions in less than {NO_PROGRESS:e} s, the last at the {wall} wall, {along:e} m up from \
             the lowest place of the disk"
        )
    };
    Error::Step {
        scene: NAME,
        time,
        what,
        remedy: remedy.into(),
    }
}

fn look<L: CollisionLaw, B: WallMotion>(disk: &DiskInWedge<L, B>, time: f64) -> Look {
    let (view, sums, setup) = (disk.view(time), disk.state().sums, disk.setup());
    let [vx, vy] = view.velocity;
    let rim = setup.radius * view.angular_velocity;
    Look {
        place: view.place,
        velocity: view.velocity,
        angle: view.angle,
        angular_velocity: view.angular_velocity,
        base: disk.base(time),
        impulse: sums.velocity,
        energy: Energy {
            kinetic: 0.5 * (vx * vx + vy * vy + 0.5 * rim * rim),
            potential: setup.gravity * view.place[1],
            input: sums.input,
            lost: sums.lost,
        },
    }
}

/// Goes to a state if it can be one.
fn restore<L: CollisionLaw, B: WallMotion>(disk: &mut DiskInWedge<L, B>, state: &State<B>, time: f64) -> Result<()> {
    let numbers = [
        state.time,
        state.place.along,
        state.place.above,
        state.velocity.along,
        state.velocity.above,
        state.rim_velocity,
        state.rim_way,
        state.base.displacement,
        state.base.velocity,
    ];
    let in_flight = state.time <= time && time < state.time + state.delay;
    if !(numbers.iter().all(|number| number.is_finite()) && state.delay >= 0.0 && in_flight) {
        return Err(Error::state(
            "its flight is none that a disk in a wedge can be on",
            "Restore states of the same scene and parameters only.",
        ));
    }
    disk.restore(state);
    Ok(())
}

impl Engine for Map {
    type State = State<Resting>;
    const NAME: &'static str = "map";
    const DRIVE: &'static str = <Sine as BaseDrive>::NAME;
    const IDENTIFIER: &'static str = "jostle_wedge_map";
    const DESCRIPTION: &'static str =
        "Disk that bounces in a wedge, by the map of its impacts with a random phase of the base";
    /// The walls rest.
    const AT_START: AtStart = AtStart {
        place: &["seed"],
        displacement: &[],
        acceleration: &[],
        frequency: &[],
    };

    fn parameters() -> Vec<Variable> {
        vec![restitution()]
    }

    /// The phase is random. Any amplitude goes: the walls rest, and only A omega_b counts.
    fn drive() -> Vec<Variable> {
        let mut rows = Sine::variables();
        rows.retain(|row| row.name != "drive.phase");
        for row in &mut rows {
            if let ("drive.amplitude", Kind::Real(quantity)) = (row.name.as_str(), &mut row.kind) {
                quantity.max = 1e4;
            }
        }
        rows
    }

    fn counts() -> Vec<Variable> {
        vec![collisions()]
    }

    fn new(start_time: f64, values: &Values) -> Result<Self> {
        let amplitude = values.real("drive.amplitude");
        let mut generator = Pcg64::seed_from_u64(values.integer("seed") as u64);
        let (height, sideways) = rows::throw(values, &mut generator);
        let phase = RandomPhase {
            peak_velocity: TAU * values.real("drive.frequency") * amplitude,
        };
        let (setup, walls) = (setup(values, 0.0), Resting { phase, generator });
        let disk = DiskInWedge::new(setup, law(values)?, walls, start_time, height, sideways);
        Ok(Self(disk))
    }

    fn aim(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn advance_to(&mut self, end_time: f64, work: &mut WorkBudget) -> Result<()> {
        self.0
            .advance_within(end_time, work)
            .map_err(|stop| refusal(stop, "Raise collision.restitution or drive.amplitude."))
    }

    fn look(&self, time: f64) -> Look {
        look(&self.0, time)
    }

    fn write_counts(&self, outputs: &mut OutputWriter<'_>) {
        outputs.integer("collisions", counted(self.0.state().sums.collisions));
    }

    fn state(&self) -> Self::State {
        self.0.state().clone()
    }

    fn restore(&mut self, state: &Self::State, time: f64) -> Result<()> {
        restore(&mut self.0, state, time)
    }
}

const FLOOR: &str = "collision.minimum_normal_velocity";

impl<D: BaseDrive + FirstHit> Engine for EventDriven<D> {
    type State = State<Moving<D>>;
    const NAME: &'static str = "event-driven";
    const DRIVE: &'static str = D::NAME;
    const IDENTIFIER: &'static str = if D::STEERED {
        "jostle_wedge_event_driven_input"
    } else {
        "jostle_wedge_event_driven"
    };
    const DESCRIPTION: &'static str = "Disk that bounces in a vibrating wedge, exactly from impact to impact";
    const AT_START: AtStart = AtStart {
        place: &["seed"],
        displacement: D::DISPLACEMENT_AT_START,
        acceleration: D::ACCELERATION_AT_START,
        frequency: &[],
    };

    fn parameters() -> Vec<Variable> {
        let floor = "Smallest normal velocity with which a collision leaves the wall: ends the infinitely many collisions \
                     of a disk that comes to rest";
        vec![
            restitution(),
            Variable::parameter(FLOOR, Unit::MetrePerSecond, 0.0..=1e3, 1e-4, floor),
        ]
    }

    fn drive() -> Vec<Variable> {
        rows::drive::<D>()
    }

    fn counts() -> Vec<Variable> {
        let slow = "Collisions among them that left the wall at collision.minimum_normal_velocity";
        vec![collisions(), Variable::count_output("slow_collisions", slow)]
    }

    fn new(start_time: f64, values: &Values) -> Result<Self> {
        let mut generator = Pcg64::seed_from_u64(values.integer("seed") as u64);
        let (height, sideways) = rows::throw(values, &mut generator);
        let floor = values.real(FLOOR);
        let law = VelocityFloor::new(law(values)?, floor)?;
        let (setup, walls) = (setup(values, floor), Moving(D::new(start_time, values)?));
        Ok(Self(DiskInWedge::new(setup, law, walls, start_time, height, sideways)))
    }

    fn aim(&mut self, time: f64, duration: f64, values: &Values) {
        if D::STEERED {
            self.0.steer(time, |walls| walls.0.aim(time, duration, values));
        }
    }

    fn advance_to(&mut self, end_time: f64, work: &mut WorkBudget) -> Result<()> {
        let remedy = format!("Inelastic collapse? Raise {FLOOR} or collision.restitution.");
        self.0
            .advance_within(end_time, work)
            .map_err(|stop| refusal(stop, &remedy))
    }

    fn look(&self, time: f64) -> Look {
        look(&self.0, time)
    }

    fn write_counts(&self, outputs: &mut OutputWriter<'_>) {
        let sums = self.0.state().sums;
        outputs.integer("collisions", counted(sums.collisions));
        outputs.integer("slow_collisions", counted(sums.slow_collisions));
    }

    fn state(&self) -> Self::State {
        self.0.state().clone()
    }

    fn restore(&mut self, state: &Self::State, time: f64) -> Result<()> {
        restore(&mut self.0, state, time)
    }
}
