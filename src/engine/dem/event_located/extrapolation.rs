//! The force of a contact along its tangent in time from the start of a step: the prediction of the step.

use super::impulse::{ContactImpulse, OwnImpulse};
use super::laws::Laws;
use super::state::Contact;

/// A force \[N\] and its rate \[N/s\].
#[derive(Clone, Copy)]
struct ForceLine {
    value: f64,
    rate: f64,
}

impl ForceLine {
    /// Impulse and first moment about the end of a step.
    #[inline(always)]
    fn integrals(self, step: f64) -> [f64; 2] {
        let Self { value, rate } = self;
        [
            step * (value + 0.5 * step * rate),
            0.5 * step * step * (value + step * rate / 3.0),
        ]
    }
}

/// Impulse and moment of the force of a pressed contact that continues from the start of a step along its tangent.
#[inline(always)]
pub fn extrapolated(contact: &Contact, laws: &Laws, step: f64) -> OwnImpulse {
    let start = &contact.kinematics;
    let normal = ForceLine {
        value: laws.normal_force(start.overlap, start.closing),
        rate: laws.normal_force(start.closing, contact.closing_rate),
    };
    let tangential = match contact.phase.slip_sense() {
        Some(sense) => {
            let share = -sense * laws.slip_share();
            ForceLine {
                value: share * normal.value,
                rate: share * normal.rate,
            }
        }
        None => ForceLine {
            value: laws.tangential.force(start.tangential_displacement - contact.reference),
            rate: laws.tangential.force(start.sliding),
        },
    };
    OwnImpulse {
        normal: normal.integrals(step),
        tangential: tangential.integrals(step),
    }
}

/// The same as vectors. The force turns with the normal: by half the angle of the step in the impulse, to first order,
/// and by a third of it in the moment.
#[inline(always)]
pub fn along_tangent(contact: &Contact, own: OwnImpulse, step: f64) -> ContactImpulse {
    let start = &contact.kinematics;
    let [nx, ny] = start.normal;
    let turn = step * start.turning;
    let vector = |part: usize, angle: f64| {
        let (normal, sideways) = (own.normal[part], own.tangential[part] * start.lever);
        let (x, y) = (normal * nx + sideways * ny, normal * ny - sideways * nx);
        [x - angle * y, y + angle * x]
    };
    ContactImpulse {
        impulse: vector(0, 0.5 * turn),
        moment: vector(1, turn / 3.0),
        own,
        ..ContactImpulse::default()
    }
}
