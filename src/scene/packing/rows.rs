//! Rows that both kinds of packings have, and what they depend on at the start: where the disks lie and where the base is.

use std::sync::Arc;

use crate::scene::base_drive::BaseDrive;
use crate::scene::disks_on_base::{
    BaseRows, DisksOnBase, heights, horizontal_positions, mean_angular_velocity, mean_velocity, names, rotations,
    velocities,
};
use crate::scene::info::GRAVITY;
use crate::scene::{Row, Unit, recommended, work_limit};

use super::rotation::{self, MeasuresRotation};

/// Names of the three radii that share the disks equally.
pub const RADII: [&str; 3] = ["disk.radius_small", "disk.radius_medium", "disk.radius_large"];

/// Name of the parameter that asks for a settled packing.
pub const SETTLED: &str = "initial.settled";

/// Name of the parameter that displaces the disks at the start.
pub const PERTURBATION: &str = "initial.perturbation";

/// Name of the parameter that says whether the side walls move.
pub const WALL_MOTION: &str = "wall.motion";

/// Its value for side walls that move with the floor.
pub const WITH_BASE: i64 = 2;

/// Radii in their order, and the box: the packing on a base at height zero.
pub const PLACES: &[&str] = &["seed", "box.width", PERTURBATION, RADII[0], RADII[1], RADII[2]];

/// What decides where a settled packing rests besides: weight and contacts.
pub const SETTLING: &[&str] = &[
    SETTLED,
    "gravity",
    "disk.surface_density",
    "contact.normal_stiffness",
    "contact.normal_damping",
];

/// The same of hard disks, which have no contacts while they settle.
pub const HARD_SETTLING: &[&str] = &[SETTLED, "gravity"];

