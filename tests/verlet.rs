//! Velocity Verlet and Gear's method against closed forms, a reference of its own, and conservation laws.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::drive::{FollowsInput, Sine};
use jostle::engine::Engine;
use jostle::engine::dem::verlet::{Gear5, Integrator, PredictorCorrector, VelocityVerlet};
use jostle::engine::dem::{ContactLaws, FixedGrid, SoftDiskSetup, Verlet};
use jostle::geometry::{Disk, Wall};
use support::soft_disks::{RADIUS, at_rest, laws, mass};
use support::{order, thrown_disk};

/// Errors of e_n and of u_t' of a disk thrown at the floor.
fn impact_errors<I: Integrator>(laws: ContactLaws, velocity: [f64; 3], steps_a_contact: f64) -> [f64; 2] {
    let duration = std::f64::consts::PI * (mass(RADIUS) / laws.normal.stiffness).sqrt();
    thrown_disk::errors(laws, velocity, |phase| {
        let time_step = duration / steps_a_contact;
        thrown_disk::velocity_after::<PredictorCorrector<I>>(laws, velocity, time_step, phase, |disks| {
            disks.velocity[..3].copy_from_slice(&velocity);
        })
    })
}

fn impact_table<I: Integrator>() {
    let cases = [
        ("sticking", laws(0.1, 0.77, 0.8), [0.02, -0.3, 0.0]),
        ("rolling back", laws(0.1, 0.77, 0.1), [0.05, -0.3, 2.0]),
        ("sliding", laws(0.1, 0.77, 0.1), [0.5, -0.2, 0.0]),
        ("damped", laws(3.0, 0.3, 0.3), [0.2, -0.2, -3.0]),
    ];
    for (name, laws, velocity) in cases {
        let levels = [50.0, 200.0, 800.0, 3200.0];
        let errors: Vec<_> = levels
            .iter()
            .map(|level| impact_errors::<I>(laws, velocity, *level))
            .collect();
        for (level, [normal, surface]) in levels.iter().zip(&errors) {
            println!(
                "{:16} {name:13} {level:6.0} steps a contact: e_n {normal:.2e}, u_t' {surface:.2e}",
                I::NAME
            );
        }
        let (first, last) = (errors[1], errors[3]);
        let (normal, surface) = (order(first[0], last[0], 16.0), order(first[1], last[1], 16.0));
        println!("{:16} {name:13} order: e_n {normal:.2}, u_t' {surface:.2}", I::NAME);
        // The onset of a contact is not located: no integrator of fixed steps is better than first order across it.
        assert!(
            normal > 0.75 && surface > 0.75,
            "{name}: orders {normal:.2}, {surface:.2}"
        );
        assert!(errors[3][0] < 3e-4 && errors[3][1] < 3e-3, "{name}: {:?}", errors[3]);
    }
}

/// P 4.56 and a tight integration of the tangential law, for both integrators, with the orders as a table.
#[test]
fn impacts_converge_to_the_reference() {
    impact_table::<VelocityVerlet>();
    impact_table::<Gear5>();
}

/// Head-on impacts of two free disks of different radii reproduce e_n of their effective mass (P 4.56).
#[test]
fn binary_collisions_have_the_restitution_of_their_effective_mass() {
    for damping in [0.0, 0.1, 3.0, 12.0] {
        let disks = [
            Disk {
                x: -0.021,
                y: 0.0,
                radius: 0.015,
            },
            Disk {
                x: 0.021,
                y: 0.0,
                radius: 0.025,
            },
        ];
        let masses = vec![mass(0.015), mass(0.025)];
        let effective_mass = 1.0 / (1.0 / masses[0] + 1.0 / masses[1]);
        let laws = laws(damping, 0.77, 0.1);
        let setup = SoftDiskSetup {
            laws,
            walls: Vec::new(),
            masses,
            gravity: 0.0,
            time_step: 1e-6,
            start_time: 0.0,
        };
        let mut engine = Verlet::new(setup, &disks, at_rest());
        engine.set_motion(|disks| disks.velocity.copy_from_slice(&[0.2, 0.0, 0.0, -0.1, 0.0, 0.0]));
        engine.advance_to(0.05).unwrap();
        let rates = engine.observables().velocities;
        let restitution = (rates[1][0] - rates[0][0]) / 0.3;
        let error = (restitution - laws.normal.restitution(effective_mass)).abs();
        println!("gamma_n = {damping} kg/s: e_n = {restitution:.6}, error {error:.1e}");
        assert!(error < 2e-3, "gamma_n = {damping}: {restitution}");
    }
}

