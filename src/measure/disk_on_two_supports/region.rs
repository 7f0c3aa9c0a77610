//! The region of departure and stretch that Coulomb's condition admits, and its corners (P 4.4, Fig. 4.3).

use super::balance::loads;
use super::{Acceleration, Setting, Tangential};
use crate::elementary::sin_cos;

/// A state of the tangential springs: `delta_theta` and `Theta` of P 4.14 and 4.15.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// `delta_theta = -(tau_1 + tau_2) / (2 k_t R)` \[rad\]: angle of the disk from where its torque vanishes.
    pub departure: f64,
    /// `Theta = (tau_2 - tau_1) / (2 k_t R)` \[rad\]: stretch of the tangential springs.
    pub stretch: f64,
}

impl Point {
    /// Point of these tangential forces, P 4.17.
    pub fn from_forces(setting: &Setting, tangential: Tangential) -> Self {
        let unit = 2.0 * setting.tangential_stiffness * setting.radius;
        Self {
            departure: -(tangential.right + tangential.left) / unit,
            stretch: (tangential.right - tangential.left) / unit,
        }
    }

    /// Tangential forces at this point, P 4.16.
    pub fn forces(&self, setting: &Setting) -> Tangential {
        let stiffness = setting.tangential_stiffness * setting.radius;
        Tangential {
            left: -stiffness * (self.stretch + self.departure),
            right: stiffness * (self.stretch - self.departure),
        }
    }
}

/// Corners of the region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Both contacts slide while the disk turns clockwise, P 4.41.
    S1,
    /// Both contacts slide while the disk turns counter-clockwise, P 4.43.
    S2,
    /// The contacts slide in opposite senses, the springs are stretched most, P 4.47.
    T1,
    /// The contacts slide in opposite senses, the springs are compressed most, P 4.49.
    T2,
    /// Contact 1 opens, P 4.44.
    D1,
    /// Contact 2 opens, P 4.45.
    D2,
}

impl Corner {
    /// All of them, the quadrilateral S1 T2 S2 T1 first, counter-clockwise with the departure to the right.
    pub const ALL: [Self; 6] = [Self::S1, Self::T2, Self::S2, Self::T1, Self::D1, Self::D2];

    /// Name as in the thesis.
    pub fn name(self) -> &'static str {
        match self {
            Self::S1 => "S1",
            Self::S2 => "S2",
            Self::T1 => "T1",
            Self::T2 => "T2",
            Self::D1 => "D1",
            Self::D2 => "D2",
        }
    }
}

/// Corner of the region while the centre of the disk has this acceleration, P 4.41 to 4.49.
///
/// Denominators are those of print times mu, so that without friction S and T lie at the origin. S and T bound the region
/// while the friction is below [`super::detachment_friction`] and below `1/tan theta_0`. From there on supports far apart
/// jam the disk: no compression of the springs makes both contacts slide, the region is open there and T2 no corner of it.
pub fn point(setting: &Setting, acceleration: Acceleration, corner: Corner) -> Point {
    let (w_1, w_2) = loads(setting, acceleration);
    let (s_12, c_12) = sin_cos(2.0 * setting.half_angle);
    let mu = setting.friction;
    let (difference, sum) = (w_1 - w_2, w_1 + w_2);
    let both = 2.0 * s_12 * s_12 * (1.0 + mu * mu);
    let (departure, stretch) = match corner {
        Corner::S1 => (
            mu * (mu * difference * (c_12 - 1.0) - sum * s_12) / both,
            mu * (mu * sum * (1.0 + c_12) - difference * s_12) / both,
        ),
        Corner::S2 => (
            mu * (mu * difference * (c_12 - 1.0) + sum * s_12) / both,
            mu * (mu * sum * (1.0 + c_12) + difference * s_12) / both,
        ),
        Corner::T1 => (
            mu * difference / (2.0 * (s_12 - mu * (c_12 + 1.0))),
            mu * sum / (2.0 * (s_12 - mu * (c_12 - 1.0))),
        ),
        Corner::T2 => (
            -mu * difference / (2.0 * (s_12 + mu * (c_12 + 1.0))),
            -mu * sum / (2.0 * (s_12 + mu * (c_12 - 1.0))),
        ),
        Corner::D1 => (-0.5 * w_1, 0.5 * w_1),
        Corner::D2 => (0.5 * w_2, 0.5 * w_2),
    };
    let unit = setting.radius * setting.tangential_stiffness;
    Point {
        departure: departure / unit,
        stretch: stretch / unit,
    }
}

/// How far the tangential forces at a point are from each of Coulomb's four limits \[N\]: (a), (b), (c), (d) of P 4.32 to
/// 4.35 as `mu n_i - |tau_i|` with either sign of `tau_i`. Negative beyond a limit.
///
/// (a) contact 1 slides counter-clockwise (`tau_1 < 0`), (b) clockwise; (c) contact 2 clockwise, (d) counter-clockwise.
pub fn amonton_margins(setting: &Setting, acceleration: Acceleration, point: Point) -> [f64; 4] {
    let tangential = point.forces(setting);
    let (n_1, n_2) = super::normal_forces(setting, acceleration, tangential);
    let mu = setting.friction;
    [
        mu * n_1 + tangential.left,
        mu * n_1 - tangential.left,
        mu * n_2 - tangential.right,
        mu * n_2 + tangential.right,
    ]
}
