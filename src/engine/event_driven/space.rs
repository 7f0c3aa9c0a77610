//! Where disks live: an open plane with walls, or a periodic cell. A type, so that walled scenes have no images.

use nalgebra::Vector2;

/// Rectangle that the cells of the neighbour search divide. Disks beyond an edge that is not periodic belong to the cells
/// at the edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// Left and bottom \[m\].
    pub corner: Vector2<f64>,
    /// Width and height \[m\].
    pub size: Vector2<f64>,
}

/// Shape of space.
pub trait Space: Copy + Send + 'static {
    /// Whether opposite edges are the same: left and right, bottom and top.
    const PERIODIC: [bool; 2];

    /// The region; in a periodic direction one period.
    fn region(&self) -> Region;

    /// Shortest of the separations \[m\] of all images of two points.
    #[inline(always)]
    fn nearest_image(&self, separation: Vector2<f64>) -> Vector2<f64> {
        let size = self.region().size;
        let nearest = |axis: usize| match separation[axis] {
            far if Self::PERIODIC[axis] && far > 0.5 * size[axis] => far - size[axis],
            far if Self::PERIODIC[axis] && far < -0.5 * size[axis] => far + size[axis],
            near => near,
        };
        Vector2::new(nearest(0), nearest(1))
    }

    /// The image of a position inside the region, at most one period away.
    #[inline(always)]
    fn wrapped(&self, position: Vector2<f64>) -> Vector2<f64> {
        let Region { corner, size } = self.region();
        let wrapped = |axis: usize| match position[axis] {
            right if Self::PERIODIC[axis] && right >= corner[axis] + size[axis] => right - size[axis],
            left if Self::PERIODIC[axis] && left < corner[axis] => left + size[axis],
            inside => inside,
        };
        Vector2::new(wrapped(0), wrapped(1))
    }
}

/// Open plane; most disks are in the region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Open(pub Region);

/// Region repeated in both directions: the cell of a gas, the standard benchmark of event-driven engines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Periodic(pub Region);

/// Region repeated to the left and right, open above and below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeriodicAcross(pub Region);

impl Space for Open {
    const PERIODIC: [bool; 2] = [false, false];

    #[inline(always)]
    fn region(&self) -> Region {
        self.0
    }
}

impl Space for Periodic {
    const PERIODIC: [bool; 2] = [true, true];

    #[inline(always)]
    fn region(&self) -> Region {
        self.0
    }
}

impl Space for PeriodicAcross {
    const PERIODIC: [bool; 2] = [true, false];

    #[inline(always)]
    fn region(&self) -> Region {
        self.0
    }
}
