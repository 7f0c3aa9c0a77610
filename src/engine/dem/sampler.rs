//! Who looks at soft disks at times of its own, between the communication points.

/// Takes the positions of the disks at times that it says beforehand.
pub trait Sampler {
    /// Time \[s\] at which it looks next; after [`Self::take`] a later one.
    fn due(&self) -> f64;

    /// How often it looks until `end_time` \[s\].
    fn samples_until(&self, end_time: f64) -> f64;

    /// Takes x, y \[m\] and angle \[rad\] of each disk at the time that was due.
    fn take(&mut self, positions: &[[f64; 3]]);
}

/// The sampler that never looks; compiles to nothing.
#[derive(Debug, Clone, Copy)]
pub struct Unsampled;

impl Sampler for Unsampled {
    fn due(&self) -> f64 {
        f64::INFINITY
    }

    fn samples_until(&self, _end_time: f64) -> f64 {
        0.0
    }

    fn take(&mut self, _positions: &[[f64; 3]]) {}
}
