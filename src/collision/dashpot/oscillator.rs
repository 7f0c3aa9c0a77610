//! Normal motion during an impact of the linear dashpot: damping ratio and time in, overlap rate and force out.
//!
//! Units of this folder: time in `sqrt(m_eff / k_n)`, velocities in |u_n|. The overlap x obeys `x'' + 2 c x' + x = 0`,
//! `x(0) = 0`, `x'(0) = 1`; the force is `N = x + 2 c x' = -x''`, and with `v = x'` the pair obeys
//! `v' = -N`, `N' = v - 2 c N`. Source: P 4.52 to 4.54 with `delta'(0) = -u_n`.

use crate::contact::LinearDashpot;
use crate::elementary::{atan2, atanh, cosh, exp, sin_cos, sinh};

/// Damped oscillation in closed form, for any damping ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Oscillator {
    /// Damping ratio c.
    pub damping: f64,
    /// `1 - c^2`, negative when over-damped.
    discriminant: f64,
    /// `sqrt |1 - c^2|`.
    frequency: f64,
    /// Time at which the force vanishes and the contact ends.
    pub duration: f64,
    /// `e_n = -v(duration)`.
    pub restitution: f64,
}

/// Where the normal motion is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Normal {
    /// v, the rate of the overlap: 1 at touch, `-e_n` at the end.
    pub velocity: f64,
    /// N >= 0.
    pub force: f64,
}

impl Oscillator {
    pub fn new(damping: f64) -> Self {
        let discriminant = (1.0 - damping) * (1.0 + damping);
        Self {
            damping,
            discriminant,
            frequency: discriminant.abs().sqrt(),
            duration: LinearDashpot::scaled_duration(damping),
            restitution: LinearDashpot::restitution_at(damping),
        }
    }

    /// Normal motion at `time` since touch.
    #[inline]
    pub fn at(&self, time: f64) -> Normal {
        let decay = exp(-self.damping * time);
        let square = self.discriminant * time * time;
        let (sine, cosine) = if square.abs() < 1e-2 {
            // sin(w t) / w and cos(w t) by their series in w^2, through critical damping.
            let sine = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)));
            let cosine = 1.0
                - square / 2.0
                    * (1.0 - square / 12.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0 * (1.0 - square / 90.0))));
            (time * sine, cosine)
        } else if self.discriminant > 0.0 {
            let (sine, cosine) = sin_cos(self.frequency * time);
            (sine / self.frequency, cosine)
        } else {
            let angle = self.frequency * time;
            (sinh(angle) / self.frequency, cosh(angle))
        };
        Normal {
            velocity: decay * (cosine - self.damping * sine),
            force: decay * (2.0 * self.damping * cosine + (1.0 - 2.0 * self.damping * self.damping) * sine),
        }
    }

    /// Rate of the force.
    #[inline]
    pub fn force_rate(&self, normal: Normal) -> f64 {
        normal.velocity - 2.0 * self.damping * normal.force
    }

    /// First positive time after which a solution y of `y'' + 2 c y' + y = 0` turns, from its value and rate now.
    ///
    /// `y'` is proportional to `y'(0) cos(w t) - (y(0) + c y'(0)) sin(w t) / w`. Returns none if it never turns.
    pub fn turns_after(&self, value: f64, rate: f64) -> Option<f64> {
        let slope = value + self.damping * rate;
        let ratio = rate / slope;
        let square = self.discriminant * ratio * ratio;
        let time = if square.abs() < 1e-6 && ratio > 0.0 {
            ratio * (1.0 - square / 3.0 * (1.0 - 0.6 * square))
        } else if self.discriminant > 0.0 {
            let angle = atan2(self.frequency * rate, slope);
            let angle = if angle > 0.0 {
                angle
            } else {
                angle + std::f64::consts::PI
            };
            angle / self.frequency
        } else {
            atanh(self.frequency * ratio) / self.frequency
        };
        (time > 0.0).then_some(time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contact_ends_when_the_force_vanishes() {
        for c in [0.0, 1e-9, 0.02, 0.5, 0.707, 0.95, 0.9999, 1.0, 1.0001, 1.05, 1.2, 3.0] {
            let oscillator = Oscillator::new(c);
            let end = oscillator.at(oscillator.duration);
            assert!(end.force.abs() < 1e-14, "c = {c}: {end:?}");
            assert!(
                (end.velocity + oscillator.restitution).abs() < 1e-14,
                "c = {c}: {end:?}"
            );
        }
    }

    #[test]
    fn turning_points_have_no_slope() {
        for c in [0.0, 0.3, 0.9999, 1.0, 1.0001, 1.2] {
            let oscillator = Oscillator::new(c);
            // v is a solution with v(0) = 1 and v'(0) = -2 c; N one with N(0) = 2 c and N'(0) = 1 - 4 c^2.
            if let Some(time) = oscillator.turns_after(1.0, -2.0 * c) {
                assert!(oscillator.at(time).force.abs() < 1e-14, "c = {c}");
            }
            if let Some(time) = oscillator.turns_after(2.0 * c, 1.0 - 4.0 * c * c) {
                assert!(oscillator.force_rate(oscillator.at(time)).abs() < 1e-14, "c = {c}");
            }
        }
    }
}
