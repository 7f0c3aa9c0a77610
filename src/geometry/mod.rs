//! Shapes, and nothing that moves them: pure functions of positions.

pub(crate) mod bracketed_root;
pub mod disk;
pub mod sawtooth;
pub mod time_of_impact;
pub mod wall;

pub use disk::Disk;
pub use nalgebra::Vector2;
pub use sawtooth::{Clearance, SawtoothProfile, ToothPart};
pub use time_of_impact::{Flight, disk_disk, disk_wall};
pub use wall::Wall;

/// The vector turned clockwise by a right angle: the tangent that goes with a normal.
#[inline(always)]
pub fn clockwise(vector: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(vector.y, -vector.x)
}