/// Two free disks, oblique and spinning: momentum and angular momentum are kept to rounding though they overlap.
fn free_collision<I: Integrator>() -> f64 {
    let disks = [
        Disk {
            x: -0.03,
            y: 0.004,
            radius: 0.015,
        },
        Disk {
            x: 0.03,
            y: -0.006,
            radius: 0.025,
        },
    ];
    let masses = vec![mass(0.015), mass(0.025)];
    let setup = SoftDiskSetup {
        laws: laws(0.5, 0.77, 0.4),
        walls: Vec::new(),
        masses: masses.clone(),
        gravity: 0.0,
        time_step: 1e-5,
        start_time: 0.0,
    };
    let mut engine = FixedGrid::<PredictorCorrector<I>, _>::new(setup, &disks, at_rest());
    engine.set_motion(|disks| disks.velocity.copy_from_slice(&[1.0, 0.1, 20.0, -0.5, 0.0, -7.0]));
    let angular_momentum = |engine: &FixedGrid<PredictorCorrector<I>, FollowsInput>| -> f64 {
        let now = engine.observables();
        let rows = now.positions.iter().zip(now.velocities).zip(&masses).zip(&disks);
        rows.map(|(((place, rate), mass), disk)| {
            mass * (place[0] * rate[1] - place[1] * rate[0] + 0.5 * disk.radius.powi(2) * rate[2])
        })
        .sum()
    };
    let (momentum, spin) = (engine.momentum(), angular_momentum(&engine));
    let energy = engine.energies().kinetic;
    let (mut touched, mut spin_error) = (false, 0.0);
    for step in 1..=100 {
        engine.advance_to(f64::from(step) * 3e-4).unwrap();
        touched |= engine.now().contacts > 0;
        let now = engine.momentum();
        assert!((now[0] - momentum[0]).abs() < 1e-16 && (now[1] - momentum[1]).abs() < 1e-16);
        spin_error = f64::max(spin_error, (angular_momentum(&engine) / spin - 1.0).abs());
    }
    assert!(touched && engine.now().contacts == 0);
    assert!(engine.energies().kinetic < energy);
    println!("{}: relative change of angular momentum {spin_error:.1e}", I::NAME);
    spin_error
}

#[test]
fn free_collisions_keep_momentum_and_angular_momentum() {
    // For Verlet it is an identity: both sides of x' v' - x v = h (x a + x' a') / 2 are torques of balanced forces.
    assert!(free_collision::<VelocityVerlet>() < 1e-13);
    assert!(free_collision::<Gear5>() < 1e-9);
}

/// Free fall is exact: y = -g t^2 / 2, whatever the grid and the sampling times.
#[test]
fn free_fall_is_exact() {
    let setup = SoftDiskSetup {
        laws: laws(0.1, 0.77, 0.1),
        walls: Vec::new(),
        masses: vec![mass(RADIUS)],
        gravity: 9.8,
        time_step: 1e-3,
        start_time: 5.0,
    };
    let disk = Disk {
        x: 0.0,
        y: 0.0,
        radius: RADIUS,
    };
    let mut engine = Verlet::new(setup, &[disk], at_rest());
    for sampled in [0.01234, 0.3, 0.98765] {
        engine.advance_to(5.0 + sampled).unwrap();
        assert!(
            (engine.observables().positions[0][1] + 0.5 * 9.8 * sampled * sampled).abs() < 1e-13,
            "{sampled}"
        );
        assert!((engine.observables().velocities[0][1] + 9.8 * sampled).abs() < 1e-12);
    }
}

/// A disk let down on a sine base of low amplitude stays in contact and follows the closed form of the driven,
/// damped oscillator m y'' = -k (y - b) - gamma (y' - b') - m g with b = A sin(omega t).
fn driven_oscillator<I: Integrator>(steps_a_period: f64) -> f64 {
    let (stiffness, damping, gravity, frequency, amplitude) = (1e4, 3.0, 9.8, 40.0, 2e-5);
    let mass = mass(RADIUS);
    let (natural, rate) = ((stiffness / mass).sqrt(), damping / (2.0 * mass));
    let damped = (natural * natural - rate * rate).sqrt();
    let period = std::f64::consts::TAU / damped;
    let setup = SoftDiskSetup {
        laws: laws(damping, 0.77, 0.1),
        walls: vec![Wall::vibrating_floor()],
        masses: vec![mass],
        gravity,
        time_step: period / steps_a_period,
        start_time: 0.0,
    };
    let sag = mass * gravity / stiffness;
    let disk = Disk {
        x: 0.0,
        y: RADIUS - sag,
        radius: RADIUS,
    };
    let drive = Sine {
        amplitude,
        frequency,
        phase: 0.0,
    };
    let mut engine = FixedGrid::<PredictorCorrector<I>, _>::new(setup, &[disk], drive);
    let end = 8.0 * period;
    engine.advance_to(end).unwrap();
    assert_eq!(engine.now().contacts, 1);
    // Steady response C e^(i omega t) of the transmissibility, and the transient that meets rest at the start.
    let omega = std::f64::consts::TAU * frequency;
    let (re, im) = (natural * natural - omega * omega, 2.0 * rate * omega);
    let (top_re, top_im) = (natural * natural, 2.0 * rate * omega);
    let modulus = re * re + im * im;
    let (c_re, c_im) = (
        (top_re * re + top_im * im) / modulus,
        (top_im * re - top_re * im) / modulus,
    );
    let steady = |t: f64| amplitude * (c_re * (omega * t).sin() + c_im * (omega * t).cos());
    let steady_rate = |t: f64| amplitude * omega * (c_re * (omega * t).cos() - c_im * (omega * t).sin());
    let (y0, v0) = (-steady(0.0), -steady_rate(0.0));
    let transient =
        (-rate * end).exp() * (y0 * (damped * end).cos() + (v0 + rate * y0) / damped * (damped * end).sin());
    let height = engine.observables().positions[0][1] - (RADIUS - sag);
    (height - steady(end) - transient).abs() / amplitude
}

