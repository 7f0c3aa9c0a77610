//! One contact over one step: its relative motion at both ends in, its impulse on the two bodies out.
//!
//! Without a force there is none. A step in which the phase changes is left to `contact_events`, one with a force in the same phase
//! is that of `lane_contacts`.

use super::frame::ContactFrame;
use super::impulse::{ContactImpulse, OwnImpulse};
use super::laws::Laws;
use super::state::{Contact, Kinematics, LocatedPhase};

/// The contact after a step, and what it gave to its bodies.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// Phase at the end.
    pub phase: LocatedPhase,
    /// lambda* at the end \[m\].
    pub reference: f64,
    /// Rate of the closing velocity at the end \[m/s2\].
    pub closing_rate: f64,
    /// Impulses and energies.
    pub given: ContactImpulse,
}

/// One contact in one step.
#[derive(Debug, Clone, Copy)]
pub struct ContactStep<'step, F> {
    /// Relative motion at the start.
    pub start: &'step Kinematics,
    /// Relative motion at the end, as known so far.
    pub end: &'step Kinematics,
    /// The contact at the start.
    pub contact: &'step Contact,
    /// Integrals of the contact's own force that are contained in `end`.
    pub own: OwnImpulse,
    /// Inverse of the effective mass \[1/kg\].
    pub inverse_mass: f64,
    /// Frame over the step.
    pub frame: &'step F,
    /// Length \[s\].
    pub step: f64,
}

/// Whether the cubic with these values and rates at the ends of a step cannot rise above zero: its control points, of
/// which it is a convex combination, are all below.
#[inline(always)]
fn stays_below([value, rate]: [f64; 2], [end_value, end_rate]: [f64; 2], step: f64) -> bool {
    let third = step / 3.0;
    value <= 0.0 && value + third * rate <= 0.0 && end_value - third * end_rate <= 0.0 && end_value <= 0.0
}

impl<F: ContactFrame> ContactStep<'_, F> {
    /// Outcome if the contact has no force at all in the step.
    #[inline(always)]
    pub fn without_force(&self, laws: &Laws) -> Option<Outcome> {
        match self.contact.phase {
            LocatedPhase::Open => self.apart(),
            LocatedPhase::Unpressed => self.unpressed(laws),
            _ => None,
        }
    }

    fn resting(&self, phase: LocatedPhase) -> Outcome {
        Outcome {
            phase,
            reference: self.contact.reference,
            closing_rate: 0.0,
            given: ContactImpulse::default(),
        }
    }

    fn apart(&self) -> Option<Outcome> {
        let (start, end) = (self.start, self.end);
        let apart = stays_below([start.overlap, start.closing], [end.overlap, end.closing], self.step);
        apart.then(|| self.resting(LocatedPhase::Open))
    }

    fn unpressed(&self, laws: &Laws) -> Option<Outcome> {
        let (start, end) = (self.start, self.end);
        if laws.normal_force(end.overlap, end.closing) > 0.0 {
            return None;
        }
        let phase = if end.overlap > 0.0 {
            LocatedPhase::Unpressed
        } else {
            LocatedPhase::Open
        };
        let mut outcome = self.resting(phase);
        // The spring gives way to nothing.
        outcome.given.lost = laws.normal.energy(start.overlap) - laws.normal.energy(end.overlap.max(0.0));
        Some(outcome)
    }
}
