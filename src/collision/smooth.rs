//! Smooth inelastic disks: constant restitution, no friction, no spin.

use serde::{Deserialize, Serialize};

use super::{CollisionLaw, Impact, checked};
use crate::error::Result;

/// `u_n' = -e_n u_n`; the tangential velocity stays as it is. With e_n = 1 energy is conserved to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Smooth {
    restitution: f64,
}

impl Smooth {
    /// No loss at all.
    pub const ELASTIC: Self = Self { restitution: 1.0 };

    /// Law of restitution e_n in \[0, 1\].
    ///
    /// # Errors
    /// A restitution out of range, by the name `collision.restitution`.
    pub fn new(restitution: f64) -> Result<Self> {
        let remedy = "1 loses nothing, 0 sticks along the normal.";
        checked("collision.restitution", restitution, 1.0, remedy).map(|restitution| Self { restitution })
    }
}

impl CollisionLaw for Smooth {
    const ROTATES: bool = false;

    #[inline]
    fn separation_velocity(&self, impact: &Impact) -> f64 {
        self.restitution * impact.normal_velocity.abs()
    }

    #[inline]
    fn tangential_impulse(&self, _impact: &Impact, _normal_impulse: f64) -> f64 {
        0.0
    }
}
