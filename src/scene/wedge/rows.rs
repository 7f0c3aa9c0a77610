//! Parameters of the wedge scene, and what several engines compute from them.

use std::f64::consts::{FRAC_PI_2, TAU};

use rand::Rng;

use crate::engine::wedge::WedgeFrame;
use crate::scene::base_drive::BaseDrive;
use crate::scene::info::GRAVITY;
use crate::scene::random_phase_base::PROFILE;
use crate::scene::{Error, Kind, Result, Row, Unit, Values, recommended, work_limit};

/// Largest aperture \[rad\]: a little more than 179.9 degrees. Not a rounded pi.
#[allow(clippy::approx_constant)]
const WIDEST: f64 = 3.14;

/// Smallest amplitude \[m\] and frequency \[Hz\] of a base.
const SMALLEST: f64 = 1e-12;

/// Name of the scene.
pub const NAME: &str = "wedge";

const BASE_SPEED: &str = "measure.base_velocity";

/// Rows of a drive. Where inputs move the base, its largest velocity is a parameter.
pub fn drive<M, D: BaseDrive>() -> Vec<Row<M>> {
    let mut rows = D::rows();
    exclude_rest(&mut rows);
    if D::STEERED {
        rows.push(Row::parameter(
            BASE_SPEED,
            Unit::METRE_PER_SECOND,
            1e-9..=1e3,
            0.04,
            "Velocity of the base A omega_b by which scaled_angular_velocity is scaled",
        ));
    }
    rows
}

/// Leaves the base at rest out of the range of a sine: nothing moves then, and scaled_angular_velocity divides by its velocity.
pub fn exclude_rest<M>(rows: &mut [Row<M>]) {
    for Row { variable, .. } in rows {
        if let ("drive.amplitude" | "drive.frequency", Kind::Real(quantity)) =
            (variable.name.as_str(), &mut variable.kind)
        {
            quantity.min = SMALLEST;
        }
    }
}

/// Wedge, disk and measurement.
pub fn geometry<M>() -> Vec<Row<M>> {
    vec![
        Row::parameter("gravity", Unit::METRE_PER_SECOND_SQUARED, 1e-3..=1e4, 9.81, GRAVITY).tunable(),
        Row::long_parameter(
            "seed",
            0..=i64::MAX,
            1,
            "Seed of the disk's first sideways velocity and, in the map, of the phases of the base",
        ),
        Row::parameter(
            "wedge.aperture",
            Unit::RADIAN,
            1.047..=WIDEST,
            2.0944,
            "Angle theta_W between the walls",
        )
        // P 6: 90 to 179 degrees. In a narrower wedge walls hang over when it is tilted; a flatter one is a floor.
        .recommended(
            1.57..=3.13,
            "the model was compared with P from 90 to 179 degrees; walls of narrower wedges hang over at large tilts, flatter ones \
             hardly hold a disk.",
        ),
        Row::parameter(
            "wedge.tilt",
            Unit::RADIAN,
            -FRAC_PI_2..=FRAC_PI_2,
            0.1745,
            "Angle theta_T of the bisector to the vertical, counter-clockwise; smaller than (pi - theta_W)/2, where one wall is horizontal",
        ),
        Row::parameter("disk.radius", Unit::METRE, 1e-6..=1e3, 0.02, "Radius R of the disk"),
        Row::parameter("disk.mass", Unit::KILOGRAM, 1e-12..=1e6, 4.5e-3, "Mass m of the disk"),
        Row::parameter(
            "disk.drop_height",
            Unit::METRE,
            1e-9..=1e3,
            1e-3,
            "Height above its lowest place, up the bisector, from which the disk starts",
        ),
        Row::parameter(
            "measure.start",
            Unit::SECOND,
            0.0..=1e9,
            0.0,
            "Time from which on scaled_angular_velocity is averaged: leaves out how the disk started",
        ),
        work_limit::row(),
    ]
}

/// Parameters of friction, which every engine has.
pub fn friction<M>() -> Vec<Row<M>> {
    vec![
        Row::parameter(
            "contact.stiffness_ratio",
            Unit::ONE,
            0.0..=1e4,
            0.773,
            "Tangential over normal stiffness, kappa = k_t / k_n",
        )
        // From 1000 on the impact is that of Coulomb's law without a spring.
        .recommended(
            0.0..=1e3,
            "elastic bodies have 0.67 to 1; beyond 1000 the outcome of an impact no longer changes and only takes longer to compute.",
        ),
        recommended::friction(Row::parameter(
            "contact.friction",
            Unit::ONE,
            0.0..=1e3,
            0.1,
            "Friction coefficient mu",
        ))
        .tunable(),
    ]
}

/// Refuses what confines no disk.
pub fn check(values: &Values) -> Result<()> {
    let (aperture, tilt) = (values.real("wedge.aperture"), values.real("wedge.tilt"));
    let critical = WedgeFrame::critical_tilt(aperture);
    if tilt.abs() >= critical {
        return Err(Error::parameter(
            "wedge.tilt",
            Unit::RADIAN.format(tilt),
            format!(
                "between -{0} and {0}, which is (pi - wedge.aperture)/2 and excluded",
                Unit::RADIAN.format(critical)
            ),
            "At this tilt a wall is horizontal and the disk runs away: tilt less or take a smaller wedge.aperture.",
        ));
    }
    Ok(())
}

/// Refuses a wall that hangs over: a base that falls at once would hit from above with no velocity that exists.
pub fn check_no_overhang(values: &Values) -> Result<()> {
    let [left, right] = slopes(values);
    if left.max(right) <= FRAC_PI_2 {
        return Ok(());
    }
    let most = FRAC_PI_2 - WedgeFrame::critical_tilt(values.real("wedge.aperture"));
    Err(Error::parameter(
        PROFILE,
        "sawtooth",
        format!(
            "sine where a wall hangs over: with this wedge.aperture at a wedge.tilt beyond {}",
            Unit::RADIAN.format(most)
        ),
        "Tilt less, take a larger wedge.aperture, or base.profile sine.",
    ))
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
