//! What the outputs of a packing depend on before its first step: where the disks lie, and where the base is.

use crate::scene::base_drive::BaseDrive;
use crate::scene::stem;

/// Radii, which all disks are shared among.
const RADII: &[&str] = &["disk.radius_small", "disk.radius_medium", "disk.radius_large"];

/// Radii in their order, and the box: the packing on a base at height zero.
const PLACES: &[&str] = &[
    "seed",
    "box.width",
    "disk.radius_small",
    "disk.radius_medium",
    "disk.radius_large",
];

/// What the largest time step depends on besides the radii and the drive.
const STIFFEST: &[&str] = &[
    "disk.surface_density",
    "contact.normal_stiffness",
    "contact.stiffness_ratio",
    "contact.normal_damping",
    "contact.friction",
];

/// What says which time step is taken.
const CHOICE: &[&str] = &["tolerance", "time_step"];

/// See [`Scene::initial_dependencies`](crate::scene::Scene::initial_dependencies). Whether disks touch, and how much energy
/// that is, is a matter of rounding and thus of where the base is.
pub fn of_soft<D: BaseDrive>(name: &str) -> Vec<&'static str> {
    match stem(name) {
        "contacts" => [PLACES, D::DISPLACEMENT_AT_START].concat(),
        "energy.elastic" => [PLACES, D::DISPLACEMENT_AT_START, &["contact.normal_stiffness"]].concat(),
        "largest_time_step" => [RADII, STIFFEST, D::FREQUENCY].concat(),
        "chosen_time_step" => [RADII, STIFFEST, D::FREQUENCY, CHOICE].concat(),
        _ => of_any::<D>(name, &[]),
    }
}

/// The same for hard disks. A bottom whose phase is random rests.
pub fn of_hard<D: BaseDrive>(name: &str) -> Vec<&'static str> {
    of_any::<D>(name, &["base.model"])
}

fn of_any<D: BaseDrive>(name: &str, model: &[&'static str]) -> Vec<&'static str> {
    match stem(name) {
        "disk.radius" => [RADII, &["seed"]].concat(),
        "disk.x" => PLACES.to_vec(),
        "disk.y" => [PLACES, D::DISPLACEMENT_AT_START, model].concat(),
        "energy.potential" => {
            let weight = &["gravity", "disk.surface_density"];
            [PLACES, D::DISPLACEMENT_AT_START, model, weight].concat()
        }
        "base.position" => [D::DISPLACEMENT_AT_START, model].concat(),
        "base.acceleration" => [D::ACCELERATION_AT_START, model].concat(),
        // At rest, and nothing has happened yet.
        _ => Vec::new(),
    }
}
