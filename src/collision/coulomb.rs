//! Coulomb restitution: constant normal restitution, and surfaces that slide throughout or stick before the end.

use serde::{Deserialize, Serialize};

use super::{CollisionLaw, Impact, checked};
use crate::error::Result;

/// Constant restitution e_n and Coulomb friction mu (F appendix A).
///
/// Friction `mu J_n` brakes the surfaces; if less is enough to stop them, `J_t = -alpha u_t` does, and they roll off.
/// This is A12-A26 for any masses and any inertia factors; A28 is decided by comparing products, so that nothing is
/// divided by u_n and the impulse is continuous where sliding ends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Coulomb {
    restitution: f64,
    friction: f64,
}

impl Coulomb {
    /// Law of restitution e_n in \[0, 1\] and friction coefficient mu >= 0.
    ///
    /// # Errors
    /// A value out of range, by the names `collision.restitution` and `collision.friction`.
    pub fn new(restitution: f64, friction: f64) -> Result<Self> {
        let remedy = "1 loses nothing, 0 sticks along the normal.";
        Ok(Self {
            restitution: checked("collision.restitution", restitution, 1.0, remedy)?,
            friction: checked("collision.friction", friction, f64::INFINITY, "0 slides freely.")?,
        })
    }
}

impl CollisionLaw for Coulomb {
    const ROTATES: bool = true;

    #[inline]
    fn separation_velocity(&self, impact: &Impact) -> f64 {
        self.restitution * impact.normal_velocity.abs()
    }

    #[inline]
    fn tangential_impulse(&self, impact: &Impact, normal_impulse: f64) -> f64 {
        let stopping = -impact.tangential_mass * impact.tangential_velocity;
        let limit = self.friction * normal_impulse;
        if stopping.abs() < limit {
            stopping
        } else {
            limit.copysign(stopping)
        }
    }
}
