//! Candidates for contact and what a closed contact remembers.

use serde::{Deserialize, Serialize};

use crate::engine::dem::angle::{SMALL_SINE, angle_between};
use crate::engine::dem::candidates::Candidate;
use crate::error::are_sane;

/// Two disks in the neighbour list; `first < second`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// Index of the first disk.
    pub first: u32,
    /// Index of the second disk.
    pub second: u32,
    /// Sum of the radii \[m\].
    pub radius_sum: f64,
    /// Spring of the closed contact; [`SpringMemory::OPEN`] while the disks are apart.
    pub spring: SpringMemory,
}

/// A disk and a wall in the neighbour list.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WallContact {
    /// Index of the disk.
    pub disk: u32,
    /// Index of the wall.
    pub wall: u32,
    /// Spring of the closed contact; [`SpringMemory::OPEN`] while they are apart.
    pub spring: SpringMemory,
}

impl Candidate for Pair {
    fn key(&self) -> [u32; 2] {
        [self.first, self.second]
    }

    fn remembers(&self) -> bool {
        self.spring.is_closed()
    }
}

impl Candidate for WallContact {
    fn key(&self) -> [u32; 2] {
        [self.disk, self.wall]
    }

    fn remembers(&self) -> bool {
        self.spring.is_closed()
    }
}

/// What the tangential spring of one contact remembers.
///
/// lambda is computed from positions and angles alone (P 4.5). The angle beta of the line of centres enters as the angle
/// from a remembered direction, which unwraps it for good and needs no arc tangent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpringMemory {
    /// Direction of the normal to which `reference` belongs; zero while the contact is open.
    pub direction: [f64; 2],
    /// lambda* (P 4.6) \[m\], counted with beta = 0 along `direction`.
    pub reference: f64,
    /// Stretch lambda - lambda* at the last evaluation \[m\].
    pub stretch: f64,
}

impl SpringMemory {
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

    /// Whether the numbers are finite and the direction is no longer than one.
    pub fn is_sane(&self) -> bool {
        let unit = self.direction.iter().all(|part| part.abs() <= 1.0 + 1e-9);
        are_sane([self.reference, self.stretch]) && unit
    }

    /// Angle \[rad\] from the remembered direction to `normal`, counter-clockwise.
    ///
    /// Beyond a tenth of a degree the remembered direction follows, and `reference` moves by `radius_sum` times the angle.
    #[inline]
    pub fn turn(&mut self, normal: [f64; 2], radius_sum: f64) -> f64 {
        let angle = angle_between(self.direction, normal);
        let sine = self.direction[0] * normal[1] - self.direction[1] * normal[0];
        if sine.abs() < SMALL_SINE {
            return angle;
        }
        self.reference += radius_sum * angle;
        self.direction = normal;
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Many turns of the line of centres, through +-pi, add up without a jump.
    #[test]
    fn the_contact_angle_unwraps() {
        let mut spring = SpringMemory {
            direction: [1.0, 0.0],
            reference: 0.0,
            stretch: 0.0,
        };
        let radius_sum = 0.04;
        for i in 1..=50_000 {
            let beta = 0.000_93 * f64::from(i);
            let turn = spring.turn([beta.cos(), beta.sin()], radius_sum);
            assert!(
                (spring.reference + radius_sum * turn - radius_sum * beta).abs() < 1e-12,
                "beta = {beta}"
            );
        }
    }
}
