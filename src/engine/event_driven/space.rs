//! Where disks live: an open plane with walls, or a periodic cell. A type, so that walled scenes hold no images.

use serde::{Deserialize, Serialize};

/// Shape of space.
pub trait Space: Clone + Send + 'static {
    /// Whether cells at opposite edges are neighbours.
    const PERIODIC: [bool; 2];

    /// Corner (left, bottom) and size (width, height) \[m\] of the region that the cells divide. Disks beyond an edge
    /// that is not periodic belong to the cells at the edge.
    fn region(&self) -> ([f64; 2], [f64; 2]);

    /// Shortest of the separations that are the same.
    fn shortest(&self, separation: [f64; 2]) -> [f64; 2];

    /// The same place inside the region, and how many periods it was moved.
    fn wrapped(&self, place: [f64; 2]) -> [f64; 2];
}

/// Open plane; the box tells where most disks are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Open {
    /// Left and bottom \[m\].
    pub corner: [f64; 2],
    /// Width and height \[m\].
    pub size: [f64; 2],
}

impl Space for Open {
    const PERIODIC: [bool; 2] = [false, false];

    fn region(&self) -> ([f64; 2], [f64; 2]) {
        (self.corner, self.size)
    }

    #[inline(always)]
    fn shortest(&self, separation: [f64; 2]) -> [f64; 2] {
        separation
    }

    #[inline(always)]
    fn wrapped(&self, place: [f64; 2]) -> [f64; 2] {
        place
    }
}

/// Cell repeated in both directions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Periodic {
    /// Width and height \[m\].
    pub size: [f64; 2],
}

impl Space for Periodic {
    const PERIODIC: [bool; 2] = [true, true];

    fn region(&self) -> ([f64; 2], [f64; 2]) {
        ([0.0, 0.0], self.size)
    }

    #[inline(always)]
    fn shortest(&self, [mut x, mut y]: [f64; 2]) -> [f64; 2] {
        let [width, height] = self.size;
        if x > 0.5 * width {
            x -= width;
        } else if x < -0.5 * width {
            x += width;
        }
        if y > 0.5 * height {
            y -= height;
        } else if y < -0.5 * height {
            y += height;
        }
        [x, y]
    }

    #[inline(always)]
    fn wrapped(&self, [mut x, mut y]: [f64; 2]) -> [f64; 2] {
        let [width, height] = self.size;
        if x >= width {
            x -= width;
        } else if x < 0.0 {
            x += width;
        }
        if y >= height {
            y -= height;
        } else if y < 0.0 {
            y += height;
        }
        [x, y]
    }
}

/// Cell repeated to the left and right, open above and below.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PeriodicAcross {
    /// Period \[m\]; the cell begins at zero.
    pub width: f64,
    /// Bottom and height \[m\] of the region where most disks are.
    pub bottom: f64,
    /// See `bottom`.
    pub height: f64,
}

impl Space for PeriodicAcross {
    const PERIODIC: [bool; 2] = [true, false];

    fn region(&self) -> ([f64; 2], [f64; 2]) {
        ([0.0, self.bottom], [self.width, self.height])
    }

    #[inline(always)]
    fn shortest(&self, [mut x, y]: [f64; 2]) -> [f64; 2] {
        if x > 0.5 * self.width {
            x -= self.width;
        } else if x < -0.5 * self.width {
            x += self.width;
        }
        [x, y]
    }

    #[inline(always)]
    fn wrapped(&self, [mut x, y]: [f64; 2]) -> [f64; 2] {
        if x >= self.width {
            x -= self.width;
        } else if x < 0.0 {
            x += self.width;
        }
        [x, y]
    }
}
