//! Recommended ranges that rows of several scenes share: quantities that parameters make together, and why they are bounded.
//!
//! The bounds are orders of magnitude. Each reason is what a user reads in the warning and on the page.

use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

use fmi_component::Derived;

use super::{Row, Unit};

/// How a row gets the values of other rows.
type Real<'a> = &'a dyn Fn(&str) -> f64;

/// Dry friction of solids is 0.05 to 1, that of rubber up to 1.5.
pub const FRICTION: (RangeInclusive<f64>, &str) = (
    0.0..=1.5,
    "dry solids have 0.05 to 1, rubber up to 1.5; more only glues surfaces together.",
);

/// From an overlap of 1 % of the radius on, a disk in a deep packing, with tens of others above, is pressed flat.
const MOST_OVERLAP_UNDER_WEIGHT: f64 = 1e-2;
/// An impact is a linear contact of two disks while its overlap is some per cent of the radius.
const MOST_OVERLAP_OF_IMPACT: f64 = 0.05;
/// At 1 the contacts would be in resonance with the base.
const MOST_PERIODS_OF_CONTACT: f64 = 0.5;
/// Twice critical: a disk leaves an impact with 1 % of its velocity, and the dashpot is all that acts.
const MOST_DAMPING_RATIO: f64 = 2.0;

const UNDER_WEIGHT: &str = "contacts stand for small deformations; where a disk sinks in under its own weight, the layers above press \
    it in by a multiple. Raise the stiffness.";
const OF_IMPACT: &str = "contacts stand for small deformations; an impact at this velocity sinks in deeply, and steps may be refused. \
    Raise contact.normal_stiffness or shake less.";
const OF_PERIODS: &str = "the base moves as fast as a contact springs back: the result is that of the spring, not of the impacts. Raise \
    contact.normal_stiffness or lower the frequency.";
const OF_DAMPING: &str = "beyond twice the critical damping nothing leaves an impact, and the time step grows small.";

/// A row with the recommended range of friction coefficients.
pub fn friction<M>(row: Row<M>) -> Row<M> {
    let (range, reason) = FRICTION;
    row.recommended(range, reason)
}

/// Mass of the lightest disk of a packing: masses go with areas.
fn smallest_mass(real: Real) -> f64 {
    let radii = ["disk.radius_small", "disk.radius_medium", "disk.radius_large"].map(real);
    let radius = radii.into_iter().fold(f64::INFINITY, f64::min);
    real("disk.surface_density") * PI * radius * radius
}

fn base_speed(real: Real) -> f64 {
    real("drive.amplitude") * TAU * real("drive.frequency")
}

/// Peak acceleration of a sine over gravity.
pub const GAMMA: Derived = Derived {
    name: "peak acceleration of the base over gravity",
    unit: Unit::ONE,
    value: |real| base_speed(real) * TAU * real("drive.frequency") / real("gravity"),
};

