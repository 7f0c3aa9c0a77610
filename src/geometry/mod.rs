//! Shapes, and nothing that moves them: pure functions of positions.

pub mod disk;
pub mod wall;

pub use disk::Disk;
pub use wall::Wall;
