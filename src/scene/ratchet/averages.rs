//! Averages of the ratchet, and the impacts on the teeth since the averages began.

use serde::{Deserialize, Serialize};

use crate::clone_in_place::clone_in_place;
use crate::drive::BoundedDrive;
use crate::engine::event_driven::{PartImpacts, Sawtooth, ToothImpacts};
use crate::error::are_sane;
use crate::measure::Transport;

/// Averages since `measure.start` or the last change of `measure.mark`.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct Averages {
    /// The averages.
    pub transport: Transport,
    /// `measure.mark` in the last communication step.
    pub mark: f64,
    /// Impacts on the teeth until the averages began.
    pub teeth: ToothImpacts,
}

clone_in_place!(Averages { transport, mark, teeth });

/// Whether the impacts on the teeth at the mark come before those now, and these are all that `wall_impacts` leave to the base.
pub(super) fn teeth_hold<D: BoundedDrive>(at_mark: &ToothImpacts, boundary: &Sawtooth<D>, wall_impacts: u64) -> bool {
    let now = boundary.tooth_impacts();
    let sum = |sum: u64, part: &PartImpacts| sum.checked_add(part.count);
    let in_order = at_mark.iter().zip(now).all(|(then, now)| then.count <= now.count);
    let impulses = at_mark.iter().chain(now).map(|part| part.impulse);
    now.iter().try_fold(boundary.ceiling_hits(), sum) == Some(wall_impacts) && in_order && are_sane(impulses)
}
