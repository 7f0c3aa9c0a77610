//! The variables of the ratchet.

use crate::scene::{Choice, Kind, Unit, Variable};

/// Value of `disk.mass_rule` for equal masses; the other is equal density.
pub const EQUAL_MASS: i64 = 1;

/// Parameters, inputs, calculated parameters and outputs, with those of the drive.
pub fn rows(choice: Choice, drive: Vec<Variable>) -> Vec<Variable> {
    let mut rows = general();
    rows.extend(teeth());
    rows.extend(disks());
    rows.extend(drive.into_iter().map(of_the_ratchet));
    rows.push(Variable::input(
        "measure.mark",
        Unit::Second,
        1.0,
        "The averages start anew at a communication point where this value has changed; any new value will do",
    ));
    rows.extend(calculated(choice.disks));
    rows.extend(outputs());
    rows.extend(each_disk(choice.disks));
    rows
}

/// A row of the drive with the amplitude and frequency of F IV.
fn of_the_ratchet(mut row: Variable) -> Variable {
    let changed = match row.name.as_str() {
        "drive.amplitude" => Some((
            2e-3,
            "Amplitude A of the base, y = A sin(2 pi f t + phase); the default is Gamma = 5 at 25 Hz",
        )),
        "drive.frequency" => Some((25.0, "Frequency f of the base")),
        _ => None,
    };
    if let (Some((start, description)), Kind::Real(quantity)) = (changed, &mut row.kind) {
        (quantity.start, quantity.nominal) = (start, start);
        row.description = description.into();
    }
    row
}

fn general() -> Vec<Variable> {
    vec![
        Variable::parameter(
            "gravity",
            Unit::MetrePerSecondSquared,
            1e-6..=1e4,
            9.81,
            "Gravity, downwards",
        ),
        Variable::long_parameter("seed", 0..=i64::MAX, 1, "Seed of the radii and the places at the start"),
        Variable::parameter(
            "cell.height",
            Unit::Metre,
            1e-6..=1e3,
            0.6,
            "Height of the ceiling above the valleys of the base at rest",
        ),
        Variable::parameter(
            "measure.start",
            Unit::Second,
            0.0..=1e9,
            0.0,
            "Time from which transport_velocity and what belongs to it are averaged at first",
        ),
        Variable::parameter(
            "collision.restitution",
            Unit::One,
            0.0..=1.0,
            0.8,
            "Normal restitution of every impact",
        ),
        Variable::parameter(
            "collision.friction",
            Unit::One,
            0.0..=1e6,
            0.1,
            "Friction coefficient of every impact",
        ),
        Variable::parameter(
            "collision.minimum_normal_velocity",
            Unit::MetrePerSecond,
            0.0..=1e3,
            5e-3,
            "No impact leaves slower than this along the normal: ends inelastic collapse",
        ),
    ]
}

fn teeth() -> Vec<Variable> {
    vec![
        Variable::parameter("tooth.width", Unit::Metre, 1e-6..=1e3, 6e-3, "Width of a tooth"),
        Variable::parameter(
            "tooth.height",
            Unit::Metre,
            0.0..=1e3,
            6e-3,
            "Height of the sharp apex, before rounding; 0 is flat",
        ),
        Variable::parameter(
            "tooth.asymmetry",
            Unit::One,
            0.0..=1.0,
            0.25,
            "Horizontal extent of the left side over the width: 0 a vertical left side, 1 a vertical right side",
        ),
        Variable::parameter(
            "tooth.tip_radius",
            Unit::Metre,
            0.0..=1e3,
            4e-4,
            "Radius of the arc that rounds the tip",
        ),
        Variable::long_parameter("tooth.count", 1..=1_000_000, 10, "Teeth in the periodic cell"),
    ]
}

fn disks() -> Vec<Variable> {
    const OPTIONS: &[(&str, &str)] = &[
        ("equal_mass", "All disks have the mass disk.mass"),
        (
            "equal_density",
            "Masses go with the area; a disk of the mean of the two radii has the mass disk.mass",
        ),
    ];
    vec![
        Variable::parameter(
            "disk.radius_min",
            Unit::Metre,
            1e-6..=1e3,
            1.05e-3,
            "Smallest radius; radii are drawn evenly",
        ),
        Variable::parameter("disk.radius_max", Unit::Metre, 1e-6..=1e3, 1.155e-3, "Largest radius"),
        Variable::parameter("disk.mass", Unit::Kilogram, 1e-12..=1e6, 1e-5, "Mass of a disk"),
        Variable::enumeration_parameter(
            "disk.mass_rule",
            "mass_rule",
            OPTIONS,
            EQUAL_MASS,
            "How masses go with radii",
        ),
        Variable::parameter(
            "disk.inertia_factor",
            Unit::One,
            1e-3..=1.0,
            0.5,
            "Moment of inertia over mass times radius squared: 0.5 a disk, 0.4 a ball",
        ),
    ]
}

