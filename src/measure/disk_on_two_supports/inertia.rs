//! What inertia adds to a slide, to first order in `m omega_e^2 / k_n` and `m omega_e^2 / k_t`.
//!
//! Soft contacts let the disk follow the torque. When the last contact begins to slide the centre moves at
//! `v ~ T' / (R k_n)`, and the disk rolls on the contact that still sticks and winds up its tangential spring:
//! `omega = -(v.t + tau' / k_t) / R`. In the slide the centre
//! comes to rest: the normal forces deliver the impulse `-m v`, and with them friction an angular impulse. Both together
//! are an angular velocity with which the slide starts, and over its duration they turn the disk on. The relative effect is
//! `m omega_e^2 / (k_n (A_e / A_S - 1))`: largest just above a limit.

use super::slide::{HarmonicTorque, slide};
use super::{Corner, Limits, Setting, closed_form};
use crate::elementary::{asin, cos, sin_cos};

/// P 5.9 with the inertia of the disk \[rad/s\], for contacts of stiffness `normal_stiffness` \[N/m\].
///
/// `limits` should be those of the same contacts, [`super::Relaxed::limits`]. `None` where [`closed_form`] is. It holds if
/// slides and rests last much longer than the oscillations of the disk on its contacts, of rate `gamma_n / (2 m)`, and
/// assumes that the weaker contact slides before both do, which it does once the torque has been strong enough in both senses.
/// The next order is the square of the correction's relative size.
pub fn closed_form_with_inertia(
    setting: &Setting,
    limits: &Limits,
    normal_stiffness: f64,
    torque: HarmonicTorque,
) -> Option<f64> {
    let without = closed_form(setting, limits, torque)?;
    let more = |corner, limit: f64| {
        if torque.amplitude <= limit {
            return 0.0;
        }
        let start = asin(limit / torque.amplitude);
        let rate = torque.amplitude * cos(start) * torque.angular_frequency;
        // Per period: velocity times duration / omega_e, over 2 pi / omega_e.
        kick(setting, normal_stiffness, corner) * rate * slide(torque.amplitude, limit, start).duration
    };
    let forth = more(Corner::S2, limits.counter_clockwise);
    let back = more(Corner::S1, limits.clockwise);
    Some(without + (forth - back) / std::f64::consts::TAU)
}

/// Angular velocity at the start of a slide over the rate of the torque's size then \[rad/s per N m/s\], in the sense of the
/// slide, at S1 or S2.
pub(super) fn kick(setting: &Setting, normal_stiffness: f64, corner: Corner) -> f64 {
    // A disk tilted clockwise is the mirror image: contacts and senses change places.
    if setting.tilt < 0.0 {
        let other = if corner == Corner::S1 { Corner::S2 } else { Corner::S1 };
        return kick(&setting.tilted(-setting.tilt), normal_stiffness, other);
    }
    // Counter-clockwise torque grows at S2, where tau = -mu n; clockwise at S1, where tau = mu n.
    let (slope, rate) = if corner == Corner::S2 {
        (-setting.friction, 1.0)
    } else {
        (setting.friction, -1.0)
    };
    let (s_1, c_1) = sin_cos(setting.left_angle());
    let (s_2, c_2) = sin_cos(setting.right_angle());
    let (s_12, c_12) = sin_cos(2.0 * setting.half_angle);
    // Rates of P 4.29 and 4.30 with R (tau_1 + tau_2) = -T, contact 2 sliding already; without tilt neither does.
    let both = -rate / setting.radius;
    let tau_2 = if setting.tilt > 0.0 {
        slope * both / (s_12 + slope * (1.0 - c_12))
    } else {
        0.5 * both
    };
    let tau_1 = both - tau_2;
    let n_1 = (-tau_1 * c_12 - tau_2) / s_12;
    let n_2 = (tau_1 + tau_2 * c_12) / s_12;
    // Velocity of the centre: the overlaps n / k_n grow along the lines of centres (s_1, c_1) and (-s_2, c_2).
    let (a, b) = (-n_1 / normal_stiffness, -n_2 / normal_stiffness);
    let (x, y) = ((a * c_2 - b * c_1) / s_12, (a * s_2 + b * s_1) / s_12);
    let rolling = -(x * c_1 - y * s_1 + tau_1 / setting.tangential_stiffness) / setting.radius;
    // Impulses along (s_1, c_1) + slope (c_1, -s_1) and (-s_2, c_2) + slope (c_2, s_2) that stop the centre.
    let first = (s_1 + slope * c_1, c_1 - slope * s_1);
    let second = (-s_2 + slope * c_2, c_2 + slope * s_2);
    let determinant = first.0 * second.1 - second.0 * first.1;
    let (p_x, p_y) = (-setting.mass * x, -setting.mass * y);
    let impulses = (p_x * second.1 - second.0 * p_y + first.0 * p_y - p_x * first.1) / determinant;
    let braked = setting.radius * slope * impulses / setting.inertia();
    rate * (rolling + braked)
}
