//! Sawtooth profile: shape in, distance of a point from a tooth and the normal there out.
//!
//! Each tooth counts as a convex body: the wedge between its two sides, continued below the base, with its tip rounded
//! by an arc tangent to both. The solid above height zero is the union of these bodies, and a disk that meets the part of
//! a wedge below the base would have met another tooth before. So the distance from the profile is the smallest of the
//! distances from the teeth, concave valleys need no case of their own, and each distance is a convex function of place
//! with a continuous gradient: what `engine::event_driven::Sawtooth` needs to find first hits for certain.
//!
//! Source: F III, Fig. 5; the height is that of the sharp apex, before rounding.

use std::ops::RangeInclusive;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::clockwise;
use crate::elementary::hypot;
use crate::error::{Error, Result, Shortest};

/// Periodic row of equal teeth; a tooth begins at each multiple of its width.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SawtoothProfile {
    /// Width w \[m\].
    width: f64,
    /// Radius s of the arc \[m\].
    tip_radius: f64,
    /// Centre of the arc of the tooth that begins at zero \[m\].
    centre: Vector2<f64>,
    /// Left and right side.
    sides: [Side; 2],
    /// Height of the rounded top \[m\].
    top: f64,
}

/// One side of a wedge: unit vector down along it, unit normal out of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Side {
    down: Vector2<f64>,
    normal: Vector2<f64>,
}

/// What a point is nearest to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToothPart {
    /// The side of horizontal extent a w, which faces left.
    LeftSide,
    /// The other side.
    RightSide,
    /// The arc that rounds the tip, or the apex if that is sharp.
    Tip,
}

/// Where a point is from a tooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearance {
    /// Distance \[m\].
    pub distance: f64,
    /// Unit normal, from the tooth to the point.
    pub normal: Vector2<f64>,
    /// What the normal stands on.
    pub part: ToothPart,
}

impl SawtoothProfile {
    /// Teeth of this width \[m\], height \[m\] of the sharp apex, asymmetry `a = l / w` in \[0, 1\] with l the horizontal
    /// extent of the left side, and radius \[m\] of the tip. Height 0 is a flat base.
    ///
    /// # Errors
    /// A shape that does not exist, by the names `tooth.width`, `tooth.height`, `tooth.asymmetry`, `tooth.tip_radius`.
    pub fn new(width: f64, height: f64, asymmetry: f64, tip_radius: f64) -> Result<Self> {
        check_shape(width, height, asymmetry, tip_radius)?;
        let (left, right) = (asymmetry * width, (1.0 - asymmetry) * width);
        if height == 0.0 {
            let side = |sign: f64| Side {
                down: Vector2::new(sign, 0.0),
                normal: Vector2::y(),
            };
            return Ok(Self {
                width,
                tip_radius: 0.0,
                centre: Vector2::new(left, 0.0),
                sides: [side(-1.0), side(1.0)],
                top: 0.0,
            });
        }
        if 2.0 * tip_radius > width {
            return Err(Error::parameter(
                "tooth.tip_radius",
                format!("{} m", Shortest(tip_radius)),
                format!(
                    "at most half of tooth.width = {} m: the tooth is narrower than its tip",
                    Shortest(width)
                ),
                "Take a smaller tip or wider teeth.",
            ));
        }
        let lengths = [hypot(left, height), hypot(right, height)];
        let one = Vector2::new(-left, -height) / lengths[0];
        let two = Vector2::new(right, -height) / lengths[1];
        let side = |down, normal| Side { down, normal };
        let sides = [side(one, clockwise(&one)), side(two, -clockwise(&two))];
        // Tangent of half the angle at the apex: |sin| / (1 + cos) of the whole.
        let half = one.perp(&two).abs() / (1.0 + one.dot(&two));
        let shortest = lengths[0].min(lengths[1]);
        if tip_radius > shortest * half {
            return Err(Error::parameter(
                "tooth.tip_radius",
                format!("{} m", Shortest(tip_radius)),
                format!(
                    "at most {} m for teeth {} m wide, {} m high, asymmetry {}: the arc has to touch both sides",
                    Shortest(shortest * half),
                    Shortest(width),
                    Shortest(height),
                    Shortest(asymmetry)
                ),
                "Take a smaller tip, or higher or more even teeth.",
            ));
        }
        // From the apex the centre lies at tip_radius / half down one side and tip_radius inwards.
        let along = if half > 0.0 { tip_radius / half } else { 0.0 };
        let centre = Vector2::new(left, height) + along * one - tip_radius * sides[0].normal;
        Ok(Self {
            width,
            tip_radius,
            centre,
            sides,
            top: centre.y + tip_radius,
        })
    }

    /// Width of a tooth \[m\].
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Height of the rounded tops \[m\].
    pub fn top(&self) -> f64 {
        self.top
    }

