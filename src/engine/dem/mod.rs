//! Discrete element method: disks with soft contacts, advanced in fixed time steps (P calls it molecular dynamics).
//!
//! Two engines, which differ in their [`Stepper`]: [`Verlet`] evaluates the forces once a step and is of second order
//! between contact events; [`EventLocated`] is of fourth order and finds the instants at which contacts change. They
//! share what is in this folder: setup, grid of time, candidates for contact, energies, limits of the time step.
//!
//! Needs: radii and masses, contact laws, walls, a drive. Guarantees: see [`FixedGrid`]. Not here: force laws
//! (`contact`), motion of the base (`drive`).

mod angle;
mod candidates;
mod cell_grid;
pub mod event_located;
mod fixed_grid;
mod lanes;
mod observables;
mod sampler;
mod setup;
mod time_step_limits;
mod two_lanes;
pub mod verlet;

pub use crate::contact::ContactLaws;
pub use fixed_grid::{FixedGrid, GridState, Stepper};
pub use lanes::{lanes, limit_lanes};
pub use observables::{SoftDiskEnergies, SoftDiskObservables};
pub use sampler::{Sampler, Unsampled};
pub use setup::{Breakdown, SoftDiskSetup, SoftDisks};
pub use time_step_limits::TimeStepLimits;

/// Disks by velocity Verlet, on a base that moves with the drive D.
pub type Verlet<D> = FixedGrid<verlet::PredictorCorrector<verlet::VelocityVerlet>, D>;

/// Disks by the integrator of P 2.2, Gear's predictor-corrector of fifth order.
pub type Gear<D> = FixedGrid<verlet::PredictorCorrector<verlet::Gear5>, D>;

/// Disks by the method of fourth order that locates contact events.
pub type EventLocated<D> = FixedGrid<event_located::EventStepper, D>;
