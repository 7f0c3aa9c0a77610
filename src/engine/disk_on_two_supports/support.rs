//! Where the disk touches a support, from displacements that stay small: overlap, tangential displacement, frame.
//!
//! Everything is counted from the place where both contacts just touch, so that overlaps of 1e-3 and stretches of 1e-7 of
//! a radius keep all their digits. A support is a disk or, with curvature zero, a wall: the formulas hold for both.

use crate::drive::excitation::SupportMotion;
use crate::elementary::{atan, sin_cos};

/// Directions of a contact at the place where the disk just touches both supports.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SupportFrame {
    /// From the support to the disk.
    pub normal: [f64; 2],
    /// The normal turned clockwise: the surface of a disk that turns counter-clockwise moves along it at the contact.
    pub tangent: [f64; 2],
}

impl SupportFrame {
    /// Contact whose normal is turned counter-clockwise from the vertical by `angle` \[rad\].
    ///
    /// The left contact has `angle = -alpha_1`, the right one `alpha_2` (P 4.1).
    pub fn new(angle: f64) -> Self {
        let (sine, cosine) = sin_cos(angle);
        Self {
            normal: [-sine, cosine],
            tangent: [cosine, sine],
        }
    }
}

/// A contact at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    /// Components of the present normal along those of the frame; the tangent has (-tangent, normal) of them.
    pub normal: f64,
    /// See `normal`.
    pub tangent: f64,
    /// Sum of the radii over the distance of the centres; 1 at a wall.
    pub shortness: f64,
    /// Overlap delta \[m\], negative while apart.
    pub overlap: f64,
    /// Its rate \[m/s\], minus the normal velocity u_n of P 4.1.
    pub overlap_rate: f64,
    /// Tangential displacement lambda \[m\] (P 4.5, 4.7), counted from where the disk just touches both supports.
    pub tangential_displacement: f64,
    /// Its rate \[m/s\].
    pub tangential_velocity: f64,
    /// Centripetal part of the second rate of the overlap \[m/s2\].
    pub centripetal: f64,
}

/// atan(x) / x, smooth and even in x.
#[inline]
fn arc_over_slope(slope: f64) -> f64 {
    let square = slope * slope;
    if square < 1e-4 {
        // The next term is square^6 / 13 < 1e-25.
        let tail = 1.0 / 7.0 - square * (1.0 / 9.0 - square * (1.0 / 11.0));
        1.0 - square * (1.0 / 3.0 - square * (1.0 / 5.0 - square * tail))
    } else {
        atan(slope) / slope
    }
}

/// A contact between the disk of `radius` \[m\], with `place` (x, y, angle) and `rates`, and a support.
///
/// `curvature` \[1/m\] is 1 / (R + R_i), 0 at a wall. lambda = R theta + R theta_i + (arc along the support), whose sign is
/// that of the frame's tangent. Source: P 4.5, 4.7 with ERRATA's signs.
#[inline(always)]
pub fn kinematics(
    frame: &SupportFrame,
    curvature: f64,
    radius: f64,
    place: [f64; 3],
    rates: [f64; 3],
    support: &SupportMotion,
) -> Kinematics {
    let along = |direction: [f64; 2], vector: [f64; 2]| vector[0] * direction[0] + vector[1] * direction[1];
    let off = [place[0] - support.place[0], place[1] - support.place[1]];
    let speed = [rates[0] - support.rates[0], rates[1] - support.rates[1]];
    let (up, side) = (along(frame.normal, off), along(frame.tangent, off));
    let (up_rate, side_rate) = (along(frame.normal, speed), along(frame.tangent, speed));

    let (ahead, across) = (1.0 + curvature * up, curvature * side);
    let stretch = (ahead * ahead + across * across).sqrt();
    let shortness = 1.0 / stretch;
    let (normal, tangent) = (ahead * shortness, across * shortness);
    let outward = up_rate * normal + side_rate * tangent;
    let sideways = side_rate * normal - up_rate * tangent;
    let slope = across / ahead;
    let arc = side / ahead * arc_over_slope(slope);
    Kinematics {
        normal,
        tangent,
        shortness,
        // (1 - stretch) / curvature without its cancellation.
        overlap: -(2.0 * up + curvature * (up * up + side * side)) / (1.0 + stretch),
        overlap_rate: -outward,
        tangential_displacement: radius * (place[2] + support.place[2]) + arc,
        tangential_velocity: radius * (rates[2] + support.rates[2]) + sideways * shortness,
        centripetal: -curvature * sideways * sideways * shortness,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two disks by the formulas as printed, away from where these cancel.
    #[test]
    fn agrees_with_distances_and_angles_as_printed() {
        let (radius, angle) = (0.7, 0.4_f64);
        let frame = SupportFrame::new(angle);
        let support = SupportMotion {
            place: [0.02, -0.03, 0.3],
            ..SupportMotion::REST
        };
        let place = [0.05, -0.11, 0.9];
        let found = kinematics(&frame, 0.5 / radius, radius, place, [0.0; 3], &support);
        // Centres: support at its own displacement, disk at two radii up the normal.
        let from = [
            2.0 * radius * frame.normal[0] + place[0] - support.place[0],
            2.0 * radius * frame.normal[1] + place[1] - support.place[1],
        ];
        let distance = from[0].hypot(from[1]);
        assert!((found.overlap - (2.0 * radius - distance)).abs() < 1e-15);
        let turned = from[1].atan2(from[0]) - frame.normal[1].atan2(frame.normal[0]);
        let tangential_displacement = radius * place[2] + radius * support.place[2] - 2.0 * radius * turned;
        assert!(
            (found.tangential_displacement - tangential_displacement).abs() < 1e-15,
            "{} {tangential_displacement}",
            found.tangential_displacement
        );
    }

    #[test]
    fn rates_are_derivatives() {
        let frame = SupportFrame::new(-0.3);
        for curvature in [0.0, 0.5] {
            let at = |time: f64| {
                let support = SupportMotion {
                    place: [0.01 * time, 0.02 * time, -0.3 * time],
                    rates: [0.01, 0.02, -0.3],
                    ..SupportMotion::REST
                };
                kinematics(
                    &frame,
                    curvature,
                    1.0,
                    [0.1 * time, 0.3 * time, 2.0 * time],
                    [0.1, 0.3, 2.0],
                    &support,
                )
            };
            let h = 1e-6;
            let slope = |value: fn(&Kinematics) -> f64| (value(&at(0.5 + h)) - value(&at(0.5 - h))) / (2.0 * h);
            let now = at(0.5);
            assert!((slope(|k| k.overlap) - now.overlap_rate).abs() < 1e-9);
            assert!((slope(|k| k.tangential_displacement) - now.tangential_velocity).abs() < 1e-9);
            // No acceleration: all of the second rate is centripetal.
            assert!((slope(|k| k.overlap_rate) - now.centripetal).abs() < 1e-9);
        }
    }
}
