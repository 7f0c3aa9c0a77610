//! The variables of the scene, and what is refused among its parameters.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

use crate::contact::{LinearDashpot, TangentialSpring};
use crate::engine::disk_on_two_supports::{Frame, Rig};
use crate::error::{Error, Result};
use crate::scene::{Unit, Values, Variable};

/// P 4.1, left and right.
const SHAPES: &[(&str, &str)] = &[
    ("disks", "Disks of the radius of the upper one"),
    ("walls", "Straight walls: a disk in a wedge"),
];

const CONTACT_STATES: &[(&str, &str)] = &[
    ("open", "No force acts"),
    ("stick", "The skin holds"),
    (
        "slip_counter_clockwise",
        "The skin slips as under a disk that turns counter-clockwise",
    ),
    ("slip_clockwise", "The skin slips as under a disk that turns clockwise"),
];

const REGIMES: &[(&str, &str)] = &[
    ("none", "Both contacts never slipped the same way at once"),
    ("unidirectional", "They did in one sense only"),
    ("bidirectional", "They did in both senses"),
];

/// All rows, with those of a drive.
pub fn rows(drive: Vec<Variable>, drive_outputs: Vec<Variable>) -> Vec<Variable> {
    let mut rows = geometry();
    rows.extend(contact());
    rows.extend(run());
    rows.extend(drive);
    rows.push(Variable::calculated(
        "chosen_time_step",
        Unit::Second,
        1e-5,
        "Time step of the integration in use",
    ));
    rows.extend(motion());
    rows.extend(drive_outputs);
    rows.extend(energies());
    rows.extend(skins());
    rows.extend(contacts());
    rows.extend(slides());
    rows.extend(disk());
    rows
}

fn geometry() -> Vec<Variable> {
    vec![
        Variable::parameter(
            "gravity",
            Unit::MetrePerSecondSquared,
            1e-3..=1e4,
            10.0,
            "Gravity, downwards",
        ),
        Variable::parameter(
            "tilt",
            Unit::Radian,
            -FRAC_PI_2..=FRAC_PI_2,
            0.0,
            "Angle theta_T by which the supports are turned counter-clockwise; smaller than support.angle",
        )
        .with_nominal(0.1),
        Variable::parameter(
            "support.angle",
            Unit::Radian,
            1e-3..=FRAC_PI_2,
            FRAC_PI_6,
            "Half the angle between the contacts, theta_0; pi/6 for three disks that touch",
        ),
        Variable::enumeration_parameter("support.shape", "support_shape", SHAPES, 1, "What the disk lies on"),
        Variable::parameter("disk.radius", Unit::Metre, 1e-6..=1e3, 1.0, "Radius R of the disk"),
        Variable::parameter("disk.mass", Unit::Kilogram, 1e-12..=1e6, 0.1, "Mass m of the disk"),
    ]
}

fn contact() -> Vec<Variable> {
    vec![
        Variable::parameter(
            "contact.normal_stiffness",
            Unit::NewtonPerMetre,
            1e-3..=1e15,
            1e3,
            "Normal stiffness k_n of the contacts",
        ),
        Variable::parameter(
            "contact.stiffness_ratio",
            Unit::One,
            1e-2..=1e6,
            1e3,
            "Tangential over normal stiffness, k_t / k_n",
        ),
        Variable::parameter(
            "contact.normal_damping",
            Unit::KilogramPerSecond,
            0.0..=1e9,
            10.0,
            "Normal damping gamma_n of the contacts",
        ),
        Variable::parameter(
            "contact.friction",
            Unit::One,
            0.0..=10.0,
            0.1,
            "Friction coefficient mu",
        ),
    ]
}

