//! Geometry of a wedge in the frames of its two walls: a vector in one frame in, the same vector in the other out.
//!
//! The centre of a disk moves in the wedge shifted by `R / sin(theta_W / 2)` up the bisector (P 6.6 as corrected). Vectors
//! in the frame of a wall have the components x along the wall, up from the vertex, and y off the wall, into the wedge.
//! Both walls have the same frame but for a reflection, so that mirrored wedges give mirrored bits, and nothing is divided
//! by an angle: walls may be horizontal, vertical or hang over.

use crate::elementary::{cos, sin, sin_cos};
use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

/// One of the two walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    /// Wall 1.
    Left,
    /// Wall 2.
    Right,
}

impl Side {
    /// The other wall.
    #[inline]
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// 1 on the right, where e is the wall's tangent t, and -1 on the left, where e is -t.
    #[inline]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }
}

/// A wedge by its aperture and tilt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WedgeFrame {
    /// The upward unit vector in the frame of each wall, `(sin alpha, cos alpha)` at a slope alpha.
    left: Vector2<f64>,
    right: Vector2<f64>,
    /// From the frame of one wall to that of the other.
    reflection: Matrix2<f64>,
    /// `cos(theta_W / 2)`, `sin(theta_W / 2)`: up the bisector in the frame of either wall.
    bisector: Vector2<f64>,
}

impl WedgeFrame {
    /// Wedge of aperture theta_W \[rad\], tilted counter-clockwise by theta_T \[rad\]: the left wall has the slope
    /// `alpha_1 = theta_0 - theta_T`, the right one `alpha_2 = theta_0 + theta_T`, with `theta_0 = (pi - theta_W) / 2`.
    pub fn new(aperture: f64, tilt: f64) -> Self {
        let critical = Self::critical_tilt(aperture);
        let up = |slope: f64| Vector2::new(sin(slope), cos(slope));
        let ((sine, cosine), half) = (sin_cos(aperture), 0.5 * aperture);
        Self {
            left: up(critical - tilt),
            right: up(critical + tilt),
            reflection: Matrix2::new(cosine, sine, sine, -cosine),
            bisector: Vector2::new(cos(half), sin(half)),
        }
    }

    /// Tilt theta_0 \[rad\] at which a wall is horizontal and the wedge no longer confines.
    pub fn critical_tilt(aperture: f64) -> f64 {
        0.5 * (std::f64::consts::PI - aperture)
    }

    /// The upward unit vector in the frame of a wall.
    #[inline]
    pub fn up(&self, side: Side) -> Vector2<f64> {
        match side {
            Side::Left => self.left,
            Side::Right => self.right,
        }
    }

    /// The unit vector up the bisector, the same in the frames of both walls.
    pub fn bisector(&self) -> Vector2<f64> {
        self.bisector
    }

    /// A vector in the frame of one wall from that of the other. Positions count from the vertex.
    #[inline]
    pub fn reflected(&self, vector: Vector2<f64>) -> Vector2<f64> {
        self.reflection * vector
    }

    /// A vector in the laboratory, x to the right and y up, from the frame of a wall.
    pub fn to_laboratory(&self, side: Side, vector: Vector2<f64>) -> Vector2<f64> {
        let up = self.up(side);
        Vector2::new(side.sign() * vector.perp(&up), vector.dot(&up))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Wall;

    /// Against `geometry::Wall`, for walls of every slope: n, t, and the change from wall to wall.
    #[test]
    fn agrees_with_the_frame_of_walls() {
        for (aperture, tilt) in [(2.1_f64, 0.3), (2.1, -0.3), (1.2, 0.9), (3.0, 0.05), (1.58, 0.78)] {
            let frame = WedgeFrame::new(aperture, tilt);
            let critical = WedgeFrame::critical_tilt(aperture);
            let walls = [-(critical - tilt), critical + tilt].map(Wall::vibrating_slope);
            let vector = Vector2::new(0.7, -0.4);
            for (side, wall) in [Side::Left, Side::Right].into_iter().zip(walls) {
                let laboratory = frame.to_laboratory(side, vector);
                let along = side.sign() * laboratory.dot(&wall.tangent());
                assert!((wall.distance(laboratory, 0.0) - vector.y).abs() < 1e-15);
                assert!((along - vector.x).abs() < 1e-15);
                let other = frame.to_laboratory(side.other(), frame.reflected(vector));
                assert!((other - laboratory).abs() < Vector2::repeat(1e-15));
                let bisector = frame.to_laboratory(side, frame.bisector());
                assert!((bisector - Vector2::new(-tilt.sin(), tilt.cos())).abs() < Vector2::repeat(1e-15));
            }
        }
    }

    #[test]
    fn mirrored_wedges_have_mirrored_bits() {
        let (frame, image) = (WedgeFrame::new(2.0, 0.4), WedgeFrame::new(2.0, -0.4));
        assert_eq!(frame.up(Side::Left), image.up(Side::Right));
        assert_eq!(frame.up(Side::Right), image.up(Side::Left));
    }
}
