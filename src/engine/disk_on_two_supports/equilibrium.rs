//! Where the disk rests with its tangential springs not stretched.

use crate::drive::excitation::SupportMotion;

use super::dynamics::TwoSupportsRig;
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
pub fn equilibrium(rig: &TwoSupportsRig, supports: &[SupportMotion; 2]) -> Result<[f64; 2], NoEquilibrium> {
    let stiffness = rig.normal.stiffness;
    // Overlap of a contact, its force along x and y, and the derivatives of that, per k_n.
    let contact = |index: usize, [x, y]: [f64; 2]| {
        let (frame, support) = (&rig.frames[index], &supports[index]);
        let at = kinematics(frame, rig.curvature, rig.radius, [x, y, 0.0], [0.0; 3], support);
        let normal = [0, 1].map(|axis| at.normal * frame.normal[axis] + at.tangent * frame.tangent[axis]);
        let tangent = [normal[1], -normal[0]];
        // The normal turns by 1/r for a displacement along the tangent.
        let turning = rig.curvature * at.overlap * at.shortness;
        let slope = [0, 1]
            .map(|row| [0, 1].map(|column| turning * tangent[row] * tangent[column] - normal[row] * normal[column]));
        (at.overlap, normal.map(|part| at.overlap * part), slope)
    };
    // Sums of two first, so that mirrored rigs give mirrored bits.
    let forces = |place: [f64; 2]| {
        let ((overlap_1, force_1, slope_1), (overlap_2, force_2, slope_2)) = (contact(0, place), contact(1, place));
        let weight = rig.mass * rig.gravity / stiffness;
        let force = [force_1[0] + force_2[0], (force_1[1] + force_2[1]) - weight];
        let slope = [0, 1].map(|row| [0, 1].map(|column| slope_1[row][column] + slope_2[row][column]));
        (force, slope, overlap_1.min(overlap_2))
    };
    let mut place = [0.0; 2];
    for _ in 0..50 {
        let ([fx, fy], [[xx, xy], [yx, yy]], least) = forces(place);
        let determinant = xx * yy - xy * yx;
        let step = [(xy * fy - yy * fx) / determinant, (yx * fx - xx * fy) / determinant];
        place = [place[0] + step[0], place[1] + step[1]];
        let size = place[0].abs().max(place[1].abs());
        if size.is_nan() || size >= 0.5 * rig.radius {
            return Err(NoEquilibrium);
        }
        if step[0].abs().max(step[1].abs()) <= 4.0 * f64::EPSILON * size {
            return if least > 0.0 { Ok(place) } else { Err(NoEquilibrium) };
        }
    }
    Err(NoEquilibrium)
}
