//! Normal force of the linear dashpot with cut-off at zero (P 4.2).

use super::{NormalForce, Numbers};
use crate::elementary::{acos, acosh, exp};
use crate::geometry::bracketed_root::falling_root;

/// Linear spring and dashpot that push and never pull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearDashpot {
    /// Normal stiffness k_n \[N/m\].
    pub stiffness: f64,
    /// Normal damping gamma_n \[kg/s\].
    pub damping: f64,
}

impl LinearDashpot {
    /// Normal force \[N\], `max(k_n delta - gamma_n u_n, 0)`.
    ///
    /// `overlap` delta \[m\] > 0; `normal_velocity` u_n \[m/s\] negative on approach. Source: P 4.2.
    #[inline]
    pub fn force(&self, overlap: f64, normal_velocity: f64) -> f64 {
        let force = self.stiffness * overlap - self.damping * normal_velocity;
        if force > 0.0 { force } else { 0.0 }
    }

    /// Power \[W\] that a contact turns to heat: what the spring gives up and the disks do not get.
    ///
    /// `(k_n delta - n) u_n`, which is `gamma_n u_n^2` unless the cut-off holds the force at zero.
    #[inline]
    pub fn dissipated_power(&self, overlap: f64, normal_velocity: f64, force: f64) -> f64 {
        (self.stiffness * overlap - force) * normal_velocity
    }

    /// Energy \[J\] stored in the spring.
    #[inline]
    pub fn energy(&self, overlap: f64) -> f64 {
        0.5 * self.stiffness * overlap * overlap
    }

    /// Damping ratio c of a contact of effective mass m \[kg\]: `c = gamma_n / (2 sqrt(k_n m))`.
    pub fn damping_ratio(&self, effective_mass: f64) -> f64 {
        self.damping / (2.0 * (self.stiffness * effective_mass).sqrt())
    }

    /// Coefficient of normal restitution e_n of an undisturbed head-on impact of effective mass m \[kg\].
    ///
    /// See [`LinearDashpot::restitution_at`].
    pub fn restitution(&self, effective_mass: f64) -> f64 {
        Self::restitution_at(self.damping_ratio(effective_mass))
    }

    /// Coefficient of normal restitution e_n at the damping ratio c >= 0.
    ///
    /// `exp(-2 c acos(c) / sqrt(1 - c^2))` for c < 1, `exp(-2 c acosh(c) / sqrt(c^2 - 1))` for c > 1, `e^-2` at c = 1.
    /// The contact ends when the force vanishes. Source: P 4.56 (in a form without its singularities), Schwager and
    /// Poeschel 2007.
    pub fn restitution_at(damping_ratio: f64) -> f64 {
        exp(-damping_ratio * Self::scaled_duration(damping_ratio))
    }

    /// Damping ratio c >= 0 at which the restitution is e_n in (0, 1].
    ///
    /// The inverse of [`LinearDashpot::restitution_at`], by bisection to rounding.
    pub fn damping_ratio_for(restitution: f64) -> f64 {
        if restitution >= 1.0 {
            return 0.0;
        }
        // Above critical damping e_n > 1 / (2 c)^2 / e^2: there the bracket ends.
        let most = 1.0 + 1.0 / restitution.sqrt();
        falling_root(0.0, most, |c| (Self::restitution_at(c) - restitution, 0.0))
    }

    /// Time for which an impact presses, in units of `sqrt(m / k_n)`, at the damping ratio c >= 0.
    ///
    /// `2 acos(c) / sqrt(1 - c^2)` for c < 1, `2 acosh(c) / sqrt(c^2 - 1)` for c > 1, 2 at c = 1. Source: P 4.55.
    pub fn scaled_duration(damping_ratio: f64) -> f64 {
        let c = damping_ratio;
        let departure = c - 1.0;
        // acos(c)/sqrt(1-c^2) = 1 - (c-1)/3 + 2 (c-1)^2/15 - 2 (c-1)^3/35 + ... on both sides of 1, where the closed
        // form is 0/0.
        let arc = if departure.abs() < 1e-4 {
            1.0 - departure * (1.0 / 3.0 - departure * (2.0 / 15.0 - departure * (2.0 / 35.0)))
        } else if c < 1.0 {
            acos(c) / ((1.0 - c) * (1.0 + c)).sqrt()
        } else {
            acosh(c) / ((c - 1.0) * (c + 1.0)).sqrt()
        };
        2.0 * arc
    }
}

impl NormalForce for LinearDashpot {
    fn constants(&self) -> [f64; 2] {
        [self.stiffness, self.damping]
    }

    #[inline(always)]
    fn elastic<T: Numbers>([stiffness, _]: [T; 2], overlap: T) -> T {
        stiffness * overlap
    }

    #[inline(always)]
    fn viscous<T: Numbers>([_, damping]: [T; 2], _overlap: T, normal_velocity: T) -> T {
        damping * normal_velocity
    }

    #[inline]
    fn energy(&self, overlap: f64) -> f64 {
        LinearDashpot::energy(self, overlap)
    }

    fn stiffness(&self) -> f64 {
        self.stiffness
    }

    fn damping(&self) -> f64 {
        self.damping
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_force_is_never_attractive() {
        let law = LinearDashpot {
            stiffness: 1e4,
            damping: 0.1,
        };
        assert_eq!(law.force(1e-3, 0.0), 10.0);
        assert_eq!(law.force(1e-6, 1.0), 0.0);
    }

    /// The three branches of P 4.56 as printed, away from their singular points.
    #[test]
    fn agrees_with_the_printed_branches() {
        for c in [0.01_f64, 0.3, 0.7, 0.72, 0.9, 0.99, 1.01, 1.5, 4.0] {
            let law = LinearDashpot {
                stiffness: 1.0,
                damping: 2.0 * c,
            };
            let printed = if c < std::f64::consts::FRAC_1_SQRT_2 {
                let s = (1.0 - c * c).sqrt();
                (-c / s * (std::f64::consts::PI - (2.0 * c * s / (1.0 - 2.0 * c * c)).atan())).exp()
            } else if c < 1.0 {
                let s = (1.0 - c * c).sqrt();
                (c / s * (2.0 * c * s / (1.0 - 2.0 * c * c)).atan()).exp()
            } else {
                let s = (c * c - 1.0).sqrt();
                (-c / s * ((c + s) / (c - s)).ln()).exp()
            };
            assert!((law.restitution(1.0) - printed).abs() < 1e-13, "c = {c}");
        }
    }

    #[test]
    fn damping_gives_the_restitution_that_was_asked_for() {
        for restitution in [1e-6, 0.01, 0.1, 0.5, 0.9, 0.999_999, 1.0] {
            let c = LinearDashpot::damping_ratio_for(restitution);
            assert!(
                (LinearDashpot::restitution_at(c) / restitution - 1.0).abs() < 1e-12,
                "{restitution}"
            );
        }
    }

    #[test]
    fn the_restitution_is_smooth_through_critical_damping() {
        let at = |c: f64| {
            LinearDashpot {
                stiffness: 1.0,
                damping: 2.0 * c,
            }
            .restitution(1.0)
        };
        assert!((at(1.0) - (-2.0_f64).exp()).abs() < 1e-15);
        // The series meets the closed form where they hand over.
        for edge in [1.0 - 1e-4, 1.0 + 1e-4] {
            assert!((at(edge * (1.0 - 1e-9)) - at(edge * (1.0 + 1e-9))).abs() < 1e-9);
        }
    }
}
