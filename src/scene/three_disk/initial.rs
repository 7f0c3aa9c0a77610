//! What the outputs depend on before the first step: a disk at rest on its supports, or lifted off them, that may spin.

use super::ThreeDiskDrive;
use crate::scene::STEP_OF_ONE_DISK;

/// Where the disk would rest.
const REST: &[&str] = &[
    "gravity",
    "tilt",
    "support.angle",
    "support.shape",
    "disk.radius",
    "disk.mass",
    "contact.normal_stiffness",
];

const DROP: &[&str] = &["disk.drop_height"];

/// See [`Scene::initial_dependencies`](crate::scene::Scene::initial_dependencies).
pub fn dependencies<D: ThreeDiskDrive>(name: &str) -> Vec<&'static str> {
    let of_contact = name.strip_prefix("contact[").and_then(|rest| rest.split_once("]."));
    let member = of_contact.map_or(name, |(_, member)| member);
    let overlap = || [REST, DROP, D::PLACES_AT_START].concat();
    let force = || [REST, DROP, D::PLACES_AT_START, D::RATES_AT_START].concat();
    match member {
        "chosen_time_step" => [STEP_OF_ONE_DISK, D::PERIOD].concat(),
        "disk.x[1]" => [REST, D::PLACES_AT_START].concat(),
        "disk.y[1]" | "overlap" | "energy.potential" | "energy.elastic" => overlap(),
        // A dashpot may pull a contact open.
        "normal_force" | "state" => force(),
        "amonton_margin" => [force(), vec!["contact.friction"]].concat(),
        "mean_angular_velocity" | "disk.angular_velocity[1]" => vec!["disk.initial_angular_velocity"],
        "energy.kinetic" => vec!["disk.initial_angular_velocity", "disk.mass", "disk.radius"],
        // The skins are not stretched, and nothing has happened yet; or it is an output of the drive.
        _ => D::output_at_start(name),
    }
}
