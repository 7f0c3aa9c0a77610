//! Impulse laws of event-driven dynamics, one a file: relative velocities before an impact in, impulses out.
//!
//! Needs: two bodies that touch and approach. Guarantees: one impulse and its opposite act on the two bodies, so that
//! linear momentum, and angular momentum about the contact, are conserved to rounding; `|J_t| <= mu J_n` where a law has
//! friction; no law creates energy, except the velocity floor, which is there to do so.
//! Not here: when bodies meet (`geometry::time_of_impact`, `drive::FirstHit`), forces that last (`contact`).
//!
//! Frame of an impact: n is the unit normal from the second body (or the wall) to the first, `t = (n_y, -n_x)`, angular
//! velocities counter-clockwise. Then, for both kinds of impact (P 2.12; a wall has no spin and infinite mass),
//! ```text
//! u_n = (v_1 - v_2) . n            (< 0 on approach; this is -v_n of F A1)
//! u_t = (v_1 - v_2) . t + R_1 omega_1 + R_2 omega_2
//!
//! m_1 v_1 += J_n n + J_t t         I_1 omega_1 += R_1 J_t
//! m_2 v_2 -= J_n n + J_t t         I_2 omega_2 += R_2 J_t
//! ```
//! Source: F appendix A, P 2.3.1; a boundary that moves counts with its velocity at the instant of contact.

mod contact_time;
mod coulomb;
mod dashpot;
mod smooth;
mod velocity_floor;

use crate::error::{Error, Result, Shortest};

pub use contact_time::ContactTime;
pub use coulomb::Coulomb;
pub use dashpot::{Dashpot, TabulatedDashpot};
pub use smooth::Smooth;
pub use velocity_floor::VelocityFloor;

/// What a law may know about one impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// m_eff \[kg\] that the normal impulse moves: [`effective_mass`].
    pub effective_mass: f64,
    /// alpha \[kg\] that the tangential impulse moves: [`tangential_mass`]. Laws that do not rotate ignore it.
    pub tangential_mass: f64,
    /// u_n \[m/s\], negative on approach.
    pub normal_velocity: f64,
    /// u_t \[m/s\] of the surfaces. Laws that do not rotate ignore it.
    pub tangential_velocity: f64,
    /// Time \[s\] since the last impact of either body, the shorter of the two. Only laws that remember use it
    /// ([`CollisionLaw::REMEMBERS`]); infinite where the engine does not keep it.
    pub time_since_last: f64,
}

/// Impulse on the first body; the second gets the opposite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impulse {
    /// J_n \[N.s\] along the normal, not negative.
    pub normal: f64,
    /// J_t \[N.s\] along the tangent.
    pub tangential: f64,
}

/// An impulse law.
///
/// It is the duty of the caller that the bodies approach (`u_n <= 0`): the laws take `|u_n|`.
pub trait CollisionLaw: Send + 'static {
    /// Whether there is friction, and with it spin. Without it, the tangential impulse is zero.
    const ROTATES: bool;
    /// Whether the engine must keep the time of each body's last impact.
    const REMEMBERS: bool = false;

    /// `u_n' >= 0` \[m/s\], the normal velocity after the impact.
    fn separation_velocity(&self, impact: &Impact) -> f64;

    /// `J_t` \[N.s\] that goes with the normal impulse J_n \[N.s\].
    fn tangential_impulse(&self, impact: &Impact, normal_impulse: f64) -> f64;

    /// What an impact may cost at most, in the time of an event with an impact in closed form.
    fn most_work(&self) -> u64 {
        1
    }

    /// Both impulses. `J_n = m_eff (|u_n| + |u_n'|)` (F A11 in magnitudes).
    #[inline]
    fn impulse(&self, impact: &Impact) -> Impulse {
        let normal = impact.normal_impulse(self.separation_velocity(impact));
        Impulse {
            normal,
            tangential: self.tangential_impulse(impact, normal),
        }
    }
}

impl Impact {
    /// J_n \[N.s\] that turns u_n into `separation_velocity` \[m/s\].
    #[inline]
    pub fn normal_impulse(&self, separation_velocity: f64) -> f64 {
        self.effective_mass * (self.normal_velocity.abs() + separation_velocity)
    }
}

/// Effective mass \[kg\] of two bodies by their inverse masses \[1/kg\], of which a wall's is zero.
///
/// The bits do not depend on the order of the bodies.
#[inline]
pub fn effective_mass(first_inverse_mass: f64, second_inverse_mass: f64) -> f64 {
    1.0 / (first_inverse_mass + second_inverse_mass)
}

/// Tangential mass alpha \[kg\], `1/alpha = 1/m_1 + 1/m_2 + R_1^2/I_1 + R_2^2/I_2` (P 4.60).
///
/// Arguments in 1/kg, zero for a wall; `R^2/I = 1/(l m)` with the inertia factor l = 1/2 of a disk, 2/5 of a ball.
#[inline]
pub fn tangential_mass(
    first_inverse_mass: f64,
    second_inverse_mass: f64,
    first_inverse_inertia: f64,
    second_inverse_inertia: f64,
) -> f64 {
    1.0 / ((first_inverse_mass + second_inverse_mass) + (first_inverse_inertia + second_inverse_inertia))
}

/// A number in [0, `most`], or the parameter's name and what to do.
fn checked(name: &'static str, value: f64, most: f64, remedy: &'static str) -> Result<f64> {
    if value.is_finite() && (0.0..=most).contains(&value) {
        return Ok(value);
    }
    let allowed = if most.is_finite() {
        format!("0 to {}", Shortest(most))
    } else {
        "0 or more, finite".to_string()
    };
    Err(Error::parameter(name, Shortest(value), allowed, remedy))
}

#[cfg(test)]
mod tests;
