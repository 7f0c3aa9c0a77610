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
mod rotation;
mod rows;
mod settled;
mod sheet;
pub mod soft;
mod soft_packing;

use serde::{Deserialize, Serialize};

use crate::contact::LinearDashpot;
use crate::drive::{FixedBottom, FollowsInput, RandomBottom, Sine};
use crate::engine::dem::event_located::EventStepper;
use crate::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};
use crate::engine::threads::ThreadPool;
use crate::measure::Rotation;
use crate::scene::disks_on_base::StepReport;

pub use soft_packing::SoftPacking;

/// Packing of soft disks by velocity Verlet, on a base that moves with the drive D, with the normal force N.
pub type PackingOn<D, N = LinearDashpot> = SoftPacking<PredictorCorrector<VelocityVerlet, N, ThreadPool>, D>;
/// The base follows the inputs `base.displacement` and `base.velocity`.
pub type PackingOnInput = PackingOn<FollowsInput>;
/// The base moves as a sine.
pub type PackingOnSine = PackingOn<Sine>;
/// The base moves as a sine, and the bottom row of disks is fixed to it.
pub type PackingOnFixedBottom = PackingOn<FixedBottom>;
/// The bottom row of disks vibrates randomly over a base at rest.
pub type PackingOnRandomBottom = PackingOn<RandomBottom>;

/// The same of fourth order, with located contact events.
pub type LocatedPackingOn<D> = SoftPacking<EventStepper, D>;
/// See [`LocatedPackingOn`].
pub type LocatedPackingOnInput = LocatedPackingOn<FollowsInput>;
/// See [`LocatedPackingOn`].
pub type LocatedPackingOnSine = LocatedPackingOn<Sine>;

/// State of a packing, soft or hard.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PackingState<S> {
    /// The engine's: disks, contacts or events, and the base.
    pub engine: S,
    /// The last communication step.
    pub report: StepReport,
    /// Total energy at the start \[J\], which depends on where the inputs had the base; for the residual.
    pub start_energy: f64,
    /// Rotation since `measure.start`.
    pub rotation: Rotation,
}
