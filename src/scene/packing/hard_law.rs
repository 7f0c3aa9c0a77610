//! The impact law of hard disks that have the outcome of the soft contacts, from the same parameters.

use crate::collision::{ContactTime, Dashpot, TabulatedDashpot, effective_mass};
use crate::scene::{Error, Result, Unit, Values};

/// Law of the packing: stick and slip of the soft contact from a table, without loss in impacts that follow at once.
pub type HardLaw = ContactTime<TabulatedDashpot>;

/// Largest ratio of stiffnesses: an impact has some sqrt(3 kappa) phases of stick and slip.
const LARGEST_STIFFNESS_RATIO: f64 = 1e4;

/// Largest damping ratio c: beyond, disks leave an impact at less than 0.003 of their velocity.
const STRONGEST_DAMPING: f64 = 10.0;

/// Different masses up to which impacts are tabulated.
const MOST_CLASSES: usize = 8;

/// The law for disks of these `masses` \[kg\].
///
/// # Errors
/// Parameters that an impact cannot have.
pub fn hard_law(masses: &[f64], values: &Values) -> Result<HardLaw> {
    let kappa = values.real("contact.stiffness_ratio");
    if kappa > LARGEST_STIFFNESS_RATIO {
        return Err(Error::parameter(
            "contact.stiffness_ratio",
            Unit::ONE.format(kappa),
            format!(
                "at most {LARGEST_STIFFNESS_RATIO:e} with the engine event-driven, which follows each of its oscillations"
            ),
            "Take a softer tangential spring, or the engine molecular-dynamics.",
        ));
    }
    let law = Dashpot::new(
        values.real("contact.normal_stiffness"),
        values.real("contact.normal_damping"),
        kappa,
        values.real("contact.friction"),
    )?;
    let mut inverse: Vec<f64> = masses.iter().map(|mass| 1.0 / mass).collect();
    inverse.sort_by(f64::total_cmp);
    inverse.dedup();
    let lightest = inverse.last().map_or(1.0, |most| effective_mass(*most, *most));
    let ratio = law.damping_ratio(lightest);
    if ratio > STRONGEST_DAMPING {
        let damping = values.real("contact.normal_damping");
        let most = damping * STRONGEST_DAMPING / ratio;
        return Err(Error::parameter(
            "contact.normal_damping",
            format!("{damping:e} kg/s"),
            format!("at most {most:e} kg/s for these masses with the engine event-driven, a damping ratio of 10"),
            "Damp less, or take heavier disks or the engine molecular-dynamics.",
        ));
    }
    let table = TabulatedDashpot::new(law, &tabulated_masses(&inverse), 0.5);
    Ok(ContactTime::new(table, values.real("collision.contact_time"))?)
}

/// Effective masses \[kg\] of all pairs of these inverse masses, and of each with a wall. Beyond a few classes the tables would
/// cost more than they save, and impacts are stitched one by one.
fn tabulated_masses(inverse: &[f64]) -> Vec<f64> {
    if inverse.len() > MOST_CLASSES {
        return Vec::new();
    }
    let with_others = inverse
        .iter()
        .flat_map(|one| inverse.iter().map(|two| effective_mass(*one, *two)));
    with_others
        .chain(inverse.iter().map(|one| effective_mass(*one, 0.0)))
        .collect()
}