/// While contacts last, the integrators show at least their own order: 2 for Verlet, 5 for Gear.
#[test]
fn lasting_contact_follows_the_driven_oscillator() {
    type Error = fn(f64) -> f64;
    let cases: [(&str, Error, f64); 2] = [
        ("velocity Verlet", driven_oscillator::<VelocityVerlet>, 2.0),
        ("Gear 5", driven_oscillator::<Gear5>, 5.0),
    ];
    for (name, error, expected) in cases {
        let errors = [22.0, 44.0, 88.0].map(error);
        let order = order(errors[0], errors[2], 4.0);
        println!("{name}: lasting contact, errors at 22, 44, 88 steps a period {errors:?}, order {order:.2}");
        assert!(order > expected - 0.1, "{name}: {errors:?}, order {order}");
    }
}

/// Closed contacts are counted where they close and open: the count is that of the disks that overlap, with
/// tangential springs and without, and a state with another count is refused.
#[test]
fn closed_contacts_are_those_that_overlap() {
    for friction in [0.1, 0.0] {
        let setup = SoftDiskSetup {
            laws: laws(0.1, 0.77, friction),
            walls: vec![Wall::vibrating_floor(), Wall::left(-0.1), Wall::right(0.1)],
            masses: vec![mass(RADIUS); 12],
            gravity: 9.8,
            time_step: 1e-5,
            start_time: 0.0,
        };
        let disk = |index: u32| Disk {
            x: f64::from(index % 4) * 0.049 - 0.073 + 0.003 * f64::from(index / 4),
            y: RADIUS + f64::from(index / 4) * 0.042,
            radius: RADIUS,
        };
        let disks: Vec<Disk> = (0..12).map(disk).collect();
        let sine = Sine {
            amplitude: 1e-3,
            frequency: 40.0,
            phase: 0.0,
        };
        let mut engine = Verlet::new(setup, &disks, sine);
        let mut observed = std::collections::BTreeSet::new();
        for step in 1..=400 {
            let time = 1e-3 * f64::from(step);
            engine.advance_to(time).unwrap();
            let (now, floor) = (engine.now(), engine.now().base.displacement);
            let places = engine.observables().positions;
            let closed = |a: &[f64; 3], b: &[f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]) < 2.0 * RADIUS;
            let pairs = (0..12).flat_map(|i| (0..i).map(move |j| (i, j)));
            let between = pairs.filter(|&(i, j)| closed(&places[i], &places[j])).count();
            let at_walls = places.iter().flat_map(|[x, y, _]| [y - floor, x + 0.1, 0.1 - x]);
            let count = between + at_walls.filter(|distance| *distance < RADIUS).count();
            assert_eq!(now.contacts as usize, count, "at {time} s, friction {friction}");
            observed.insert(count);
        }
        assert!(observed.len() > 5, "{observed:?}");

        let (mut state, time) = (engine.state().clone(), 0.4);
        assert!(engine.fits(&state, time));
        state.contacts += 1;
        assert_eq!(engine.fits(&state, time), friction == 0.0);
    }
}

/// An observation between grid points that fails leaves the state and the former observation as they were.
#[test]
fn a_refused_observation_leaves_the_former_one() {
    let setup = SoftDiskSetup {
        laws: laws(0.1, 0.77, 0.1),
        walls: vec![Wall::vibrating_floor()],
        masses: vec![mass(RADIUS)],
        gravity: 9.8,
        time_step: 1e-3,
        start_time: 0.0,
    };
    let disk = Disk {
        x: 0.0,
        y: 0.1,
        radius: RADIUS,
    };
    let mut engine = Verlet::new(setup, &[disk], at_rest());
    engine.advance_to(0.002_5).unwrap();
    let (state, observed) = (engine.state().clone(), engine.now().clone());
    *engine.drive_mut() = FollowsInput::uniform(0.0, 1.0, 0.0);
    engine.advance_to(0.002_6).unwrap_err();
    *engine.drive_mut() = at_rest();
    assert!(*engine.state() == state && *engine.now() == observed);
}
