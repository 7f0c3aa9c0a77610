//! What the outputs of a wedge depend on before the first step: a disk thrown across the bisector from some height.

use crate::scene::{STEP_OF_ONE_DISK, stem};

/// Height up the bisector and the bisector itself.
const PLACE: &[&str] = &["wedge.aperture", "wedge.tilt", "disk.radius", "disk.drop_height"];

/// The throw.
const VELOCITY: &[&str] = &["gravity", "seed", "wedge.aperture", "wedge.tilt", "disk.drop_height"];

/// What an engine adds to what is the same for all of them.
#[derive(Debug, Clone, Copy)]
pub struct AtStart {
    /// What the place depends on besides: the seed where the frame is that of the wall that the disk flies to, since the
    /// two differ in rounding.
    pub place: &'static [&'static str],
    /// What the displacement of the base depends on.
    pub displacement: &'static [&'static str],
    /// What its acceleration depends on.
    pub acceleration: &'static [&'static str],
    /// What its frequency depends on, where that bounds a time step.
    pub frequency: &'static [&'static str],
}

/// See [`Scene::initial_dependencies`](crate::scene::Scene::initial_dependencies).
pub fn dependencies(name: &str, engine: AtStart) -> Vec<&'static str> {
    let AtStart {
        place,
        displacement,
        acceleration,
        frequency,
    } = engine;
    match stem(name) {
        "disk.x" => [PLACE, place].concat(),
        "disk.y" => [PLACE, place, displacement].concat(),
        "mean_velocity" => VELOCITY.to_vec(),
        "energy.kinetic" => [VELOCITY, &["disk.mass"]].concat(),
        "energy.potential" => [PLACE, place, displacement, &["gravity", "disk.mass"]].concat(),
        "base.position" => displacement.to_vec(),
        "base.acceleration" => acceleration.to_vec(),
        "chosen_time_step" => [STEP_OF_ONE_DISK, frequency].concat(),
        // In flight without spin, and nothing has happened yet.
        _ => Vec::new(),
    }
}
