//! The force of a contact that goes on from the start of a step along its tangent: what a step is predicted by.

use super::laws::Laws;
use super::push::{Own, Push};
use super::state::Contact;

/// Force of a pressed contact at the start of a step, and its rate: N, N', tau, tau'.
#[inline(always)]
fn start_force(contact: &Contact, laws: &Laws) -> [f64; 4] {
    let start = &contact.kinematics;
    let force = laws.normal_force(start.overlap, start.closing);
    let rate = laws.normal_force(start.closing, contact.closing_rate);
    match contact.phase.slip_sense() {
        Some(sense) => {
            let share = -sense * laws.slip_share();
            [force, rate, share * force, share * rate]
        }
        None => {
            let stretch = start.surface - contact.reference;
            let skin = &laws.skin;
            [force, rate, skin.force(stretch), skin.force(start.sliding)]
        }
    }
}

/// Impulse and moment of the force that goes on from the start of a step along its tangent.
#[inline(always)]
pub fn extrapolated(contact: &Contact, laws: &Laws, step: f64) -> Own {
    let [force, rate, tangential, tangential_rate] = start_force(contact, laws);
    let integrals = |force: f64, rate: f64| {
        [
            step * (force + 0.5 * step * rate),
            0.5 * step * step * (force + step * rate / 3.0),
        ]
    };
    Own {
        normal: integrals(force, rate),
        tangential: integrals(tangential, tangential_rate),
    }
}

/// The same as vectors. The force turns with the normal: by half the angle of the step in the impulse, to first order,
/// and by a third of it in the moment.
#[inline(always)]
pub fn along_tangent(contact: &Contact, own: Own, step: f64) -> Push {
    let start = &contact.kinematics;
    let [nx, ny] = start.normal;
    let turn = step * start.turning;
    let vector = |part: usize, angle: f64| {
        let (normal, sideways) = (own.normal[part], own.tangential[part] * start.lever);
        let (x, y) = (normal * nx + sideways * ny, normal * ny - sideways * nx);
        [x - angle * y, y + angle * x]
    };
    Push {
        impulse: vector(0, 0.5 * turn),
        moment: vector(1, turn / 3.0),
        own,
        ..Push::default()
    }
}
