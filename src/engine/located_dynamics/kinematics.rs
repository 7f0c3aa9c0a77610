//! Relative motion of two bodies in the frame of their contact.

use crate::drive::Motion;
use crate::geometry::Wall;

use super::state::Kinematics;

/// Places and rates of all disks at one instant.
#[derive(Clone, Copy)]
pub struct Disks<'a> {
    /// x, y, angle.
    pub places: &'a [[f64; 3]],
    /// Their rates.
    pub rates: &'a [[f64; 3]],
    /// Radii \[m\].
    pub radii: &'a [f64],
}

impl Disks<'_> {
    /// Vector from the centre of the second disk of a pair to that of the first \[m\].
    #[inline(always)]
    pub fn difference(&self, (i, j): (usize, usize)) -> [f64; 2] {
        let (a, b) = (&self.places[i], &self.places[j]);
        [a[0] - b[0], a[1] - b[1]]
    }

    /// Relative motion of two disks; lambda counts beta from the direction of the normal.
    #[inline(always)]
    pub fn of_pair(&self, (i, j): (usize, usize)) -> Kinematics {
        let [dx, dy] = self.difference((i, j));
        let distance = (dx * dx + dy * dy).sqrt();
        let (ra, rb) = (self.radii[i], self.radii[j]);
        let reach = ra + rb;
        let inverse = 1.0 / distance;
        let (nx, ny) = (dx * inverse, dy * inverse);
        let (va, vb) = (&self.rates[i], &self.rates[j]);
        let (ux, uy) = (va[0] - vb[0], va[1] - vb[1]);
        let sideways = ux * ny - uy * nx;
        let lever = reach * inverse;
        Kinematics {
            overlap: reach - distance,
            closing: -(ux * nx + uy * ny),
            surface: ra * self.places[i][2] + rb * self.places[j][2],
            sliding: sideways * lever + (ra * va[2] + rb * vb[2]),
            normal: [nx, ny],
            turning: -sideways * inverse,
            lever,
        }
    }

    /// Relative motion of a disk and a wall.
    #[inline(always)]
    pub fn of_wall(&self, disk: usize, wall: &Wall, base: &Motion) -> Kinematics {
        let ([x, y, angle], [vx, vy, spin]) = (self.places[disk], self.rates[disk]);
        let radius = self.radii[disk];
        let lift = wall.follows_base * base.displacement;
        let vy = vy - wall.follows_base * base.velocity;
        let ([nx, ny], [tx, ty]) = (wall.normal.into(), wall.tangent().into());
        Kinematics {
            overlap: radius - wall.distance([x, y], base.displacement),
            closing: -(nx * vx + ny * vy),
            surface: radius * angle + tx * x + ty * (y - lift),
            sliding: tx * vx + ty * vy + radius * spin,
            normal: [nx, ny],
            turning: 0.0,
            lever: 1.0,
        }
    }
}

/// Below this the series of the arc sine through the fifth power is exact to rounding.
const SMALL_SINE: f64 = 0.002;

/// Angle \[rad\] from `direction` to `normal`, counter-clockwise, between -pi and pi.
#[inline(always)]
pub fn angle_between(direction: [f64; 2], normal: [f64; 2]) -> f64 {
    let sine = direction[0] * normal[1] - direction[1] * normal[0];
    if sine.abs() < SMALL_SINE {
        let square = sine * sine;
        return sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0)));
    }
    sine.atan2(direction[0] * normal[0] + direction[1] * normal[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_right_on_both_sides_of_the_series() {
        for angle in [-3.0_f64, -0.5, -0.002_001, -0.001_999, 0.0, 1e-9, 0.001_9, 0.1, 2.5] {
            let found = angle_between([0.6, 0.8], {
                let (sine, cosine) = angle.sin_cos();
                [0.6 * cosine - 0.8 * sine, 0.6 * sine + 0.8 * cosine]
            });
            assert!((found - angle).abs() < 4.0 * f64::EPSILON, "{angle} {found}");
        }
    }
}
