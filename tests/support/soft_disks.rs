//! Soft disks of the tests of both engines: contact laws, masses and a base at rest.

use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::FollowsInput;
use jostle::engine::dem::ContactLaws;

/// Radius \[m\].
pub const RADIUS: f64 = 0.02;

/// Normal stiffness 1e4 N/m; tangential stiffness `ratio` of it.
pub fn laws(normal_damping: f64, ratio: f64, friction: f64) -> ContactLaws {
    ContactLaws {
        normal: LinearDashpot {
            stiffness: 1e4,
            damping: normal_damping,
        },
        tangential: TangentialSpring {
            stiffness: ratio * 1e4,
            friction,
        },
    }
}

/// Of a disk of the papers' surface density \[kg\].
pub fn mass(radius: f64) -> f64 {
    3.57 * std::f64::consts::PI * radius * radius
}

/// A base that stays at height zero.
pub fn at_rest() -> FollowsInput {
    FollowsInput::uniform(0.0, 0.0, 0.0)
}
