//! The data sheet of the packing.

use fmi_component::{DataSheet, ExampleRun, Symbol};

use crate::scene::sheet::{
    AXES, INPUT, LIMITS_OF_INPUTS, LIMITS_OF_WORK, PARAMETERS_OF_DRIVE, SYMBOLS_OF_BASE, SYMBOLS_OF_CONTACTS,
    base_label, symbol,
};

const PURPOSE: &str = "A granular load: disks in a box that a shaker, a machine or your model moves up and down. It returns the force of the \
    disks on the base, as you need it to close the loop with a plant, and how each disk moves and turns. Physicists use it for the \
    spontaneous rotation in vibrated packings: the same parameters and seed give the same bits everywhere.";

/// Places of a settled packing of this scene: `jostle run packing --disks 23 --set box.width=0.22`, its lower disks.
const DISKS: &str = "<g class=\"body\"><circle cx=\"79\" cy=\"178\" r=\"17.5\"/><circle cx=\"110\" cy=\"183\" r=\"13\"/>\
    <circle cx=\"141\" cy=\"178\" r=\"17.5\"/><circle cx=\"182\" cy=\"174\" r=\"22\"/><circle cx=\"226\" cy=\"178\" r=\"17.5\"/>\
    <circle cx=\"114\" cy=\"151\" r=\"17.5\"/><circle cx=\"246\" cy=\"153\" r=\"13\"/><circle cx=\"155\" cy=\"150\" r=\"13\"/>\
    <circle cx=\"212\" cy=\"140\" r=\"22\"/><circle cx=\"137\" cy=\"124\" r=\"17.5\"/><circle cx=\"79\" cy=\"142\" r=\"17.5\"/>\
    <circle cx=\"174\" cy=\"125\" r=\"17.5\"/><circle cx=\"237\" cy=\"103\" r=\"22\"/><circle cx=\"103\" cy=\"122\" r=\"13\"/>\
    <circle cx=\"151\" cy=\"86\" r=\"22\"/><circle cx=\"200\" cy=\"106\" r=\"13\"/><circle cx=\"78\" cy=\"111\" r=\"13\"/>\
    <circle cx=\"111\" cy=\"91\" r=\"17.5\"/></g>";

/// Box, arrows and labels.
const BOX: &str = "<path class=\"wall\" d=\"M61 30V196M259 30V196\"/><rect class=\"base\" x=\"50\" y=\"196\" width=\"220\" height=\"10\"/>\
    <path class=\"thin\" d=\"M61 20v-8M259 20v-8M61 16H259\"/><text class=\"middle\" x=\"160\" y=\"12\">box.width</text>\
    <path class=\"in\" d=\"M30 216V188\"/><path class=\"out\" d=\"M160 208v22\"/>\
    <text class=\"out\" x=\"168\" y=\"226\">base.reaction_force</text><path class=\"out\" d=\"M163 73a18 18 0 0 0-25 4\"/>\
    <text class=\"out middle\" x=\"151\" y=\"56\">disk.angle</text><path class=\"thin\" d=\"M151 86L137 103\"/>";

const FREE_PARTS: &[&str] = &[
    "<b>Two dimensions, one law.</b> Gravity lies in the plane of the disks. Disks are rigid in rotation, all contacts have the same \
     linear spring, dashpot and Coulomb friction; there is no rolling resistance, no cohesion and no air.",
    "<b>Side walls</b> stand still unless <code>wall.motion</code> = <code>with_base</code>: they then rub on disks, and \
     <code>base.reaction_force</code> does not hold that friction. The box has no lid.",
    "<b>Chaos.</b> Two packings that differ in the last bit part within some tenths of a second. Single trajectories are no prediction: \
     take means over time or over <code>seed</code>.",
];

const SOFT: &[&str] = &[
    "<b>Overlaps</b> stand for the deformation of a contact and must stay small. A step in which two surfaces overlap by more than half \
     of the smallest radius, or a disk or the base moves by more than half of that radius in a time step, is refused. Raise \
     <code>contact.normal_stiffness</code> or shake less.",
    "<b>Time step.</b> By default a hundredth of the shortest contact period, which leaves an error of 2.4e-4 in the restitution of a \
     weakly damped impact (<i>c</i> = 0.0075) and of 4.4e-3 in that of a strongly damped one (<i>c</i> = 0.22); a twentieth at most is \
     accepted. Stiff contacts and light disks make the step small, and a run slow.",
    "<b>Contacts last</b> 1.1 ms and longer with the start values. What happens faster than a contact is not resolved: keep the base slow \
     against it.",
];

const LOCATED: &[&str] = &[
    "<b>Overlaps</b> stand for the deformation of a contact and must stay small. A step in which two surfaces overlap by more than half \
     of the smallest radius is refused. Raise <code>contact.normal_stiffness</code> or shake less.",
    "<b>Tolerance.</b> <code>tolerance</code> is the relative error of the velocities after one impact. In a packing it grows with time: \
     the angles of 60 disks at &Gamma; = 4 are off by 55 to 150 times the tolerance after 50 ms. Steps longer than an eighth of the \
     contact period are refused.",
];

