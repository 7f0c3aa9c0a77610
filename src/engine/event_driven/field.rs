//! Gravity or none, as a type: without it flights are straight and no term of it is compiled.

/// Constant acceleration of all disks.
pub trait Field: Clone + Copy + Send + 'static {
    /// Acceleration downwards \[m/s2\].
    fn gravity(&self) -> f64;
}

/// Weightless disks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weightless;

impl Field for Weightless {
    #[inline(always)]
    fn gravity(&self) -> f64 {
        0.0
    }
}

/// Gravity \[m/s2\], downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gravity(pub f64);

impl Field for Gravity {
    #[inline(always)]
    fn gravity(&self) -> f64 {
        self.0
    }
}
