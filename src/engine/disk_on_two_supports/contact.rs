//! The phases of a contact and what ends each.

use serde::{Deserialize, Serialize};

/// Phase of a contact, in which its forces are smooth functions of positions and velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ContactPhase {
    /// Disk and support do not overlap.
    Apart,
    /// They still overlap, but part faster than their surfaces recover: no force.
    Relaxing,
    /// The tangential spring holds.
    Stick,
    /// The tangential spring slips at the limit of Coulomb friction, stretched by a disk that turns in this sense.
    Slip(Sense),
}

/// Sense of a turning disk.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sense {
    /// The stretch of the spring is positive.
    CounterClockwise,
    /// The stretch of the spring is negative.
    Clockwise,
}

impl Sense {
    /// Of a stretch or slip; of zero counter-clockwise.
    #[inline]
    pub fn of(quantity: f64) -> Self {
        if quantity < 0.0 {
            Self::Clockwise
        } else {
            Self::CounterClockwise
        }
    }

    /// 1 or -1.
    #[inline]
    pub fn sign(self) -> f64 {
        match self {
            Self::CounterClockwise => 1.0,
            Self::Clockwise => -1.0,
        }
    }
}

/// One contact: its phase, and where its tangential spring is not stretched.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Phase.
    pub phase: ContactPhase,
    /// Tangential displacement lambda* at which the spring is not stretched \[m\]; used while the contact sticks.
    pub unstretched: f64,
}

impl Contact {
    /// Whether a force acts.
    #[inline]
    pub fn is_closed(&self) -> bool {
        matches!(self.phase, ContactPhase::Stick | ContactPhase::Slip(_))
    }

    /// Sense in which it slips, if it does.
    #[inline]
    pub fn slips(&self) -> Option<Sense> {
        match self.phase {
            ContactPhase::Slip(sense) => Some(sense),
            _ => None,
        }
    }
}

/// Forces and rates at one contact at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// Overlap delta \[m\].
    pub overlap: f64,
    /// `k_n delta + gamma_n delta'` \[N\]: the normal force n unless the contact is open.
    pub push: f64,
    /// Normal force n \[N\].
    pub normal: f64,
    /// Tangential force tau along the tangent \[N\], on the disk.
    pub tangential: f64,
    /// Tangential displacement lambda \[m\].
    pub tangential_displacement: f64,
    /// Stretch of the tangential spring, lambda - lambda* \[m\].
    pub stretch: f64,
    /// Rate at which lambda* would move if the spring slipped in the sense of its stretch \[m/s\], along that sense:
    /// `sigma lambda' - mu n' / k_t`. The spring slips as long as it is positive.
    pub slip_rate: f64,
    /// Size below which the slip rate is rounding \[m/s\].
    pub slip_rounding: f64,
    /// Power that the contact turns to heat \[W\].
    pub lost_power: f64,
    /// Power of the support on the disk \[W\].
    pub input_power: f64,
}

/// Laws of both contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Normal stiffness k_n \[N/m\].
    pub normal_stiffness: f64,
    /// Tangential stiffness k_t \[N/m\].
    pub tangential_stiffness: f64,
    /// Friction coefficient mu.
    pub friction: f64,
    /// A short time \[s\], to compare rates with forces.
    pub time: f64,
}

/// Relative rounding of a stretch, generously.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// What may end a phase, positive as long as it does not: `[first, second]` \[N\].
///
/// Apart: overlap. Relaxing: end of overlap, return of the force. Stick: end of the force, limit of friction. Slip: end of the
/// force, slip in the opposite sense. Rounding errors change nothing, or a contact at a limit would change without end.
#[inline]
pub fn margins(contact: &Contact, force: &ContactForce, bounds: &Bounds) -> [f64; 2] {
    let per_rate = bounds.tangential_stiffness * bounds.time;
    match contact.phase {
        ContactPhase::Apart => [-bounds.normal_stiffness * force.overlap, f64::INFINITY],
        ContactPhase::Relaxing => [bounds.normal_stiffness * force.overlap, -force.push],
        ContactPhase::Stick => {
            let rounding = ROUNDING * (force.tangential_displacement.abs() + contact.unstretched.abs());
            let room = bounds.friction * force.push - bounds.tangential_stiffness * (force.stretch.abs() - rounding);
            [force.push, room]
        }
        ContactPhase::Slip(_) => [force.push, per_rate * (force.slip_rate + force.slip_rounding)],
    }
}

/// The contact after margin `which` has become negative.
pub fn after(contact: &Contact, force: &ContactForce, which: usize, bounds: &Bounds) -> Contact {
    let opened = if force.overlap < 0.0 {
        ContactPhase::Apart
    } else {
        ContactPhase::Relaxing
    };
    let stuck_at = |unstretched| Contact {
        phase: ContactPhase::Stick,
        unstretched,
    };
    let with = |phase| Contact { phase, ..*contact };
    match (contact.phase, which) {
        (ContactPhase::Apart, _) | (ContactPhase::Relaxing, 1) => stuck_at(force.tangential_displacement),
        (ContactPhase::Relaxing, _) => with(ContactPhase::Apart),
        (ContactPhase::Stick | ContactPhase::Slip(_), 0) => with(opened),
        (ContactPhase::Stick, _) => with(ContactPhase::Slip(Sense::of(force.stretch))),
        // Without friction there is no force to stick by: the surfaces tangential_displacement back at once.
        (ContactPhase::Slip(sense), _) if bounds.friction == 0.0 => with(ContactPhase::Slip(Sense::of(-sense.sign()))),
        (ContactPhase::Slip(_), _) => stuck_at(force.tangential_displacement - force.stretch),
    }
}
