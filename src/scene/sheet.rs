//! What the data sheets of several scenes share: pieces of pictures, limits and symbols.
//!
//! Figures stand in `docs/physics.md` and `docs/abuse.md` with what they were measured by, or are the ranges of the rows.

use fmi_component::Symbol;

/// Name of the drive that follows inputs.
pub const INPUT: &str = "input";

/// Senses of x, y and angles, at the lower right of a picture.
pub const AXES: &str = "<path class=\"axis\" d=\"M280 232h30\"/><path class=\"axis\" d=\"M280 232v-30\"/>\
    <path class=\"axis\" d=\"M300 231A20 20 0 0 0 282 212\"/><text x=\"312\" y=\"228\">x</text><text x=\"270\" y=\"206\">y</text>";

/// Parameters of a drive that is inside, for the diagram.
pub const PARAMETERS_OF_DRIVE: &[&str] = &["drive.amplitude", "drive.frequency"];

/// How the base moves: the label at the arrow of the base, at the lower left.
pub fn base_label(drive: &str) -> &'static str {
    match drive {
        INPUT => "<text class=\"in\" x=\"6\" y=\"234\">base.displacement</text>",
        "random-bottom" => "<text class=\"in\" x=\"6\" y=\"234\">bottom row: noise</text>",
        _ => "<text class=\"in\" x=\"6\" y=\"234\">A sin(2&#960;f t + phase)</text>",
    }
}

/// Limits of a base on inputs: `docs/control-engineer.md`, how small the step must be.
pub const LIMITS_OF_INPUTS: &[&str] = &[
    "<b>Inputs between communication points are extrapolated.</b> With displacement and velocity, 16 steps in a period of the \
     highest frequency give the acceleration of a sine to 1.2 %, 8 steps only to 18 %. In a loop through a plant the order of the \
     exchange limits the accuracy: halve the step and compare.",
    "<b>Rates that contradict.</b> <code>base.velocity</code> must be the rate of <code>base.displacement</code>, and \
     <code>base.acceleration_input</code> that of <code>base.velocity</code>. Leave them unset if you do not have them.",
];

/// What bounds every run.
pub const LIMITS_OF_WORK: &[&str] = &[
    "<b>Work.</b> A step that takes more than <code>work.limit</code>, at its start value about a minute of one core, is refused, with \
     the state as before; shorter steps do the same.",
];

/// Symbols of a base on a sine and of gravity.
pub const SYMBOLS_OF_BASE: &[Symbol] = &[
    symbol("<i>g</i>", "gravity", "gravity, downwards"),
    symbol(
        "<i>A</i>",
        "drive.amplitude",
        "amplitude of the base; &Gamma; = <i>A</i> &omega;<sub>b</sub><sup>2</sup> / <i>g</i> is its peak acceleration over gravity",
    ),
    symbol(
        "<i>f</i>",
        "drive.frequency",
        "frequency of the base, &omega;<sub>b</sub> = 2 &pi; <i>f</i>",
    ),
    symbol("<i>&phi;</i>", "drive.phase", "phase of the base at time zero"),
];

/// Symbols of soft contacts.
pub const SYMBOLS_OF_CONTACTS: &[Symbol] = &[
    symbol(
        "<i>k<sub>n</sub></i>",
        "contact.normal_stiffness",
        "normal stiffness of a contact",
    ),
    symbol(
        "&gamma;<sub>n</sub>",
        "contact.normal_damping",
        "normal damping; over the critical one <i>c</i> = &gamma;<sub>n</sub> / (2 &radic;(<i>k<sub>n</sub> m</i>))",
    ),
    symbol(
        "&kappa;",
        "contact.stiffness_ratio",
        "tangential over normal stiffness, <i>k<sub>t</sub></i> = &kappa; <i>k<sub>n</sub></i>",
    ),
    symbol("&mu;", "contact.friction", "friction coefficient"),
    symbol(
        "&delta;, <i>N</i>, &tau;",
        "",
        "overlap, normal and tangential force of a contact",
    ),
    symbol(
        "&lambda;, &lambda;*",
        "",
        "tangential displacement of the surfaces, and the one at which the tangential spring is relaxed",
    ),
];

/// A symbol of the equations.
pub const fn symbol(symbol: &'static str, variable: &'static str, meaning: &'static str) -> Symbol {
    Symbol {
        symbol,
        variable,
        meaning,
    }
}
