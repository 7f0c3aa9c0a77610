//! Changes of friction, restitution and gravity during a run against closed forms and balances.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::collision::Smooth;
use jostle::contact::LinearDashpot;
use jostle::drive::{Drive, FollowsInput, Sine};
use jostle::engine::dem::event_located::EventStepper;
use jostle::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};
use jostle::engine::dem::{FixedGrid, SoftDiskSetup, Stepper};
use jostle::engine::event_driven::{EventDriven, Moving, Open, Region, Settings, Unobserved, Walls};
use jostle::engine::threads::ThreadPool;
use jostle::engine::{Engine, event_driven};
use jostle::geometry::{Disk, Vector2, Wall};
use jostle::scene::packing::event_driven::HardPackingOnSine;
use jostle::scene::packing::{LocatedPackingOnSine, PackingOnFixedBottom, PackingOnSine};
use jostle::scene::ratchet::RatchetOnSine;
use jostle::scene::wedge::{WedgeEventDrivenOnSine, WedgeMolecularDynamicsOnSine};
use jostle::scene::{Model, Simulation};
use support::simulation_of;
use support::soft_disks::{RADIUS, at_rest, laws, mass};

const GRAVITY: f64 = 9.8;

/// One disk on a floor at rest, as deep in it as its weight presses it, with a horizontal velocity of 1 m/s.
fn sliding<S: Stepper<Normal = LinearDashpot>>(
    friction: f64,
    push: impl FnOnce(&mut S::Disks),
) -> FixedGrid<S, FollowsInput> {
    let mass = mass(RADIUS);
    let sunk = mass * GRAVITY / 1e4;
    let setup = SoftDiskSetup {
        laws: laws(0.5, 0.77, friction),
        walls: vec![Wall::vibrating_floor()],
        masses: vec![mass],
        gravity: GRAVITY,
        time_step: 2e-5,
        start_time: 0.0,
    };
    let disk = Disk {
        x: 0.0,
        y: RADIUS - sunk,
        radius: RADIUS,
    };
    let mut engine = FixedGrid::new(setup, &[disk], at_rest());
    engine.set_motion(push);
    engine
}

type VerletStepper = PredictorCorrector<VelocityVerlet, LinearDashpot, ThreadPool>;

/// v' = -mu g and R omega' = 2 mu g while the disk slides. Springs that stretch first delay that by far less than a millisecond.
fn slides_as_its_friction_says<S: Stepper<Normal = LinearDashpot>>(push: impl FnOnce(&mut S::Disks)) {
    let mut engine = sliding::<S>(0.05, push);
    let (mut velocity, mut surface) = (1.0, 0.0);
    for (index, friction) in [0.05, 0.2, 0.02, 0.0, 0.1].into_iter().enumerate() {
        engine.tune(friction, GRAVITY);
        engine.advance_to(0.02 * (index + 1) as f64).unwrap();
        velocity -= friction * GRAVITY * 0.02;
        surface += 2.0 * friction * GRAVITY * 0.02;
        let disk = engine.observables().disk(0);
        let spun = -RADIUS * disk.angular_velocity;
        assert!(
            (disk.velocity.x - velocity).abs() < 2e-4 && (spun - surface).abs() < 4e-4,
            "friction {friction}: {} m/s instead of {velocity}, surface {spun} m/s instead of {surface}",
            disk.velocity.x
        );
    }
}

#[test]
fn a_disk_that_slides_is_braked_by_the_friction_of_the_time() {
    slides_as_its_friction_says::<VerletStepper>(|disks| disks.velocity[0] = 1.0);
    slides_as_its_friction_says::<EventStepper>(|disks| disks.velocities[0][0] = 1.0);
}

/// A disk above the floor: parabola after parabola, exact for both methods.
fn falls_as_gravity_says<S: Stepper<Normal = LinearDashpot>>(lift: impl FnOnce(&mut S::Disks)) {
    let mut engine = sliding::<S>(0.1, lift);
    let (mut height, mut velocity) = (1.0, 0.0);
    for (index, gravity) in [GRAVITY, 1.6, 0.0, 24.8].into_iter().enumerate() {
        engine.tune(0.1, gravity);
        engine.advance_to(0.05 * (index + 1) as f64).unwrap();
        height += 0.05 * (velocity - 0.5 * 0.05 * gravity);
        velocity -= 0.05 * gravity;
        let disk = engine.observables().disk(0);
        assert!(
            (disk.position.y - height).abs() < 1e-12 && (disk.velocity.y - velocity).abs() < 1e-12,
            "gravity {gravity}: {:?} instead of {height} m, {velocity} m/s",
            disk
        );
    }
}

#[test]
fn a_soft_disk_falls_under_the_gravity_of_the_time() {
    falls_as_gravity_says::<VerletStepper>(|disks| disks.position[1] = 1.0);
    falls_as_gravity_says::<EventStepper>(|disks| disks.positions[0][1] = 1.0);
}

