//! The wedge from impact to impact: the map and the truly moving walls.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::collision::{CollisionLaw, Dashpot, TabulatedDashpot, VelocityFloor};
use crate::contact::LinearDashpot;
use crate::drive::{AtRandomPhase, BaseMotion, BaseProfile, FirstHit, Motion, RandomPhase, Sine};
use crate::engine::DiskMotion;
use crate::engine::wedge::{DiskInWedge, NO_PROGRESS, Side, Start, Stuck, WedgeSetup, WedgeStop};
use crate::scene::base_drive::BaseDrive;
use crate::scene::{Error, Kind, Result, Row, Unit, Values, Warning, random_phase_base, recommended, work_limit};

use super::engine::{AtStart, SpecificEnergies, WedgeEngine};
use super::rows::{self, NAME};

/// The map of P 6.3.
///
/// There is no velocity floor: a slow disk meets the base near its top, with `v_b` of order `sqrt(|v_n| A omega_b)`, and
/// is thrown up again, so that impacts do not pile up whatever the restitution.
pub type Map = DiskInWedge<TabulatedDashpot, AtRandomPhase>;

/// The wedge that moves with a drive D.
///
/// A disk that comes to rest on a moving wall does so by infinitely many impacts in finite time. The velocity floor ends
/// that: no impact leaves slower than `collision.minimum_normal_velocity`, and how many it concerned is an output. A
/// disk at rest is thus one that bounces by v^2 / (2 g); its friction and the force on the base are right in the mean.
pub type EventDriven<D> = DiskInWedge<VelocityFloor<TabulatedDashpot>, D>;

/// The impact law of a disk of unit mass at a wall, which depends on e_n, kappa and mu alone.
fn law(values: &Values) -> Result<TabulatedDashpot> {
    Ok(TabulatedDashpot::new(dashpot(values)?, &[1.0], 0.5))
}

fn dashpot(values: &Values) -> Result<Dashpot> {
    let ratio = LinearDashpot::damping_ratio_for(values.real("collision.restitution"));
    let (kappa, friction) = (values.real("contact.stiffness_ratio"), values.real("contact.friction"));
    Ok(Dashpot::of_damping_ratio(1.0, ratio, 1.0, kappa, friction)?)
}

/// Takes over gravity; its value is that of a flight from `time` \[s\] on.
fn tune_gravity<L: CollisionLaw, B: BaseMotion>(engine: &mut DiskInWedge<L, B>, time: f64, values: &Values) {
    let gravity = values.real("gravity");
    if gravity != engine.setup().gravity {
        engine.set_gravity(time, gravity);
    }
}

fn setup(values: &Values, slow: f64) -> WedgeSetup {
    WedgeSetup {
        frame: rows::frame(values),
        radius: values.real("disk.radius"),
        gravity: values.real("gravity"),
        slow,
    }
}

fn restitution<M>() -> Row<M> {
    Row::parameter(
        "collision.restitution",
        Unit::ONE,
        0.01..=1.0,
        0.9,
        "Coefficient of normal restitution e_n",
    )
    .tunable()
    // Below, a disk stops in its first impacts and is carried by the base, which the map does not know at all.
    .recommended(
        0.1..=1.0,
        "the disk loses nearly all in one impact and lies on the wall between throws.",
    )
}

/// The rows of a drive, whose base should throw the disk.
fn shaken<M>(rows: Vec<Row<M>>, least: f64) -> Vec<Row<M>> {
    let reason = "the base hardly throws the disk: the map knows no disk that is carried, and the moving wedge lets it hop at the floor of \
                  velocity.";
    let row = |row| recommended::shaken_enough(row, least, reason);
    rows.into_iter().map(row).collect()
}

fn collisions<M>(read: fn(&M) -> i64) -> Row<M> {
    let description = "Collisions since the start; stops counting at 2147483647";
    Row::count_output("collisions", description, read)
}

