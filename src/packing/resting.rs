//! Where a disk touches two given elements: pure geometry, the upper root, without cancellation.
//!
//! Distances that are short of a contact by no more than [`CONTACT_TOLERANCE`] count as touching, so that boxes and rows
//! of exactly so many diameters fill as they do on paper.

use crate::geometry::Disk;

/// Gap or overlap that counts as touch, as a part of the contact distance.
pub(super) const CONTACT_TOLERANCE: f64 = 1e-12;

/// Length \[m\] that counts as nothing for a contact at distance `reach` \[m\] around the point (x, y).
pub(super) fn slack(reach: f64, x: f64, y: f64) -> f64 {
    CONTACT_TOLERANCE * reach + 4.0 * f64::EPSILON * (x.abs() + y.abs())
}

/// Centre of a disk of `radius` on top of `a` and `b`, `a` left of `b` (eqs 2.3, 2.4); none if they are too far apart.
///
/// One Newton step on the two distances follows the closed form.
pub(super) fn on_disks(a: &Disk, b: &Disk, radius: f64) -> Option<(f64, f64)> {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let distance = (dx * dx + dy * dy).sqrt(); // not hypot, whose last bit depends on the machine
    let (reach_a, reach_b) = (a.radius + radius, b.radius + radius);
    let reach = reach_a + reach_b;
    let radii = a.radius - b.radius;
    let spare = reach - distance;
    if distance <= radii.abs() || spare < -slack(reach, a.x, a.y) {
        return None;
    }
    let along = 0.5 * (distance + radii * reach / distance);
    let height_squared = spare.max(0.0) * (reach + distance) * (distance - radii) * (distance + radii);
    let height = height_squared.max(0.0).sqrt() / (2.0 * distance);
    let (ux, uy) = (dx / distance, dy / distance);
    let start = (a.x + along * ux - height * uy, a.y + along * uy + height * ux);
    Some(refined(start, (a, reach_a), (b, reach_b)))
}

/// One Newton step towards both contact distances, taken only if it brings both nearer.
fn refined(start: (f64, f64), a: (&Disk, f64), b: (&Disk, f64)) -> (f64, f64) {
    let miss = |(x, y): (f64, f64), (disk, reach): (&Disk, f64)| {
        let (dx, dy) = (x - disk.x, y - disk.y);
        (dx, dy, 0.5 * (dx * dx + dy * dy - reach * reach))
    };
    let (ax, ay, miss_a) = miss(start, a);
    let (bx, by, miss_b) = miss(start, b);
    let determinant = ax * by - ay * bx;
    let step_x = (miss_a * by - miss_b * ay) / determinant;
    let step_y = (ax * miss_b - bx * miss_a) / determinant;
    let next = (start.0 - step_x, start.1 - step_y);
    let (after_a, after_b) = (miss(next, a).2, miss(next, b).2);
    // False as well where the two distances are one and the step is not a number.
    let nearer = after_a.abs() / a.1 + after_b.abs() / b.1 < miss_a.abs() / a.1 + miss_b.abs() / b.1;
    start
}

/// Height of a disk of `radius` whose centre is at `x` and that lies on `support` (eqs 2.5, 2.6 for an upright wall).
pub(super) fn above(support: &Disk, x: f64, radius: f64) -> Option<f64> {
    let reach = support.radius + radius;
    leg(reach, x - support.x, slack(reach, x, support.y)).map(|height| support.y + height)
}

/// Position of a disk of `radius` on the floor, to the right of `neighbour` and touching it (eqs 2.5, 2.6, floor).
pub(super) fn beside(neighbour: &Disk, radius: f64) -> Option<f64> {
    let reach = neighbour.radius + radius;
    leg(reach, neighbour.y - radius, slack(reach, neighbour.x, neighbour.y)).map(|offset| neighbour.x + offset)
}

/// The other leg of a right triangle; none if `leg` is longer than `hypotenuse` by more than `slack`.
fn leg(hypotenuse: f64, leg: f64, slack: f64) -> Option<f64> {
    let spare = hypotenuse - leg.abs();
    (spare >= -slack).then(|| (spare.max(0.0) * (hypotenuse + leg.abs())).sqrt())
}