/// What outputs depend on before the first step.
pub struct AtStart {
    /// Radii of the disks.
    pub radii: Arc<[&'static str]>,
    /// Horizontal positions of the disks.
    pub places: Arc<[&'static str]>,
    /// Heights of the disks.
    pub heights: Arc<[&'static str]>,
    /// Which contacts are closed.
    pub touching: Arc<[&'static str]>,
    /// Vertical velocities of the disks: a settled packing moves with the base.
    pub vertical_velocities: Arc<[&'static str]>,
    /// Energy of the motion.
    pub kinetic_energy: Arc<[&'static str]>,
    /// Energy in gravity.
    pub potential_energy: Arc<[&'static str]>,
    /// Displacement of the base.
    pub base_position: Arc<[&'static str]>,
    /// Velocity of the base.
    pub base_velocity: Arc<[&'static str]>,
    /// Acceleration of the base.
    pub base_acceleration: Arc<[&'static str]>,
}

impl AtStart {
    /// With the drive D; `base_model` names the parameter that may hold the base at rest, if there is one, and `settling` what
    /// decides where a settled packing rests.
    pub fn of<D: BaseDrive>(base_model: &[&'static str], settling: &[&'static str]) -> Self {
        let position = [D::DISPLACEMENT_AT_START, base_model].concat();
        let places = names(&[PLACES, settling]);
        let heights = names(&[&places, &position]);
        // Which disks belong to the base is a matter of places.
        let free: &[&str] = if D::MOVES_DISKS { &places } else { &[] };
        let mass_and_motion = &[SETTLED, "seed", "disk.surface_density", RADII[0], RADII[1], RADII[2]];
        Self {
            radii: names(&[&RADII, &["seed"]]),
            touching: Arc::clone(&heights),
            vertical_velocities: match D::VELOCITY_AT_START {
                [] => names(&[]),
                of_base => names(&[
                    &[SETTLED],
                    of_base,
                    base_model,
                    if D::MOVES_DISKS { PLACES } else { &[] },
                ]),
            },
            kinetic_energy: names(&[mass_and_motion, D::VELOCITY_AT_START, base_model, free]),
            potential_energy: names(&[&heights, &["gravity", "disk.surface_density"]]),
            heights,
            places,
            base_velocity: names(&[D::VELOCITY_AT_START, base_model]),
            base_acceleration: names(&[D::ACCELERATION_AT_START, base_model]),
            base_position: position.into(),
        }
    }
}

/// Means over the disks and motion of the base, which come before the energies.
pub fn means_and_base<M: DisksOnBase + MeasuresRotation>(at_start: &AtStart) -> Vec<Row<M>> {
    let base = BaseRows {
        force: 1.0,
        bodies: "disks on the base, and on side walls that move with it",
        note: "",
        position_at_start: &at_start.base_position,
        velocity_at_start: &at_start.base_velocity,
        acceleration_at_start: &at_start.base_acceleration,
    };
    let mut rows = vec![
        mean_velocity(0.1, "Mean horizontal velocity of the disks now"),
        mean_angular_velocity(1.0, "Mean angular velocity of the disks now, counter-clockwise"),
    ];
    rows.extend(rotation::of_all());
    rows.extend(base.rows());
    rows
}

/// Motion of each disk, which comes last.
pub fn each_disk<M: DisksOnBase + MeasuresRotation + 'static>(disks: u32, at_start: &AtStart) -> Vec<Row<M>> {
    let angle = "Angle turned, counter-clockwise and unwrapped, of disk {}";
    let rate = "Angular velocity, counter-clockwise, of disk {}";
    let across = "Distance of the centre to the right of the middle of the box of disk {}";
    let up = "Height of the centre above the base at rest of disk {}";
    rotations(disks, angle, 1.0, rate)
        .chain(horizontal_positions(disks, 0.1, across).map(|row| row.depending_on(&at_start.places)))
        .chain(heights(disks, 0.1, up).map(|row| row.depending_on(&at_start.heights)))
        .chain(velocities(disks, 0.1, &[], &at_start.vertical_velocities))
        .chain(rotation::of_each(disks))
        .collect()
}

const WALL_MOTIONS: &[(&str, &str)] = &[
    ("fixed", "Side walls stand still while the floor moves"),
    (
        "with_base",
        "Side walls move up and down with the floor and rub on the disks",
    ),
];

/// Parameters that both kinds of packings have.
pub fn parameters<M>() -> Vec<Row<M>> {
    let radius = |name: &str, start: f64, which: &str| {
        let description = format!("Radius of the {which} third of the disks");
        Row::parameter(name, Unit::METRE, 1e-6..=1e3, start, &description)
    };
    let mut rows = vec![
        Row::parameter("gravity", Unit::METRE_PER_SECOND_SQUARED, 0.0..=1e4, 9.8, GRAVITY).tunable(),
        Row::long_parameter(
            "seed",
            0..=i64::MAX,
            1,
            "Seed of the order of the radii in the packing, and of initial.perturbation",
        ),
        Row::parameter(
            PERTURBATION,
            Unit::ONE,
            0.0..=0.5,
            0.0,
            "Each disk starts displaced at random by up to this part of its radius, with as much room around it; without it \
             equal radii give the same run for every seed",
        )
        .with_nominal(1e-3),
        Row::parameter(
            "box.width",
            Unit::METRE,
            1e-6..=1e6,
            0.40,
            "Inner width of the box; its middle is x = 0",
        ),
        Row::enumeration_parameter(
            WALL_MOTION,
            "wall_motion",
            WALL_MOTIONS,
            1,
            "What the side walls do; those of a box on a shaker move with its floor",
        ),
        radius(RADII[0], 0.015, "first"),
        radius(RADII[1], 0.020, "second"),
        radius(RADII[2], 0.025, "last"),
        Row::parameter(
            "disk.surface_density",
            Unit::KILOGRAM_PER_SQUARE_METRE,
            1e-9..=1e9,
            3.57,
            "Mass of a disk over its area",
        ),
        Row::parameter(
            "contact.normal_stiffness",
            Unit::NEWTON_PER_METRE,
            1e-3..=1e15,
            1e4,
            "Normal stiffness k_n of every contact",
        ),
        Row::parameter(
            "contact.stiffness_ratio",
            Unit::ONE,
            0.0..=1e9,
            0.77,
            "Tangential over normal stiffness, kappa = k_t / k_n",
        )
        // Hertz and Mindlin: 2 (1 - nu) / (2 - nu), which is 2/3 to 1 for Poisson's ratios of 0 to 1/2.
        .recommended(
            0.0..=10.0,
            "elastic bodies have 0.67 to 1; far stiffer tangential springs make the time step small, and each impact a series of \
             oscillations.",
        ),
        recommended::packing_damping(Row::parameter(
            "contact.normal_damping",
            Unit::KILOGRAM_PER_SECOND,
            0.0..=1e9,
            0.1,
            "Normal damping gamma_n of every contact",
        )),
        recommended::friction(Row::parameter(
            "contact.friction",
            Unit::ONE,
            0.0..=1e6,
            0.1,
            "Friction coefficient mu of every contact",
        ))
        .tunable(),
        work_limit::row(),
    ];
    rows.extend(rotation::parameters());
    rows
}

/// Parameter that sets the time step, or leaves it to the engine.
pub fn time_step<M>(description: &str) -> Row<M> {
    Row::parameter("time_step", Unit::SECOND, 0.0..=1.0, 0.0, description).with_nominal(1e-5)
}
