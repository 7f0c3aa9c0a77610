//! Force laws of soft disks, one a file: overlap, velocities and spring displacement in, forces out.
//!
//! Not here: which disks touch (`engine::dem`), impulse laws of instantaneous collisions (`collision`).

mod linear_dashpot;
mod tangential_spring;

pub use linear_dashpot::LinearDashpot;
pub use tangential_spring::TangentialSpring;

/// Contact laws of every contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaws {
    /// Normal force.
    pub normal: LinearDashpot,
    /// Tangential force.
    pub tangential: TangentialSpring,
}
