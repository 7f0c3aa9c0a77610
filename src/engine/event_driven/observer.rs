//! Who looks on: each piece of flight as it ends. A type, so that a run without an observer compiles none of it.

use super::Body;

/// Sees flights and changes nothing.
///
/// The flights of a disk that an observer is told follow each other without gap or overlap. The first began when the disk
/// last met something, which may be before the observer came.
pub trait Observer {
    /// Disk `disk` has flown freely from where and when `from` is until the local time `until` \[s\].
    fn flight(&mut self, disk: u32, from: &Body, until: f64);

    /// The origin of local time moves on by `seconds`.
    fn shift(&mut self, seconds: f64);
}

/// Nobody.
#[derive(Debug, Clone, Copy)]
pub struct Unobserved;

impl Observer for Unobserved {
    #[inline(always)]
    fn flight(&mut self, _disk: u32, _from: &Body, _until: f64) {}

    #[inline(always)]
    fn shift(&mut self, _seconds: f64) {}
}