    /// Numbers of the teeth of which some part lies within `half_width` \[m\] of `x` \[m\].
    #[inline]
    pub fn teeth_within(&self, half_width: f64, x: f64) -> RangeInclusive<i64> {
        let tooth_at = |x: f64| (x / self.width).floor() as i64;
        tooth_at(x - half_width)..=tooth_at(x + half_width)
    }

    /// Distance of a point outside from tooth `tooth`, and the normal there.
    #[inline]
    pub fn clearance(&self, tooth: i64, point: Vector2<f64>) -> Clearance {
        let from = point - Vector2::new(tooth as f64 * self.width + self.centre.x, self.centre.y);
        for (Side { down, normal }, part) in self.sides.iter().zip([ToothPart::LeftSide, ToothPart::RightSide]) {
            let distance = from.dot(normal);
            if distance > 0.0 && from.dot(down) > 0.0 {
                return Clearance {
                    distance: distance - self.tip_radius,
                    normal: *normal,
                    part,
                };
            }
        }
        let distance = hypot(from.x, from.y);
        Clearance {
            distance: distance - self.tip_radius,
            normal: from / distance,
            part: ToothPart::Tip,
        }
    }
}

/// Refuses a dimension that no tooth has, by its name.
fn check_shape(width: f64, height: f64, asymmetry: f64, tip_radius: f64) -> Result<()> {
    check(
        "tooth.width",
        width,
        f64::MIN_POSITIVE..=f64::MAX,
        "a finite length above 0 m",
    )?;
    check(
        "tooth.height",
        height,
        0.0..=f64::MAX,
        "a finite length from 0 m, which is flat",
    )?;
    let vertical = "from 0, a vertical left side, to 1, a vertical right side";
    check("tooth.asymmetry", asymmetry, 0.0..=1.0, vertical)?;
    check(
        "tooth.tip_radius",
        tip_radius,
        0.0..=f64::MAX,
        "a finite length from 0 m, which is sharp",
    )
}

fn check(name: &str, value: f64, range: RangeInclusive<f64>, allowed: &str) -> Result<()> {
    if range.contains(&value) {
        return Ok(());
    }
    Err(Error::parameter(
        name,
        Shortest(value),
        allowed,
        "Give a value in this range.",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arc_touches_both_sides() {
        for (height, asymmetry, tip_radius) in [
            (6e-3, 0.25, 4e-4),
            (3e-3, 0.1, 4e-4),
            (16e-3, 0.05, 1e-4),
            (5e-3, 0.0, 4e-4),
        ] {
            let width = 6e-3;
            let profile = SawtoothProfile::new(width, height, asymmetry, tip_radius).unwrap();
            let apex = Vector2::new(asymmetry * width, height) - profile.centre;
            for side in &profile.sides {
                assert!(
                    (apex.dot(&side.normal) - tip_radius).abs() < 1e-17,
                    "{height} {asymmetry}"
                );
            }
            assert!(profile.top() < height && profile.top() > 0.5 * height);
        }
    }

    #[test]
    fn flat_and_sharp_profiles_have_exact_distances() {
        let flat = SawtoothProfile::new(6e-3, 0.0, 0.1, 4e-4).unwrap();
        for x in [-1.0, 0.0, 6e-4, 0.3] {
            let Clearance { distance, normal, .. } = flat.clearance(0, Vector2::new(x, 2e-3));
            assert!((distance - 2e-3).abs() < 1e-18 && normal[0].abs() < 1e-12 && normal[1] == 1.0);
        }
        let sharp = SawtoothProfile::new(6e-3, 4e-3, 0.5, 0.0).unwrap();
        let Clearance { distance, normal, part } = sharp.clearance(2, Vector2::new(15e-3, 5e-3));
        assert!((distance - 1e-3).abs() < 1e-17 && (normal[1] - 1.0).abs() < 1e-12);
        assert_eq!(part, ToothPart::Tip);
    }

    #[test]
    fn impossible_shapes_are_refused_by_name() {
        let message = |w, h, a, s| SawtoothProfile::new(w, h, a, s).unwrap_err().to_string();
        assert!(message(0.0, 1e-3, 0.1, 0.0).starts_with("tooth.width = 0"));
        assert!(message(6e-3, -1.0, 0.1, 0.0).starts_with("tooth.height = -1"));
        assert!(message(6e-3, 1e-3, 1.1, 0.0).starts_with("tooth.asymmetry = 1.1"));
        assert!(message(6e-3, 1e-3, 0.1, f64::NAN).starts_with("tooth.tip_radius = NaN"));
        assert!(message(6e-3, 1e-3, 0.1, 4e-3).contains("narrower than its tip"));
        assert!(message(6e-3, 1e-4, 0.0, 1e-3).contains("touch both sides"));
    }
}
