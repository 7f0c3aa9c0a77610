//! Relative motion of two bodies in the frame of their contact.

use crate::drive::Motion;
use crate::geometry::Wall;

use super::state::Kinematics;

/// Positions and velocities of all disks at one instant.
#[derive(Clone, Copy)]
pub struct DiskArrays<'a> {
    /// x, y, angle.
    pub positions: &'a [[f64; 3]],
    /// Their rates.
    pub velocities: &'a [[f64; 3]],
    /// Radii \[m\].
    pub radii: &'a [f64],
}

impl DiskArrays<'_> {
    /// Relative motion of two disks; lambda counts beta from the direction of the normal.
    #[inline(always)]
    pub fn of_pair(&self, [i, j]: [usize; 2]) -> Kinematics {
        let (a, b) = (&self.positions[i], &self.positions[j]);
        let (va, vb) = (&self.velocities[i], &self.velocities[j]);
        let (ra, rb) = (self.radii[i], self.radii[j]);
        let arcs = RelativeArcs {
            arc: ra * a[2] + rb * b[2],
            rate: ra * va[2] + rb * vb[2],
        };
        Kinematics::of_pair(
            [a[0] - b[0], a[1] - b[1]],
            [va[0] - vb[0], va[1] - vb[1]],
            ra + rb,
            arcs,
        )
    }

    /// Relative motion of a disk and a wall.
    #[inline(always)]
    pub fn of_wall(&self, disk: usize, wall: &Wall, base: &Motion) -> Kinematics {
        let ([x, y, angle], [vx, vy, spin]) = (self.positions[disk], self.velocities[disk]);
        let radius = self.radii[disk];
        let arcs = RelativeArcs {
            arc: radius * angle,
            rate: radius * spin,
        };
        Kinematics::of_wall([x, y], [vx, vy], radius, wall, [base.displacement, base.velocity], arcs)
    }
}

/// Sum of radius times angle of the bodies in contact \[m\], and its rate \[m/s\].
#[derive(Debug, Clone, Copy)]
pub struct RelativeArcs {
    /// \[m\]
    pub arc: f64,
    /// \[m/s\]
    pub rate: f64,
}

impl Kinematics {
    /// Of two disks at this distance, vector and rate from the second to the first.
    #[inline(always)]
    pub fn of_pair([dx, dy]: [f64; 2], [ux, uy]: [f64; 2], radius_sum: f64, arcs: RelativeArcs) -> Self {
        let distance = (dx * dx + dy * dy).sqrt();
        let inverse = 1.0 / distance;
        let (nx, ny) = (dx * inverse, dy * inverse);
        let sideways = ux * ny - uy * nx;
        let lever = radius_sum * inverse;
        Self {
            overlap: radius_sum - distance,
            closing: -(ux * nx + uy * ny),
            tangential_displacement: arcs.arc,
            sliding: sideways * lever + arcs.rate,
            normal: [nx, ny],
            turning: -sideways * inverse,
            lever,
        }
    }

    /// Of a disk at a wall, whose base has this displacement \[m\] and velocity \[m/s\].
    #[inline(always)]
    pub fn of_wall(
        [x, y]: [f64; 2],
        [vx, vy]: [f64; 2],
        radius: f64,
        wall: &Wall,
        [displacement, velocity]: [f64; 2],
        arcs: RelativeArcs,
    ) -> Self {
        let lift = wall.follows_base * displacement;
        let vy = vy - wall.follows_base * velocity;
        let ([nx, ny], [tx, ty]) = (wall.normal.into(), wall.tangent().into());
        Self {
            overlap: radius - wall.distance([x, y], displacement),
            closing: -(nx * vx + ny * vy),
            tangential_displacement: arcs.arc + tx * x + ty * (y - lift),
            sliding: tx * vx + ty * vy + arcs.rate,
            normal: [nx, ny],
            turning: 0.0,
            lever: 1.0,
        }
    }
}