/// An elastic ball is dropped, rises again, and meets another gravity on its way: its next impact is that of the closed form.
#[test]
fn a_hard_disk_flies_under_the_gravity_of_the_time() {
    let drive = Sine {
        amplitude: 0.0,
        frequency: 1.0,
        phase: 0.0,
    };
    assert_eq!(drive.motion(0.3).displacement, 0.0);
    let model = event_driven::Model {
        law: Smooth::ELASTIC,
        boundary: Walls {
            walls: vec![Wall::vibrating_floor()],
            base: Moving { drive, farthest: 0.0 },
            origin: 0.0,
        },
        gravity: GRAVITY,
        space: Open(Region {
            corner: Vector2::new(-1.0, 0.0),
            size: Vector2::new(2.0, 2.0),
        }),
    };
    let disk = Disk::new(Vector2::new(0.0, RADIUS + 0.1), RADIUS);
    let mut engine = EventDriven::new(model, &[disk], &[1.0], &[[0.0; 3]], Settings::default());
    let first = (2.0 * 0.1 / GRAVITY).sqrt();
    let turn = first + 0.05;
    engine.advance_to(turn).unwrap();
    engine.set_gravity(turn, 2.0, &mut Unobserved);
    let (height, velocity) = (
        GRAVITY * first * 0.05 - 0.5 * GRAVITY * 0.05 * 0.05,
        GRAVITY * first - GRAVITY * 0.05,
    );
    let impact = turn + (velocity + (velocity * velocity + 4.0 * height).sqrt()) / 2.0;
    for (time, impacts) in [(impact - 1e-9, 1), (impact + 1e-9, 2)] {
        engine.advance_to(time).unwrap();
        assert_eq!(engine.state().counts.wall_impacts, impacts, "at {time} s");
    }
    let motion = engine.sample_at(impact + 1e-9, 0);
    let landing = (velocity * velocity + 4.0 * height).sqrt();
    assert!(
        (motion.velocity.y - landing).abs() < 1e-7,
        "{motion:?} instead of {landing} m/s"
    );
}

/// Energies \[J\] of a packing.
struct Balance {
    kinetic: f64,
    potential: f64,
    elastic: f64,
    lost: f64,
    residual: f64,
}

fn balance<M: Model>(simulation: &Simulation<M>, soft: bool) -> Balance {
    let energy = |name: &str| simulation.real(&format!("energy.{name}")).unwrap();
    Balance {
        kinetic: energy("kinetic"),
        potential: energy("potential"),
        elastic: if soft { energy("elastic") } else { 0.0 },
        lost: energy("lost"),
        residual: energy("residual"),
    }
}

/// What a change does at its instant, seen across one time step after it: springs lose what friction no longer holds, gravity
/// changes the potential energy alone, and the residual stays where it was.
///
/// Tangential forces are within `slack` of the limit of friction, in units of friction times the largest normal force.
fn balances_across_a_change<M: Model>(drive: &[(&str, f64)], slack: f64) {
    let mut simulation = simulation_of::<M>(40, drive);
    let step = simulation.real("chosen_time_step").unwrap();
    let (mut slipped, mut n) = (0.0_f64, 0_u32);
    for (friction, gravity) in [
        (0.5, 9.8),
        (0.05, 9.8),
        (0.05, 15.0),
        (0.0, 2.0),
        (0.3, 9.8),
        (0.01, 30.0),
    ] {
        n += 2000;
        simulation.advance_to(f64::from(n) * step).unwrap();
        let before = balance(&simulation, true);
        let old_gravity = simulation.real("gravity").unwrap();
        let friction_falls = friction < simulation.real("contact.friction").unwrap();
        simulation.set("contact.friction", friction).unwrap();
        simulation.set("gravity", gravity).unwrap();
        n += 1;
        simulation.advance_to(f64::from(n) * step).unwrap();
        let after = balance(&simulation, true);
        let energy = before.kinetic + before.elastic;
        assert!(
            (after.residual - before.residual).abs() < 1e-4 * energy,
            "{friction}, {gravity}: residual {} and {} of {energy}",
            before.residual,
            after.residual
        );
        let potential = before.potential * gravity / old_gravity;
        assert!(
            (after.potential - potential).abs() < 0.02 * energy + 1e-3 * potential,
            "{friction}, {gravity}: {} instead of {potential}",
            after.potential
        );
        if friction_falls {
            slipped = slipped.max((after.lost - before.lost) / energy);
        }
        let contacts = simulation.list("contacts").unwrap();
        let columns = contacts.info.columns.iter().map(|column| column.name);
        let column = |name: &str| columns.clone().position(|known| known == name).unwrap();
        let (normal, tangential) = (column("normal_force"), column("tangential_force"));
        let rows = || contacts.numbers.chunks(contacts.info.columns.len());
        let largest = rows().map(|row| row[normal]).fold(0.0, f64::max);
        for row in rows() {
            assert!(
                row[tangential].abs() <= friction * (row[normal] + slack * largest),
                "{friction}: {} of {} N",
                row[tangential],
                row[normal]
            );
        }
    }
    // What slips is more than the residual may change: a balance without it would be seen to be open.
    println!("{:?}: {slipped:.1e} of the energy slips", M::info().variant);
    assert!(slipped > 5e-4, "{slipped}");
}

