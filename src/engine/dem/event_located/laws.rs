//! Contact laws with the constants that a step needs.

use crate::contact::{ContactLaws, LinearDashpot, TangentialSpring};

use super::state::{Contact, LocatedPhase};

/// Normal and tangential force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Laws {
    /// Normal force.
    pub normal: LinearDashpot,
    /// Tangential force.
    pub tangential: TangentialSpring,
    /// mu / k_t: stretch of the slipping spring over the normal force \[m/N\]; 0 if there is no tangential force.
    pub slip_compliance: f64,
}

impl Laws {
    /// With the constants of these laws.
    pub fn new(laws: &ContactLaws) -> Self {
        let ContactLaws { normal, tangential } = *laws;
        let slip_compliance = if tangential.acts() {
            tangential.friction / tangential.stiffness
        } else {
            0.0
        };
        Self {
            normal,
            tangential,
            slip_compliance,
        }
    }

    /// Whether there are tangential forces.
    #[inline(always)]
    pub fn has_friction(&self) -> bool {
        self.slip_compliance > 0.0
    }

    /// Tangential over normal force while slipping.
    #[inline(always)]
    pub fn slip_share(&self) -> f64 {
        if self.has_friction() {
            self.tangential.friction
        } else {
            0.0
        }
    }

    /// Normal force \[N\] before the cut-off at zero; its rate, if the arguments are the rates of those.
    #[inline(always)]
    pub fn normal_force(&self, overlap: f64, closing: f64) -> f64 {
        self.normal.stiffness * overlap + self.normal.damping * closing
    }

    /// Stretch \[m\] of the tangential spring of a closed contact with this overlap \[m\].
    fn stretch(&self, contact: &Contact, overlap: f64) -> f64 {
        let stretch = contact.kinematics.tangential_displacement - contact.reference;
        let normal_force = self.normal_force(overlap, contact.kinematics.closing);
        self.stretch_in(contact.phase, stretch, normal_force)
    }

    /// Of the `stretch` \[m\] of a spring what is left in this phase under a normal force \[N\]. The one that slips keeps its sign
    /// with the phase.
    pub fn stretch_in(&self, phase: LocatedPhase, stretch: f64, normal_force: f64) -> f64 {
        match phase {
            LocatedPhase::Open | LocatedPhase::Unpressed => 0.0,
            LocatedPhase::Stick => stretch,
            LocatedPhase::SlipForward => self.slip_compliance * normal_force,
            LocatedPhase::SlipBackward => -self.slip_compliance * normal_force,
        }
    }

    /// Energy \[J\] in both springs of a contact with this overlap \[m\].
    pub fn elastic_energy(&self, contact: &Contact, overlap: f64) -> f64 {
        if contact.phase == LocatedPhase::Open {
            return 0.0;
        }
        self.normal.energy(overlap) + self.tangential.energy(self.stretch(contact, overlap))
    }

    /// Energy \[J\] in the tangential spring of a contact in this phase: of its stretch \[m\] while it sticks, of the one that
    /// the normal force \[N\] leaves while it slips.
    pub fn spring_energy(&self, phase: LocatedPhase, stretch: f64, normal_force: f64) -> f64 {
        self.tangential.energy(self.stretch_in(phase, stretch, normal_force))
    }

    /// Normal and tangential force \[N\] of a contact with this overlap \[m\] and closing velocity \[m/s\].
    pub fn forces(&self, contact: &Contact, overlap: f64, closing: f64) -> [f64; 2] {
        if contact.phase == LocatedPhase::Open {
            return [0.0; 2];
        }
        let tangential = self.tangential.force(self.stretch(contact, overlap));
        [self.normal_force(overlap, closing).max(0.0), tangential]
    }
}
