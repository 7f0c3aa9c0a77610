//! What scenes on a base of random phase share: the parameter `base.profile`, and the outputs that tell how often a drawn
//! velocity was rejected (P 2.3.3).

use crate::drive::BaseProfile;

use super::{Row, Values};

/// Name of the parameter that chooses the profile.
pub const PROFILE: &str = "base.profile";

/// Value of the parameter for the sawtooth; the other is the sine.
const SAWTOOTH: i64 = 2;

/// Row of the parameter `base.profile`.
pub fn profile_parameter<M>() -> Row<M> {
    const OPTIONS: &[(&str, &str)] = &[
        ("sine", "Velocity of a sine at a random phase"),
        (
            "sawtooth",
            "Velocity A omega_b, up, at every impact: the base rises evenly and falls at once",
        ),
    ];
    let description = "Motion from which a base that stays in place lends each impact its velocity";
    Row::enumeration_parameter(PROFILE, "base_profile", OPTIONS, 1, description)
}

/// The profile that the parameter says.
pub fn profile(values: &Values) -> BaseProfile {
    match values.integer(PROFILE) {
        SAWTOOTH => BaseProfile::Sawtooth,
        _ => BaseProfile::Sine,
    }
}

/// Names and descriptions of the outputs that count draws, all and rejected.
pub const DRAW_COUNTS: [(&str, &str); 2] = [
    (
        "base.draws",
        "Velocities of the base drawn at random phases so far, those rejected among them; base.profile sawtooth draws none",
    ),
    (
        "base.rejected_draws",
        "Draws among them that were rejected and drawn again, since the disk would still have moved into the wall: rare where the \
         approximation holds",
    ),
];
