//! What the theory has to know of the disk and its supports.

use std::f64::consts::FRAC_PI_2;

use crate::error::{Error, Result, Shortest};

/// One disk on two supports, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// g \[m/s2\].
    pub gravity: f64,
    /// Mass of the disk m \[kg\].
    pub mass: f64,
    /// Radius of the disk R \[m\].
    pub radius: f64,
    /// Half the angle between the contacts, `theta_0` \[rad\]: pi/6 for three equal disks that touch.
    pub half_angle: f64,
    /// `theta_T` \[rad\]; positive turns the supports counter-clockwise, and contact 1 carries more.
    pub tilt: f64,
    /// mu.
    pub friction: f64,
    /// `k_t` \[N/m\].
    pub tangential_stiffness: f64,
}

impl Setting {
    /// Parameters of P 5.1, without tilt.
    pub const THESIS: Self = Self {
        gravity: 10.0,
        mass: 0.1,
        radius: 1.0,
        half_angle: std::f64::consts::FRAC_PI_6,
        tilt: 0.0,
        friction: 0.1,
        tangential_stiffness: 1e6,
    };

    /// The same setting at another tilt \[rad\].
    pub fn tilted(self, tilt: f64) -> Self {
        Self { tilt, ..self }
    }

    /// This setting, if the disk lies on both supports.
    ///
    /// # Errors
    /// A number that is not positive (the friction may be zero), or so large that products overflow; an angle
    /// `theta_0` outside (0, pi/2); a tilt that is not smaller than `theta_0`.
    pub fn checked(self) -> Result<Self> {
        let positive = [
            ("gravity", self.gravity),
            ("disk.mass", self.mass),
            ("disk.radius", self.radius),
            ("contact.tangential_stiffness", self.tangential_stiffness),
        ];
        for (name, value) in positive {
            if !(1e-30..=1e30).contains(&value) {
                return Err(Error::parameter(
                    name,
                    Shortest(value),
                    "from 1e-30 to 1e30",
                    "Give it in SI units.",
                ));
            }
        }
        if !(0.0..=1e6).contains(&self.friction) {
            let remedy = "Friction is a ratio of forces.";
            return Err(Error::parameter(
                "contact.friction",
                Shortest(self.friction),
                "from 0 to 1e6",
                remedy,
            ));
        }
        if !(self.half_angle > 0.0 && self.half_angle < FRAC_PI_2) {
            let remedy = "Three equal disks that touch have pi/6.";
            return Err(Error::parameter(
                "half_angle",
                Shortest(self.half_angle),
                "between 0 and pi/2 rad",
                remedy,
            ));
        }
        if self.tilt.is_nan() || self.tilt.abs() >= self.half_angle {
            let allowed = format!(
                "between -{0} and {0} rad, half the angle between the contacts",
                Shortest(self.half_angle)
            );
            return Err(Error::parameter(
                "tilt",
                Shortest(self.tilt),
                allowed,
                "Beyond it the disk rolls off.",
            ));
        }
        Ok(self)
    }

    /// `alpha_1 = theta_0 - theta_T`, from gravity to the left contact \[rad\].
    pub fn left_angle(&self) -> f64 {
        self.half_angle - self.tilt
    }

    /// `alpha_2 = theta_0 + theta_T`, from gravity to the right contact \[rad\].
    pub fn right_angle(&self) -> f64 {
        self.half_angle + self.tilt
    }

    /// m g \[N\].
    pub fn weight(&self) -> f64 {
        self.mass * self.gravity
    }

    /// I = m R^2 / 2 \[kg m2\].
    pub fn inertia(&self) -> f64 {
        0.5 * self.mass * self.radius * self.radius
    }
}
