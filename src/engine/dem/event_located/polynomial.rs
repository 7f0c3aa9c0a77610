//! Polynomials of one phase of a contact, on the scaled time 0 to 1, and where they first fall through zero.

use crate::geometry::bracketed_root::falling_root_near;

/// Coefficients of 1, x, x^2, ...
pub const LENGTH: usize = 8;

/// A polynomial of degree 7 at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polynomial(pub [f64; LENGTH]);

impl Polynomial {
    /// Value at x.
    #[cfg(test)]
    pub fn at(&self, x: f64) -> f64 {
        self.at_with_slope(x)[0]
    }

    /// Value and derivative at x.
    #[inline(always)]
    fn at_with_slope(&self, x: f64) -> [f64; 2] {
        let (mut value, mut slope) = (self.0[LENGTH - 1], 0.0);
        for coefficient in self.0[..LENGTH - 1].iter().rev() {
            slope = slope * x + value;
            value = value * x + coefficient;
        }
        [value, slope]
    }

    /// Value and derivative at 1.
    #[inline(always)]
    fn at_one(&self) -> [f64; 2] {
        let (mut value, mut slope) = (self.0[0], 0.0);
        for (i, coefficient) in self.0.iter().enumerate().skip(1) {
            value += coefficient;
            slope += i as f64 * coefficient;
        }
        [value, slope]
    }

    /// Without the factor x^`ZEROS`.
    #[inline(always)]
    fn divided<const ZEROS: usize>(&self) -> Self {
        Self(std::array::from_fn(|i| self.0.get(i + ZEROS).copied().unwrap_or(0.0)))
    }

    /// First x in \[0, 1\] at which this falls through zero, after `zeros` roots known to lie at x = 0, two at most.
    ///
    /// With known roots at 0 the polynomial is divided by their power of x: their rounding cannot be taken for an event.
    #[inline(always)]
    pub fn first_fall(&self, zeros: usize) -> Option<f64> {
        let rest = match zeros {
            0 => *self,
            1 => self.divided::<1>(),
            _ => self.divided::<2>(),
        };
        let [start, slope, ..] = rest.0;
        if start <= 0.0 {
            return (start < 0.0 || slope < 0.0).then_some(0.0);
        }
        let [end, end_slope] = rest.at_one();
        if end < 0.0 {
            // The parabola with this value and slope at 0 and this value at 1 falls through zero once.
            let bend = end - start - slope;
            let guess = 2.0 * start / ((slope * slope - 4.0 * bend * start).sqrt() - slope);
            return Some(rest.root_near(guess, 1.0));
        }
        if slope < 0.0 && end_slope > 0.0 {
            // Both ends are above zero and there is a minimum between them.
            let low = [0.25, 0.5, 0.75]
                .into_iter()
                .find(|x| rest.at_with_slope(*x)[0] < 0.0)?;
            return Some(rest.root_near(0.5 * low, low));
        }
        None
    }

    #[inline(never)]
    fn root_near(&self, guess: f64, high: f64) -> f64 {
        let guess = if guess > 0.0 && guess < high { guess } else { 0.5 * high };
        falling_root_near(0.0, high, guess, |x| {
            let [value, slope] = self.at_with_slope(x);
            (value, slope)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(coefficients: &[f64]) -> Polynomial {
        Polynomial(std::array::from_fn(|i| coefficients.get(i).copied().unwrap_or(0.0)))
    }

    #[test]
    fn the_first_fall_through_zero_is_found() {
        // (0.3 - x) (1.7 - x) (2 + x)
        let cubic = of(&[1.02, -3.49, 0.0, 1.0]);
        let root = cubic.first_fall(0);
        assert!((root.unwrap() - 0.3).abs() < 1e-15, "{root:?}");
        assert!(cubic.at(0.3).abs() < 1e-15);
        // x^2 (0.6 - x), whose roots at 0 are known.
        let known = of(&[1e-19, -1e-19, 0.6, -1.0]).first_fall(2);
        assert!((known.unwrap() - 0.6).abs() < 1e-15, "{known:?}");
        // (x - 0.4) (x - 0.9), above zero at both ends.
        let dip = of(&[0.36, -1.3, 1.0]).first_fall(0);
        assert!((dip.unwrap() - 0.4).abs() < 1e-15, "{dip:?}");
        assert_eq!(of(&[0.5, -1.0, 1.0]).first_fall(0), None);
        assert_eq!(of(&[1.0, 1.0]).first_fall(0), None);
        assert_eq!(of(&[-1.0]).first_fall(0), Some(0.0));
    }
}
