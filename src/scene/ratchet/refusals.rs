//! Why a step of the ratchet is refused: what stopped the engine or is wrong with the inputs, and what to do about it.

use crate::engine::event_driven::{EventDrivenStop, Partner};
use crate::scene::hard_disks::refused_step;
use crate::scene::{Error, Unit};

use super::NAME;

/// Greatest acceleration \[m/s2\] of the base, beyond which searches for first hits take ever smaller steps. The sine of the
/// greatest amplitude and frequency has 4e13.
pub const MOST_ACCELERATION: f64 = 1e14;

/// What stopped the engine, as the error of a step.
pub fn refusal(stop: EventDrivenStop) -> Error {
    let partner = |partner| match partner {
        Partner::Wall(0) => "the base",
        Partner::Wall(_) => "the ceiling",
        _ => "nobody: it is too fast",
    };
    let remedy = "Inelastic collapse? Raise collision.minimum_normal_velocity or collision.restitution.";
    let crowded = "Disks that touch all the time collide again and again: where they lie still, or where a thick layer is shaken \
                   weakly. Shake more, take fewer disks or raise collision.minimum_normal_velocity.";
    refused_step(NAME, stop, partner, remedy, crowded)
}

/// The inputs move the base so that disks cannot follow it.
pub fn impossible_motion(time: f64, acceleration: f64, farthest: f64, headroom: f64) -> Error {
    let (what, remedy) = if farthest < headroom {
        (
            format!(
                "the inputs accelerate the base by {acceleration:e} m/s2, and {MOST_ACCELERATION:e} m/s2 is the most"
            ),
            "Let base.displacement and base.velocity fit each other and the communication step.",
        )
    } else {
        (
            format!(
                "the inputs move the base up by {}, and {} are left below the ceiling",
                Unit::METRE.format(farthest),
                Unit::METRE.format(headroom)
            ),
            "Keep base.displacement smaller or raise cell.height.",
        )
    };
    Error::Step {
        model: NAME,
        time,
        what,
        remedy: remedy.into(),
    }
}
