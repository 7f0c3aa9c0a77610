//! Scene `packing`: disks in a box on a vibrating bottom (P 2, 3, 4.2), soft or hard.
//!
//! Parameters, initial packing and the outputs that both kinds of disks have stand here and in `rows`; soft disks in
//! `soft_packing`, hard ones in [`event_driven`].

mod either_base;
mod equations;
pub mod event_driven;
pub mod hard;
mod hard_law;
mod initial_packing;
mod rows;
pub mod soft;
mod soft_packing;

use crate::drive::{FollowsInput, Sine};
use crate::engine::dem::event_located::EventStepper;
use crate::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};

pub use soft_packing::{PackingState, SoftPacking};

/// Packing whose base follows the inputs `base.displacement` and `base.velocity`.
pub type PackingOnInput = SoftPacking<PredictorCorrector<VelocityVerlet>, FollowsInput>;

/// Packing whose base moves as a sine.
pub type PackingOnSine = SoftPacking<PredictorCorrector<VelocityVerlet>, Sine>;

/// The same on inputs and on a sine, of fourth order with located contact events.
pub type LocatedPackingOnInput = SoftPacking<EventStepper, FollowsInput>;
/// See [`LocatedPackingOnInput`].
pub type LocatedPackingOnSine = SoftPacking<EventStepper, Sine>;
