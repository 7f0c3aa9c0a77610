//! Dashpot restitution: the impact of the contact law of soft disks as one impulse.
//!
//! Linear dashpot with cut-off along the normal, spring with Coulomb friction along the tangent (`contact`), bodies
//! that do not move during the impact. `e_n` depends on the damping ratio c alone, `e_t` on |u_t / u_n|, kappa, mu, c.
//! Source: P 2.3.1, 4.5.
//!
//! [`Dashpot`] follows the phases of stick and slip of each impact, [`TabulatedDashpot`] has tables of `e_t`.

mod oscillator;
mod stick_slip;
mod table;

use serde::{Deserialize, Serialize};

use super::{CollisionLaw, Impact, checked};
use crate::contact::{LinearDashpot, NO_FRICTION};
use crate::error::{Error, Result, Shortest};
use oscillator::Oscillator;
use stick_slip::{StickSlip, TangentialSpring};
pub use table::TabulatedDashpot;

/// Dashpot restitution, evaluated directly.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Dashpot {
    normal_stiffness: f64,
    normal_damping: f64,
    stiffness_ratio: f64,
    friction: f64,
}

/// Ratio |u_t / u_n| in units of `max(1, mu/kappa)` from which the first stick is too short to matter.
const SLIDING_RATIO: f64 = 1e14;

/// Work of the phases of an impact for each unit of Omega, in events of one phase.
const WORK_OF_PHASES: f64 = 10.0;

impl Dashpot {
    /// Law of normal stiffness k_n > 0 \[N/m\], normal damping gamma_n >= 0 \[kg/s\], stiffness ratio
    /// kappa = k_t / k_n >= 0 and friction coefficient mu >= 0.
    ///
    /// # Errors
    /// A value out of range, by its name such as `contact.normal_stiffness`.
    pub fn new(normal_stiffness: f64, normal_damping: f64, stiffness_ratio: f64, friction: f64) -> Result<Self> {
        let most = f64::INFINITY;
        let name = "contact.normal_stiffness";
        if !(normal_stiffness.is_finite() && normal_stiffness > 0.0) {
            let remedy = "Give the stiffness of the contact in N/m.";
            return Err(Error::parameter(
                name,
                Shortest(normal_stiffness),
                "above 0, finite",
                remedy,
            ));
        }
        let remedy = "0 has no tangential spring: surfaces pass each other freely.";
        Ok(Self {
            normal_stiffness,
            normal_damping: checked("contact.normal_damping", normal_damping, most, "0 loses nothing.")?,
            stiffness_ratio: checked("contact.stiffness_ratio", stiffness_ratio, most, remedy)?,
            friction: checked("contact.friction", friction, most, "0 slides freely.")?,
        })
    }

    /// Law in which bodies of effective mass m \[kg\] have the damping ratio c >= 0.
    ///
    /// # Errors
    /// As [`Dashpot::new`]; a damping ratio out of range is reported as the damping that it gives.
    pub fn of_damping_ratio(
        normal_stiffness: f64,
        damping_ratio: f64,
        effective_mass: f64,
        stiffness_ratio: f64,
        friction: f64,
    ) -> Result<Self> {
        let damping = 2.0 * damping_ratio * (normal_stiffness * effective_mass).sqrt();
        Self::new(normal_stiffness, damping, stiffness_ratio, friction)
    }

    /// Damping ratio c of an impact of effective mass m \[kg\].
    #[inline]
    pub fn damping_ratio(&self, effective_mass: f64) -> f64 {
        self.normal().damping_ratio(effective_mass)
    }

    /// Normal restitution e_n of an impact of effective mass m \[kg\].
    #[inline]
    pub fn normal_restitution(&self, effective_mass: f64) -> f64 {
        self.normal().restitution(effective_mass)
    }

    /// Duration t_c \[s\] of an impact of effective mass m \[kg\].
    pub fn duration(&self, effective_mass: f64) -> f64 {
        let scaled = LinearDashpot::scaled_duration(self.damping_ratio(effective_mass));
        scaled * (effective_mass / self.normal_stiffness).sqrt()
    }

