//! The frame of a contact over one step: normal, lever and motion of the wall at every instant of it.

use crate::drive::Motion;

use super::state::Kinematics;

/// Weights, in Hermite's cubic at x, of the value at 0, the slope at 0, the value at 1, the slope at 1.
#[derive(Debug, Clone, Copy)]
pub struct HermiteCubic(pub [f64; 4]);

impl HermiteCubic {
    /// Of the value.
    #[inline]
    pub const fn value(x: f64) -> Self {
        let y = 1.0 - x;
        Self([(1.0 + 2.0 * x) * y * y, x * y * y, x * x * (3.0 - 2.0 * x), -x * x * y])
    }

    /// Of the derivative.
    #[inline]
    pub const fn slope(x: f64) -> Self {
        let y = 1.0 - x;
        Self([-6.0 * x * y, y * (1.0 - 3.0 * x), 6.0 * x * y, x * (3.0 * x - 2.0)])
    }

    /// The cubic with these values and slopes.
    #[inline(always)]
    pub fn of(&self, value: f64, slope: f64, end_value: f64, end_slope: f64) -> f64 {
        let [a, b, c, d] = self.0;
        a * value + b * slope + (c * end_value + d * end_slope)
    }
}

/// Frame of a contact at the fraction x of a step.
pub trait ContactFrame {
    /// Unit normal.
    fn normal(&self, x: &HermiteCubic) -> [f64; 2];
    /// Lever of the tangential force, at this overlap \[m\].
    fn lever(&self, overlap: f64) -> f64;
    /// Upward velocity \[m/s\] of a wall, from [`HermiteCubic::slope`].
    fn wall_velocity(&self, slope: &HermiteCubic) -> f64;
}

/// Frame of two disks, which rotates.
#[derive(Debug, Clone, Copy)]
pub struct PairFrame {
    normals: [[f64; 2]; 4],
    radius_sum: f64,
}

impl PairFrame {
    /// The frame that rotates from `start` to `end` in a step of length `step` \[s\].
    #[inline]
    pub fn new(start: &Kinematics, end: &Kinematics, step: f64, radius_sum: f64) -> Self {
        let rate = |kinematics: &Kinematics| {
            let turn = step * kinematics.turning;
            [-turn * kinematics.normal[1], turn * kinematics.normal[0]]
        };
        Self {
            normals: [start.normal, rate(start), end.normal, rate(end)],
            radius_sum,
        }
    }
}

impl ContactFrame for PairFrame {
    #[inline(always)]
    fn normal(&self, x: &HermiteCubic) -> [f64; 2] {
        let part = |axis: usize| {
            x.of(
                self.normals[0][axis],
                self.normals[1][axis],
                self.normals[2][axis],
                self.normals[3][axis],
            )
        };
        [part(0), part(1)]
    }

    #[inline(always)]
    fn lever(&self, overlap: f64) -> f64 {
        self.radius_sum / (self.radius_sum - overlap)
    }

    #[inline(always)]
    fn wall_velocity(&self, _slope: &HermiteCubic) -> f64 {
        0.0
    }
}

/// Frame of a wall, which keeps its direction and may be carried by the base.
#[derive(Debug, Clone, Copy)]
pub struct WallFrame {
    /// Normal of the wall.
    pub normal: [f64; 2],
    /// 1 if it moves with the base, else 0.
    pub follows_base: f64,
    /// Base at the start and at the end of the step.
    pub base: [Motion; 2],
    /// Length of the step \[s\].
    pub step: f64,
}

impl ContactFrame for WallFrame {
    #[inline(always)]
    fn normal(&self, _x: &HermiteCubic) -> [f64; 2] {
        self.normal
    }

    #[inline(always)]
    fn lever(&self, _overlap: f64) -> f64 {
        1.0
    }

    #[inline(always)]
    fn wall_velocity(&self, slope: &HermiteCubic) -> f64 {
        let [from, to] = &self.base;
        let rise = slope.of(
            from.displacement,
            self.step * from.velocity,
            to.displacement,
            self.step * to.velocity,
        );
        self.follows_base * rise / self.step
    }
}
