//! Torques at which the disk begins to slide (P 5.3 to 5.5), and where a contact opens (P 4.50, 5.2.1).

use super::{Acceleration, Corner, Setting, point};
use crate::elementary::{acos, atan, cos, hypot, powi, sin_cos};

/// Torques that friction can hold \[N m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// `A_S1` against a clockwise torque.
    pub clockwise: f64,
    /// `A_S2` against a counter-clockwise torque.
    pub counter_clockwise: f64,
}

impl Limits {
    /// The smaller one.
    pub fn lower(&self) -> f64 {
        self.clockwise.min(self.counter_clockwise)
    }

    /// The larger one.
    pub fn upper(&self) -> f64 {
        self.clockwise.max(self.counter_clockwise)
    }

    /// `A_0`, the limit without tilt, P 5.4: `m g R mu / ((1 + mu^2) cos theta_0)` \[N m\].
    pub fn untilted(setting: &Setting) -> f64 {
        let mu = setting.friction;
        setting.weight() * setting.radius * mu / ((1.0 + mu * mu) * cos(setting.half_angle))
    }
}

/// `A_S1 = A_0 (cos theta_T + mu sin theta_T)` (P 5.5) and `A_S2 = A_0 (cos theta_T - mu sin theta_T)` (P 5.3).
///
/// Rigid contacts at rest; valid while both bear, `|theta_T| < detachment_tilt`.
pub fn limits(setting: &Setting) -> Limits {
    let torque = |corner| {
        let departure = point(setting, Acceleration::default(), corner).departure;
        2.0 * powi(setting.radius, 2) * setting.tangential_stiffness * departure.abs()
    };
    Limits {
        clockwise: torque(Corner::S1),
        counter_clockwise: torque(Corner::S2),
    }
}

/// Tilt `theta_T^D = theta_0 - arctan mu` \[rad\] from which on a slide can open a contact, 2 if tilted counter-clockwise.
///
/// P 5.2.1. Zero or negative where a contact can open without tilt.
pub fn detachment_tilt(setting: &Setting) -> f64 {
    setting.half_angle - atan(setting.friction)
}

/// Friction below which neither contact opens in any slide while the centre has this acceleration, P 4.50.
///
/// The smaller one of contact 2, `(-x'' c_1 + (g + y'') s_1) / (x'' s_1 + (g + y'') c_1)`, which is printed, and of its
/// mirror image for contact 1. Zero if the acceleration alone opens a contact.
pub fn detachment_friction(setting: &Setting, acceleration: Acceleration) -> f64 {
    let down = setting.gravity + acceleration.y;
    let of = |angle: f64, sideways: f64| {
        let (sine, cosine) = sin_cos(angle);
        let (across, along) = (down * sine - sideways * cosine, down * cosine + sideways * sine);
        match (across > 0.0, along > 0.0) {
            (false, _) => 0.0,
            (true, false) => f64::INFINITY,
            (true, true) => across / along,
        }
    };
    of(setting.left_angle(), acceleration.x).min(of(setting.right_angle(), -acceleration.x))
}

/// Tilt `theta_S2` \[rad\] from which on a torque of this amplitude \[N m\] slides the disk counter-clockwise (P 5.2.2).
///
/// The solution of `A_e = A_S2(theta_T)`: `arccos(A_e / (A_0 sqrt(1 + mu^2))) - arctan mu`. Zero if `A_e >= A_0`, none if
/// the contacts open first.
pub fn critical_tilt(setting: &Setting, amplitude: f64) -> Option<f64> {
    let mu = setting.friction;
    let ratio = amplitude / (Limits::untilted(setting) * hypot(mu, 1.0));
    let tilt = (acos(ratio.min(1.0)) - atan(mu)).max(0.0);
    (tilt <= detachment_tilt(setting)).then_some(tilt)
}