    /// Tangential restitution e_t in \[-1, 1\] at `ratio` = |u_t / u_n|.
    ///
    /// `effective_mass` m_eff and `tangential_mass` alpha in kg. At ratio 0 the limit of small ratios.
    pub fn tangential_restitution(&self, effective_mass: f64, tangential_mass: f64, ratio: f64) -> f64 {
        if self.slides_freely() {
            return 1.0;
        }
        let stick_slip = self.stick_slip(effective_mass, effective_mass / tangential_mass);
        // Where the surfaces barely slide at all, what is left is rounding.
        let ratio = ratio.max(1e-8 * self.friction.min(1.0));
        if ratio > self.sliding_ratio() {
            return 1.0 - stick_slip.full_slide() / ratio;
        }
        (stick_slip.after(ratio).velocity / ratio).clamp(-1.0, 1.0)
    }

    /// Ratio |u_t / u_n| from which the surfaces slide to the end once they have started to.
    ///
    /// Without damping they slide from touch to end, so that `e_t = 1 - rho mu (1 + e_n) |u_n / u_t|` is exact, if and
    /// only if the ratio exceeds `max(mu/kappa, 2 rho mu - mu/kappa)`, `rho = m_eff / alpha`. With damping they stick
    /// first, and sliding to the end after that is certain from `mu/kappa + rho mu (1 + e_n)`: sliding lasts while
    /// `kappa u > mu N'`, where `u >= u_t - rho mu (1 + e_n) |u_n|` and `N' <= 1`.
    pub fn slides_throughout_from(&self, effective_mass: f64, tangential_mass: f64) -> f64 {
        let rho = effective_mass / tangential_mass;
        let (start, slide) = (self.friction / self.stiffness_ratio, rho * self.friction);
        if self.normal_damping == 0.0 {
            start.max(2.0 * slide - start)
        } else {
            start + slide * (1.0 + self.normal_restitution(effective_mass))
        }
    }

    /// Whether there is no tangential impulse, or none that rounding leaves anything of.
    fn slides_freely(&self) -> bool {
        self.friction < NO_FRICTION || self.stiffness_ratio < NO_FRICTION
    }

    fn normal(&self) -> LinearDashpot {
        LinearDashpot {
            stiffness: self.normal_stiffness,
            damping: self.normal_damping,
        }
    }

    fn sliding_ratio(&self) -> f64 {
        SLIDING_RATIO * (self.friction / self.stiffness_ratio).max(1.0)
    }

    fn stick_slip(&self, effective_mass: f64, mobility: f64) -> StickSlip {
        let spring = TangentialSpring {
            stiffness_ratio: self.stiffness_ratio,
            friction: self.friction,
            mobility,
        };
        StickSlip::new(spring, Oscillator::new(self.damping_ratio(effective_mass)))
    }
}

impl CollisionLaw for Dashpot {
    const ROTATES: bool = true;

    #[inline]
    fn separation_velocity(&self, impact: &Impact) -> f64 {
        self.normal_restitution(impact.effective_mass) * impact.normal_velocity.abs()
    }

    /// Under a wrapper that changes the normal impulse, this is the tangential impulse of the impact that has it.
    fn tangential_impulse(&self, impact: &Impact, normal_impulse: f64) -> f64 {
        if self.slides_freely() || impact.tangential_velocity == 0.0 {
            return 0.0;
        }
        let limit = self.friction * normal_impulse;
        let stick_slip = self.stick_slip(impact.effective_mass, impact.effective_mass / impact.tangential_mass);
        let speed = normal_impulse / (impact.effective_mass * (1.0 + stick_slip.normal.restitution));
        let ratio = impact.tangential_velocity.abs() / speed;
        let braking = if ratio < self.sliding_ratio() {
            (impact.tangential_mass * speed * (ratio - stick_slip.after(ratio).velocity)).clamp(-limit, limit)
        } else {
            limit
        };
        -braking * impact.tangential_velocity.signum()
    }

    /// An impact has some Omega phases of stick and slip.
    fn most_work(&self) -> u64 {
        (WORK_OF_PHASES * (1.0 + (3.0 * self.stiffness_ratio).sqrt())) as u64
    }
}
