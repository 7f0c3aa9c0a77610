//! The data sheet of the wedge.

use fmi_component::{DataSheet, ExampleRun, Symbol};

use crate::scene::sheet::{
    AXES, INPUT, LIMITS_OF_INPUTS, LIMITS_OF_WORK, PARAMETERS_OF_DRIVE, SYMBOLS_OF_BASE, SYMBOLS_OF_CONTACTS,
    base_label, symbol,
};

const PURPOSE: &str = "The smallest granular motor: one disk that bounces in a tilted, vibrated wedge and turns steadily. It returns the mean \
    angular velocity, scaled by the velocity of the base, with its standard error, the motion of the disk and its force on the wedge. \
    With one body it is fast and clear enough to learn how vibration becomes rotation, and to test a coupling.";

/// Opening 120 degrees, turned counter-clockwise by 10 degrees about (150, 196): left wall 20 degrees above the horizontal to the
/// left, right wall 40 degrees to the right.
const PICTURE: &str = "<path class=\"wall\" d=\"M26 151L150 196L253 110\"/><path class=\"thin\" d=\"M150 196V60M150 196L124 50\"/>\
    <circle class=\"body\" cx=\"139\" cy=\"133\" r=\"38\"/><path class=\"thin\" d=\"M139 133L112 160\"/>\
    <path class=\"thin\" d=\"M97 177A56 56 0 0 1 193 160\"/>\
    <text x=\"196\" y=\"184\">wedge.aperture</text><text class=\"middle\" x=\"120\" y=\"44\">wedge.tilt</text>\
    <path class=\"out\" d=\"M171 99a46 46 0 0 0-60-3\"/><text class=\"out\" x=\"176\" y=\"92\">disk.angle</text>\
    <path class=\"in\" d=\"M24 222V192\"/><path class=\"out\" d=\"M150 202v24\"/>\
    <text class=\"out\" x=\"158\" y=\"222\">base.reaction_force</text>";

const COMMON: &[&str] = &[
    "<b>Tilt.</b> At (&pi; &minus; <code>wedge.aperture</code>)/2 one wall is horizontal and the disk runs away: tilts from there on are \
     refused.",
    "<b>Means converge slowly.</b> <code>scaled_angular_velocity</code> has a standard error of 0.003 after 5,000 s of simulated time; \
     <code>scaled_angular_velocity.standard_error</code> says what it is in your run.",
    "<b>Two dimensions, one law.</b> A rigid disk, walls without end, one friction coefficient, no rolling resistance and no air.",
];

const MAP: &[&str] = &[
    "<b>The walls rest.</b> Each impact gets the velocity of a base at a random phase. This is an approximation of strong shaking: at \
     &Gamma; = 2 the rotation differs from that of the moving wedge by up to 8 % of the largest one. There is no base motion to \
     follow, and a disk never comes to rest.",
    "<b>Rejected velocities.</b> Where the disk would not leave the wall, the velocity is drawn again: 2 % of the draws at a restitution \
     of 0.9 and &Gamma; = 2, 13 % at a restitution of 0.2. <code>base.rejected_draws</code> counts them.",
];

const EVENT_DRIVEN: &[&str] = &[
    "<b>No lasting contacts.</b> No impact leaves the wall slower than <code>collision.minimum_normal_velocity</code>, 0.1 mm/s at the \
     start: a disk at rest is one that hops by <i>v</i><sup>2</sup>/(2<i>g</i>). Its force and friction are right in the mean, and \
     <code>slow_collisions</code> counts such impacts. On a base at rest there are tens of thousands of them a second.",
    "<b>Restitution</b> does not depend on the velocity of the impact.",
];

const SOFT: &[&str] = &[
    "<b>Overlaps</b> stand for the deformation of a contact and must stay small; a step in which the disk is deeper than half of its radius \
     in a wall is refused.",
    "<b>Time step.</b> By default a hundredth of the contact period; a twentieth at most is accepted. Stiff contacts make a run long.",
];

const OUTPUTS: &[&str] = &[
    "scaled_angular_velocity",
    "scaled_angular_velocity.standard_error",
    "mean_angular_velocity",
    "base.reaction_force",
    "base.impulse",
    "base.position",
    "disk.angle",
    "disk.x",
    "disk.y",
];

const WEDGE: &[&str] = &["wedge.aperture", "wedge.tilt"];

const SYMBOLS: &[Symbol] = &[
    symbol("&theta;<sub>W</sub>", "wedge.aperture", "angle between the walls"),
    symbol(
        "&theta;<sub>T</sub>",
        "wedge.tilt",
        "angle of the bisector to the vertical, counter-clockwise",
    ),
    symbol("<i>R</i>", "disk.radius", "radius of the disk"),
    symbol("<i>m</i>", "disk.mass", "mass of the disk"),
    symbol("<i>e<sub>n</sub></i>", "collision.restitution", "normal restitution"),
    symbol("<i>e<sub>t</sub></i>", "", "tangential restitution"),
    symbol(
        "<i>v<sub>n</sub></i>, <i>v<sub>t</sub></i>, &omega;",
        "",
        "velocity of the disk along the normal and the tangent of a wall; its angular velocity",
    ),
    symbol(
        "&lang;&omega;&rang;",
        "",
        "mean of the angular velocity over the time since <code>measure.start</code>",
    ),
];

/// The data sheet of the engine `engine` on the drive `drive`.
pub fn of(engine: &str, drive: &str) -> DataSheet {
    let (map, input) = (engine == "map", drive == INPUT);
    let mut limits = match engine {
        "map" => MAP,
        "event-driven" => EVENT_DRIVEN,
        _ => SOFT,
    }
    .to_vec();
    if input {
        limits.extend(LIMITS_OF_INPUTS);
    }
    limits.extend(COMMON.iter().chain(LIMITS_OF_WORK));
    DataSheet {
        purpose: PURPOSE,
        limits,
        without_inputs: if input {
            "The base stands still: the disk falls by <code>disk.drop_height</code>, 1 mm, turns by a tenth of a radian while it bounces, \
             and comes to rest within a second. It turns steadily only on a base that shakes."
        } else {
            ""
        },
        picture: vec![
            PICTURE,
            if map {
                "<text class=\"in\" x=\"6\" y=\"234\">base of random phase</text>"
            } else {
                base_label(drive)
            },
            AXES,
        ],
        outputs: OUTPUTS.to_vec(),
        parameters: [PARAMETERS_OF_DRIVE, WEDGE].concat(),
        symbols: [SYMBOLS, SYMBOLS_OF_CONTACTS, SYMBOLS_OF_BASE].concat(),
        example: Some(example(map, input)),
    }
}

fn example(map: bool, input: bool) -> ExampleRun {
    let about = "The disk bounces and turns to one side in the mean.";
    match (map, input) {
        (true, _) => ExampleRun {
            duration: 4.0,
            steps: 400,
            curves: &["disk.y[1]", "disk.angle[1]", "scaled_angular_velocity"],
            about,
        },
        (false, true) => ExampleRun {
            duration: 0.25,
            steps: 256,
            curves: &["base.displacement", "base.reaction_force", "disk.y[1]", "disk.angle[1]"],
            about: "The disk falls into the wedge, is thrown up again and again, and turns.",
        },
        (false, false) => ExampleRun {
            duration: 0.5,
            steps: 400,
            curves: &["base.position", "base.reaction_force", "disk.y[1]", "disk.angle[1]"],
            about,
        },
    }
}
