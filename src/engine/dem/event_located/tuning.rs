//! Changes of friction and gravity during a run, at a point of the grid of time.

use crate::engine::dem::fixed_grid::GridState;

use super::laws::Laws;
use super::state::{Contact, LocatedPhase};
use super::{Disks, EventStepper};

impl EventStepper {
    /// From the state on with this friction coefficient and gravity \[m/s2\].
    ///
    /// A tangential spring that is stretched beyond the new limit of friction slips at once, and what it held more is lost.
    pub(super) fn retune<D>(&mut self, state: &mut GridState<D, Disks>, friction: f64, gravity: f64) {
        let setup = &mut self.constants.setup;
        setup.gravity = gravity;
        setup.laws.tangential.friction = friction;
        let (old, new) = (self.laws, Laws::new(&setup.laws));
        self.laws = new;
        let disks = &mut state.disks;
        if old != new {
            let contacts = disks.pairs.iter_mut().chain(&mut disks.wall_contacts);
            let lost = contacts.map(|contact| change_laws(contact, &old, &new));
            state.energy_lost += lost.sum::<f64>();
        }
    }
}

/// Brings a contact from the old limit of friction to the new one; gives the energy \[J\] that its spring loses.
fn change_laws(contact: &mut Contact, old: &Laws, new: &Laws) -> f64 {
    if !contact.phase.is_pressed() {
        return 0.0;
    }
    let now = contact.kinematics;
    let force = old.normal_force(now.overlap, now.closing).max(0.0);
    let stretch = old.stretch_in(contact.phase, now.tangential_displacement - contact.reference, force);
    let limit = new.slip_compliance * force;
    let kept = stretch.clamp(-limit, limit);
    let sense = if kept != 0.0 { kept } else { now.sliding };
    let slipping = if sense > 0.0 {
        LocatedPhase::SlipForward
    } else {
        LocatedPhase::SlipBackward
    };
    // At the limit the surfaces slip on if the stretch would outrun it.
    let force_rate = new.normal_force(now.closing, contact.closing_rate);
    let outrun = now.sliding * sense.signum() > new.slip_compliance * force_rate;
    let at_limit = stretch.abs() >= limit;
    contact.phase = if !new.has_friction() || (at_limit && outrun) {
        slipping
    } else {
        LocatedPhase::Stick
    };
    contact.reference = now.tangential_displacement - kept;
    new.tangential.energy(stretch) - new.tangential.energy(kept)
}
