//! The variables of the wedge scene, and what several engines read from them.

use std::f64::consts::{FRAC_PI_2, TAU};

use rand::Rng;

use crate::engine::wedge::WedgeFrame;
use crate::error::{Error, Result};
use crate::scene::base_drive::BaseDrive;
use crate::scene::{Unit, Values, Variable};

/// Largest aperture \[rad\]: a little more than 179.9 degrees. Not a rounded pi.
#[allow(clippy::approx_constant)]
const WIDEST: f64 = 3.14;

const BASE_SPEED: &str = "measure.base_velocity";

/// All rows: those of every engine with the engine's own parameters, drive and counts.
pub fn rows(contact: Vec<Variable>, drive: Vec<Variable>, counts: Vec<Variable>) -> Vec<Variable> {
    let mut rows = geometry();
    rows.extend(contact);
    rows.extend(friction());
    rows.extend(drive);
    rows.extend(outputs(counts));
    rows
}

/// Rows of a drive. Where inputs move the base, nobody knows its largest velocity: it is told.
pub fn drive<D: BaseDrive>() -> Vec<Variable> {
    let mut rows = D::variables();
    if D::STEERED {
        rows.push(Variable::parameter(
            BASE_SPEED,
            Unit::MetrePerSecond,
            1e-9..=1e3,
            0.04,
            "Velocity of the base A omega_b by which scaled_angular_velocity is scaled",
        ));
    }
    rows
}

#[allow(clippy::approx_constant)] // 3.14 rad is 179.9 degrees: a bound just below pi
fn geometry() -> Vec<Variable> {
    vec![
        Variable::parameter(
            "gravity",
            Unit::MetrePerSecondSquared,
            1e-3..=1e4,
            9.81,
            "Gravity, downwards",
        ),
        Variable::long_parameter(
            "seed",
            0..=i64::MAX,
            1,
            "Seed of the disk's first sideways velocity and, in the map, of the phases of the base",
        ),
        Variable::parameter(
            "wedge.aperture",
            Unit::Radian,
            1.047..=WIDEST,
            2.0944,
            "Angle theta_W between the walls",
        ),
        Variable::parameter(
            "wedge.tilt",
            Unit::Radian,
            -FRAC_PI_2..=FRAC_PI_2,
            0.1745,
            "Angle theta_T of the bisector to the vertical, counter-clockwise; smaller than (pi - theta_W)/2, where one wall is horizontal",
        ),
        Variable::parameter("disk.radius", Unit::Metre, 1e-6..=1e3, 0.02, "Radius R of the disk"),
        Variable::parameter("disk.mass", Unit::Kilogram, 1e-12..=1e6, 4.5e-3, "Mass m of the disk"),
        Variable::parameter(
            "disk.drop_height",
            Unit::Metre,
            1e-9..=1e3,
            1e-3,
            "Height above its lowest place, up the bisector, from which the disk starts",
        ),
        Variable::parameter(
            "measure.start",
            Unit::Second,
            0.0..=1e9,
            0.0,
            "Time from which on scaled_angular_velocity is averaged: leaves out how the disk started",
        ),
    ]
}

fn friction() -> Vec<Variable> {
    vec![
        Variable::parameter(
            "contact.stiffness_ratio",
            Unit::One,
            0.0..=1e4,
            0.773,
            "Tangential over normal stiffness, kappa = k_t / k_n",
        ),
        Variable::parameter("contact.friction", Unit::One, 0.0..=1e3, 0.1, "Friction coefficient mu"),
    ]
}