fn counted(count: u64) -> i64 {
    count.min(i32::MAX as u64) as i64
}

fn refused_step(stop: WedgeStop, remedy: &str) -> Error {
    let Stuck {
        time,
        side,
        along,
        collisions,
    } = match stop {
        WedgeStop::Stuck(stuck) => stuck,
        WedgeStop::TooManyImpacts { time, most } => {
            let reason = "A disk that hardly leaves its wall collides again and again.";
            return work_limit::refusal(NAME, time, &format!("more than {most} collisions"), reason);
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
        model: NAME,
        time,
        what,
        remedy: remedy.into(),
    }
}

/// What both engines do alike.
macro_rules! observations {
    () => {
        fn disk_at(&self, time: f64) -> DiskMotion {
            self.sample_at(time)
        }

        fn base_at(&self, time: f64) -> Motion {
            self.base(time)
        }

        fn energies_at(&self, time: f64) -> SpecificEnergies {
            let (motion, sums, setup) = (self.sample_at(time), self.state().sums, self.setup());
            let surface_velocity = setup.radius * motion.angular_velocity;
            SpecificEnergies {
                kinetic: 0.5 * (motion.velocity.norm_squared() + 0.5 * surface_velocity * surface_velocity),
                potential: setup.gravity * motion.position.y,
                input: sums.input,
                lost: sums.lost,
            }
        }

        fn impulse(&self) -> f64 {
            self.state().sums.velocity
        }
    };
}

impl WedgeEngine for Map {
    const NAME: &'static str = "map";
    const DRIVE: &'static str = <Sine as BaseDrive>::NAME;
    const IDENTIFIER: &'static str = "jostle_wedge_map";
    const DESCRIPTION: &'static str =
        "Disk that bounces in a wedge, by the map of its impacts with a random phase of the base";
    /// The walls rest.
    const AT_START: AtStart = AtStart {
        place: &["seed"],
        displacement: &[],
        velocity: &[],
        acceleration: &[],
    };

    fn contact_rows<M>() -> Vec<Row<M>> {
        vec![restitution()]
    }

    /// The phase is random. Any amplitude goes: the walls rest, and only A omega_b counts.
    fn drive_rows<M>() -> Vec<Row<M>> {
        let mut rows = <Sine as BaseDrive>::rows();
        rows.retain(|Row { variable, .. }| variable.name != "drive.phase");
        rows::exclude_rest(&mut rows);
        for Row { variable, .. } in &mut rows {
            if let ("drive.amplitude", Kind::Real(quantity)) = (variable.name.as_str(), &mut variable.kind) {
                quantity.max = 1e4;
            }
        }
        rows.push(random_phase_base::profile_parameter());
        shaken(rows, 0.99)
    }

    fn own_outputs<M: AsRef<Self>>() -> Vec<Row<M>> {
        let [draws, rejected] = random_phase_base::DRAW_COUNTS;
        vec![
            collisions(|scene: &M| counted(scene.as_ref().state().sums.collisions)),
            Row::count_output(draws.0, draws.1, |scene: &M| {
                counted(scene.as_ref().state().walls.counts.draws)
            }),
            Row::count_output(rejected.0, rejected.1, |scene: &M| {
                counted(scene.as_ref().state().walls.counts.rejected)
            }),
        ]
    }

    fn from_values(start_time: f64, values: &Values) -> Result<Self> {
        let profile = random_phase_base::profile(values);
        if profile == BaseProfile::Sawtooth {
            rows::check_no_overhang(values)?;
        }
        let amplitude = values.real("drive.amplitude");
        let mut generator = Pcg64::seed_from_u64(values.integer("seed") as u64);
        let (height, sideways) = rows::throw(values, &mut generator);
        let phase = RandomPhase {
            peak_velocity: TAU * values.real("drive.frequency") * amplitude,
        };
        let (setup, walls) = (
            setup(values, 0.0),
            AtRandomPhase::new(phase, generator).with_profile(profile),
        );
        let start = Start {
            time: start_time,
            height,
            sideways,
        };
        Ok(Self::new(setup, law(values)?, walls, start))
    }

    fn tune(&mut self, time: f64, values: &Values) -> Result<()> {
        if dashpot(values)? != *self.law().law() {
            self.set_law(law(values)?);
        }
        tune_gravity(self, time, values);
        Ok(())
    }

    fn set_target(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn refused_step(stop: WedgeStop) -> Error {
        refused_step(stop, "Raise collision.restitution or drive.amplitude.")
    }

    observations!();
}

const FLOOR: &str = "collision.minimum_normal_velocity";

impl<D: BaseDrive + FirstHit> WedgeEngine for EventDriven<D> {
    const NAME: &'static str = "event-driven";
    const DRIVE: &'static str = D::NAME;
    const IDENTIFIER: &'static str = "jostle_wedge_event_driven";
    const DESCRIPTION: &'static str = "Disk that bounces in a vibrating wedge, exactly from impact to impact";
    const INPUT_PARTS: u32 = D::INPUT_PARTS;
    const AT_START: AtStart = AtStart {
        place: &["seed"],
        displacement: D::DISPLACEMENT_AT_START,
        velocity: D::VELOCITY_AT_START,
        acceleration: D::ACCELERATION_AT_START,
    };

    fn contact_rows<M>() -> Vec<Row<M>> {
        let floor = "Smallest normal velocity with which a collision leaves the wall: ends the infinitely many collisions \
                     of a disk that comes to rest";
        vec![
            restitution(),
            // The base moves at 39 mm/s with the start values; at 1 um/s a disk at rest collides some million times a second.
            Row::parameter(FLOOR, Unit::METRE_PER_SECOND, 0.0..=1e3, 1e-4, floor).recommended(
                1e-6..=5e-3,
                "a smaller floor makes a disk at rest collide so often that steps are refused; a larger one throws it up by itself.",
            ),
        ]
    }

    fn drive_rows<M>() -> Vec<Row<M>> {
        shaken(rows::drive::<M, D>(), 1.1)
    }

    fn own_outputs<M: AsRef<Self>>() -> Vec<Row<M>> {
        let slow = "Collisions among them that left the wall at collision.minimum_normal_velocity";
        vec![
            collisions(|scene: &M| counted(scene.as_ref().state().sums.collisions)),
            Row::count_output("slow_collisions", slow, |scene: &M| {
                counted(scene.as_ref().state().sums.slow_collisions)
            }),
        ]
    }

    fn from_values(start_time: f64, values: &Values) -> Result<Self> {
        let mut generator = Pcg64::seed_from_u64(values.integer("seed") as u64);
        let (height, sideways) = rows::throw(values, &mut generator);
        let floor = values.real(FLOOR);
        let law = VelocityFloor::new(law(values)?, floor)?;
        let (setup, walls) = (setup(values, floor), D::new(start_time, values)?);
        let start = Start {
            time: start_time,
            height,
            sideways,
        };
        Ok(Self::new(setup, law, walls, start))
    }

    fn tune(&mut self, time: f64, values: &Values) -> Result<()> {
        if dashpot(values)? != *self.law().law().law() {
            self.set_law(VelocityFloor::new(law(values)?, values.real(FLOOR))?);
        }
        tune_gravity(self, time, values);
        Ok(())
    }

    fn set_target(&mut self, time: f64, duration: f64, values: &Values) {
        if D::STEERED {
            self.steer(time, |walls| walls.set_target(time, duration, values));
        }
    }

    fn warning(&self, told: &[&'static str]) -> Option<Warning> {
        self.state().walls.warning(told)
    }

    fn refused_step(stop: WedgeStop) -> Error {
        let remedy = format!("Inelastic collapse? Raise {FLOOR} or collision.restitution.");
        refused_step(stop, &remedy)
    }

    observations!();
}
