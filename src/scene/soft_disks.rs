//! What the scenes of soft disks share: contact laws and time step that their parameters describe, and what they say when an
//! engine stops.

use crate::contact::{ContactLaws, NormalForce, TangentialSpring};
use crate::engine::dem::{Breakdown, TimeStepLimits};

use super::{Error, Result, Row, Values, work_limit};

const FRICTION: &str = "contact.friction";

/// What the time step of one disk depends on besides its drive: its fastest mode, and the choice of the user.
pub const STEP_OF_ONE_DISK: &[&str] = &[
    "disk.mass",
    "contact.normal_stiffness",
    "contact.stiffness_ratio",
    "contact.normal_damping",
    "contact.friction",
    "time_step",
];

/// A normal force that a scene of soft disks can have: see [`laws`](super::laws), one a file.
pub trait SceneNormalForce: NormalForce {
    /// Name of velocity Verlet with this force on the command line.
    const ENGINE: &'static str;
    /// Model identifier of the packing with it, on a base that follows inputs.
    const PACKING: &'static str;
    /// Names of the parameters that it has besides stiffness and damping.
    const PARAMETERS: &'static [&'static str];

    /// These parameters.
    fn rows<M>() -> Vec<Row<M>>;

    /// The force that the parameters describe.
    fn from_values(values: &Values) -> Self;
}

/// The laws that the parameters `contact.*` describe.
pub fn contact_laws<N: SceneNormalForce>(values: &Values) -> ContactLaws<N> {
    let normal = N::from_values(values);
    let tangential = TangentialSpring {
        stiffness: values.real("contact.stiffness_ratio") * values.real("contact.normal_stiffness"),
        friction: values.real(FRICTION),
    };
    ContactLaws { normal, tangential }
}

/// The time step that the parameter `time_step` asks for: 0 asks for the default.
///
/// # Errors
/// A step that these contacts do not allow.
pub fn chosen_time_step(values: &Values, limits: &TimeStepLimits) -> Result<f64> {
    let asked = values.real("time_step");
    if asked == 0.0 {
        return Ok(limits.default);
    }
    if asked <= limits.largest {
        return Ok(asked);
    }
    Err(Error::parameter(
        "time_step",
        format!("{asked:e} s"),
        format!("at most {:e} s for these contacts, masses and drive", limits.largest),
        format!("Give a smaller step, or 0 for the default of {:e} s.", limits.default),
    ))
}

/// Says whether contacts of another friction still allow the time step \[s\] that was chosen at the start.
///
/// # Errors
/// They do not.
pub fn check_tuned_time_step(values: &Values, limits: &TimeStepLimits, time_step: f64) -> Result<()> {
    if time_step <= limits.largest {
        return Ok(());
    }
    Err(Error::parameter(
        FRICTION,
        values.real(FRICTION),
        format!(
            "0 with the time step of {time_step:e} s that was chosen at the start: with friction the contacts allow at most {:e} s",
            limits.largest
        ),
        "Start with a smaller time_step, or with friction.",
    ))
}

/// The refused step of a scene whose engine broke down.
pub fn refused_step(scene: &'static str, breakdown: Breakdown) -> Error {
    let smaller = "Check the base's amplitude and the inputs, or take a smaller time_step";
    let (time, what, remedy) = match breakdown {
        Breakdown::TooDeep { time, overlap, allowed } => (
            time,
            format!("an overlap of {overlap:e} m, more than the {allowed:e} m (half of the smallest radius) allowed"),
            format!("{smaller} or a larger contact.normal_stiffness."),
        ),
        Breakdown::TooFast {
            time,
            distance,
            allowed,
        } => (
            time,
            format!("a disk moved {distance:e} m in one time step, more than the {allowed:e} m allowed"),
            format!("{smaller}."),
        ),
        Breakdown::NotFinite { time } => (
            time,
            "a position, a velocity or the base is beyond 1e100 or no longer finite".into(),
            format!("{smaller}."),
        ),
        Breakdown::TooManySteps { time, steps, most } => {
            let asked = format!("{steps:e} time steps (at most {most:e} for these disks)");
            let reason =
                "Light disks, stiff or damped contacts and fast drives make the time step small: see chosen_time_step.";
            return work_limit::refusal(scene, time, &asked, reason);
        }
    };
    Error::Step {
        model: scene,
        time,
        what,
        remedy,
    }
}
