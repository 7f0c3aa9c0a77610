//! Parameters of the scene without those of the drive, and what is refused among them.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

use crate::contact::ContactLaws;
use crate::elementary::sin_cos;
use crate::engine::disk_on_two_supports::{SupportFrame, TwoSupportsRig};
use crate::error::{Error, Result};
use crate::scene::info::GRAVITY;
use crate::scene::soft_disks::contact_laws;
use crate::scene::{Derived, Row, Unit, Values, recommended, work_limit};

/// Where `mu tan theta_0` passes 1 the admissible region of the tangential forces is unbounded (P 4.4).
const JAMMING: Derived = Derived {
    name: "friction coefficient times the tangent of support.angle",
    unit: Unit::ONE,
    value: |real| {
        let (sine, cosine) = sin_cos(real("support.angle"));
        real("contact.friction") * sine / cosine
    },
};

/// P 4.1, left and right.
const SHAPES: &[(&str, &str)] = &[
    ("disks", "Disks of the radius of the upper one"),
    ("walls", "Straight walls: a disk in a wedge"),
];

/// All rows; `tilt` is the start value of the parameter of that name \[rad\].
pub fn rows<M>(tilt: f64) -> Vec<Row<M>> {
    let mut rows = geometry(tilt);
    rows.extend(contact().into_iter().map(recommended::one_soft_disk));
    rows.extend(run());
    rows
}

fn geometry<M>(tilt: f64) -> Vec<Row<M>> {
    vec![
        Row::parameter("gravity", Unit::METRE_PER_SECOND_SQUARED, 1e-3..=1e4, 10.0, GRAVITY),
        Row::parameter(
            "tilt",
            Unit::RADIAN,
            -FRAC_PI_2..=FRAC_PI_2,
            tilt,
            "Angle theta_T by which the supports are turned counter-clockwise; smaller than support.angle",
        )
        .with_nominal(0.1),
        Row::parameter(
            "support.angle",
            Unit::RADIAN,
            1e-3..=FRAC_PI_2,
            FRAC_PI_6,
            "Half the angle between the contacts, theta_0; pi/6 for three disks that touch",
        ),
        Row::enumeration_parameter("support.shape", "support_shape", SHAPES, 1, "What the disk lies on"),
        Row::parameter("disk.radius", Unit::METRE, 1e-6..=1e3, 1.0, "Radius R of the disk"),
        Row::parameter("disk.mass", Unit::KILOGRAM, 1e-12..=1e6, 0.1, "Mass m of the disk"),
    ]
}

fn contact<M>() -> Vec<Row<M>> {
    vec![
        Row::parameter(
            "contact.normal_stiffness",
            Unit::NEWTON_PER_METRE,
            1e-3..=1e15,
            1e3,
            "Normal stiffness k_n of the contacts",
        ),
        Row::parameter(
            "contact.stiffness_ratio",
            Unit::ONE,
            1e-2..=1e6,
            1e3,
            "Tangential over normal stiffness, k_t / k_n",
        )
        // P 5 has 10 and 1000, so that springs yield less than overlaps; elastic bodies have 0.67 to 1.
        .recommended(
            0.1..=1e4,
            "softer springs let the disk roll far while it sticks; stiffer ones only make the time step small.",
        ),
        Row::parameter(
            "contact.normal_damping",
            Unit::KILOGRAM_PER_SECOND,
            0.0..=1e9,
            10.0,
            "Normal damping gamma_n of the contacts",
        ),
        Row::parameter(
            "contact.friction",
            Unit::ONE,
            0.0..=10.0,
            0.1,
            "Friction coefficient mu",
        )
        .recommended_by(
            JAMMING,
            0.0..=1.0,
            "the supports jam the disk, and the theory of sliding does not hold. Lower the friction or support.angle.",
        ),
    ]
}

fn run<M>() -> Vec<Row<M>> {
    vec![
        Row::parameter(
            "disk.drop_height",
            Unit::METRE,
            0.0..=1e3,
            0.0,
            "Height above its rest from which the disk starts; 0 starts at rest in equilibrium, the tangential springs not stretched",
        )
        .with_nominal(1e-3),
        Row::parameter(
            "disk.initial_angular_velocity",
            Unit::RADIAN_PER_SECOND,
            -1e6..=1e6,
            0.0,
            "Angular velocity with which the disk starts, counter-clockwise",
        ),
        Row::parameter(
            "measure.start",
            Unit::SECOND,
            0.0..=1e9,
            0.0,
            "Time from which on means, times, counts and the sliding regime are taken",
        ),
        Row::parameter(
            "time_step",
            Unit::SECOND,
            0.0..=1.0,
            0.0,
            "Time step of the integration; 0: half a radian of the fastest mode",
        )
        .with_nominal(1e-5),
        work_limit::row(),
    ]
}

/// The disk on its supports.
///
/// # Errors
/// Supports that do not confine the disk or overlap each other.
pub fn rig(values: &Values) -> Result<TwoSupportsRig> {
    let (opening, tilt, radius) = (
        values.real("support.angle"),
        values.real("tilt"),
        values.real("disk.radius"),
    );
    let disks = values.integer("support.shape") == 1;
    if disks && opening < FRAC_PI_6 * (1.0 - 1e-12) {
        return Err(Error::parameter(
            "support.angle",
            Unit::RADIAN.format(opening),
            format!("at least pi/6 = {FRAC_PI_6} rad between disks"),
            "The supporting disks would overlap: open them or take support.shape walls.",
        ));
    }
    if tilt.abs() >= opening {
        return Err(Error::parameter(
            "tilt",
            Unit::RADIAN.format(tilt),
            format!(
                "between -{0} and {0}, which is support.angle and excluded",
                Unit::RADIAN.format(opening)
            ),
            "At this tilt nothing holds the disk on one side: tilt less or raise support.angle.",
        ));
    }
    let ContactLaws { normal, tangential } = contact_laws(values);
    Ok(TwoSupportsRig {
        radius,
        mass: values.real("disk.mass"),
        gravity: values.real("gravity"),
        normal,
        tangential,
        frames: [SupportFrame::new(tilt - opening), SupportFrame::new(opening + tilt)],
        curvature: if disks { 0.5 / radius } else { 0.0 },
    })
}