fn calculated(disks: u32) -> Vec<Variable> {
    let mut rows = vec![Variable::calculated(
        "layers",
        Unit::One,
        1.0,
        "Layer count n: disks over those of the smallest radius that lie side by side across the cell",
    )];
    rows.extend((1..=disks).map(|disk| {
        let description = format!("Radius of disk {disk}");
        Variable::calculated(format!("disk.radius[{disk}]"), Unit::Metre, 1e-3, description)
    }));
    rows
}

fn outputs() -> Vec<Variable> {
    let energy = |name: &str, description: &str| Variable::output(name, Unit::Joule, 1e-6, description);
    let count = |name: &str, description: &str| Variable::output(name, Unit::One, 1e4, description);
    vec![
        Variable::output(
            "mean_velocity",
            Unit::MetrePerSecond,
            0.1,
            "Mean horizontal velocity of the disks now",
        ),
        Variable::output(
            "transport_velocity",
            Unit::MetrePerSecond,
            0.1,
            "Mean horizontal velocity of the disks since measure.start or the last change of measure.mark: their \
             displacement over the time; 0 before",
        ),
        Variable::output(
            "transport_velocity.standard_error",
            Unit::MetrePerSecond,
            1e-2,
            "Standard error of transport_velocity from batch means; 0 in the first 0.8 s",
        ),
        Variable::output(
            "transport_velocity.spread",
            Unit::MetrePerSecond,
            1e-2,
            "Standard deviation over the disks of each one's own mean velocity over the same time",
        ),
        Variable::output(
            "mean_angular_velocity",
            Unit::RadianPerSecond,
            10.0,
            "Mean angular velocity of the disks now, counter-clockwise",
        ),
        Variable::output(
            "base.reaction_force",
            Unit::Newton,
            1e-3,
            "Vertical force of the disks on the base, up: impulse over the last communication step divided by its length",
        ),
        Variable::output("base.position", Unit::Metre, 1e-3, "Displacement of the base now, up"),
        Variable::output(
            "base.acceleration",
            Unit::MetrePerSecondSquared,
            10.0,
            "Acceleration of the base now, up",
        ),
        Variable::output(
            "base.mean_power",
            Unit::Watt,
            1e-4,
            "Work of the base on the disks over the time that transport_velocity is averaged over, divided by it",
        ),
        energy("energy.kinetic", "Kinetic energy of translation and rotation"),
        energy(
            "energy.potential",
            "Energy in gravity, zero at the height of the valleys at rest",
        ),
        energy("energy.input", "Work done by the base on the disks since the start"),
        energy("energy.lost", "Energy lost in impacts since the start"),
        energy(
            "energy.residual",
            "Change of energy less work of the base plus losses: rounding",
        ),
        count("collisions", "Impacts so far, of disks, on the base and on the ceiling"),
        count("collisions.disks", "Impacts of two disks so far"),
        count("collisions.base", "Impacts on the base so far"),
        count("collisions.ceiling", "Impacts on the ceiling so far"),
    ]
}

fn each_disk(disks: u32) -> Vec<Variable> {
    let mut rows = Vec::new();
    let mut each = |prefix: &str, unit: Unit, nominal: f64, what: &str| {
        rows.extend((1..=disks).map(|disk| {
            let description = format!("{what} of disk {disk}");
            Variable::output(format!("{prefix}[{disk}]"), unit, nominal, description)
        }));
    };
    each(
        "disk.angle",
        Unit::Radian,
        1.0,
        "Angle turned, counter-clockwise and unwrapped,",
    );
    each(
        "disk.x",
        Unit::Metre,
        0.1,
        "Place of the centre to the right, unwrapped,",
    );
    each(
        "disk.y",
        Unit::Metre,
        0.01,
        "Height of the centre above the valleys of the base at rest",
    );
    rows
}
