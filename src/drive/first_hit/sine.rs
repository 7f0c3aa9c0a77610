//! First hit on a sinusoidal base.
//!
//! The gap is `G(t) = d + w t - a t^2 / 2 - B (s (cos x - 1) + c (sin x - x))`, `x = omega t`, with B = A n_y and s, c the
//! sine and cosine of the phase at the start. Because `G'' >= -(a + |B| omega^2)` and `|G'''| <= |B| omega^3`, a parabola
//! and a cubic below G are known at every instant. The march steps to the later of their roots: it
//! cannot pass a root of G, and near a simple root it converges like Newton's method. While the disk is above the band
//! that the base sweeps, the march jumps to where it enters it.

use std::f64::consts::TAU;

use super::FirstHit;
use crate::drive::Sine;
use crate::elementary::{powi, sin_cos};
use crate::geometry::{Flight, disk_wall};

/// More than any march takes (some tens); what is left then is a hover within rounding of a touch.
const MOST_STEPS: usize = 100_000;

/// Gap and its derivatives.
#[derive(Debug, Clone, Copy)]
struct Gap {
    value: f64,
    rate: f64,
    curvature: f64,
}

/// Gap as a function of the delay.
#[derive(Debug, Clone, Copy)]
struct March {
    flight: Flight,
    /// B \[m\].
    amplitude: f64,
    angular_frequency: f64,
    sine: f64,
    cosine: f64,
}

impl FirstHit for Sine {
    #[inline]
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64 {
        let amplitude = self.amplitude * normal_up;
        let angular_frequency = TAU * self.frequency;
        if amplitude == 0.0 || angular_frequency == 0.0 {
            return disk_wall(flight);
        }
        if flight.gap <= 0.0 && flight.velocity < 0.0 {
            return 0.0;
        }
        let (sine, cosine) = sin_cos(TAU * (self.frequency * time).fract() + self.phase);
        March {
            flight: Flight {
                gap: flight.gap.max(0.0),
                ..*flight
            },
            amplitude,
            angular_frequency,
            sine,
            cosine,
        }
        .first_hit()
    }
}

impl March {
    fn first_hit(&self) -> f64 {
        let Self {
            amplitude,
            sine,
            cosine,
            ..
        } = *self;
        let omega = self.angular_frequency;
        let pull = self.flight.pull;
        let size = amplitude.abs();
        let fall = (pull + size * omega * omega).max(0.0);
        let jerk = size * powi(omega, 3);
        // Gap to the highest position of the base, at rest.
        let above = self.flight.gap - (size - amplitude * sine);
        let sinking = self.flight.velocity + amplitude * omega * cosine;
        let mut time = 0.0;
        for step in 0..MOST_STEPS {
            let gap = self.at(time);
            if step > 0 && gap.value <= 0.0 {
                return time;
            }
            let mut next = time + safe_step(gap, fall, jerk);
            let clear = above + time * (sinking - 0.5 * pull * time);
            if clear > 0.0 {
                next = next.max(
                    time + disk_wall(&Flight {
                        gap: clear,
                        velocity: sinking - pull * time,
                        pull,
                    }),
                );
            }
            if next == f64::INFINITY {
                return next;
            }
            if next <= time {
                // Only at a touch without velocity and without acceleration does the next derivative, B omega^3 c, decide.
                let parting = amplitude * cosine;
                if step > 0 || gap.curvature != 0.0 || gap.value > 0.0 || parting <= 0.0 {
                    return time;
                }
                next = 4.0 * parting / (size * omega);
            }
            time = next;
        }
        time
    }

    #[inline]
    fn at(&self, time: f64) -> Gap {
        let Self {
            flight: Flight { gap, velocity, pull },
            amplitude,
            angular_frequency,
            sine,
            cosine,
        } = *self;
        let x = angular_frequency * time;
        let (half_sine, half_cosine) = sin_cos(0.5 * x);
        let lower = -2.0 * half_sine * half_sine; // cos x - 1
        let full_sine = 2.0 * half_sine * half_cosine;
        let lag = if x < 0.5 {
            let q = x * x;
            let series = 1.0 - q / 42.0 * (1.0 - q / 72.0 * (1.0 - q / 110.0 * (1.0 - q / 156.0)));
            -x * q / 6.0 * (1.0 - q / 20.0 * series)
        } else {
            full_sine - x
        };
        Gap {
            value: gap + time * (velocity - 0.5 * pull * time) - amplitude * (sine * lower + cosine * lag),
            rate: velocity - pull * time - amplitude * angular_frequency * (cosine * lower - sine * full_sine),
            curvature: amplitude * powi(angular_frequency, 2) * (sine * (1.0 + lower) + cosine * full_sine) - pull,
        }
    }
}

/// Delay within which `G >= G_0 + G_0' h - fall h^2 / 2` and `G >= G_0 + G_0' h + G_0'' h^2 / 2 - jerk h^3 / 6` exclude a root.
#[inline]
fn safe_step(gap: Gap, fall: f64, jerk: f64) -> f64 {
    let Gap { value, rate, curvature } = gap;
    // While the gap curves up for certain, it stays above its tangent.
    let curving = (3.0 * curvature / jerk).max(0.0);
    let root = (rate * rate + 2.0 * fall * value).sqrt();
    if rate < 0.0 {
        let parabola = 2.0 * value / (root - rate);
        parabola.max(curving.min(-value / rate))
    } else if fall > 0.0 {
        ((rate + root) / fall).max(curving)
    } else {
        f64::INFINITY
    }
}
