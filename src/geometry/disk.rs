//! A disk at rest.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// A disk: centre and radius \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Disk {
    /// Centre, to the right \[m\].
    pub x: f64,
    /// Centre, up \[m\].
    pub y: f64,
    /// Radius \[m\].
    pub radius: f64,
}

impl Disk {
    /// Disk of a centre and a radius \[m\].
    pub fn new(centre: Vector2<f64>, radius: f64) -> Self {
        let [x, y] = centre.into();
        Self { x, y, radius }
    }

    /// Centre \[m\].
    #[inline]
    pub fn centre(&self) -> Vector2<f64> {
        Vector2::new(self.x, self.y)
    }

    /// The same disk higher by `rise` \[m\].
    pub fn raised(self, rise: f64) -> Self {
        Self {
            y: self.y + rise,
            ..self
        }
    }
}
