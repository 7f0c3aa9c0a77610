//! A disk at rest.

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
    /// The same disk higher by `rise` \[m\].
    pub fn raised(self, rise: f64) -> Self {
        Self {
            y: self.y + rise,
            ..self
        }
    }
}
