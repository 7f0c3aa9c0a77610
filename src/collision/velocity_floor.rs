//! Velocity floor against inelastic collapse: no impact leaves slower than a minimum.

use serde::{Deserialize, Serialize};

use super::{CollisionLaw, Impact, checked};
use crate::error::Result;

/// The law inside with `|u_n'| = max(|u_n'|, minimum)` for every kind of pair.
///
/// The friction limit follows the impulse that the floor gives, `J_n = m_eff (|u_n| + |u_n'|)`, in place of
/// `(1 + e) |u_n|` in F A11-A28. Impacts slower than the minimum gain energy: that is what keeps them apart.
/// Source: F A1, A5.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct VelocityFloor<L> {
    law: L,
    minimum: f64,
}

impl<L> VelocityFloor<L> {
    /// Puts a floor of `minimum` >= 0 \[m/s\] under the law.
    ///
    /// # Errors
    /// A minimum out of range, by the name `collision.minimum_normal_velocity`.
    pub fn new(law: L, minimum: f64) -> Result<Self> {
        let name = "collision.minimum_normal_velocity";
        let minimum = checked(name, minimum, f64::INFINITY, "0 has no floor.")?;
        Ok(Self { law, minimum })
    }

    /// The law inside.
    pub fn law(&self) -> &L {
        &self.law
    }
}

impl<L: CollisionLaw> CollisionLaw for VelocityFloor<L> {
    const ROTATES: bool = L::ROTATES;
    const REMEMBERS: bool = L::REMEMBERS;

    #[inline]
    fn separation_velocity(&self, impact: &Impact) -> f64 {
        let own = self.law.separation_velocity(impact);
        if own > self.minimum { own } else { self.minimum }
    }

    #[inline]
    fn tangential_impulse(&self, impact: &Impact, normal_impulse: f64) -> f64 {
        self.law.tangential_impulse(impact, normal_impulse)
    }

    fn most_work(&self) -> u64 {
        self.law.most_work()
    }
}
