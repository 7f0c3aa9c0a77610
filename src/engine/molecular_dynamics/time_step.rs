//! Which time steps resolve the contacts.

use super::forces::ContactLaws;

/// Time steps that suit a set of contact laws and masses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepLimits {
    /// A hundredth of the shortest contact period \[s\], as P 2.2 asks at least.
    pub default: f64,
    /// A twentieth of it \[s\]: beyond, impacts are no longer resolved and disks with many contacts turn unstable.
    pub largest: f64,
}

impl TimeStepLimits {
    /// Limits for the two lightest disks of `masses` \[kg\] in contact, and for a drive of frequency \[Hz\] if it is known.
    ///
    /// The period of a contact of effective mass m is `2 pi sqrt(m / max(k_n, 3 k_t))`: the skin of two uniform disks acts
    /// on the effective mass m / 3 (P 4.60). Damping adds the rate `gamma_n / m`, of which up to six contacts act at
    /// once. A drive is resolved by 20 steps a period at least.
    ///
    /// Stability: with six contacts on a disk the highest frequency is below `sqrt(6)` times that of one contact, and
    /// velocity Verlet is stable up to 2 over it, which is 0.13 periods of one contact: 2.6 times `largest`.
    pub fn of(laws: &ContactLaws, masses: &[f64], drive_frequency: Option<f64>) -> Self {
        let (mut lightest, mut second) = (f64::INFINITY, f64::INFINITY);
        for &mass in masses {
            if mass < lightest {
                (lightest, second) = (mass, lightest);
            } else if mass < second {
                second = mass;
            }
        }
        let effective_mass = 1.0 / (1.0 / lightest + 1.0 / second);
        let tangential = if laws.skin.friction > 0.0 {
            3.0 * laws.skin.stiffness
        } else {
            0.0
        };
        let stiffness = laws.normal.stiffness.max(tangential);
        let period = std::f64::consts::TAU * (effective_mass / stiffness).sqrt();
        let damping_time = effective_mass / laws.normal.damping;
        let drive_period = drive_frequency.map_or(f64::INFINITY, |frequency| 1.0 / frequency);
        Self {
            default: (period / 100.0).min(damping_time / 30.0).min(drive_period / 100.0),
            largest: (period / 20.0).min(damping_time / 6.0).min(drive_period / 20.0),
        }
    }
}
