//! What the outputs of a ratchet depend on before its first step: loose rows of disks above the teeth, at rest.

use crate::scene::base_drive::BaseDrive;
use crate::scene::stem;

/// The highest point of the base at rest, and the pitch of the rows.
const ROWS: &[&str] = &[
    "tooth.width",
    "tooth.height",
    "tooth.asymmetry",
    "tooth.tip_radius",
    "disk.radius_max",
];

/// See [`Scene::initial_dependencies`](crate::scene::Scene::initial_dependencies).
pub fn dependencies<D: BaseDrive>(name: &str) -> Vec<&'static str> {
    match stem(name) {
        "layers" => vec!["disk.radius_min", "tooth.count", "tooth.width"],
        "disk.radius" => vec!["seed", "disk.radius_min", "disk.radius_max"],
        "disk.x" => vec!["seed", "disk.radius_max", "tooth.count", "tooth.width"],
        "disk.y" => [ROWS, D::DISPLACEMENT_AT_START, &["tooth.count"]].concat(),
        "energy.potential" => {
            let weights = &["gravity", "seed", "disk.radius_min", "disk.mass", "disk.mass_rule"];
            [ROWS, D::DISPLACEMENT_AT_START, &["tooth.count"], weights].concat()
        }
        "base.position" => D::DISPLACEMENT_AT_START.to_vec(),
        "base.acceleration" => D::ACCELERATION_AT_START.to_vec(),
        // At rest, and nothing has happened yet.
        _ => Vec::new(),
    }
}
