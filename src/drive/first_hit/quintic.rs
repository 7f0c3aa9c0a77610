//! First hit on a base that moves along a quintic.
//!
//! The gap is a polynomial of degree five of the delay. Its Bernstein control points over an interval bound it from both sides,
//! and it has at most as many roots there as they change sign: none without a change, exactly one with one. Intervals with
//! more changes are halved, the earlier half first, so that the root found is the first one.
//! Source: G. Farin, Curves and Surfaces for CAGD, chapter 6 (convex hull, variation diminishing, subdivision).

use super::FirstHit;
use crate::drive::FollowsInput;
use crate::drive::quintic::bernstein;
use crate::geometry::Flight;
use crate::geometry::bracketed_root::falling_root;

/// Times that an interval is halved: down to rounding.
const MOST_HALVINGS: u32 = 52;

impl FirstHit for FollowsInput {
    /// Infinity if there is no hit until the end of the present path.
    #[inline]
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64 {
        let end = self.path().end_time() - time;
        if end.is_nan() || end < 0.0 {
            return f64::INFINITY;
        }
        let base = self.path().expansion(time).map(|coefficient| -normal_up * coefficient);
        let mut gap = base;
        gap[0] = flight.gap.max(0.0);
        gap[1] = flight.velocity;
        gap[2] -= 0.5 * flight.pull;
        first_fall(&gap, end)
    }
}

/// First t in [0, `end`] at which the polynomial with coefficients of 1, t, ..., t^5 falls through zero, or infinity.
#[inline]
fn first_fall(coefficients: &[f64; 6], end: f64) -> f64 {
    let mut scale = 1.0;
    let scaled = coefficients.map(|coefficient| {
        let scaled = coefficient * scale;
        scale *= end;
        scaled
    });
    if scaled[0] > 0.0 {
        return end * first_root(&scaled);
    }
    // The disk leaves contact: what remains is of degree four, and the contact just left is no root of it.
    let rest: [f64; 5] = std::array::from_fn(|index| scaled[index + 1]);
    match rest.iter().find(|coefficient| **coefficient != 0.0) {
        Some(first) if *first < 0.0 => 0.0,
        Some(_) => end * first_root(&rest),
        None => f64::INFINITY,
    }
}

/// First u in (0, 1] from which a polynomial that is positive near 0 is negative, or infinity.
#[inline]
fn first_root<const COUNT: usize>(coefficients: &[f64; COUNT]) -> f64 {
    let controls = bernstein(coefficients);
    if controls.iter().all(|control| *control >= 0.0) {
        return f64::INFINITY;
    }
    isolate(coefficients, &controls, 0.0, 1.0, MOST_HALVINGS).unwrap_or(f64::INFINITY)
}

/// The first fall through zero between `low` and `high`, over which the polynomial has these control points.
fn isolate<const COUNT: usize>(
    coefficients: &[f64; COUNT],
    controls: &[f64; COUNT],
    low: f64,
    high: f64,
    halvings: u32,
) -> Option<f64> {
    let last = controls[COUNT - 1];
    match changes_of_sign(controls) {
        0 => return (last < 0.0).then_some(low),
        1 if last < 0.0 => return Some(falling_root(low, high, |u| value_and_slope(coefficients, u))),
        1 => return Some(low),
        _ => {}
    }
    let middle = 0.5 * (low + high);
    if halvings == 0 || middle <= low || middle >= high {
        return (last < 0.0).then_some(high);
    }
    let (left, right) = halve(controls);
    isolate(coefficients, &left, low, middle, halvings - 1)
        .or_else(|| isolate(coefficients, &right, middle, high, halvings - 1))
}

/// How often the signs of the numbers change, zeros left out.
fn changes_of_sign(numbers: &[f64]) -> usize {
    let signs = numbers
        .iter()
        .filter(|number| **number != 0.0)
        .map(|number| *number < 0.0);
    let later = signs.clone().skip(1);
    signs.zip(later).filter(|(one, other)| one != other).count()
}

/// Control points over both halves of the interval. Source: de Casteljau's algorithm.
fn halve<const COUNT: usize>(controls: &[f64; COUNT]) -> ([f64; COUNT], [f64; COUNT]) {
    let (mut left, mut right) = (*controls, *controls);
    for level in 1..COUNT {
        left[level - 1] = right[0];
        for index in 0..COUNT - level {
            right[index] = 0.5 * (right[index] + right[index + 1]);
        }
    }
    left[COUNT - 1] = right[0];
    (left, right)
}

fn value_and_slope<const COUNT: usize>(coefficients: &[f64; COUNT], u: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for coefficient in coefficients.iter().rev() {
        slope = slope * u + value;
        value = value * u + coefficient;
    }
    (value, slope)
}
