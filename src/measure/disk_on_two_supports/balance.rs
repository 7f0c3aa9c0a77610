//! Newton's equations for the centre of the disk (P 4.23, 4.24), solved for the normal forces.

use super::Setting;
use crate::elementary::sin_cos;

/// Acceleration of the centre of the disk \[m/s2\]. [`Acceleration::default`] is the quasi-static case.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Acceleration {
    /// To the right.
    pub x: f64,
    /// Upwards.
    pub y: f64,
}

/// Tangential forces on the disk, counter-clockwise positive \[N\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangential {
    /// `tau_1`, at the left contact.
    pub left: f64,
    /// `tau_2`, at the right contact.
    pub right: f64,
}

/// `w_1`, `w_2` of P 4.27 and 4.28 \[N\]: `sin(2 theta_0)` times the normal forces without tangential ones.
pub(super) fn loads(setting: &Setting, acceleration: Acceleration) -> (f64, f64) {
    let (s_1, c_1) = sin_cos(setting.left_angle());
    let (s_2, c_2) = sin_cos(setting.right_angle());
    let sideways = setting.mass * acceleration.x;
    let down = setting.mass * (setting.gravity + acceleration.y);
    (sideways * c_2 + down * s_2, -sideways * c_1 + down * s_1)
}

/// Normal forces at contacts 1 and 2 \[N\] that keep the centre on its acceleration, P 4.29 and 4.30.
///
/// `s_12 n_1 = w_1 - tau_1 c_12 - tau_2`, `s_12 n_2 = w_2 + tau_1 + tau_2 c_12`. Negative where a contact would have to
/// pull: it has opened.
pub fn normal_forces(setting: &Setting, acceleration: Acceleration, tangential: Tangential) -> (f64, f64) {
    let (w_1, w_2) = loads(setting, acceleration);
    let (s_12, c_12) = sin_cos(2.0 * setting.half_angle);
    let Tangential { left, right } = tangential;
    ((w_1 - left * c_12 - right) / s_12, (w_2 + left + right * c_12) / s_12)
}
