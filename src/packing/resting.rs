//! Where a disk touches two given elements: pure geometry, the upper root, without cancellation.
//!
//! Distances that are short of a contact by no more than [`CONTACT_TOLERANCE`] count as touching, so that boxes and rows
//! of exactly so many diameters fill as they do on paper.

use nalgebra::Vector2;

use crate::geometry::{Disk, clockwise};

/// Gap or overlap that counts as touch, as a part of the contact distance.
pub(super) const CONTACT_TOLERANCE: f64 = 1e-12;

/// Length \[m\] that counts as nothing for a contact at a distance \[m\] around a point.
pub(super) fn slack(distance: f64, point: Vector2<f64>) -> f64 {
    CONTACT_TOLERANCE * distance + 4.0 * f64::EPSILON * (point.x.abs() + point.y.abs())
}

/// Centre of a disk of `radius` on top of `a` and `b`, `a` left of `b` (eqs 2.3, 2.4); none if they are too far apart.
///
/// In this form both distances are met to the rounding of the coordinates: to 1.2e-13 of the contact distance at a ratio
/// of radii of 1e8, where a Newton step on top gains a factor of two, and to a few 1e-16 at ordinary ratios.
pub(super) fn on_disks(a: &Disk, b: &Disk, radius: f64) -> Option<Vector2<f64>> {
    let separation = b.centre() - a.centre();
    let distance = separation.norm_squared().sqrt(); // not hypot, whose last bit depends on the machine
    let (sum_a, sum_b) = (a.radius + radius, b.radius + radius);
    let widest = sum_a + sum_b;
    let difference = a.radius - b.radius;
    let spare = widest - distance;
    if distance <= difference.abs() || spare < -slack(widest, a.centre()) {
        return None;
    }
    // (L^2 + R_ia^2 - R_ib^2) / (2 L), written with the small spare so that nothing cancels.
    let along = sum_a - spare * (distance - difference) / (2.0 * distance);
    let height_squared = spare.max(0.0) * (widest + distance) * (distance - difference) * (distance + difference);
    let height = height_squared.max(0.0).sqrt() / (2.0 * distance);
    let direction = separation / distance;
    Some(a.centre() + along * direction - height * clockwise(&direction))
}

/// Height of a disk of `radius` whose centre is at `x` and that lies on `support` (eqs 2.5, 2.6 for an upright wall).
pub(super) fn above(support: &Disk, x: f64, radius: f64) -> Option<f64> {
    let radius_sum = support.radius + radius;
    let slack = slack(radius_sum, Vector2::new(x, support.y));
    leg(radius_sum, x - support.x, slack).map(|height| support.y + height)
}

/// Position of a disk of `radius` on the floor, to the right of `neighbour` and touching it (eqs 2.5, 2.6, floor).
pub(super) fn beside(neighbour: &Disk, radius: f64) -> Option<f64> {
    let radius_sum = neighbour.radius + radius;
    let slack = slack(radius_sum, neighbour.centre());
    leg(radius_sum, neighbour.y - radius, slack).map(|offset| neighbour.x + offset)
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
                        let a = Disk::new(Vector2::new(0.1, 0.2), a);
                        let b = Disk::new(a.centre() + distance * Vector2::new(cosine, sine), b);
                        let centre = on_disks(&a, &b, size).unwrap();
                        let disk = Disk::new(centre, size);
                        let scale = centre.x.abs() + centre.y.abs() + b.x.abs() + b.y.abs();
                        for other in [&a, &b] {
                            let radius_sum = other.radius + size;
                            worst = worst.max(gap(&disk, other).abs() / (radius_sum + scale));
                        }
                        let side = (b.centre() - a.centre()).perp(&(centre - a.centre()));
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
