//! Contact laws with the constants that a step needs.

use crate::contact::{ElasticSkin, LinearDashpot};

/// Normal and tangential force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Laws {
    /// Normal force.
    pub normal: LinearDashpot,
    /// Tangential force.
    pub skin: ElasticSkin,
    /// mu / k_t: stretch of the slipping skin over the normal force \[m/N\]; 0 if there is no tangential force.
    pub slip_compliance: f64,
}

impl Laws {
    /// With the constants of these laws.
    pub fn new(normal: LinearDashpot, skin: ElasticSkin) -> Self {
        let grips = skin.stiffness > 0.0 && skin.friction > 0.0;
        Self {
            normal,
            skin,
            slip_compliance: if grips { skin.friction / skin.stiffness } else { 0.0 },
        }
    }

    /// Whether there are tangential forces.
    #[inline(always)]
    pub fn grips(&self) -> bool {
        self.slip_compliance > 0.0
    }

    /// Tangential over normal force while slipping.
    #[inline(always)]
    pub fn slip_share(&self) -> f64 {
        if self.grips() { self.skin.friction } else { 0.0 }
    }

    /// Normal force \[N\] before the cut-off at zero; its rate, if the arguments are the rates of those.
    #[inline(always)]
    pub fn normal_force(&self, overlap: f64, closing: f64) -> f64 {
        self.normal.stiffness * overlap + self.normal.damping * closing
    }
}