fn outputs(counts: Vec<Variable>) -> Vec<Variable> {
    let energy = |name: &str, description: &str| Variable::output(name, Unit::Joule, 1e-6, description);
    let mut rows = vec![
        Variable::output(
            "mean_velocity",
            Unit::MetrePerSecond,
            0.1,
            "Horizontal velocity of the disk now",
        ),
        Variable::output(
            "mean_angular_velocity",
            Unit::RadianPerSecond,
            1.0,
            "Angular velocity of the disk now, counter-clockwise",
        ),
        Variable::output(
            "scaled_angular_velocity",
            Unit::One,
            0.01,
            "Mean angular velocity since measure.start, scaled: R omega / (A omega_b)",
        ),
        Variable::output(
            "scaled_angular_velocity.standard_error",
            Unit::One,
            0.01,
            "Standard error of scaled_angular_velocity by batch means; 0 until there are eight batches",
        ),
        Variable::output(
            "base.reaction_force",
            Unit::Newton,
            0.1,
            "Vertical force of the disk on the base, up: impulse over the last communication step divided by its length",
        ),
        Variable::output(
            "base.position",
            Unit::Metre,
            1e-3,
            "Displacement of the base now, up; the map holds it at 0",
        ),
        Variable::output(
            "base.acceleration",
            Unit::MetrePerSecondSquared,
            10.0,
            "Acceleration of the base now, up; the map holds it at 0",
        ),
        energy("energy.kinetic", "Kinetic energy of translation and rotation"),
        energy(
            "energy.potential",
            "Energy in gravity, zero at the height of the vertex with the base at rest",
        ),
        energy("energy.input", "Work done by the base on the disk since the start"),
        energy("energy.lost", "Energy lost in collisions since the start"),
    ];
    rows.extend(counts);
    rows.extend([
        Variable::output(
            "disk.angle[1]",
            Unit::Radian,
            1.0,
            "Angle turned, counter-clockwise and unwrapped",
        ),
        Variable::output(
            "disk.angular_velocity[1]",
            Unit::RadianPerSecond,
            1.0,
            "Angular velocity, counter-clockwise",
        ),
        Variable::output(
            "disk.x[1]",
            Unit::Metre,
            0.01,
            "Distance of the centre to the right of the wedge's vertex",
        ),
        Variable::output(
            "disk.y[1]",
            Unit::Metre,
            0.01,
            "Height of the centre above the wedge's vertex with the base at rest",
        ),
    ]);
    rows
}

/// Refuses what confines no disk and what no angular velocity can be scaled by.
pub fn check(values: &Values) -> Result<()> {
    let (aperture, tilt) = (values.real("wedge.aperture"), values.real("wedge.tilt"));
    let critical = WedgeFrame::critical_tilt(aperture);
    if tilt.abs() >= critical {
        return Err(Error::parameter(
            "wedge.tilt",
            format!("{tilt} rad"),
            format!("between -{critical} and {critical} rad, which is (pi - wedge.aperture)/2 and excluded"),
            "At this tilt a wall is horizontal and the disk runs away: tilt less or take a smaller wedge.aperture.",
        ));
    }
    for name in ["drive.amplitude", "drive.frequency"] {
        if values.table().position(name).is_some() && values.real(name) == 0.0 {
            return Err(Error::parameter(
                name,
                0,
                "above 0 in a wedge",
                "Without it nothing moves, and scaled_angular_velocity divides by it.",
            ));
        }
    }
    Ok(())
}

/// Largest velocity of the base, A omega_b \[m/s\].
pub fn base_speed(values: &Values) -> f64 {
    if values.table().position(BASE_SPEED).is_some() {
        return values.real(BASE_SPEED);
    }
    TAU * values.real("drive.frequency") * values.real("drive.amplitude")
}

/// The wedge.
pub fn frame(values: &Values) -> WedgeFrame {
    WedgeFrame::new(values.real("wedge.aperture"), values.real("wedge.tilt"))
}

/// Slopes alpha_1, alpha_2 of the left and the right wall \[rad\].
pub fn slopes(values: &Values) -> [f64; 2] {
    let critical = WedgeFrame::critical_tilt(values.real("wedge.aperture"));
    let tilt = values.real("wedge.tilt");
    [critical - tilt, critical + tilt]
}

/// Height up the bisector \[m\] and velocity across it \[m/s\] with which the disk starts.
///
/// The velocity is random, up to half of what the fall through the height gives: a disk that falls along the bisector
/// would meet both walls at once.
pub fn throw(values: &Values, generator: &mut impl Rng) -> (f64, f64) {
    let height = values.real("disk.drop_height");
    let even = (generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    (height, (even - 0.5) * (2.0 * values.real("gravity") * height).sqrt())
}
