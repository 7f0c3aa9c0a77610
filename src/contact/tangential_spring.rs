//! Tangential force of a spring that slips at the limit of Coulomb friction (P 4.2.2, after Cundall and Strack 1979).

/// Friction coefficient, and tangential stiffness \[N/m\], below which surfaces pass each other freely. The force would be less
/// than the rounding of any other, and products of smaller numbers are no longer exact.
pub const NO_FRICTION: f64 = 1e-100;

/// Tangential spring of stiffness k_t (Cundall and Strack; P calls it the elastic skin of the disks) with Coulomb's limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialSpring {
    /// Tangential stiffness k_t \[N/m\].
    pub stiffness: f64,
    /// Friction coefficient mu.
    pub friction: f64,
}

impl TangentialSpring {
    /// Whether there is any force along the surfaces.
    pub fn acts(&self) -> bool {
        self.friction >= NO_FRICTION && self.stiffness >= NO_FRICTION
    }

    /// The stretch \[m\] that Coulomb friction `k_t |s| <= mu n` leaves of `stretch` s = lambda - lambda* \[m\].
    ///
    /// What is cut off is slip: the caller moves lambda* by it. `normal_force` n >= 0 \[N\]. Source: P 4.6 with the sign
    /// of P 4.3 and 4.8, P 4.31.
    #[inline]
    pub fn limited(&self, stretch: f64, normal_force: f64) -> f64 {
        let limit = self.friction * normal_force;
        if self.stiffness * stretch.abs() > limit {
            (limit / self.stiffness).copysign(stretch)
        } else {
            stretch
        }
    }

    /// Tangential force \[N\] on the first body along the tangent, `-k_t s`.
    #[inline]
    pub fn force(&self, stretch: f64) -> f64 {
        -self.stiffness * stretch
    }

    /// Energy \[J\] stored in the spring.
    #[inline]
    pub fn energy(&self, stretch: f64) -> f64 {
        0.5 * self.stiffness * stretch * stretch
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_at_the_limit_and_sticks_below() {
        let spring = TangentialSpring {
            stiffness: 100.0,
            friction: 0.5,
        };
        assert_eq!(spring.limited(0.04, 10.0), 0.04);
        assert_eq!(spring.limited(0.2, 10.0), 0.05);
        assert_eq!(spring.limited(-0.2, 10.0), -0.05);
        assert_eq!(spring.limited(0.2, 0.0), 0.0);
    }
}
