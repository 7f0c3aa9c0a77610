//! The data sheet of the disk on two supports.

use fmi_component::{DataSheet, ExampleRun, Symbol};

use crate::scene::sheet::{AXES, INPUT, LIMITS_OF_WORK, SYMBOLS_OF_CONTACTS, symbol};

const PURPOSE: &str = "A rotor that sticks and slips: one disk in the gap of two supports, turned by a torque or by vibration of the \
    supports. It returns angle, angular velocity and the forces of both contacts, with every change between stick, slip and flight \
    located exactly; in FMI 3.0 each of them is an event. Use it to test a controller against dry friction, or to study how a disk in a \
    packing is turned by its neighbours.";

/// Two disks of radius 62 that touch a third one between them at 30 degrees from the vertical.
const PICTURE: &str = "<g class=\"base\"><path d=\"M36 214A62 62 0 1 1 160 214z\"/><path d=\"M160 214A62 62 0 1 1 284 214z\"/></g>\
    <circle class=\"body\" cx=\"160\" cy=\"107\" r=\"62\"/><path class=\"thin\" d=\"M160 107L98 214M160 107L222 214M160 107V196\"/>\
    <text x=\"164\" y=\"182\">support.angle</text><path class=\"thin\" d=\"M160 107L116 63\"/>\
    <path class=\"out\" d=\"M192 46a74 74 0 0 0-70-2\"/><text class=\"out\" x=\"198\" y=\"42\">disk.angle</text>\
    <path class=\"out\" d=\"M118 180L102 208\"/><text class=\"out\" x=\"4\" y=\"132\">contact[1]</text>\
    <path class=\"out\" d=\"M202 180L218 208\"/><text class=\"out\" x=\"246\" y=\"132\">contact[2]</text>";

const TORQUE: &str =
    "<path class=\"in\" d=\"M184 98a26 26 0 1 0-2 24\"/><text class=\"in middle\" x=\"160\" y=\"111\">torque</text>";

const SUPPORTS: &str = "<path class=\"in\" d=\"M98 236v-16\"/><path class=\"in\" d=\"M222 236v-16\"/>\
    <text class=\"in middle\" x=\"160\" y=\"234\">supports move</text>";

const LIMITS: &[&str] = &[
    "<b>Small overlaps.</b> Contacts are linear springs; the disk has to rest on both with overlaps far below its radius, else its \
     parameters are refused. Soft contacts give in, so that the disk rolls by some torque / (<i>k<sub>n</sub> R</i>) even while it sticks.",
    "<b>Sticking contacts are not damped</b> along their surface: after a stop the tangential springs oscillate until slips of \
     microseconds have ended it. Damping acts along the normal alone.",
    "<b>Between supports.</b> A disk that falls off its supports is refused. Supports of the shape <code>disks</code> need a \
     <code>support.angle</code> of &pi;/6 or more, and tilts from <code>support.angle</code> on are refused.",
    "<b>Coulomb friction</b> with one coefficient for stick and slip; no rolling resistance, no Stribeck effect, no wear.",
    "<b>Time step.</b> Half a radian of the fastest mode, which the tangential stiffness decides; changes of a contact are located inside \
     of it. More than 1000 of them in one time step are refused.",
];

const TORQUE_LIMITS: &[&str] = &[
    "<b>Slow torques</b> below <i>A</i><sub>S</sub> = <i>m g R</i> &mu; / ((1 + &mu;<sup>2</sup>) cos &theta;<sub>0</sub>), 0.114 N m with \
     the start values and without tilt, do not slide the disk: it only rolls to and fro by some 1e-4 rad.",
];

const RANDOM_LIMITS: &[&str] = &[
    "<b>Noise</b> has the distribution of its oscillators at the ends of time steps; between them the supports follow the cubic through \
     places and velocities there. Without <code>tilt</code> the disk turns at random, with no mean.",
];

const SINE_LIMITS: &[&str] = &[
    "<b>Symmetry.</b> With <code>drive.phase_difference</code> 0 and no <code>tilt</code> both supports move as one base, and the disk does \
     not turn.",
];

const OUTPUTS: &[&str] = &[
    "disk.angle",
    "disk.angular_velocity",
    "torque.applied",
    "base.position",
    "base.reaction_force",
    "disk.x",
    "disk.y",
    "contact[1].state",
    "contact[1].normal_force",
    "contact[1].tangential_force",
    "slips",
    "sliding_regime",
];

