//! Where the disk rests with its skins not stretched.

use crate::drive::excitation::SupportMotion;

use super::dynamics::Bench;
use super::support::kinematics;

/// There is no place near where both contacts touch at which the disk rests on them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoEquilibrium;

/// Place (x, y) \[m\] at which the normal forces alone carry the disk, with the supports at these places.
///
/// Newton's method on P 4.23, 4.24 with tau = 0, to rounding.
///
/// # Errors
/// A contact would have to pull, or overlaps are no longer small.
pub fn equilibrium(bench: &Bench, supports: &[SupportMotion; 2]) -> Result<[f64; 2], NoEquilibrium> {
    let stiffness = bench.normal.stiffness;
    // Force along x and y, and its derivatives, per k_n.
    let forces = |[x, y]: [f64; 2]| {
        let mut force = [0.0, -bench.mass * bench.gravity / stiffness];
        let mut slope = [[0.0; 2]; 2];
        let mut least = f64::INFINITY;
        for (frame, support) in bench.frames.iter().zip(supports) {
            let at = kinematics(frame, bench.curvature, bench.radius, [x, y, 0.0], [0.0; 3], support);
            let normal = [0, 1].map(|axis| at.normal * frame.normal[axis] + at.tangent * frame.tangent[axis]);
            let tangent = [normal[1], -normal[0]];
            // The normal turns by 1/r for a displacement along the tangent.
            let turning = bench.curvature * at.overlap * at.shortness;
            least = least.min(at.overlap);
            for row in 0..2 {
                force[row] += at.overlap * normal[row];
                for column in 0..2 {
                    slope[row][column] -= normal[row] * normal[column] - turning * tangent[row] * tangent[column];
                }
            }
        }
        (force, slope, least)
    };
    let mut place = [0.0; 2];
    for _ in 0..50 {
        let ([fx, fy], [[xx, xy], [yx, yy]], least) = forces(place);
        let determinant = xx * yy - xy * yx;
        let step = [(xy * fy - yy * fx) / determinant, (yx * fx - xx * fy) / determinant];
        place = [place[0] + step[0], place[1] + step[1]];
        let size = place[0].abs().max(place[1].abs());
        if !(size < 0.5 * bench.radius) {
            return Err(NoEquilibrium);
        }
        if step[0].abs().max(step[1].abs()) <= 4.0 * f64::EPSILON * size {
            return if least > 0.0 { Ok(place) } else { Err(NoEquilibrium) };
        }
    }
    Err(NoEquilibrium)
}
