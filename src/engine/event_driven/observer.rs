//! Observer of a run: each flight as it ends. A type parameter; the one that observes nothing compiles to nothing.

use super::Body;

/// Is shown flights and changes nothing.
///
/// The flights of a disk follow each other without gap or overlap. The first began at the last event of the disk, which
/// may be before the observation.
pub trait Observer {
    /// Disk `disk` has flown freely from the position and time of `from` until the local time `until` \[s\].
    fn flight(&mut self, disk: u32, from: &Body, until: f64);

    /// The origin of local time moves on by `seconds`.
    fn shift_origin(&mut self, seconds: f64);
}

/// Observes nothing.
#[derive(Debug, Clone, Copy)]
pub struct Unobserved;

impl Observer for Unobserved {
    #[inline(always)]
    fn flight(&mut self, _disk: u32, _from: &Body, _until: f64) {}

    #[inline(always)]
    fn shift_origin(&mut self, _seconds: f64) {}
}
