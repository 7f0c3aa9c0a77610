//! One slide under a harmonic torque, from rest to rest (P 5.6 to 5.8).
//!
//! In the phase `psi = omega_e t` and from rest at `psi_0`, with resistance L:
//!
//! `I omega_e omega(psi) = A (cos psi_0 - cos psi) - L (psi - psi_0)`
//!
//! P writes it for slides that begin where the torque passes the limit, `A sin psi_0 = L`. A disk that has just been
//! stopped may set off in the opposite sense at any phase, hence the general `psi_0`.

use std::f64::consts::{PI, TAU};

use crate::elementary::{asin, cos, sin};
use crate::geometry::bracketed_root::falling_root;

/// `A_e sin(omega_e t)`, P 5.1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HarmonicTorque {
    /// `A_e` \[N m\], positive.
    pub amplitude: f64,
    /// `omega_e` \[rad/s\], positive.
    pub angular_frequency: f64,
}

/// A slide from rest to rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slide {
    /// Phase gone through while sliding, `omega_e t_s` \[rad\].
    pub duration: f64,
    /// `I omega_e^2` times the angle turned in the sense of the slide \[N m\].
    pub turn: f64,
}

/// The slide in the sense of the torque `amplitude sin(psi)` against `resistance` that starts from rest at `start`.
///
/// Phase in rad, torques in N m. It needs `amplitude sin(start) >= resistance > 0`, and rising if equal; `start` in
/// (0, pi). Exact to rounding; for `amplitude` just above `resistance` the relative error is
/// 1e-16 / (amplitude / resistance - 1).
pub fn slide(amplitude: f64, resistance: f64, start: f64) -> Slide {
    // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2) keeps the digits of short slides.
    let speed = |x: f64| 2.0 * amplitude * sin(start + 0.5 * x) * sin(0.5 * x) - resistance * x;
    let gain = |x: f64| amplitude * sin(start + x) - resistance;
    // Speed falls from where the torque sinks below the resistance until it rises above it again, a period apart.
    let balance = asin((resistance / amplitude).min(1.0));
    let (fastest, slowest) = (PI - balance - start, TAU + balance - start);
    // Each period takes 2 pi L from the speed: so many more go by before it can vanish.
    let more = TAU * (speed(slowest) / (TAU * resistance)).ceil().max(0.0);
    let duration = falling_root((fastest + more).max(0.0), slowest + more, |x| (speed(x), gain(x)));
    Slide {
        duration,
        turn: turn(amplitude, start, duration),
    }
}

/// `I omega_e^2` times the angle: the integral of the speed over a slide of the duration x that ends at rest.
///
/// `A (x cos psi_0 - sin(psi_0 + x) + sin psi_0) - L x^2 / 2` (P 5.8), where `L x = 2 A sin(mid) sin(x / 2)` since the
/// speed is zero at the end, is `A cos(mid) (x cos(x / 2) - 2 sin(x / 2))` with `mid = psi_0 + x / 2`.
fn turn(amplitude: f64, start: f64, x: f64) -> f64 {
    let half = 0.5 * x;
    let lag = if x < 0.1 {
        // -x^3/12 + x^5/480 - x^7/53760 + x^9/11612160; the next term is below rounding.
        let square = x * x;
        -x * square / 12.0 * (1.0 - square / 40.0 * (1.0 - square / 112.0 * (1.0 - square / 216.0)))
    } else {
        x * cos(half) - 2.0 * sin(half)
    };
    amplitude * cos(start + half) * lag
}
