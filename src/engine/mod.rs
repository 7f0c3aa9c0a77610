//! What advances time.

pub mod event_driven;
pub mod molecular_dynamics;
pub mod three_disk;
pub mod wedge;
