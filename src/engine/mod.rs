//! What advances time.

pub mod molecular_dynamics;
