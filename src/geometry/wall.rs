//! Straight walls and their frame.
//!
//! The frame of a wall at angle `th` to the horizontal is `n = (-sin th, cos th)`, `t = (cos th, sin th)`: the normal
//! points into the free half plane and the tangent is the normal turned clockwise by a right angle.

use crate::elementary::{cos, sin};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::clockwise;

/// A straight wall. The half plane `normal . r > offset` is free.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Wall {
    /// Unit normal, into the free half plane.
    pub normal: Vector2<f64>,
    /// `normal . r` of every point of the wall while its base is at zero displacement \[m\].
    pub offset: f64,
    /// 1 for a wall that is fixed to the vibrating base and moves vertically with it, 0 for one at rest.
    pub follows_base: f64,
}

impl Wall {
    /// Horizontal floor at height zero that moves with the base.
    pub const fn vibrating_floor() -> Self {
        Self {
            normal: Vector2::new(0.0, 1.0),
            offset: 0.0,
            follows_base: 1.0,
        }
    }

    /// Vertical wall at rest, on the left of the free space, at `x` \[m\].
    pub const fn left(x: f64) -> Self {
        Self {
            normal: Vector2::new(1.0, 0.0),
            offset: x,
            follows_base: 0.0,
        }
    }

    /// Vertical wall at rest, on the right of the free space, at `x` \[m\].
    pub const fn right(x: f64) -> Self {
        Self {
            normal: Vector2::new(-1.0, 0.0),
            offset: -x,
            follows_base: 0.0,
        }
    }

    /// Wall through the origin at `angle` \[rad\] to the horizontal that moves with the base; one side of a wedge.
    pub fn vibrating_slope(angle: f64) -> Self {
        Self {
            normal: Vector2::new(-sin(angle), cos(angle)),
            offset: 0.0,
            follows_base: 1.0,
        }
    }

    /// Unit tangent: along it the surface velocity of a disk is `t . v + R omega`.
    pub fn tangent(&self) -> Vector2<f64> {
        clockwise(&self.normal)
    }

    /// Distance of a point from the wall \[m\], negative behind it, at a base displacement \[m\].
    #[inline]
    pub fn distance(&self, point: impl Into<Vector2<f64>>, base_displacement: f64) -> f64 {
        let mut relative = point.into();
        relative.y -= self.follows_base * base_displacement;
        self.normal.dot(&relative) - self.offset
    }
}
