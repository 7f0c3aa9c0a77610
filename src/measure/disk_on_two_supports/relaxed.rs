//! Limits and corners of soft contacts: the disk sinks in by `n / k_n`, which turns the lines of centres.
//!
//! Two disks of radii R and `R_s` at the distance `r = R + R_s - n / k_n`: the normal force has the direction of the line
//! of centres there, and a tangential force `tau` with the arm R acts on the centres as `tau (R + R_s) / r`, so that
//! angular momentum is kept (see `docs/physics.md`). At a corner `tau_i = +-mu n_i`; Newton's method finds the centre
//! where the forces balance gravity. To first order a limit changes by a relative `n / (k_n (R + R_s))` times
//! `tan^2 theta_0`.

use super::{Corner, Limits, Point, Setting, Tangential};
use crate::elementary::{hypot, sin_cos};
use crate::error::{Error, Result, Shortest};

/// Corners of soft contacts at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relaxed {
    setting: Setting,
    normal_stiffness: f64,
    support_radius: f64,
}

/// Forces at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Forces {
    normal: [f64; 2],
    tangential: Tangential,
}

/// Soft contacts of stiffness `normal_stiffness` `k_n` \[N/m\] on support disks of `support_radius` \[m\], so placed that
/// rigid ones would touch at `theta_0`.
///
/// # Errors
/// Numbers that are not positive; contacts so soft that the overlap exceeds a tenth of the radii, or that open.
pub fn relaxed(setting: &Setting, normal_stiffness: f64, support_radius: f64) -> Result<Relaxed> {
    let arms = setting.radius + support_radius;
    let softest = 10.0 * setting.weight() / arms;
    if !(normal_stiffness >= softest && normal_stiffness.is_finite()) {
        let allowed = format!("{} N/m or more, so that the overlap is small", Shortest(softest));
        let remedy = "Stiffen the contacts or take a lighter disk.";
        return Err(Error::parameter(
            "contact.normal_stiffness",
            Shortest(normal_stiffness),
            allowed,
            remedy,
        ));
    }
    if !(support_radius > 0.0 && support_radius.is_finite()) {
        let remedy = "Three equal disks have that of the disk.";
        return Err(Error::parameter(
            "support.radius",
            Shortest(support_radius),
            "above 0",
            remedy,
        ));
    }
    Ok(Relaxed {
        setting: *setting,
        normal_stiffness,
        support_radius,
    })
}

impl Relaxed {
    /// Torques at which the disk slides \[N m\]. NaN where a contact would open.
    pub fn limits(&self) -> Limits {
        let torque = |corner| {
            let Tangential { left, right } = self.forces(corner).tangential;
            (self.setting.radius * (left + right)).abs()
        };
        Limits {
            clockwise: torque(Corner::S1),
            counter_clockwise: torque(Corner::S2),
        }
    }

    /// Corner S1, S2, T1 or T2; NaN at D1 and D2, where a contact opens.
    pub fn point(&self, corner: Corner) -> Point {
        Point::from_forces(&self.setting, self.forces(corner).tangential)
    }

    /// Forces where both contacts slide. NaN where a contact would open.
    fn forces(&self, corner: Corner) -> Forces {
        let mu = self.setting.friction;
        let slopes = match corner {
            Corner::S1 => [mu, mu],
            Corner::S2 => [-mu, -mu],
            Corner::T1 => [-mu, mu],
            Corner::T2 => [mu, -mu],
            Corner::D1 | Corner::D2 => [f64::NAN; 2],
        };
        // Newton's method on the centre, from where rigid disks touch. Lengths in units of the arms, forces of m g.
        let (mut x, mut y) = (0.0, 0.0);
        for _ in 0..50 {
            let (force, _) = self.balance(x, y, slopes);
            let step = 1e-7;
            let (right, _) = self.balance(x + step, y, slopes);
            let (up, _) = self.balance(x, y + step, slopes);
            let [a, c] = [0, 1].map(|i| (right[i] - force[i]) / step);
            let [b, d] = [0, 1].map(|i| (up[i] - force[i]) / step);
            let determinant = a * d - b * c;
            let (along, above) = (
                (b * force[1] - d * force[0]) / determinant,
                (c * force[0] - a * force[1]) / determinant,
            );
            (x, y) = (x + along, y + above);
            if along.abs() + above.abs() < 1e-16 {
                break;
            }
        }
        let (_, forces) = self.balance(x, y, slopes);
        if forces.normal.iter().all(|&n| n >= 0.0) {
            return forces;
        }
        Forces {
            normal: [f64::NAN; 2],
            tangential: Tangential {
                left: f64::NAN,
                right: f64::NAN,
            },
        }
    }

    /// Net force \[m g\] on the centre at (x, y) \[R + R_s\] from where rigid disks touch, and the contact forces \[N\].
    fn balance(&self, x: f64, y: f64, slopes: [f64; 2]) -> ([f64; 2], Forces) {
        let setting = &self.setting;
        let arms = setting.radius + self.support_radius;
        let stiffness = self.normal_stiffness * arms;
        let mut net = [0.0, -setting.weight()];
        let (mut normal, mut tangential) = ([0.0; 2], [0.0; 2]);
        let directions = [(setting.left_angle(), 1.0), (setting.right_angle(), -1.0)];
        for (i, (angle, side)) in directions.into_iter().enumerate() {
            let (sine, cosine) = sin_cos(angle);
            let (across, along) = (x + side * sine, y + cosine);
            let distance = hypot(across, along);
            let (n_x, n_y) = (across / distance, along / distance);
            // 1 - distance, without cancellation.
            let overlap = -(x * (x + 2.0 * side * sine) + y * (y + 2.0 * cosine)) / (1.0 + distance);
            normal[i] = stiffness * overlap;
            tangential[i] = slopes[i] * normal[i];
            let pull = tangential[i] / distance;
            net[0] += normal[i] * n_x + pull * n_y;
            net[1] += normal[i] * n_y - pull * n_x;
        }
        let forces = Forces {
            normal,
            tangential: Tangential {
                left: tangential[0],
                right: tangential[1],
            },
        };
        (net.map(|force| force / setting.weight()), forces)
    }
}
