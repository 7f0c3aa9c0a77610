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
    /// Vector from the centre of the second disk of a pair to that of the first \[m\].
    #[inline(always)]
    pub fn difference(&self, [i, j]: [usize; 2]) -> [f64; 2] {
        let (a, b) = (&self.positions[i], &self.positions[j]);
        [a[0] - b[0], a[1] - b[1]]
    }

    /// Relative motion of two disks; lambda counts beta from the direction of the normal.
    #[inline(always)]
    pub fn of_pair(&self, [i, j]: [usize; 2]) -> Kinematics {
        let [dx, dy] = self.difference([i, j]);
        let distance = (dx * dx + dy * dy).sqrt();
        let (ra, rb) = (self.radii[i], self.radii[j]);
        let radius_sum = ra + rb;
        let inverse = 1.0 / distance;
        let (nx, ny) = (dx * inverse, dy * inverse);
        let (va, vb) = (&self.velocities[i], &self.velocities[j]);
        let (ux, uy) = (va[0] - vb[0], va[1] - vb[1]);
        let sideways = ux * ny - uy * nx;
        let lever = radius_sum * inverse;
        Kinematics {
            overlap: radius_sum - distance,
            closing: -(ux * nx + uy * ny),
            tangential_displacement: ra * self.positions[i][2] + rb * self.positions[j][2],
            sliding: sideways * lever + (ra * va[2] + rb * vb[2]),
            normal: [nx, ny],
            turning: -sideways * inverse,
            lever,
        }
    }

    /// Relative motion of a disk and a wall.
    #[inline(always)]
    pub fn of_wall(&self, disk: usize, wall: &Wall, base: &Motion) -> Kinematics {
        let ([x, y, angle], [vx, vy, spin]) = (self.positions[disk], self.velocities[disk]);
        let radius = self.radii[disk];
        let lift = wall.follows_base * base.displacement;
        let vy = vy - wall.follows_base * base.velocity;
        let ([nx, ny], [tx, ty]) = (wall.normal.into(), wall.tangent().into());
        Kinematics {
            overlap: radius - wall.distance([x, y], base.displacement),
            closing: -(nx * vx + ny * vy),
            tangential_displacement: radius * angle + tx * x + ty * (y - lift),
            sliding: tx * vx + ty * vy + radius * spin,
            normal: [nx, ny],
            turning: 0.0,
            lever: 1.0,
        }
    }
}