fn run() -> Vec<Variable> {
    vec![
        Variable::parameter(
            "disk.drop_height",
            Unit::Metre,
            0.0..=1e3,
            0.0,
            "Height above its rest from which the disk starts; 0 starts at rest in equilibrium, the skins not stretched",
        )
        .with_nominal(1e-3),
        Variable::parameter(
            "disk.initial_angular_velocity",
            Unit::RadianPerSecond,
            -1e6..=1e6,
            0.0,
            "Angular velocity with which the disk starts, counter-clockwise",
        ),
        Variable::parameter(
            "measure.start",
            Unit::Second,
            0.0..=1e9,
            0.0,
            "Time from which on means, times, counts and the sliding regime are taken",
        ),
        Variable::parameter(
            "time_step",
            Unit::Second,
            0.0..=1.0,
            0.0,
            "Time step of the integration; 0: half a radian of the fastest mode",
        )
        .with_nominal(1e-5),
    ]
}

fn motion() -> Vec<Variable> {
    vec![
        Variable::output(
            "mean_velocity",
            Unit::MetrePerSecond,
            0.01,
            "Horizontal velocity of the disk now",
        ),
        Variable::output(
            "mean_angular_velocity",
            Unit::RadianPerSecond,
            0.1,
            "Angular velocity of the disk now, counter-clockwise",
        ),
        Variable::output(
            "time_averaged_angular_velocity",
            Unit::RadianPerSecond,
            0.01,
            "Angular velocity, mean over the time since measure.start",
        ),
        Variable::output(
            "time_averaged_angular_velocity.standard_error",
            Unit::RadianPerSecond,
            0.01,
            "Its standard error by batch means; 0 until there are eight batches",
        ),
        Variable::output(
            "base.reaction_force",
            Unit::Newton,
            1.0,
            "Vertical force of the disk on both supports, up: impulse over the last communication step divided by its length",
        ),
    ]
}

fn energies() -> Vec<Variable> {
    let energy = |name: &str, description: &str| Variable::output(name, Unit::Joule, 1e-3, description);
    vec![
        energy("energy.kinetic", "Kinetic energy of translation and rotation"),
        energy(
            "energy.potential",
            "Energy in gravity, zero where the disk just touches both supports at rest",
        ),
        energy("energy.elastic", "Energy in the springs and skins of the contacts"),
        energy(
            "energy.input",
            "Work of torque and supports on the disk since the start",
        ),
        energy("energy.lost", "Energy lost in dashpots and by slip since the start"),
        energy(
            "energy.residual",
            "What the balance of energies misses: kinetic + potential + elastic + lost - input, less its value at the start",
        ),
    ]
}

fn skins() -> Vec<Variable> {
    vec![
        Variable::output(
            "skin.stretch",
            Unit::Radian,
            1e-7,
            "Stretch Theta of the skins against each other, (tau_2 - tau_1) / (2 k_t R)",
        ),
        Variable::output(
            "skin.departure",
            Unit::Radian,
            1e-7,
            "Departure delta_theta of the disk from its equilibrium angle, -(tau_2 + tau_1) / (2 k_t R)",
        ),
        Variable::output(
            "amonton_margin",
            Unit::Newton,
            0.1,
            "Distance to the nearest limit of friction: the smaller mu n - |tau| of both contacts",
        ),
    ]
}

fn contacts() -> Vec<Variable> {
    let mut rows = Vec::new();
    for (index, which) in [(1, "left"), (2, "right")] {
        let row = |name: &str, unit, nominal, what: &str| {
            let (name, what) = (
                format!("contact[{index}].{name}"),
                format!("{what} the {which} contact"),
            );
            Variable::output(name, unit, nominal, what)
        };
        rows.extend([
            row("normal_force", Unit::Newton, 1.0, "Normal force n at"),
            row(
                "tangential_force",
                Unit::Newton,
                0.1,
                "Tangential force tau on the disk, positive where it turns it counter-clockwise, at",
            ),
            row("overlap", Unit::Metre, 1e-3, "Overlap delta, negative while apart, at"),
            Variable::enumeration_output(
                format!("contact[{index}].state"),
                "contact_state",
                CONTACT_STATES,
                format!("What the {which} contact does"),
            ),
            row("slip_time", Unit::Second, 1.0, "Time since measure.start of slip at"),
            row(
                "open_time",
                Unit::Second,
                1.0,
                "Time since measure.start without force at",
            ),
        ]);
    }
    rows
}

