//! Fixed base with a random phase: velocity of approach in, velocity of the base at the impact out (P 2.3.3).
//!
//! The base stays at its rest position for the geometry; at an impact it moves as a sinusoidal base does where a line of
//! slope v_n, thrown at a random instant, first meets it. With the phase tau, `V = A omega n_y` and `x = |v_n| / V` the
//! line meets the base where `sin tau + x tau = K`, K even over a span of 2 pi x (lines are even in time), and only the
//! first meeting counts. The last phase that can be met is `tau_A = acos(-x)` (pi for x >= 1), where the line is tangent;
//! from there backwards `delta = tau_A - tau` obeys
//! ```text
//! sin(tau_A) (1 - cos delta) + m (delta - sin delta) + (x - m) delta = 2 pi x U,   m = min(x, 1), U even in (0, 1)
//! ```
//! whose left side grows up to `2 tau_A`, so that there is one root and it is the visible one. This is exact:
//! no fit as in P 2.41, and the base is met at its top, with velocity zero, as v_n goes to zero.

use std::f64::consts::{PI, TAU};

use rand::Rng;
use serde::{Deserialize, Serialize};

use crate::elementary::{acos, sin_cos};
use crate::geometry::bracketed_root::falling_root_near;

/// Sinusoidal base in the fixed-bottom, random-phase approximation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RandomPhase {
    /// Largest velocity of the base, `A omega` \[m/s\], upward and downward.
    pub peak_velocity: f64,
}

/// Draws after which no velocity of the base can be right: with any restitution more than half of them are.
const MOST_DRAWS: usize = 1_000;

impl RandomPhase {
    /// Vertical velocity of the base \[m/s\] at an impact with normal velocity v_n \[m/s\], negative on approach.
    ///
    /// `normal_up` = n_y is the vertical part of the wall's normal. The velocity is to be projected on both the normal
    /// and the tangent of the wall: the disk meets the wall with `u_n = v_n - v_b n_y`, `u_t = ... - v_b t_y`.
    /// Source: P 2.37 to 2.40; density `k (v_b - v_n) / (2 pi |v_n| sqrt(V^2 - v_b^2))` on a horizontal wall.
    #[inline]
    pub fn sample(&self, generator: &mut impl Rng, normal_velocity: f64, normal_up: f64) -> f64 {
        let peak = self.peak_velocity * normal_up.abs();
        if peak == 0.0 {
            return 0.0;
        }
        // Odd multiples of 2^-54: neither 0 nor 1 is ever drawn.
        let even = ((generator.next_u64() >> 11) as f64 + 0.5) * (0.5 / (1_u64 << 52) as f64);
        let cosine = cosine_of_phase(normal_velocity.abs() / peak, even);
        // The wall moves along its normal by n_y times the base: a ceiling comes to meet the disk going down.
        self.peak_velocity * if normal_up > 0.0 { cosine } else { -cosine }
    }

    /// As [`RandomPhase::sample`], drawn again while `leaves` refuses: a velocity of the base \[m/s\] after which the disk
    /// would still move into the wall. None if it refuses a thousand in a row, as at rest (v_n = 0) it may.
    #[inline]
    pub fn sample_leaving(
        &self,
        generator: &mut impl Rng,
        normal_velocity: f64,
        normal_up: f64,
        mut leaves: impl FnMut(f64) -> bool,
    ) -> Option<f64> {
        (0..MOST_DRAWS)
            .map(|_| self.sample(generator, normal_velocity, normal_up))
            .find(|velocity| leaves(*velocity))
    }
}

/// Whether a disk leaves a wall at rest: `(1 + e_n) v_b n_y - e_n v_n > 0` with v_n < 0 and the base's v_b (P 2.11).
#[inline]
pub fn leaves_wall(restitution: f64, normal_velocity: f64, base_velocity: f64, normal_up: f64) -> bool {
    (1.0 + restitution) * base_velocity * normal_up > restitution * normal_velocity
}

/// cos tau where a line of scaled slope `ratio` x >= 0 meets the base, `even` U in (0, 1).
#[inline]
fn cosine_of_phase(ratio: f64, even: f64) -> f64 {
    if ratio == 0.0 {
        return 0.0;
    }
    let tangent = ratio.min(1.0); // m
    let sine = ((1.0 - tangent) * (1.0 + tangent)).sqrt(); // sin tau_A
    let last = if ratio < 1.0 { acos(-tangent) } else { PI }; // tau_A
    let excess = ratio - tangent;
    let target = TAU * ratio * even;
    // The left side bends up until delta = tau_A, where it is sin tau_A + x tau_A, and down from there: Newton's method
    // started near this point or between it and the root converges.
    let middle = sine + ratio * last;
    let guess = if ratio >= 1.0 {
        TAU * even
    } else if target < middle {
        last * (target / middle).sqrt()
    } else {
        last
    };
    let delta = falling_root_near(0.0, 2.0 * last, guess, |delta| {
        let (half_sine, half_cosine) = sin_cos(0.5 * delta);
        let lower = 2.0 * half_sine * half_sine; // 1 - cos delta
        let full_sine = 2.0 * half_sine * half_cosine;
        let lag = if delta < 0.3 {
            cubic_lag(delta)
        } else {
            delta - full_sine
        };
        (
            target - (sine * lower + tangent * lag + excess * delta),
            -(sine * full_sine + tangent * lower + excess),
        )
    });
    let (full_sine, cosine) = sin_cos(delta);
    sine * full_sine - tangent * cosine
}

/// `delta - sin delta` for small delta.
#[inline]
fn cubic_lag(delta: f64) -> f64 {
    let q = delta * delta;
    delta * q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0 * (1.0 - q / 72.0 * (1.0 - q / 110.0))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_met_at_its_top_when_nothing_moves() {
        assert_eq!(cosine_of_phase(0.0, 0.3), 0.0);
        for ratio in [1e-12, 1e-8, 1e-4] {
            // Near the top sin tau is a parabola: cos tau = sqrt(4 pi x U) to lowest order.
            let expected = (4.0 * PI * ratio * 0.3_f64).sqrt();
            assert!((cosine_of_phase(ratio, 0.3) / expected - 1.0).abs() < 2.0 * ratio.sqrt());
        }
    }

    #[test]
    fn every_phase_is_met_by_fast_disks() {
        assert!((cosine_of_phase(1e9, 0.25) - (0.75 * TAU).cos()).abs() < 1e-8);
        assert!((cosine_of_phase(1e300, 0.125) + (0.125 * TAU).cos()).abs() < 1e-15);
    }

    /// The first meeting, found by scanning the line from far above.
    #[test]
    fn the_first_meeting_is_taken() {
        for ratio in [0.01, 0.1, 0.217, 0.5, 0.9, 1.0, 1.7, 10.0_f64] {
            for step in 0..40 {
                let even = (f64::from(step) + 0.5) / 40.0;
                let last = (-ratio.min(1.0)).acos();
                let line = last.sin() + ratio * last - TAU * ratio * even;
                let mut tau = -3.0 * PI;
                while tau.sin() + ratio * tau < line {
                    tau += 1e-4;
                }
                assert!(
                    (tau.cos() - cosine_of_phase(ratio, even)).abs() < 2e-4,
                    "x {ratio}, U {even}"
                );
            }
        }
    }
}
