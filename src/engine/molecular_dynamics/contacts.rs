//! Candidates for contact and what a closed contact remembers.

use serde::{Deserialize, Serialize};

/// Two disks that may touch before the next search; `first < second`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// Index of the first disk.
    pub first: u32,
    /// Index of the second disk.
    pub second: u32,
    /// Sum of the radii \[m\].
    pub reach: f64,
    /// Skin of the closed contact; [`SkinMemory::OPEN`] while the disks are apart.
    pub skin: SkinMemory,
}

/// A disk and a wall that may touch before the next search.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AtWall {
    /// Index of the disk.
    pub disk: u32,
    /// Index of the wall.
    pub wall: u32,
    /// Skin of the closed contact; [`SkinMemory::OPEN`] while they are apart.
    pub skin: SkinMemory,
}

/// What the elastic skin of one contact remembers.
///
/// lambda is computed from positions and angles alone (P 4.5). The angle beta of the line of centres enters through
/// how far it has turned from a remembered direction, which unwraps it for good and needs no arc tangent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SkinMemory {
    /// Direction of the normal to which `reference` belongs; zero while the contact is open.
    pub direction: [f64; 2],
    /// lambda* (P 4.6) \[m\], counted with beta = 0 along `direction`.
    pub reference: f64,
    /// Stretch lambda - lambda* at the last evaluation \[m\].
    pub stretch: f64,
}

impl SkinMemory {
    /// No contact.
    pub const OPEN: Self = Self {
        direction: [0.0, 0.0],
        reference: 0.0,
        stretch: 0.0,
    };

    /// Whether the contact is closed.
    #[inline]
    pub fn is_closed(&self) -> bool {
        self.direction[0] != 0.0 || self.direction[1] != 0.0
    }

    /// Angle \[rad\] by which `normal` is turned from the remembered direction, counter-clockwise.
    ///
    /// Beyond a tenth of a degree the remembered direction follows, and `reference` with it by `reach` times the angle.
    #[inline]
    pub fn turn(&mut self, normal: [f64; 2], reach: f64) -> f64 {
        let sine = self.direction[0] * normal[1] - self.direction[1] * normal[0];
        if sine.abs() < SMALL_SINE {
            return small_arc_sine(sine);
        }
        let cosine = self.direction[0] * normal[0] + self.direction[1] * normal[1];
        self.reference += reach * sine.atan2(cosine);
        self.direction = normal;
        0.0
    }
}

/// Below this the series of the arc sine through the fifth power is exact to rounding: the next term, relative to the
/// first, is 15/336 x^6 < 1e-17.
pub const SMALL_SINE: f64 = 0.002;

#[inline]
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

    /// Many turns of the line of centres, through +-pi, add up without a jump.
    #[test]
    fn beta_unwraps() {
        let mut skin = SkinMemory {
            direction: [1.0, 0.0],
            reference: 0.0,
            stretch: 0.0,
        };
        let reach = 0.04;
        for i in 1..=50_000 {
            let beta = 0.000_93 * f64::from(i);
            let turn = skin.turn([beta.cos(), beta.sin()], reach);
            assert!(
                (skin.reference + reach * turn - reach * beta).abs() < 1e-12,
                "beta = {beta}"
            );
        }
    }
}