fn slides() -> Vec<Variable> {
    let mut rows = vec![
        Variable::enumeration_output(
            "sliding_regime",
            "sliding_regime",
            REGIMES,
            "Senses in which the disk slid on both contacts since measure.start",
        ),
        Variable::count_output("slips", "Times that a skin began to slip since measure.start"),
        Variable::count_output("detachments", "Times that a contact opened since the start of the run"),
        Variable::output(
            "detachment.time",
            Unit::Second,
            1.0,
            "When a contact opened for the first time; -1 while none has",
        ),
    ];
    for (point, what) in POINTS {
        rows.push(Variable::output(
            format!("sliding.{point}.time"),
            Unit::Second,
            1.0,
            format!("Time since measure.start at {what}"),
        ));
        rows.push(Variable::count_output(
            format!("sliding.{point}.count"),
            format!("Times since measure.start that the contacts came to {what}"),
        ));
    }
    rows
}

/// The sliding points in the order of the engine's record.
pub const POINTS: [(&str, &str); 4] = [
    ("s1", "S1: both contacts slip clockwise"),
    ("s2", "S2: both contacts slip counter-clockwise"),
    ("t1", "T1: both slip, the skins pulling the disk up"),
    ("t2", "T2: both slip, the skins pushing the disk down"),
];

fn disk() -> Vec<Variable> {
    vec![
        Variable::output(
            "disk.angle[1]",
            Unit::Radian,
            1.0,
            "Angle turned, counter-clockwise and unwrapped",
        ),
        Variable::output(
            "disk.angular_velocity[1]",
            Unit::RadianPerSecond,
            0.1,
            "Angular velocity, counter-clockwise",
        ),
        Variable::output(
            "disk.x[1]",
            Unit::Metre,
            1e-3,
            "Displacement to the right from where the disk just touches both supports at rest",
        ),
        Variable::output(
            "disk.y[1]",
            Unit::Metre,
            1e-3,
            "Displacement up from where the disk just touches both supports at rest",
        ),
    ]
}

/// The disk on its supports.
///
/// # Errors
/// Supports that do not confine the disk or overlap each other.
pub fn rig(values: &Values) -> Result<Rig> {
    let (opening, tilt, radius) = (
        values.real("support.angle"),
        values.real("tilt"),
        values.real("disk.radius"),
    );
    let disks = values.integer("support.shape") == 1;
    if disks && opening < FRAC_PI_6 * (1.0 - 1e-12) {
        return Err(Error::parameter(
            "support.angle",
            format!("{opening} rad"),
            format!("at least pi/6 = {FRAC_PI_6} rad between disks"),
            "The supporting disks would overlap: open them or take support.shape walls.",
        ));
    }
    if tilt.abs() >= opening {
        return Err(Error::parameter(
            "tilt",
            format!("{tilt} rad"),
            format!("between -{opening} and {opening} rad, which is support.angle and excluded"),
            "At this tilt nothing holds the disk on one side: tilt less or raise support.angle.",
        ));
    }
    let stiffness = values.real("contact.normal_stiffness");
    Ok(Rig {
        radius,
        mass: values.real("disk.mass"),
        gravity: values.real("gravity"),
        normal: LinearDashpot {
            stiffness,
            damping: values.real("contact.normal_damping"),
        },
        tangential: TangentialSpring {
            stiffness: values.real("contact.stiffness_ratio") * stiffness,
            friction: values.real("contact.friction"),
        },
        frames: [Frame::new(tilt - opening), Frame::new(opening + tilt)],
        curvature: if disks { 0.5 / radius } else { 0.0 },
    })
}
