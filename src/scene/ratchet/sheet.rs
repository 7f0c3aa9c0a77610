//! The data sheet of the ratchet.

use fmi_component::{DataSheet, ExampleRun, Symbol};

use crate::scene::sheet::{
    AXES, INPUT, LIMITS_OF_INPUTS, LIMITS_OF_WORK, PARAMETERS_OF_DRIVE, SYMBOLS_OF_BASE, base_label, symbol,
};

const PURPOSE: &str = "A conveyor of grains without a motor along it: disks on an asymmetric sawtooth that vibrates up and down flow \
    sideways. It returns how fast and which way they flow, which changes with frequency, amplitude, shape of the teeth and number of \
    layers, and the force on the base. Use it to test a controller of a conveyor, or to compute the curves of the paper.";

const PICTURE: &str = "<path class=\"base\" d=\"M10 196L20 164L50 196L60 164L90 196L100 164L130 196L140 164L170 196L180 164L210 196L220 \
    164L250 196L260 164L290 196L300 164L310 175V206H10z\"/><path class=\"wall\" d=\"M10 22H310\"/>\
    <text class=\"end\" x=\"310\" y=\"16\">ceiling at cell.height</text><path class=\"thin\" d=\"M10 22V206M310 22V206\"/>\
    <text x=\"14\" y=\"36\">the cell repeats on both sides</text>\
    <g class=\"body\"><circle cx=\"40\" cy=\"150\" r=\"11\"/><circle cx=\"78\" cy=\"126\" r=\"10.5\"/><circle cx=\"113\" cy=\"158\" \
    r=\"11\"/><circle cx=\"150\" cy=\"139\" r=\"10\"/><circle cx=\"196\" cy=\"110\" r=\"11\"/><circle cx=\"197\" cy=\"158\" r=\"10.5\"/>\
    <circle cx=\"238\" cy=\"142\" r=\"11\"/><circle cx=\"276\" cy=\"128\" r=\"10\"/><circle cx=\"60\" cy=\"86\" r=\"10.5\"/>\
    <circle cx=\"132\" cy=\"92\" r=\"11\"/><circle cx=\"252\" cy=\"88\" r=\"10.5\"/></g>\
    <path class=\"out\" d=\"M150 62h-46\"/><path class=\"out\" d=\"M172 62h46\"/>\
    <text class=\"out middle\" x=\"161\" y=\"54\">transport_velocity, positive to the right</text>\
    <path class=\"in\" d=\"M30 222V210\"/><path class=\"out\" d=\"M160 208v16\"/><text class=\"out\" x=\"168\" \
    y=\"222\">base.reaction_force</text>";

const LIMITS: &[&str] = &[
    "<b>No lasting contacts.</b> Disks meet in instantaneous impacts, and none leaves slower than \
     <code>collision.minimum_normal_velocity</code>, 5 mm/s at the start. This floor ends inelastic collapse and feeds energy to disks \
     that would lie still: on a base at rest they go on to hop by some micrometres. Thick layers that are shaken weakly, and a floor of \
     zero, are refused for the number of their impacts.",
    "<b>Means scatter.</b> <code>transport_velocity</code> of a run of 30 s scatters by 0.4 to 0.8 cm/s; \
     <code>transport_velocity.standard_error</code> says how much. It is 0 in the first 0.8 s.",
    "<b>Tip radius.</b> The paper does not give the radius of the tips; the velocities depend on it: from 0.1 to 0.5 mm by 5 % in one \
     case of the paper and by a third in the other.",
    "<b>Two dimensions.</b> Disks rub by Coulomb friction with one coefficient and do not roll against resistance; there is no air and no \
     cohesion. The normal restitution does not depend on the velocity.",
    "<b>Ceiling.</b> A base that comes within a disk of the ceiling, or accelerates by more than 1e14 m/s2, is refused. A base on inputs \
     goes on with its velocity and acceleration, so that long steps take it far.",
];

const OUTPUTS: &[&str] = &[
    "transport_velocity",
    "transport_velocity.standard_error",
    "mean_velocity",
    "base.reaction_force",
    "base.impulse",
    "base.mean_power",
    "base.position",
    "disk.x",
    "disk.y",
    "disk.angle",
];

const TEETH: &[&str] = &["tooth.width", "tooth.height", "tooth.asymmetry"];

const SYMBOLS: &[Symbol] = &[
    symbol("<i>w</i>", "tooth.width", "width of a tooth"),
    symbol("<i>h</i>", "tooth.height", "height of the sharp apex above the valley"),
    symbol(
        "<i>a</i>",
        "tooth.asymmetry",
        "horizontal extent of the left side over the width",
    ),
    symbol("&epsilon;", "collision.restitution", "normal restitution"),
    symbol("&mu;", "collision.friction", "friction coefficient"),
    symbol(
        "<i>v<sub>min</sub></i>",
        "collision.minimum_normal_velocity",
        "smallest normal velocity after an impact",
    ),
    symbol("<i>n</i>", "layers", "number of layers"),
    symbol(
        "<i>N</i>, <i>k</i>",
        "",
        "number of disks; disks of the smallest radius that lie side by side across the cell",
    ),
];

/// The data sheet on the drive `drive`.
pub fn of(drive: &str) -> DataSheet {
    let mut limits = LIMITS.to_vec();
    let input = drive == INPUT;
    if input {
        limits.extend(LIMITS_OF_INPUTS);
    }
    limits.extend(LIMITS_OF_WORK);
    DataSheet {
        purpose: PURPOSE,
        limits,
        without_inputs: if input {
            "The base stands still: the disks fall on the teeth in the first tenths of a second and then hop at the floor of velocity, \
             going nowhere. They flow when the base shakes at several times gravity."
        } else {
            ""
        },
        picture: vec![PICTURE, base_label(drive), AXES],
        outputs: OUTPUTS.to_vec(),
        parameters: [PARAMETERS_OF_DRIVE, TEETH].concat(),
        symbols: [SYMBOLS, SYMBOLS_OF_BASE].concat(),
        example: Some(example(input)),
    }
}

fn example(input: bool) -> ExampleRun {
    if input {
        return ExampleRun {
            duration: 0.25,
            steps: 256,
            curves: &["base.displacement", "base.reaction_force", "mean_velocity"],
            about: "The disks fall on the teeth and are shaken at twice gravity; at this high frequency and small amplitude they hop \
                    without much flow.",
        };
    }
    ExampleRun {
        duration: 1.0,
        steps: 400,
        curves: &[
            "base.position",
            "base.reaction_force",
            "mean_velocity",
            "transport_velocity",
        ],
        about: "The mean velocity of the disks jumps with their impacts; <code>transport_velocity</code> averages it since the start.",
    }
}
