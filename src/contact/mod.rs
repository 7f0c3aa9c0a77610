//! Force laws of molecular dynamics, one a file: overlap, velocities and skin stretch in, forces out.
//!
//! Not here: who touches whom (`engine::molecular_dynamics`), impulse laws of instantaneous collisions (`collision`).

mod elastic_skin;
mod linear_dashpot;

pub use elastic_skin::ElasticSkin;
pub use linear_dashpot::LinearDashpot;
