//! The list `contacts` against Newton's equations: what it says of the contacts is what moves the disks.

#![allow(clippy::unwrap_used)]

use jostle::scene::{AnySimulation, Selection, Value};

/// Rows of the list at one instant.
fn contacts(simulation: &AnySimulation) -> Vec<[f64; 9]> {
    let listed = simulation.list("contacts").unwrap();
    assert_eq!(listed.info.columns.len(), 9);
    let (rows, rest) = listed.numbers.as_chunks();
    assert!(rest.is_empty());
    rows.to_vec()
}

/// vx, vy and angular velocity of each disk.
fn rates(simulation: &AnySimulation, disks: usize) -> Vec<[f64; 3]> {
    let rate = |name: &str, disk: usize| simulation.real(&format!("{name}[{}]", disk + 1)).unwrap();
    let names = ["disk.velocity_x", "disk.velocity_y", "disk.angular_velocity"];
    (0..disks).map(|disk| names.map(|name| rate(name, disk))).collect()
}

/// Force (x, y) and torque over radius of the contacts on each disk.
fn sums(rows: &[[f64; 9]], disks: usize) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; disks];
    for &[first, second, _, _, _, nx, ny, normal, tangential] in rows {
        let force = [normal * nx + tangential * ny, normal * ny - tangential * nx];
        for (disk, sense) in [(first, 1.0), (second, -1.0)] {
            if disk > 0.0 {
                let sum = &mut sums[disk as usize - 1];
                sum[0] += sense * force[0];
                sum[1] += sense * force[1];
                sum[2] += tangential;
            }
        }
    }
    sums
}

/// Largest difference of m a and the forces over the largest force, at `time` \[s\], by a central difference of the velocities.
fn newton(engine: &str, given: &[(&str, &str)], time: f64) -> f64 {
    const DISKS: u32 = 20;
    const H: f64 = 2e-6;
    let selection = Selection {
        engine: Some(engine),
        drive: Some("sine"),
        disks: Some(DISKS),
        ..Selection::of("packing")
    };
    let mut simulation = AnySimulation::new(selection, given).unwrap();
    let disks = DISKS as usize;
    simulation.advance_to(time - H).unwrap();
    let before = rates(&simulation, disks);
    simulation.advance_to(time).unwrap();
    let rows = contacts(&simulation);
    assert_eq!(simulation.integer("contacts").unwrap(), rows.len() as i64);
    assert!(rows.len() > 8, "{} contacts", rows.len());
    simulation.advance_to(time + H).unwrap();
    let after = rates(&simulation, disks);

    let density = simulation.given("disk.surface_density").map(Value::to_f64).unwrap();
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for (disk, sum) in sums(&rows, disks).into_iter().enumerate() {
        let radius = simulation.real(&format!("disk.radius[{}]", disk + 1)).unwrap();
        let mass = density * std::f64::consts::PI * radius * radius;
        let rate = |axis: usize| (after[disk][axis] - before[disk][axis]) / (2.0 * H);
        // m a_y + m g, and I alpha / R.
        let needed = [mass * rate(0), mass * (rate(1) + 9.8), 0.5 * mass * radius * rate(2)];
        for axis in 0..3 {
            worst = worst.max((needed[axis] - sum[axis]).abs());
            largest = largest.max(sum[axis].abs());
        }
    }
    worst / largest
}

const SHAKEN: [(&str, &str); 2] = [("drive.amplitude", "2e-5"), ("box.width", "0.15")];

/// The difference quotient is wrong by h^2 times the third rate of the velocities, here 1e-4; a wrong sign, a contact that is
/// missing or a tangential force with another lever is 1e-2 and more.
#[test]
fn the_located_engine_moves_disks_by_these_forces() {
    let worst = newton("molecular-dynamics-located", &SHAKEN, 0.313);
    assert!(worst < 1e-3, "{worst:e}");
}

/// As above; velocity Verlet with a small step.
#[test]
fn verlet_moves_disks_by_these_forces() {
    let worst = newton(
        "molecular-dynamics",
        &[SHAKEN[0], SHAKEN[1], ("time_step", "1e-6")],
        0.313,
    );
    assert!(worst < 5e-3, "{worst:e}");
}

/// Without friction the engine keeps no springs, and the list has the same contacts as the engine counts.
#[test]
fn frictionless_contacts_are_listed_too() {
    let worst = newton(
        "molecular-dynamics",
        &[SHAKEN[0], SHAKEN[1], ("contact.friction", "0"), ("time_step", "1e-6")],
        0.313,
    );
    assert!(worst < 5e-3, "{worst:e}");
}

#[test]
fn the_disk_on_two_supports_lists_both() {
    let selection = Selection {
        drive: Some("input"),
        ..Selection::of("three_disk")
    };
    let mut simulation = AnySimulation::new(selection, &[("torque", "1e-6")]).unwrap();
    simulation.advance_to(0.01).unwrap();
    let rows = contacts(&simulation);
    assert_eq!(rows.len(), 2);
    let given = |name: &str| simulation.given(name).map(Value::to_f64).unwrap();
    let weight = given("disk.mass") * given("gravity");
    let [across, up, _] = sums(&rows, 1)[0];
    assert!(
        across.abs() < 1e-6 * weight && (up / weight - 1.0).abs() < 1e-6,
        "{across:e} {up:e} {weight:e}"
    );
    for (row, number) in rows.iter().zip(1..) {
        assert_eq!((row[1], row[2]), (0.0, f64::from(number)));
        assert!(row[4] < 0.0, "a support is below the centre: {row:?}");
        let force = simulation.real(&format!("contact[{number}].normal_force")).unwrap();
        assert_eq!(row[7], force);
    }
}

#[test]
fn the_wedge_lists_its_wall_while_it_touches() {
    let selection = Selection {
        engine: Some("molecular-dynamics"),
        ..Selection::of("wedge")
    };
    let mut simulation = AnySimulation::new(selection, &[]).unwrap();
    let mut touched = 0;
    for step in 1..=2000 {
        simulation.advance_to(f64::from(step) * 1e-4).unwrap();
        let rows = contacts(&simulation);
        assert_eq!(rows.len() as i64, simulation.integer("contacts").unwrap());
        touched += rows.len();
    }
    assert!(touched > 0, "the disk has never touched a wall");
}

#[test]
fn engines_of_impacts_say_that_they_have_no_contacts() {
    let selection = Selection {
        engine: Some("event-driven"),
        ..Selection::of("packing")
    };
    let error = AnySimulation::new(selection, &[])
        .unwrap()
        .list("contacts")
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("packing, engine event-driven") && error.contains("no list contacts"),
        "{error}"
    );
    let error = AnySimulation::new(Selection::of("packing"), &[])
        .unwrap()
        .list("contact")
        .unwrap_err()
        .to_string();
    assert!(error.contains("It has contacts."), "{error}");
}
