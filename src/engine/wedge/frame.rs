//! Geometry of a wedge as seen from its two walls: a place on one wall in, the same place seen from the other out.
//!
//! The centre of a disk moves in the wedge shifted by `R / sin(theta_W / 2)` up the bisector (P 6.6 as corrected). Its
//! frame is that of one wall: `along` e, up the wall from the vertex, and `above` n, off the wall. Both walls have the
//! same frame but for a reflection, so that mirrored wedges give mirrored bits, and nothing is divided by an angle: walls
//! may be horizontal, vertical or hang over.

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

/// A vector in the frame of a wall.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Local {
    /// Component up the wall, away from the vertex.
    pub along: f64,
    /// Component off the wall, into the wedge.
    pub above: f64,
}

/// The upward unit vector in the frame of a wall, `(sin alpha, cos alpha)` at a slope alpha.
pub type Up = Local;

/// A wedge by its aperture and tilt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    left: Up,
    right: Up,
    /// `cos theta_W`, `sin theta_W`.
    turn: (f64, f64),
    /// `cos(theta_W / 2)`, `sin(theta_W / 2)`: up the bisector in the frame of either wall.
    bisector: Local,
}

impl Frame {
    /// Wedge of aperture theta_W \[rad\], tilted counter-clockwise by theta_T \[rad\]: the left wall has the slope
    /// `alpha_1 = theta_0 - theta_T`, the right one `alpha_2 = theta_0 + theta_T`, with `theta_0 = (pi - theta_W) / 2`.
    pub fn new(aperture: f64, tilt: f64) -> Self {
        let critical = Self::critical_tilt(aperture);
        let up = |slope: f64| Up {
            along: slope.sin(),
            above: slope.cos(),
        };
        let half = 0.5 * aperture;
        Self {
            left: up(critical - tilt),
            right: up(critical + tilt),
            turn: (aperture.cos(), aperture.sin()),
            bisector: Local {
                along: half.cos(),
                above: half.sin(),
            },
        }
    }

    /// Tilt theta_0 \[rad\] at which a wall is horizontal and the wedge no longer confines.
    pub fn critical_tilt(aperture: f64) -> f64 {
        0.5 * (std::f64::consts::PI - aperture)
    }

    /// The upward direction seen from a wall.
    #[inline]
    pub fn up(&self, side: Side) -> Up {
        match side {
            Side::Left => self.left,
            Side::Right => self.right,
        }
    }

    /// The unit vector up the bisector, seen from either wall.
    pub fn bisector(&self) -> Local {
        self.bisector
    }

    /// A vector seen from one wall as seen from the other. Places count from the vertex.
    #[inline]
    pub fn turned(&self, vector: Local) -> Local {
        let (cosine, sine) = self.turn;
        Local {
            along: vector.along * cosine + vector.above * sine,
            above: vector.along * sine - vector.above * cosine,
        }
    }

    /// A vector seen from a wall in the laboratory, x to the right and y up.
    pub fn laboratory(&self, side: Side, vector: Local) -> [f64; 2] {
        let up = self.up(side);
        [
            side.sign() * (vector.along * up.above - vector.above * up.along),
            vector.along * up.along + vector.above * up.above,
        ]
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
            let frame = Frame::new(aperture, tilt);
            let critical = Frame::critical_tilt(aperture);
            let walls = [-(critical - tilt), critical + tilt].map(Wall::vibrating_slope);
            let vector = Local {
                along: 0.7,
                above: -0.4,
            };
            for (side, wall) in [Side::Left, Side::Right].into_iter().zip(walls) {
                let [x, y] = frame.laboratory(side, vector);
                let along = side.sign() * (x * wall.tangent()[0] + y * wall.tangent()[1]);
                assert!((wall.distance(x, y, 0.0) - vector.above).abs() < 1e-15);
                assert!((along - vector.along).abs() < 1e-15);
                let seen = frame.laboratory(side.other(), frame.turned(vector));
                assert!((seen[0] - x).abs() < 1e-15 && (seen[1] - y).abs() < 1e-15);
                let [x, y] = frame.laboratory(side, frame.bisector());
                assert!((x + tilt.sin()).abs() < 1e-15 && (y - tilt.cos()).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn mirrored_wedges_have_mirrored_bits() {
        let (frame, image) = (Frame::new(2.0, 0.4), Frame::new(2.0, -0.4));
        assert_eq!(frame.up(Side::Left), image.up(Side::Right));
        assert_eq!(frame.up(Side::Right), image.up(Side::Left));
    }
}
