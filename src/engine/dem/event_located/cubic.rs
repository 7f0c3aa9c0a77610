//! Hermite's cubic over one step, by the half sums and half differences of what it has at the two ends: at the nodes of
//! Gauss's rule, which lie alike on both sides of the middle, its even and its odd part serve both nodes.
//!
//! Time is scaled to 0 to 1, so that slopes are those in time times the step and second derivatives times its square.

use std::ops::{Add, Mul, Sub};

/// A number, or several in lanes.
pub trait Lanes: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> {}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>> Lanes for T {}

/// Distance of the nodes of Gauss's rule from the middle of the step, 1 / (2 sqrt 3); each stands for half of the step.
pub const NODE: f64 = 0.288_675_134_594_812_9;

/// The cubic with two values and two slopes.
#[derive(Debug, Clone, Copy)]
pub struct Cubic<T> {
    /// Sum of the values at the start and at the end.
    values: T,
    /// Value at the start less that at the end.
    fall: T,
    /// Sum of the slopes.
    slopes: T,
    /// Slope at the start less that at the end.
    bend: T,
}

impl<T: Lanes> Cubic<T> {
    /// With these values and slopes at the start and at the end.
    #[inline(always)]
    pub fn new([value, slope]: [T; 2], [end_value, end_slope]: [T; 2]) -> Self {
        Self {
            values: value + end_value,
            fall: value - end_value,
            slopes: slope + end_slope,
            bend: slope - end_slope,
        }
    }

    /// Values at both nodes.
    #[inline(always)]
    pub fn at_nodes(&self) -> [T; 2] {
        let even = self.values * 0.5 + self.bend * (1.0 / 12.0);
        let odd = self.fall * (4.0 / 3.0 * NODE) + self.slopes * (NODE / 6.0);
        [even + odd, even - odd]
    }

    /// Slopes at both nodes.
    #[inline(always)]
    pub fn slopes_at_nodes(&self) -> [T; 2] {
        let odd = self.bend * NODE;
        [odd - self.fall, self.fall * -1.0 - odd]
    }

    /// Second derivatives at both nodes.
    #[inline(always)]
    pub fn bends_at_nodes(&self) -> [T; 2] {
        self.bends(2.0 * NODE)
    }

    /// Second derivatives at both ends.
    #[inline(always)]
    pub fn bends_at_ends(&self) -> [T; 2] {
        self.bends(1.0)
    }

    /// Second derivatives at the part `at` of the half step before and behind the middle.
    #[inline(always)]
    fn bends(&self, at: f64) -> [T; 2] {
        let odd = (self.fall * 2.0 + self.slopes) * (3.0 * at);
        [self.bend * -1.0 - odd, odd - self.bend]
    }
}

/// Integral over the step of what has these values at the nodes, and its first moment about the end of the step.
#[inline(always)]
pub fn integrals<T: Lanes>([first, second]: [T; 2], step: f64) -> [T; 2] {
    let integral = (first + second) * (0.5 * step);
    let moment = integral * (0.5 * step) + (first - second) * (0.5 * step * step * NODE);
    [integral, moment]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 1 + 2 x - 3 x^2 + 5 x^3.
    #[test]
    fn a_cubic_is_reproduced() {
        let cubic = Cubic::new([1.0, 2.0], [5.0, 11.0]);
        for (k, x) in [0.5 - NODE, 0.5 + NODE].into_iter().enumerate() {
            let near = |found: f64, exact: f64| assert!((found - exact).abs() < 1e-14, "{found} {exact}");
            near(cubic.at_nodes()[k], 1.0 + x * (2.0 + x * (-3.0 + 5.0 * x)));
            near(cubic.slopes_at_nodes()[k], 2.0 + x * (-6.0 + 15.0 * x));
            near(cubic.bends_at_nodes()[k], -6.0 + 30.0 * x);
        }
        assert_eq!(cubic.bends_at_ends(), [-6.0, 24.0]);
    }

    /// Of 1 + t^2 over 2 seconds: 2 + 8/3, and of (2 - t) (1 + t^2): 2 + 4/3.
    #[test]
    fn integral_and_moment_of_a_parabola_are_exact() {
        let at = [1.0 - 2.0 * NODE, 1.0 + 2.0 * NODE];
        let [integral, moment] = integrals(at.map(|time| 1.0 + time * time), 2.0);
        assert!((integral - 14.0 / 3.0).abs() < 1e-14 && (moment - 10.0 / 3.0).abs() < 1e-14);
    }
}