const PARAMETERS: &[&str] = &[
    "torque.amplitude",
    "torque.angular_frequency",
    "support.amplitude",
    "support.angular_frequency",
    "drive.amplitude",
    "drive.frequency",
    "tilt",
    "contact.friction",
];

const SYMBOLS: &[Symbol] = &[
    symbol("<i>R</i>", "disk.radius", "radius of the disk"),
    symbol("<i>m</i>", "disk.mass", "mass of the disk"),
    symbol("<i>g</i>", "gravity", "gravity, downwards"),
    symbol(
        "&theta;<sub>0</sub>",
        "support.angle",
        "half the angle between the contacts",
    ),
    symbol(
        "&theta;<sub>T</sub>",
        "tilt",
        "angle by which the supports are turned, counter-clockwise",
    ),
    symbol("&theta;", "disk.angle[1]", "angle of the disk, counter-clockwise"),
    symbol(
        "&theta;<sub>i</sub>, &beta;<sub>i</sub>",
        "",
        "angle of support <i>i</i>; direction of the line of centres",
    ),
    symbol(
        "<i>n<sub>i</sub></i>, &tau;<sub>i</sub>",
        "",
        "normal and tangential force of contact <i>i</i>",
    ),
    symbol(
        "&Theta;, &delta;&theta;",
        "",
        "common and opposite part of the stretch of both tangential springs",
    ),
    symbol("<i>T</i>", "", "torque on the disk, counter-clockwise"),
    symbol(
        "<i>A<sub>e</sub></i>",
        "torque.amplitude",
        "amplitude of the harmonic torque",
    ),
    symbol(
        "&omega;<sub>e</sub>",
        "torque.angular_frequency",
        "its angular frequency",
    ),
    symbol(
        "<i>A<sub>b</sub></i>",
        "support.amplitude",
        "root mean square displacement of a support",
    ),
    symbol(
        "&omega;<sub>b</sub>",
        "support.angular_frequency",
        "natural angular frequency of the supports",
    ),
    symbol("<i>c</i>", "support.damping_ratio", "damping ratio of the supports"),
];

/// The data sheet on the drive `drive`.
pub fn of(drive: &str) -> DataSheet {
    let turned_by_torque = matches!(drive, INPUT | "harmonic-torque");
    let own = match drive {
        INPUT | "harmonic-torque" => TORQUE_LIMITS,
        "random-supports" => RANDOM_LIMITS,
        _ => SINE_LIMITS,
    };
    DataSheet {
        purpose: PURPOSE,
        limits: [own, LIMITS, LIMITS_OF_WORK].concat(),
        without_inputs: if drive == INPUT {
            "The disk rests on its supports, and nothing moves. A torque of more than 0.114 N m slides it."
        } else {
            ""
        },
        picture: vec![PICTURE, if turned_by_torque { TORQUE } else { SUPPORTS }, AXES],
        outputs: OUTPUTS.to_vec(),
        parameters: PARAMETERS.to_vec(),
        symbols: [SYMBOLS, SYMBOLS_OF_CONTACTS].concat(),
        example: Some(example(drive)),
    }
}

fn example(drive: &str) -> ExampleRun {
    match drive {
        INPUT => ExampleRun {
            duration: 0.25,
            steps: 256,
            curves: &["torque", "disk.angular_velocity[1]", "disk.angle[1]"],
            about: "The torque passes the limit of sliding in each period: the disk slides, and sticks again below.",
        },
        "harmonic-torque" => ExampleRun {
            duration: 20.0,
            steps: 400,
            curves: &["torque.applied", "disk.angular_velocity[1]", "disk.angle[1]"],
            about: "The torque passes the limit of sliding twice in a period, and the disk slides to and fro.",
        },
        "random-supports" => ExampleRun {
            duration: 1.0,
            steps: 400,
            curves: &["support[1].y", "disk.y[1]", "disk.angle[1]"],
            about: "The disk is shaken by its supports and turns at random.",
        },
        _ => ExampleRun {
            duration: 2.0,
            steps: 400,
            curves: &["base.position", "disk.y[1]", "disk.angle[1]"],
            about: "The tilted supports throw the disk up and turn it, to one side in the mean.",
        },
    }
}
