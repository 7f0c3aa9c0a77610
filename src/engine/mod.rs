//! What advances time.

mod disk_motion;
pub mod event_driven;
pub mod located_dynamics;
pub mod molecular_dynamics;
pub mod three_disk;
pub mod wedge;
pub mod work;

pub use disk_motion::DiskMotion;
pub use work::{MOST_WORK_IN_A_CALL, Work};