const HARD: &[&str] = &[
    "<b>No lasting contacts.</b> Disks meet in instantaneous impacts. The model is made for strong shaking, &Gamma; of 2 and more. At \
     &Gamma; of 1 and below, and on a base at rest, disks lie on the base, collide infinitely often, and the step is refused (more than \
     1e10 events a second and disk). Use the engine <code>molecular-dynamics</code> there.",
    "<b>Inelastic collapse</b> is cut off: impacts of a disk within <code>collision.contact_time</code>, 1 &micro;s at the start, of its \
     last one lose nothing along the normal. Shares of the energy that are lost in such series are too small.",
    "<b>Stiff contacts.</b> The outcome of an impact is that of the soft contact, its duration is zero: two runs differ by about \
     <i>k<sub>n</sub></i><sup>&minus;1/2</sup>. Stiffness ratios above 1e4 and damping ratios above 10 are refused.",
];

const STILL_BOTTOM: &[&str] = &[
    "<b>The bottom row belongs to the base.</b> The disks that stand on the floor at the start do not turn and feel no force; the others \
     move on them.",
];

const RANDOM_PHASE: &[&str] = &[
    "<b><code>base.model</code> = <code>random_phase</code></b> holds the base in place and lends each impact the velocity of a base of \
     random phase. It is an approximation of small amplitudes: <code>base.rejected_draws</code> counts where it fails.",
];

const OUTPUTS: &[&str] = &[
    "base.reaction_force",
    "base.reaction_force_now",
    "base.impulse",
    "base.position",
    "base.acceleration",
    "mean_angular_velocity",
    "disk.angle",
    "disk.angular_velocity",
    "disk.x",
    "disk.y",
];

const BOTTOM: &[&str] = &["bottom.radius", "bottom.angular_frequency"];

const SYMBOLS: &[Symbol] = &[
    symbol("<i>R</i>", "disk.radius[1]", "radius of a disk"),
    symbol("&theta;", "disk.angle[1]", "angle of a disk, counter-clockwise"),
    symbol(
        "&omega;, &sigma;, <i>n</i>",
        "",
        "of the rotation: mean and standard deviation of the angular velocities in <i>n</i> intervals",
    ),
    symbol(
        "&epsilon;",
        "bottom.radius",
        "radius of the circle in which a disk of the bottom row moves",
    ),
];

/// The data sheet of the engine `engine` on the drive `drive`.
pub fn of(engine: &str, drive: &str) -> DataSheet {
    let hard = engine == "event-driven";
    let mut limits = match engine {
        "event-driven" => HARD,
        "molecular-dynamics-located" => LOCATED,
        _ => SOFT,
    }
    .to_vec();
    match drive {
        INPUT => limits.extend(LIMITS_OF_INPUTS),
        "sine-fixed-bottom" | "random-bottom" => limits.extend(STILL_BOTTOM),
        _ if hard => limits.extend(RANDOM_PHASE),
        _ => {}
    }
    limits.extend(FREE_PARTS.iter().chain(LIMITS_OF_WORK));
    DataSheet {
        purpose: PURPOSE,
        limits,
        without_inputs: match (drive, hard) {
            (INPUT, false) => {
                "The base stands still and the packing, which starts settled on it, stays as it is: \
                 <code>base.reaction_force</code> is minus its weight, and nothing turns. Something happens as soon as the base \
                 accelerates by more than gravity."
            }
            (INPUT, true) => {
                "The base stands still, the disks come to rest on it, and the run is refused within a tenth of a second: hard disks at \
                 rest have no next impact. Connect a motion that goes on, such as this one."
            }
            _ => "",
        },
        picture: vec![DISKS, BOX, base_label(drive), AXES],
        outputs: OUTPUTS.to_vec(),
        parameters: [PARAMETERS_OF_DRIVE, BOTTOM].concat(),
        symbols: [SYMBOLS_OF_CONTACTS, SYMBOLS_OF_BASE, SYMBOLS].concat(),
        example: Some(example(drive)),
    }
}

fn example(drive: &str) -> ExampleRun {
    match drive {
        INPUT => ExampleRun {
            duration: 0.1875,
            steps: 192,
            curves: &["base.displacement", "base.reaction_force", "mean_angular_velocity"],
            about: "The base accelerates at twice gravity: disks leave it, fall back, and turn. The force of a step is its mean over the step.",
        },
        "random-bottom" => ExampleRun {
            duration: 0.25,
            steps: 250,
            curves: &["energy.kinetic", "base.reaction_force", "mean_angular_velocity"],
            about: "The bottom row shakes at random and the disks on it hop.",
        },
        _ => ExampleRun {
            duration: 0.25,
            steps: 250,
            curves: &["base.position", "base.reaction_force", "mean_angular_velocity"],
            about: "The base moves at &Gamma; = 2: disks leave it, fall back, and turn.",
        },
    }
}
