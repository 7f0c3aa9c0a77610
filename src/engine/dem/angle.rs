//! Angles between unit vectors that are nearly parallel.

/// Below this sine the series of the arc sine through the fifth power is exact to rounding: the next term, relative to
/// the first, is 15/336 x^6 < 1e-17.
use crate::elementary::atan2;
pub const SMALL_SINE: f64 = 0.002;

/// Angle \[rad\] from `direction` to `normal`, counter-clockwise, between -pi and pi.
#[inline(always)]
pub fn angle_between(direction: [f64; 2], normal: [f64; 2]) -> f64 {
    let sine = direction[0] * normal[1] - direction[1] * normal[0];
    if sine.abs() < SMALL_SINE {
        return small_arc_sine(sine);
    }
    atan2(sine, direction[0] * normal[0] + direction[1] * normal[1])
}

#[inline(always)]
fn small_arc_sine(x: f64) -> f64 {
    let square = x * x;
    x * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_is_exact_where_it_is_used() {
        for i in -200..=200 {
            let x = SMALL_SINE * f64::from(i) / 200.0;
            assert!((small_arc_sine(x) - x.asin()).abs() <= 2.0 * f64::EPSILON * x.abs());
        }
    }

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
