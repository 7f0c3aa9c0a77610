//! Torques at the corners and their mean: why random supports turn the disk backwards (P 5.3.3).

use super::{Acceleration, Corner, Setting, point};
use crate::elementary::powi;

/// Quasi-static torques on the disk at the corners \[N m\], P 5.15 to 5.18, and their mean, P 5.21.
///
/// Print has T1 and T2 swapped: at T1 the departure is `mu m g sin theta_T / (2 k_t R (sin theta_0 - mu cos theta_0))`
/// (4.47) and the torque `-2 R^2 k_t` times that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanTorques {
    /// Sliding clockwise, `A_S1`.
    pub s1: f64,
    /// Sliding counter-clockwise, `-A_S2`.
    pub s2: f64,
    /// Contacts slide in opposite senses, springs stretched.
    pub t1: f64,
    /// Contacts slide in opposite senses, springs compressed.
    pub t2: f64,
}

impl MeanTorques {
    /// Mean of all four \[N m\], P 5.21: negative for positive tilt while the friction is below `tan theta_0` and `2 theta_0`
    /// not far above a right angle.
    pub fn all(&self) -> f64 {
        0.25 * (self.s1 + self.s2 + self.t1 + self.t2)
    }

    /// Mean of S1 and S2 alone \[N m\], positive for positive tilt: P 5.3.3, last paragraph.
    pub fn sliding_together(&self) -> f64 {
        0.5 * (self.s1 + self.s2)
    }
}

/// Torques at the four corners.
pub fn mean_torques(setting: &Setting) -> MeanTorques {
    let torque = |corner| {
        let departure = point(setting, Acceleration::default(), corner).departure;
        -2.0 * powi(setting.radius, 2) * setting.tangential_stiffness * departure
    };
    MeanTorques {
        s1: torque(Corner::S1),
        s2: torque(Corner::S2),
        t1: torque(Corner::T1),
        t2: torque(Corner::T2),
    }
}