#[test]
fn soft_packings_balance_their_energy_across_changes() {
    let drive = [
        ("drive.amplitude", 1.5e-4),
        ("drive.frequency", 80.0),
        ("contact.normal_damping", 1.0),
    ];
    // Velocity Verlet limits the springs by the dashpot's force at the predicted velocity, the list shows it at the corrected one.
    balances_across_a_change::<PackingOnSine>(&drive, 1e-3);
    balances_across_a_change::<PackingOnFixedBottom>(&drive, 1e-3);
    // Of located events it is the error of a step, and falls as that does when the tolerance is sharpened: the largest found were
    // 2.5e-5, 4.0e-6, 7.9e-7 and 3.7e-8.
    for tolerance in [1e-5, 1e-6, 1e-7, 1e-8] {
        let sharper = [&drive[..], &[("tolerance", tolerance)]].concat();
        balances_across_a_change::<LocatedPackingOnSine>(&sharper, 10.0 * tolerance);
    }
}

/// Impacts and flights are exact: the residual is rounding before and after.
fn balances_to_rounding<M: Model>(disks: u32, parameters: &[(&str, f64)], changes: &[(&str, f64)]) {
    let mut simulation = simulation_of::<M>(disks, parameters);
    let mut scale: f64 = 0.0;
    for (index, (name, value)) in changes.iter().enumerate() {
        let time = 0.1 * (index + 1) as f64;
        simulation.advance_to(time).unwrap();
        simulation.set(name, *value).unwrap();
        simulation.advance_to(time + 0.05).unwrap();
        let now = balance(&simulation, false);
        scale = scale.max(now.kinetic + now.potential.abs() + now.lost);
        assert!(
            now.residual.abs() < 1e-11 * scale,
            "{name} = {value}: residual {} of {scale}",
            now.residual
        );
    }
}

#[test]
fn hard_disks_balance_their_energy_across_changes() {
    let packing = [
        ("gravity", 4.0),
        ("contact.friction", 0.5),
        ("gravity", 20.0),
        ("contact.friction", 0.0),
        ("gravity", 9.8),
    ];
    balances_to_rounding::<HardPackingOnSine>(40, &[("drive.amplitude", 3e-4)], &packing);
    balances_to_rounding::<HardPackingOnSine>(40, &[("drive.amplitude", 3e-4), ("base.model", 1.0)], &packing);
    let ratchet = [
        ("gravity", 4.0),
        ("collision.friction", 0.5),
        ("collision.restitution", 0.6),
        ("gravity", 15.0),
        ("collision.minimum_normal_velocity", 1e-2),
        ("gravity", 9.81),
    ];
    balances_to_rounding::<RatchetOnSine>(20, &[], &ratchet);
}

/// The wedge has no residual among its outputs: what it is follows from the others, with the jumps of the potential energy.
fn wedge_balances<M: Model>(tolerance: f64) {
    let mut simulation = simulation_of::<M>(1, &[]);
    let energy = |simulation: &Simulation<M>| {
        let of = |name: &str| simulation.real(&format!("energy.{name}")).unwrap_or(0.0);
        [
            of("kinetic") + of("potential") + of("elastic") - of("input") + of("lost"),
            of("kinetic") + of("potential") + of("lost"),
        ]
    };
    let [mut expected, _] = energy(&simulation);
    for (index, gravity) in [9.81, 3.0, 20.0, 9.81].into_iter().enumerate() {
        let height = simulation.real("disk.y[1]").unwrap();
        let mass = simulation.real("disk.mass").unwrap();
        expected += (gravity - simulation.real("gravity").unwrap()) * mass * height;
        simulation.set("gravity", gravity).unwrap();
        simulation.set("contact.friction", 0.1 * (index + 1) as f64).unwrap();
        simulation.advance_to(0.3 * (index + 1) as f64).unwrap();
        let [now, scale] = energy(&simulation);
        assert!(
            (now - expected).abs() < tolerance * scale,
            "{gravity}: {now} instead of {expected} J of {scale} J"
        );
    }
}

#[test]
fn a_disk_in_a_wedge_balances_its_energy_across_changes() {
    wedge_balances::<WedgeEventDrivenOnSine>(1e-11);
    wedge_balances::<WedgeMolecularDynamicsOnSine>(1e-3);
}

/// Friction that begins: the time step of a start without friction may be too large.
#[test]
fn friction_that_the_time_step_does_not_allow_is_refused_by_name() {
    let without = [("contact.friction", 0.0), ("tolerance", 1e-4)];
    let mut simulation = simulation_of::<LocatedPackingOnSine>(10, &without);
    simulation.advance_to(0.01).unwrap();
    let before = simulation.save();
    simulation.set("contact.friction", 0.2).unwrap();
    let refusal = simulation.advance_to(0.02).unwrap_err().to_string();
    assert!(
        refusal.contains("contact.friction = 0.2") && refusal.contains("time step"),
        "{refusal}"
    );
    simulation.set("contact.friction", 0.0).unwrap();
    assert!(simulation.save() == before);
    simulation.advance_to(0.02).unwrap();
}
