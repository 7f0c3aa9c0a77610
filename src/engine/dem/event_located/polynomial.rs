//! Polynomials of one phase of a contact, on the scaled time 0 to 1, and where they first rise through zero.

use crate::geometry::bracketed_root::falling_root;

/// Coefficients of 1, x, x^2, ...
pub const LENGTH: usize = 9;

/// A polynomial of degree 8 at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polynomial(pub [f64; LENGTH]);

impl Polynomial {
    /// Value at x.
    #[inline]
    pub fn at(&self, x: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
    }

    /// Derivative with respect to x.
    #[inline]
    pub fn derivative(&self) -> Self {
        let mut slope = [0.0; LENGTH];
        for (i, (slope, coefficient)) in slope.iter_mut().zip(&self.0[1..]).enumerate() {
            *slope = (i + 1) as f64 * coefficient;
        }
        Self(slope)
    }

    /// `a` times this plus `b` times `other`.
    #[inline]
    pub fn mixed(&self, a: f64, other: &Self, b: f64) -> Self {
        Self(std::array::from_fn(|i| a * self.0[i] + b * other.0[i]))
    }

    /// This plus a constant.
    #[inline]
    pub fn raised(mut self, by: f64) -> Self {
        self.0[0] += by;
        self
    }

    /// First x in \[0, 1\] at which this rises through zero, after `zeros` roots known to lie at x = 0.
    ///
    /// With known roots at 0 the polynomial is divided by their power of x: their rounding cannot be taken for an event.
    pub fn first_rise(&self, zeros: usize) -> Option<f64> {
        let mut rest = [0.0; LENGTH];
        rest[..LENGTH - zeros].copy_from_slice(&self.0[zeros..]);
        let rest = Self(rest);
        if rest.0[0] >= 0.0 {
            return (rest.0[0] > 0.0 || rest.0[1] > 0.0).then_some(0.0);
        }
        let slope = rest.derivative();
        let end = if rest.at(1.0) > 0.0 {
            1.0
        } else if slope.0[0] > 0.0 && slope.at(1.0) < 0.0 {
            // Both ends are below zero and there is a maximum between them.
            [0.25, 0.5, 0.75].into_iter().find(|x| rest.at(*x) > 0.0)?
        } else {
            return None;
        };
        Some(falling_root(0.0, end, |x| (-rest.at(x), -slope.at(x))))
    }
}
