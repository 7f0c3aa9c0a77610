//! Sawtooth profile: shape in, distance of a point from a tooth and the normal there out.
//!
//! Each tooth counts as a convex body: the wedge between its two sides, continued below the base, with its tip rounded
//! by an arc tangent to both. The solid above height zero is the union of these bodies, and a disk that meets the part of
//! a wedge below the base would have met another tooth before. So the distance from the profile is the smallest of the
//! distances from the teeth, concave valleys need no case of their own, and each distance is a convex function of place
//! with a continuous gradient: what `engine::event_driven::Sawtooth` needs to find first hits for certain.
//!
//! Source: F III, Fig. 5; the height is that of the sharp apex, before rounding.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};

/// Periodic row of equal teeth; a tooth begins at each multiple of its width.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SawtoothProfile {
    /// Width w \[m\].
    width: f64,
    /// Radius s of the arc \[m\].
    tip_radius: f64,
    /// Centre of the arc of the tooth that begins at zero \[m\].
    centre: [f64; 2],
    /// Left and right side.
    sides: [Side; 2],
    /// Height of the rounded top \[m\].
    top: f64,
}

/// One side of a wedge: unit vector down along it, unit normal out of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Side {
    down: [f64; 2],
    normal: [f64; 2],
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl SawtoothProfile {
    /// Teeth of this width \[m\], height \[m\] of the sharp apex, asymmetry `a = l / w` in \[0, 1\] with l the horizontal
    /// extent of the left side, and radius \[m\] of the tip. Height 0 is a flat base.
    ///
    /// # Errors
    /// A shape that does not exist, by the names `tooth.width`, `tooth.height`, `tooth.asymmetry`, `tooth.tip_radius`.
    pub fn new(width: f64, height: f64, asymmetry: f64, tip_radius: f64) -> Result<Self> {
        check(
            "tooth.width",
            width,
            f64::MIN_POSITIVE,
            f64::MAX,
            "a finite length above 0 m",
        )?;
        check(
            "tooth.height",
            height,
            0.0,
            f64::MAX,
            "a finite length from 0 m, which is flat",
        )?;
        check(
            "tooth.asymmetry",
            asymmetry,
            0.0,
            1.0,
            "from 0, a vertical left side, to 1, a vertical right side",
        )?;
        check(
            "tooth.tip_radius",
            tip_radius,
            0.0,
            f64::MAX,
            "a finite length from 0 m, which is sharp",
        )?;
        let (left, right) = (asymmetry * width, (1.0 - asymmetry) * width);
        if height == 0.0 {
            let side = |sign: f64| Side {
                down: [sign, 0.0],
                normal: [0.0, 1.0],
            };
            return Ok(Self {
                width,
                tip_radius: 0.0,
                centre: [left, 0.0],
                sides: [side(-1.0), side(1.0)],
                top: 0.0,
            });
        }
        if 2.0 * tip_radius > width {
            return Err(Error::parameter(
                "tooth.tip_radius",
                format!("{tip_radius} m"),
                format!("at most half of tooth.width = {width} m: the tooth is narrower than its tip"),
                "Take a smaller tip or wider teeth.",
            ));
        }
        let lengths = [left.hypot(height), right.hypot(height)];
        let sides = [
            Side {
                down: [-left / lengths[0], -height / lengths[0]],
                normal: [-height / lengths[0], left / lengths[0]],
            },
            Side {
                down: [right / lengths[1], -height / lengths[1]],
                normal: [height / lengths[1], right / lengths[1]],
            },
        ];
        // Tangent of half the angle at the apex: |sin| / (1 + cos) of the whole.
        let (one, two) = (sides[0].down, sides[1].down);
        let half = (one[0] * two[1] - one[1] * two[0]).abs() / (1.0 + dot(one, two));
        let shortest = lengths[0].min(lengths[1]);
        if tip_radius > shortest * half {
            return Err(Error::parameter(
                "tooth.tip_radius",
                format!("{tip_radius} m"),
                format!(
                    "at most {} m for teeth {width} m wide, {height} m high, asymmetry {asymmetry}: the arc has to touch \
                     both sides",
                    shortest * half
                ),
                "Take a smaller tip, or higher or more even teeth.",
            ));
        }
        // From the apex the centre lies at tip_radius / half down one side and tip_radius inwards.
        let along = if half > 0.0 { tip_radius / half } else { 0.0 };
        let centre = [
            left + along * one[0] - tip_radius * sides[0].normal[0],
            height + along * one[1] - tip_radius * sides[0].normal[1],
        ];
        Ok(Self {
            width,
            tip_radius,
            centre,
            sides,
            top: centre[1] + tip_radius,
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

    /// Numbers of the first and the last tooth of which some part lies between `left` and `right` \[m\].
    #[inline]
    pub fn teeth_between(&self, left: f64, right: f64) -> (i64, i64) {
        ((left / self.width).floor() as i64, (right / self.width).floor() as i64)
    }

    /// Distance \[m\] of a point outside from tooth `tooth`, and the unit normal from there to the point.
    #[inline]
    pub fn distance(&self, tooth: i64, [x, y]: [f64; 2]) -> (f64, [f64; 2]) {
        let from = [x - (tooth as f64 * self.width + self.centre[0]), y - self.centre[1]];
        for side in &self.sides {
            let out = dot(from, side.normal);
            if out > 0.0 && dot(from, side.down) > 0.0 {
                return (out - self.tip_radius, side.normal);
            }
        }
        let distance = from[0].hypot(from[1]);
        (distance - self.tip_radius, [from[0] / distance, from[1] / distance])
    }
}

fn check(name: &str, value: f64, least: f64, most: f64, allowed: &str) -> Result<()> {
    if value.is_finite() && (least..=most).contains(&value) {
        return Ok(());
    }
    Err(Error::parameter(name, value, allowed, "Give a value in this range."))
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
            let apex = [asymmetry * width - profile.centre[0], height - profile.centre[1]];
            for side in &profile.sides {
                assert!(
                    (dot(apex, side.normal) - tip_radius).abs() < 1e-17,
                    "{height} {asymmetry}"
                );
            }
            assert!(profile.top() < height && profile.top() > 0.5 * height);
        }
    }

    #[test]
    fn flat_and_sharp_profiles() {
        let flat = SawtoothProfile::new(6e-3, 0.0, 0.1, 4e-4).unwrap();
        for x in [-1.0, 0.0, 6e-4, 0.3] {
            let (distance, normal) = flat.distance(0, [x, 2e-3]);
            assert!((distance - 2e-3).abs() < 1e-18 && normal[0].abs() < 1e-12 && normal[1] == 1.0);
        }
        let sharp = SawtoothProfile::new(6e-3, 4e-3, 0.5, 0.0).unwrap();
        let (distance, normal) = sharp.distance(2, [15e-3, 5e-3]);
        assert!((distance - 1e-3).abs() < 1e-17 && (normal[1] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn impossible_shapes_are_refused_by_name() {
        let told = |w, h, a, s| SawtoothProfile::new(w, h, a, s).unwrap_err().to_string();
        assert!(told(0.0, 1e-3, 0.1, 0.0).starts_with("tooth.width = 0"));
        assert!(told(6e-3, -1.0, 0.1, 0.0).starts_with("tooth.height = -1"));
        assert!(told(6e-3, 1e-3, 1.1, 0.0).starts_with("tooth.asymmetry = 1.1"));
        assert!(told(6e-3, 1e-3, 0.1, f64::NAN).starts_with("tooth.tip_radius = NaN"));
        assert!(told(6e-3, 1e-3, 0.1, 4e-3).contains("narrower than its tip"));
        assert!(told(6e-3, 1e-4, 0.0, 1e-3).contains("touch both sides"));
    }
}
