//! The variables of the packing scene.

use crate::scene::Choice;
use crate::scene::{Unit, Variable};

/// Names of the three radii that share the disks equally.
pub const RADII: [&str; 3] = ["disk.radius_small", "disk.radius_medium", "disk.radius_large"];

/// Parameters, inputs, calculated parameters and outputs, with those of the integration and the drive.
pub fn rows(choice: Choice, integration: Vec<Variable>, drive: Vec<Variable>) -> Vec<Variable> {
    let mut rows = parameters();
    rows.extend(integration);
    rows.extend(drive);
    rows.extend(calculated(choice.disks));
    rows.extend(outputs(choice.disks));
    rows
}

/// Value of `base.model` for the fixed bottom with a random phase (P 2.3.3); the other is the moving bottom.
pub const RANDOM_PHASE: i64 = 1;

/// Parameter of the event-driven packing on a sine.
pub fn base_model() -> Variable {
    const OPTIONS: &[(&str, &str)] = &[
        (
            "random_phase",
            "Fixed bottom that lends each impact the velocity of a base of random phase",
        ),
        ("moving", "Bottom that moves"),
    ];
    Variable::enumeration_parameter(
        "base.model",
        "base_model",
        OPTIONS,
        2,
        "What the bottom of the box does",
    )
}

/// Rows of the event-driven packing: no integration, no springs, impacts instead of contacts.
pub fn hard_rows(choice: Choice, drive: Vec<Variable>, further: Vec<Variable>) -> Vec<Variable> {
    let absent = ["chosen_time_step", "largest_time_step", "energy.elastic", "contacts"];
    let mut rows = parameters();
    rows.extend(further);
    rows.extend(drive);
    rows.extend(calculated(choice.disks));
    rows.extend(outputs(choice.disks));
    rows.retain(|row| !absent.contains(&row.name.as_str()));
    let energies = rows
        .iter()
        .position(|row| row.name == "disk.angle[1]")
        .unwrap_or(rows.len());
    rows.insert(
        energies,
        Variable::output("collisions", Unit::One, 1e4, "Impacts so far, of disks and on walls"),
    );
    rows
}

fn parameters() -> Vec<Variable> {
    let radius = |name: &str, start: f64, which: &str| {
        let description = format!("Radius of the {which} third of the disks");
        Variable::parameter(name, Unit::Metre, 1e-6..=1e3, start, &description)
    };
    vec![
        Variable::parameter(
            "gravity",
            Unit::MetrePerSecondSquared,
            0.0..=1e4,
            9.8,
            "Gravity, downwards",
        ),
        Variable::long_parameter("seed", 0..=i64::MAX, 1, "Seed of the order of the radii in the packing"),
        Variable::parameter(
            "box.width",
            Unit::Metre,
            1e-6..=1e6,
            0.40,
            "Inner width of the box; its middle is x = 0",
        ),
        radius(RADII[0], 0.015, "first"),
        radius(RADII[1], 0.020, "second"),
        radius(RADII[2], 0.025, "last"),
        Variable::parameter(
            "disk.surface_density",
            Unit::KilogramPerSquareMetre,
            1e-9..=1e9,
            3.57,
            "Mass of a disk over its area",
        ),
        Variable::parameter(
            "contact.normal_stiffness",
            Unit::NewtonPerMetre,
            1e-3..=1e15,
            1e4,
            "Normal stiffness k_n of every contact",
        ),
        Variable::parameter(
            "contact.stiffness_ratio",
            Unit::One,
            0.0..=1e9,
            0.77,
            "Tangential over normal stiffness, kappa = k_t / k_n",
        ),
        Variable::parameter(
            "contact.normal_damping",
            Unit::KilogramPerSecond,
            0.0..=1e9,
            0.1,
            "Normal damping gamma_n of every contact",
        ),
        Variable::parameter(
            "contact.friction",
            Unit::One,
            0.0..=1e6,
            0.1,
            "Friction coefficient mu of every contact",
        ),
    ]
}

/// Parameter that sets the time step, or leaves it to the engine.
pub fn time_step(description: &str) -> Variable {
    Variable::parameter("time_step", Unit::Second, 0.0..=1.0, 0.0, description).with_nominal(1e-5)
}

fn calculated(disks: u32) -> Vec<Variable> {
    let mut rows = vec![
        Variable::calculated("chosen_time_step", Unit::Second, 1e-5, "Time step in use"),
        Variable::calculated(
            "largest_time_step",
            Unit::Second,
            1e-4,
            "Largest time step that would be accepted",
        ),
    ];
    rows.extend((1..=disks).map(|disk| {
        let description = format!("Radius of disk {disk}");
        Variable::calculated(format!("disk.radius[{disk}]"), Unit::Metre, 0.02, description)
    }));
    rows
}

fn outputs(disks: u32) -> Vec<Variable> {
    let energy = |name: &str, description: &str| Variable::output(name, Unit::Joule, 1e-3, description);
    let mut rows = vec![
        Variable::output(
            "mean_velocity",
            Unit::MetrePerSecond,
            0.1,
            "Mean horizontal velocity of the disks now",
        ),
        Variable::output(
            "mean_angular_velocity",
            Unit::RadianPerSecond,
            1.0,
            "Mean angular velocity of the disks now, counter-clockwise",
        ),
        Variable::output(
            "base.reaction_force",
            Unit::Newton,
            1.0,
            "Vertical force of the disks on the base, up: impulse over the last communication step divided by its length",
        ),
        Variable::output("base.position", Unit::Metre, 1e-3, "Displacement of the base now, up"),
        Variable::output(
            "base.acceleration",
            Unit::MetrePerSecondSquared,
            10.0,
            "Acceleration of the base now, up",
        ),
        energy("energy.kinetic", "Kinetic energy of translation and rotation"),
        energy(
            "energy.potential",
            "Energy in gravity, zero at the height of the base at rest",
        ),
        energy("energy.elastic", "Energy in the springs and skins of closed contacts"),
        energy("energy.input", "Work done by the base on the disks since the start"),
        energy("energy.lost", "Energy lost in the dashpots and by slip since the start"),
        energy(
            "energy.residual",
            "Change of energy less work of the base plus losses: the integration's own error",
        ),
        Variable::count_output("contacts", "Closed contacts, with the walls and the base"),
    ];
    let mut each = |prefix: &str, unit: Unit, nominal: f64, what: &str| {
        rows.extend((1..=disks).map(|disk| {
            Variable::output(
                format!("{prefix}[{disk}]"),
                unit,
                nominal,
                format!("{what} of disk {disk}"),
            )
        }));
    };
    each(
        "disk.angle",
        Unit::Radian,
        1.0,
        "Angle turned, counter-clockwise and unwrapped,",
    );
    each(
        "disk.angular_velocity",
        Unit::RadianPerSecond,
        1.0,
        "Angular velocity, counter-clockwise,",
    );
    each(
        "disk.x",
        Unit::Metre,
        0.1,
        "Distance of the centre to the right of the middle of the box",
    );
    each(
        "disk.y",
        Unit::Metre,
        0.1,
        "Height of the centre above the base at rest",
    );
    rows
}
