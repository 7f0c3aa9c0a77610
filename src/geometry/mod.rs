//! Shapes, and nothing that moves them: pure functions of positions.

pub(crate) mod bracketed_root;
pub mod disk;
pub mod sawtooth;
pub mod time_of_impact;
pub mod wall;

pub use disk::Disk;
pub use sawtooth::SawtoothProfile;
pub use time_of_impact::{Flight, disk_disk, disk_wall};
pub use wall::Wall;
