//! Mean angular velocity under a slow harmonic torque, in the closed form of P 5.9.

use crate::elementary::{asin, cos, sin};
use std::f64::consts::{PI, TAU};

use super::slide::{HarmonicTorque, slide};
use super::{Limits, Setting};

/// Mean angular velocity \[rad/s\] of P 5.9 with the phases of rest solved, if the disk rests between slides.
///
/// `((A_S2 - T(t_s2))^2 / A_S2 - (A_S1 + T(t_s1))^2 / A_S1) / (2 pi m R^2 omega_e)`, each term only if the amplitude passes
/// its limit. `None` beyond [`closed_form_range`]: there [`super::cycle`] goes on. Limits must be positive.
pub fn closed_form(setting: &Setting, limits: &Limits, torque: HarmonicTorque) -> Option<f64> {
    if !rests_between_slides(limits, torque.amplitude) {
        return None;
    }
    let term = |limit: f64| {
        if torque.amplitude <= limit {
            return 0.0;
        }
        let start = asin(limit / torque.amplitude);
        let end = start + slide(torque.amplitude, limit, start).duration;
        // A_S - T(t_s) = A (sin psi_0 - sin psi_s), without the loss of digits of short slides.
        let missing = -2.0 * torque.amplitude * cos(0.5 * (start + end)) * sin(0.5 * (end - start));
        missing * missing / limit
    };
    let square = setting.mass * setting.radius * setting.radius;
    Some((term(limits.counter_clockwise) - term(limits.clockwise)) / (TAU * square * torque.angular_frequency))
}

/// Largest amplitude \[N m\] at which the disk comes to rest before the torque passes the other limit.
///
/// Without tilt `1.862 A_S`: there `tan psi_0 = 2 / pi`, and a slide lasts half a period.
pub fn closed_form_range(limits: &Limits) -> f64 {
    let (mut low, mut high) = (limits.upper(), 4.0 * limits.upper());
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if rests_between_slides(limits, middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Whether each slide ends before the torque passes the limit of the other sense, or its own limit again.
fn rests_between_slides(limits: &Limits, amplitude: f64) -> bool {
    let ends_in_time = |own: f64, other: f64| {
        if amplitude <= own {
            return true;
        }
        let start = asin(own / amplitude);
        let other_way = if amplitude > other {
            PI + asin(other / amplitude)
        } else {
            TAU + start
        };
        start + slide(amplitude, own, start).duration <= other_way
    };
    ends_in_time(limits.counter_clockwise, limits.clockwise) && ends_in_time(limits.clockwise, limits.counter_clockwise)
}
