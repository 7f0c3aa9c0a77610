//! Parameters and inputs of the ratchet.

use crate::scene::base_drive::BaseDrive;
use crate::scene::info::GRAVITY;
use crate::scene::{Derived, Kind, Row, Unit, recommended, work_limit};

const STEEPNESS: Derived = Derived {
    name: "height of a tooth over its width",
    unit: Unit::ONE,
    value: |real| real("tooth.height") / real("tooth.width"),
};

const SHARPNESS: Derived = Derived {
    name: "tip radius over the width of a tooth",
    unit: Unit::ONE,
    value: |real| real("tooth.tip_radius") / real("tooth.width"),
};

/// Value of `disk.mass_rule` for equal masses; the other is equal density.
pub const EQUAL_MASS: i64 = 1;

/// All parameters and inputs, with those of the drive D.
pub fn rows<D: BaseDrive, M>() -> Vec<Row<M>> {
    let mut rows = general();
    rows.extend(teeth());
    rows.extend(disks());
    // Threshold of F: nothing is thrown off a base that accelerates less than gravity.
    let shaken = |row| {
        recommended::shaken_enough(
            row,
            0.9,
            "disks are not thrown up, and lie on the teeth without flowing.",
        )
    };
    rows.extend(D::rows().into_iter().map(with_start_values_of_the_paper).map(shaken));
    rows.push(Row::input(
        "measure.mark",
        Unit::SECOND,
        1.0,
        "The averages start anew at a communication point where this value has changed; any new value will do",
    ));
    rows
}

/// A row of the drive with the amplitude and frequency of F IV.
fn with_start_values_of_the_paper<M>(mut row: Row<M>) -> Row<M> {
    let changed = match row.variable.name.as_str() {
        "drive.amplitude" => Some((
            2e-3,
            "Amplitude A of the base, y = A sin(2 pi f t + phase); the default is Gamma = 5 at 25 Hz",
        )),
        "drive.frequency" => Some((25.0, "Frequency f of the base")),
        _ => None,
    };
    if let (Some((start, description)), Kind::Real(quantity)) = (changed, &mut row.variable.kind) {
        (quantity.start, quantity.nominal) = (start, start);
        row.variable.description = description.into();
    }
    row
}

fn general<M>() -> Vec<Row<M>> {
    vec![
        Row::parameter("gravity", Unit::METRE_PER_SECOND_SQUARED, 1e-6..=1e4, 9.81, GRAVITY).tunable(),
        Row::long_parameter("seed", 0..=i64::MAX, 1, "Seed of the radii and the places at the start"),
        Row::parameter(
            "cell.height",
            Unit::METRE,
            1e-6..=1e3,
            0.6,
            "Height of the ceiling above the valleys of the base at rest",
        ),
        Row::parameter(
            "measure.start",
            Unit::SECOND,
            0.0..=1e9,
            0.0,
            "Time from which transport_velocity and what belongs to it are averaged at first",
        ),
        Row::parameter(
            "collision.restitution",
            Unit::ONE,
            0.0..=1.0,
            0.8,
            "Normal restitution of every impact",
        )
        .tunable()
        // Above, a vibrated base heats disks without bound; below, clusters collapse and the floor of velocity decides the run.
        .recommended(
            0.3..=0.98,
            "nearly elastic disks are thrown ever higher by the base; very lossy ones collapse into clusters that the floor of \
             velocity keeps apart.",
        ),
        recommended::friction(Row::parameter(
            "collision.friction",
            Unit::ONE,
            0.0..=1e6,
            0.1,
            "Friction coefficient of every impact",
        ))
        .tunable(),
        Row::parameter(
            "collision.minimum_normal_velocity",
            Unit::METRE_PER_SECOND,
            0.0..=1e3,
            5e-3,
            "No impact leaves slower than this along the normal: ends inelastic collapse",
        )
        .tunable()
        // The base of F moves at 0.31 m/s. At 0.1 mm/s a disk at rest collides every 20 us.
        .recommended(
            1e-4..=0.03,
            "a smaller floor makes disks at rest collide so often that steps are refused; a larger one feeds as much energy as the base.",
        ),
        work_limit::row(),
    ]
}

fn teeth<M>() -> Vec<Row<M>> {
    vec![
        Row::parameter("tooth.width", Unit::METRE, 1e-6..=1e3, 6e-3, "Width of a tooth"),
        Row::parameter(
            "tooth.height",
            Unit::METRE,
            0.0..=1e3,
            6e-3,
            "Height of the sharp apex, before rounding; 0 is flat",
        )
        .recommended_by(
            STEEPNESS,
            0.0..=4.0,
            "disks are caught in gaps between teeth that are deeper than wide by so much.",
        ),
        Row::parameter(
            "tooth.asymmetry",
            Unit::ONE,
            0.0..=1.0,
            0.25,
            "Horizontal extent of the left side over the width: 0 a vertical left side, 1 a vertical right side",
        ),
        Row::parameter(
            "tooth.tip_radius",
            Unit::METRE,
            0.0..=1e3,
            4e-4,
            "Radius of the arc that rounds the tip",
        )
        .recommended_by(
            SHARPNESS,
            5e-3..=0.2,
            "no machined tip is sharper, and the velocity depends on it; a blunter one leaves little of the sides.",
        ),
        Row::long_parameter("tooth.count", 1..=1_000_000, 10, "Teeth in the periodic cell"),
    ]
}

fn disks<M>() -> Vec<Row<M>> {
    const OPTIONS: &[(&str, &str)] = &[
        ("equal_mass", "All disks have the mass disk.mass"),
        (
            "equal_density",
            "Masses go with the area; a disk of the mean of the two radii has the mass disk.mass",
        ),
    ];
    vec![
        Row::parameter(
            "disk.radius_min",
            Unit::METRE,
            1e-6..=1e3,
            1.05e-3,
            "Smallest radius; radii are drawn evenly",
        ),
        Row::parameter("disk.radius_max", Unit::METRE, 1e-6..=1e3, 1.155e-3, "Largest radius"),
        Row::parameter("disk.mass", Unit::KILOGRAM, 1e-12..=1e6, 1e-5, "Mass of a disk"),
        Row::enumeration_parameter(
            "disk.mass_rule",
            "mass_rule",
            OPTIONS,
            EQUAL_MASS,
            "How masses go with radii",
        ),
        Row::parameter(
            "disk.inertia_factor",
            Unit::ONE,
            1e-3..=1.0,
            0.5,
            "Moment of inertia over mass times radius squared: 0.5 a disk, 0.4 a ball",
        ),
    ]
}