/// Parameters of soft contacts, of the packing: of its largest disk under weight, of its two smallest in impacts.
pub fn soft_packing<M>(row: Row<M>) -> Row<M> {
    const WEIGHT: Derived = Derived {
        name: "overlap of the largest disk under its weight over its radius",
        unit: Unit::ONE,
        value: |real| {
            let radii = ["disk.radius_small", "disk.radius_medium", "disk.radius_large"].map(real);
            let largest = radii.into_iter().fold(0.0, f64::max);
            real("disk.surface_density") * PI * largest * real("gravity") / real("contact.normal_stiffness")
        },
    };
    // v sqrt(m / k) / R, from which R goes out.
    const IMPACT: Derived = Derived {
        name: "overlap of an impact at the velocity of the base over the radius",
        unit: Unit::ONE,
        value: |real| base_speed(real) * (PI * real("disk.surface_density") / real("contact.normal_stiffness")).sqrt(),
    };
    const RANDOM_IMPACT: Derived = Derived {
        name: "overlap of an impact at the velocity of the bottom row over the radius",
        unit: Unit::ONE,
        value: |real| {
            let speed = real("bottom.radius") * real("bottom.angular_frequency");
            speed * (PI * real("disk.surface_density") / real("contact.normal_stiffness")).sqrt()
        },
    };
    const PERIODS: Derived = Derived {
        name: "shortest period of a contact over that of the base",
        unit: Unit::ONE,
        value: |real| {
            let mass = 0.5 * smallest_mass(real);
            real("drive.frequency") * TAU * (mass / real("contact.normal_stiffness")).sqrt()
        },
    };
    match row.variable.name.as_str() {
        "contact.normal_stiffness" => row.recommended_by(WEIGHT, 0.0..=MOST_OVERLAP_UNDER_WEIGHT, UNDER_WEIGHT),
        "drive.amplitude" => row.recommended_by(IMPACT, 0.0..=MOST_OVERLAP_OF_IMPACT, OF_IMPACT),
        "drive.frequency" => row.recommended_by(PERIODS, 0.0..=MOST_PERIODS_OF_CONTACT, OF_PERIODS),
        "bottom.radius" => row.recommended_by(RANDOM_IMPACT, 0.0..=MOST_OVERLAP_OF_IMPACT, OF_IMPACT),
        _ => row,
    }
}

/// Damping of the packing, soft or hard.
pub fn packing_damping<M>(row: Row<M>) -> Row<M> {
    const RATIO: Derived = Derived {
        name: "damping ratio of the two smallest disks",
        unit: Unit::ONE,
        value: |real| {
            let mass = 0.5 * smallest_mass(real);
            real("contact.normal_damping") / (2.0 * (real("contact.normal_stiffness") * mass).sqrt())
        },
    };
    row.recommended_by(RATIO, 0.0..=MOST_DAMPING_RATIO, OF_DAMPING)
}

/// Parameters of one soft disk of mass `disk.mass` and radius `disk.radius` on walls.
pub fn one_soft_disk<M>(row: Row<M>) -> Row<M> {
    const WEIGHT: Derived = Derived {
        name: "overlap of the disk under its weight over its radius",
        unit: Unit::ONE,
        value: |real| real("disk.mass") * real("gravity") / (real("contact.normal_stiffness") * real("disk.radius")),
    };
    const RATIO: Derived = Derived {
        name: "damping ratio of a contact",
        unit: Unit::ONE,
        value: |real| {
            real("contact.normal_damping") / (2.0 * (real("contact.normal_stiffness") * real("disk.mass")).sqrt())
        },
    };
    const IMPACT: Derived = Derived {
        name: "overlap of an impact at the velocity of the base over the radius",
        unit: Unit::ONE,
        value: |real| {
            base_speed(real) * (real("disk.mass") / real("contact.normal_stiffness")).sqrt() / real("disk.radius")
        },
    };
    const PERIODS: Derived = Derived {
        name: "period of a contact over that of the base",
        unit: Unit::ONE,
        value: |real| real("drive.frequency") * TAU * (real("disk.mass") / real("contact.normal_stiffness")).sqrt(),
    };
    match row.variable.name.as_str() {
        "contact.normal_stiffness" => row.recommended_by(WEIGHT, 0.0..=MOST_OVERLAP_UNDER_WEIGHT, UNDER_WEIGHT),
        "contact.normal_damping" => row.recommended_by(RATIO, 0.0..=MOST_DAMPING_RATIO, OF_DAMPING),
        "drive.amplitude" => row.recommended_by(IMPACT, 0.0..=MOST_OVERLAP_OF_IMPACT, OF_IMPACT),
        "drive.frequency" => row.recommended_by(PERIODS, 0.0..=MOST_PERIODS_OF_CONTACT, OF_PERIODS),
        _ => row,
    }
}

/// The amplitude of a sine under hard disks, from `least` times gravity on.
pub fn shaken_enough<M>(row: Row<M>, least: f64, reason: &'static str) -> Row<M> {
    match row.variable.name.as_str() {
        "drive.amplitude" => row.recommended_by(GAMMA, least..=f64::INFINITY, reason),
        _ => row,
    }
}
