//! Force laws of soft disks, one a file: overlap, velocities and spring displacement in, forces out.
//!
//! Not here: which disks touch (`engine::dem`), impulse laws of instantaneous collisions (`collision`).

use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};

mod linear_dashpot;
mod tangential_spring;

pub use linear_dashpot::LinearDashpot;
pub use tangential_spring::{NO_FRICTION, TangentialSpring};

/// A number, or several side by side in a register.
pub trait Numbers: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Numbers for T {}

/// A normal force of soft disks, `max(elastic - viscous, 0)`: a function of the overlap delta and the normal velocity u_n.
///
/// The inner loop computes several contacts at once. Where disks do not touch, the results are not used; they may be NaN.
pub trait NormalForce: Debug + Clone + Copy + PartialEq + Send + 'static {
    /// The two constants of [`NormalForce::elastic`] and [`NormalForce::viscous`].
    fn constants(&self) -> [f64; 2];

    /// Force \[N\] of the spring at the overlaps delta \[m\].
    fn elastic<T: Numbers>(constants: [T; 2], overlap: T) -> T;

    /// Force \[N\] of the damping, which is subtracted; u_n \[m/s\] is negative on approach.
    fn viscous<T: Numbers>(constants: [T; 2], overlap: T, normal_velocity: T) -> T;

    /// Normal force \[N\] of one contact that touches.
    fn of_one(&self, overlap: f64, normal_velocity: f64) -> f64 {
        let constants = self.constants();
        (Self::elastic(constants, overlap) - Self::viscous(constants, overlap, normal_velocity)).max(0.0)
    }

    /// Energy \[J\] stored in the spring at an overlap \[m\].
    fn energy(&self, overlap: f64) -> f64;

    /// Stiffness \[N/m\] that the time step has to resolve.
    fn stiffness(&self) -> f64;

    /// Damping \[kg/s\] that the time step has to resolve.
    fn damping(&self) -> f64;
}

/// Contact laws of every contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaws<N = LinearDashpot> {
    /// Normal force.
    pub normal: N,
    /// Tangential force.
    pub tangential: TangentialSpring,
}
