//! First hit on a base that moves along a cubic.
//!
//! The gap is a cubic too, `G(t) = d + w t + b t^2 + e t^3`, `b = -(a + n_y y'') / 2`, `e = -n_y y''' / 6`. Between the
//! roots of its derivative it is monotone, so that the first piece that ends below zero holds the first hit and no other.
//! A disk that leaves contact has d = 0, and what remains is a quadratic.

use super::FirstHit;
use crate::drive::{Drive, FollowsInput};
use crate::geometry::Flight;
use crate::geometry::bracketed_root::falling_root;

impl FirstHit for FollowsInput {
    /// Infinity if there is no hit until the end of the present cubic.
    #[inline]
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64 {
        let base = self.motion(time);
        let curving = -0.5 * (flight.pull + normal_up * base.acceleration);
        let bending = -normal_up * self.jerk() / 6.0;
        let gap = [flight.gap.max(0.0), flight.velocity, curving, bending];
        first_fall(gap, self.end_time() - time)
    }
}

/// First t in [0, `end`] at which the cubic with coefficients of 1, t, t^2, t^3 falls through zero, or infinity.
#[inline]
fn first_fall(coefficients: [f64; 4], end: f64) -> f64 {
    let [d, w, b, e] = coefficients;
    if d == 0.0 {
        let time = first_fall_from_contact(w, b, e);
        return if time <= end { time } else { f64::INFINITY };
    }
    let value = |t: f64| d + t * (w + t * (b + t * e));
    let (early, late) = two_roots(3.0 * e, 2.0 * b, w);
    let (mut low, mut low_value) = (0.0, d);
    for high in [early, late, end] {
        if high > low && high <= end {
            let high_value = value(high);
            if high_value < 0.0 && low_value >= 0.0 {
                return falling_root(low, high, |t| (value(t), w + t * (2.0 * b + t * 3.0 * e)));
            }
            (low, low_value) = (high, high_value);
        }
    }
    f64::INFINITY
}

/// First t >= 0 from which `t (w + b t + e t^2)` is negative.
#[inline]
fn first_fall_from_contact(w: f64, b: f64, e: f64) -> f64 {
    if w < 0.0 || w == 0.0 && (b < 0.0 || b == 0.0 && e < 0.0) {
        return 0.0;
    }
    let (early, late) = two_roots(e, b, w);
    if early > 0.0 {
        early
    } else if late > 0.0 {
        late
    } else {
        f64::INFINITY
    }
}

/// Roots of `a t^2 + b t + c` in order, without cancellation; NaN or infinity where there is none.
#[inline]
fn two_roots(a: f64, b: f64, c: f64) -> (f64, f64) {
    let discriminant = b * b - 4.0 * a * c;
    let sum = -0.5 * (b + discriminant.sqrt().copysign(b));
    let (first, second) = (sum / a, c / sum);
    if first < second {
        (first, second)
    } else {
        (second, first)
    }
}
