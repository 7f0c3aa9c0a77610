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
/// In this form both distances are met to the rounding of the coordinates: to 1.2e-13 of the contact distance at a ratio
/// of radii of 1e8, where a Newton step on top gains a factor of two, and to a few 1e-16 at ordinary ratios.
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
    // (L^2 + R_ia^2 - R_ib^2) / (2 L), written with the small spare so that nothing cancels.
    let along = reach_a - spare * (distance - radii) / (2.0 * distance);
    let height_squared = spare.max(0.0) * (reach + distance) * (distance - radii) * (distance + radii);
    let height = height_squared.max(0.0).sqrt() / (2.0 * distance);
    let (ux, uy) = (dx / distance, dy / distance);
    Some((a.x + along * ux - height * uy, a.y + along * uy + height * ux))
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

#[cfg(test)]
mod tests {
    use super::*;

    fn gap(a: &Disk, b: &Disk) -> f64 {
        (a.x - b.x).hypot(a.y - b.y) - (a.radius + b.radius)
    }

    /// Largest miss of a contact distance, in its own units, over gaps from tight to nearly too wide and steep chords.
    #[test]
    fn both_contact_distances_are_met_to_a_few_units_in_the_last_place() {
        let mut worst = 0.0f64;
        for ratio in [1.0, 1.7, 20.0, 1e4, 1e-4] {
            for size in [1e-4, 0.3, 1.0, 1e4] {
                for closeness in [1.0 - 1e-15, 1.0 - 1e-13, 1.0 - 1e-9, 0.9, 0.5, 1e-3, 1e-9] {
                    for degrees in [-89.9f64, -60.0, 0.0, 1e-9, 45.0, 89.0] {
                        let (a, b) = (1.0, ratio);
                        let distance = (a + b) + 2.0 * size * closeness;
                        let (sine, cosine) = degrees.to_radians().sin_cos();
                        let a = Disk {
                            x: 0.1,
                            y: 0.2,
                            radius: a,
                        };
                        let b = Disk {
                            x: a.x + distance * cosine,
                            y: a.y + distance * sine,
                            radius: b,
                        };
                        let (x, y) = on_disks(&a, &b, size).unwrap();
                        let disk = Disk { x, y, radius: size };
                        let scale = x.abs() + y.abs() + b.x.abs() + b.y.abs();
                        for other in [&a, &b] {
                            let reach = other.radius + size;
                            worst = worst.max(gap(&disk, other).abs() / (reach + scale));
                        }
                        let side = (y - a.y) * (b.x - a.x) - (x - a.x) * (b.y - a.y);
                        assert!(
                            side >= -1e-12 * distance * (a.radius + size),
                            "below the chord: {disk:?}"
                        );
                    }
                }
            }
        }
        assert!(worst < 8.0 * f64::EPSILON, "{worst:e}");
    }
}
