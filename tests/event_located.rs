//! The engine with located contact events against closed forms, a reference of its own, conservation laws, and the
//! other integrators.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::drive::{FollowsInput, Sine};
use jostle::engine::Engine;
use jostle::engine::dem::event_located::EventStepper;
use jostle::engine::dem::{ContactLaws, EventLocated, SoftDiskSetup, TimeStepLimits, Verlet};
use jostle::geometry::{Disk, Wall};
use support::soft_disks::{RADIUS, at_rest, laws, mass};
use support::{order, thrown_disk};

fn disk(x: f64, y: f64, radius: f64) -> Disk {
    Disk { x, y, radius }
}

/// Errors of e_n and of u_t' of a disk thrown at the floor.
fn impact_errors(laws: ContactLaws, velocity: [f64; 3], time_step: f64) -> [f64; 2] {
    thrown_disk::errors(laws, velocity, |phase| {
        thrown_disk::velocity_after::<EventStepper>(laws, velocity, time_step, phase, |disks| {
            disks.velocities[0] = velocity;
        })
    })
}

/// Normal restitution against P 4.56 and tangential against a tight integration of the tangential law.
#[test]
fn impacts_converge_at_fourth_order() {
    let cases = [
        ("sticking", laws(0.1, 0.77, 0.8), [0.02, -0.3, 0.0]),
        ("rolling back", laws(0.1, 0.77, 0.1), [0.05, -0.3, 2.0]),
        ("sliding", laws(0.1, 0.77, 0.1), [0.5, -0.2, 0.0]),
        ("damped", laws(3.0, 0.3, 0.3), [0.2, -0.2, -3.0]),
        ("elastic", laws(0.0, 0.77, 0.1), [0.05, -0.3, 2.0]),
    ];
    let duration = std::f64::consts::PI * (mass(RADIUS) / 1e4).sqrt();
    for (name, laws, velocity) in cases {
        let errors = [10.0, 20.0, 40.0, 80.0, 160.0].map(|steps| impact_errors(laws, velocity, duration / steps));
        let parts = [
            ("e_n", errors.map(|error| error[0])),
            ("u_t'", errors.map(|error| error[1])),
        ];
        for (part, errors) in parts {
            let order = order(errors[0], errors[4], 16.0);
            println!("{name:13} {part:4} at 10 to 160 steps a contact: {errors:?}, order {order:.2}");
            assert!(order > 3.5, "{name}, {part}: order {order:.2} of {errors:?}");
            assert!(errors[3] < 2e-8, "{name}, {part}: {errors:?}");
        }
    }
}

/// The time step that a tolerance chooses has an error within a factor of 3 of it, over five decades and more.
#[test]
fn impacts_keep_the_tolerance() {
    let throws = [
        [0.02, -0.3, 0.0],
        [0.05, -0.3, 2.0],
        [0.5, -0.2, 0.0],
        [0.2, -0.2, -3.0],
    ];
    // The disk and the wall: an infinitely heavy partner.
    let masses = [mass(RADIUS), f64::INFINITY];
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
        let laws = laws(0.1, 0.77, 0.1);
        let step = TimeStepLimits::event_located(&laws, &masses, None, tolerance).default;
        let errors = throws.map(|velocity| impact_errors(laws, velocity, step).into_iter().fold(0.0, f64::max));
        let error = (errors.iter().map(|error| error * error).sum::<f64>() / throws.len() as f64).sqrt();
        println!(
            "tolerance {tolerance:.0e}: step {step:.2e} s, error {error:.2e}, ratio {:.2}",
            error / tolerance
        );
        assert!(
            error < 3.0 * tolerance && error > tolerance / 3.0,
            "{tolerance:e}: {error:e}"
        );
    }
}

/// Two free disks, head on: e_n of their effective mass (P 4.56), over-critical damping included.
#[test]
fn binary_collisions_have_the_restitution_of_their_effective_mass() {
    for damping in [0.0, 0.1, 3.0, 12.0, 40.0] {
        let masses = vec![mass(0.015), mass(0.025)];
        let effective_mass = 1.0 / (1.0 / masses[0] + 1.0 / masses[1]);
        let laws = laws(damping, 0.77, 0.1);
        let setup = SoftDiskSetup {
            laws,
            walls: Vec::new(),
            time_step: TimeStepLimits::event_located(&laws, &masses, None, 1e-8).default,
            masses,
            gravity: 0.0,
            start_time: 0.0,
        };
        let disks = [disk(-0.021, 0.0, 0.015), disk(0.021, 0.0, 0.025)];
        let mut engine = EventLocated::new(setup, &disks, at_rest());
        engine.set_motion(|disks| disks.velocities.copy_from_slice(&[[0.2, 0.0, 0.0], [-0.1, 0.0, 0.0]]));
        engine.advance_to(0.1).unwrap();
        let rates = &engine.now().disks.velocities;
        let restitution = (rates[1][0] - rates[0][0]) / 0.3;
        let error = (restitution - laws.normal.restitution(effective_mass)).abs();
        println!("gamma_n = {damping} kg/s: e_n = {restitution:.6}, error {error:.1e}");
        assert!(error < 5e-8, "gamma_n = {damping}: {restitution}");
    }
}

/// Oblique, spinning, overlapping: momentum to rounding, angular momentum to the error of the method.
#[test]
fn free_collisions_keep_momentum_and_angular_momentum() {
    let radii = [0.015, 0.025];
    let masses = radii.map(mass);
    let spin_error = |time_step: f64| {
        let setup = SoftDiskSetup {
            laws: laws(0.5, 0.77, 0.4),
            walls: Vec::new(),
            masses: masses.to_vec(),
            gravity: 0.0,
            time_step,
            start_time: 0.0,
        };
        let disks = [disk(-0.03, 0.004, radii[0]), disk(0.03, -0.006, radii[1])];
        let mut engine = EventLocated::new(setup, &disks, at_rest());
        engine.set_motion(|disks| disks.velocities.copy_from_slice(&[[1.0, 0.1, 20.0], [-0.5, 0.0, -7.0]]));
        let angular_momentum = |engine: &EventLocated<FollowsInput>| -> f64 {
            let disks = &engine.now().disks;
            (0..2)
                .map(|i| {
                    let ([x, y, _], [vx, vy, spin]) = (disks.positions[i], disks.velocities[i]);
                    masses[i] * (x * vy - y * vx + 0.5 * radii[i].powi(2) * spin)
                })
                .sum()
        };
        let (momentum, spin) = (engine.momentum(), angular_momentum(&engine));
        engine.advance_to(0.03).unwrap();
        assert!(engine.now().disks.changes > 1 && engine.now().contacts == 0);
        let now = engine.momentum();
        assert!((now[0] - momentum[0]).abs() < 1e-16 && (now[1] - momentum[1]).abs() < 1e-16);
        (angular_momentum(&engine) / spin - 1.0).abs()
    };
    let errors = [8e-5, 4e-5, 2e-5, 1e-5].map(spin_error);
    println!("relative change of angular momentum at 80, 40, 20, 10 us: {errors:?}");
    let order = order(errors[0], errors[3], 8.0);
    assert!(order > 3.5 && errors[3] < 1e-10, "{errors:?}, order {order}");
}

/// y = -g t^2 / 2, whatever the grid and the sampling times; and a disk at rest on a plane stays there.
#[test]
fn free_fall_and_rest_are_exact() {
    let setup = |walls: Vec<Wall>| SoftDiskSetup {
        laws: laws(0.1, 0.77, 0.1),
        walls,
        masses: vec![mass(RADIUS)],
        gravity: 9.8,
        time_step: 1e-4,
        start_time: 5.0,
    };
    let mut falling = EventLocated::new(setup(Vec::new()), &[disk(0.0, 0.0, RADIUS)], at_rest());
    for sampled in [0.01234, 0.3, 0.98765] {
        falling.advance_to(5.0 + sampled).unwrap();
        let (place, rate) = (falling.now().disks.positions[0], falling.now().disks.velocities[0]);
        assert!((place[1] + 0.5 * 9.8 * sampled * sampled).abs() < 1e-14, "{sampled}");
        assert!((rate[1] + 9.8 * sampled).abs() < 1e-13);
    }
    let height = RADIUS - mass(RADIUS) * 9.8 / 1e4;
    let mut resting = EventLocated::new(
        setup(vec![Wall::vibrating_floor()]),
        &[disk(0.0, height, RADIUS)],
        at_rest(),
    );
    resting.advance_to(6.0).unwrap();
    assert!((resting.now().disks.positions[0][1] - height).abs() < 1e-15);
    assert_eq!(resting.now().disks.changes, 0);
}

/// A disk on a sine base of low amplitude follows the closed form of the driven, damped oscillator
/// m y'' = -k (y - b) - gamma (y' - b') - m g with b = A sin(omega t), at fourth order.
#[test]
fn lasting_contact_follows_the_driven_oscillator() {
    let (stiffness, damping, frequency, amplitude) = (1e4, 3.0, 40.0, 2e-5);
    let mass = mass(RADIUS);
    let (natural, rate) = (f64::sqrt(stiffness / mass), damping / (2.0 * mass));
    let damped = (natural * natural - rate * rate).sqrt();
    let period = std::f64::consts::TAU / damped;
    let end = 8.0 * period;
    // Transmissibility natural^2 + 2 i rate omega over natural^2 - omega^2 + 2 i rate omega, and the transient that
    // meets rest at the start.
    let omega = std::f64::consts::TAU * frequency;
    let (re, im) = (natural * natural - omega * omega, 2.0 * rate * omega);
    let (top_re, top_im, modulus) = (natural * natural, im, re * re + im * im);
    let (c_re, c_im) = (
        (top_re * re + top_im * im) / modulus,
        (top_im * re - top_re * im) / modulus,
    );
    let steady = |t: f64| amplitude * (c_re * (omega * t).sin() + c_im * (omega * t).cos());
    let steady_rate = |t: f64| amplitude * omega * (c_re * (omega * t).cos() - c_im * (omega * t).sin());
    let (y0, v0) = (-steady(0.0), -steady_rate(0.0));
    let transient =
        (-rate * end).exp() * (y0 * (damped * end).cos() + (v0 + rate * y0) / damped * (damped * end).sin());
    let rest = RADIUS - mass * 9.8 / stiffness;
    let errors = [11.0, 22.0, 44.0, 88.0].map(|steps| {
        let setup = SoftDiskSetup {
            laws: laws(damping, 0.77, 0.1),
            walls: vec![Wall::vibrating_floor()],
            masses: vec![mass],
            gravity: 9.8,
            time_step: period / steps,
            start_time: 0.0,
        };
        let drive = Sine {
            amplitude,
            frequency,
            phase: 0.0,
        };
        let mut engine = EventLocated::new(setup, &[disk(0.0, rest, RADIUS)], drive);
        engine.advance_to(end).unwrap();
        assert_eq!(engine.now().contacts, 1);
        (engine.now().disks.positions[0][1] - rest - steady(end) - transient).abs() / amplitude
    });
    let order = order(errors[1], errors[3], 4.0);
    println!("lasting contact, errors at 11, 22, 44, 88 steps a period {errors:?}, order {order:.2}");
    assert!(order > 3.7 && errors[3] < 1e-6, "{errors:?}");
}

/// Disks of a case: where they are, how they move, how wide their box is.
struct Case {
    disks: Vec<Disk>,
    rates: Vec<[f64; 3]>,
    width: f64,
    gamma: f64,
}

impl Case {
    fn setup(&self, time_step: f64) -> (SoftDiskSetup, Sine) {
        let setup = SoftDiskSetup {
            laws: laws(0.1, 0.77, 0.1),
            walls: vec![
                Wall::vibrating_floor(),
                Wall::left(-0.5 * self.width),
                Wall::right(0.5 * self.width),
            ],
            masses: self.disks.iter().map(|disk| mass(disk.radius)).collect(),
            gravity: 9.8,
            time_step,
            start_time: 0.0,
        };
        let drive = Sine {
            amplitude: Sine::amplitude_of(self.gamma, 80.0, 9.8),
            frequency: 80.0,
            phase: 0.0,
        };
        (setup, drive)
    }

    fn located(&self, time_step: f64, end: f64) -> Vec<[f64; 3]> {
        let (setup, drive) = self.setup(time_step);
        let mut engine = EventLocated::new(setup, &self.disks, drive);
        engine.set_motion(|disks| disks.velocities.clone_from(&self.rates));
        engine.advance_to(end).unwrap();
        engine.now().disks.positions.clone()
    }

    fn verlet(&self, time_step: f64, end: f64) -> Vec<[f64; 3]> {
        let (setup, drive) = self.setup(time_step);
        let mut engine = Verlet::new(setup, &self.disks, drive);
        let count = self.disks.len();
        engine.set_motion(|disks| disks.velocity[..3 * count].copy_from_slice(self.rates.as_flattened()));
        engine.advance_to(end).unwrap();
        engine.observables().positions[..count].to_vec()
    }
}

/// Root mean square difference of the angles over their root mean square.
fn difference(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let squares = |angle: &dyn Fn(usize) -> f64| (0..a.len()).map(|i| angle(i).powi(2)).sum::<f64>();
    (squares(&|i| a[i][2] - b[i][2]) / squares(&|i| b[i][2])).sqrt()
}

/// A pile of three disks, dropped on a base that shakes: one above two.
#[test]
fn a_pile_of_three_converges_to_itself_and_to_verlet() {
    let pile = Case {
        disks: vec![
            disk(-0.021, 0.0201, 0.02),
            disk(0.0205, 0.0203, 0.02),
            disk(0.001, 0.054_5, 0.02),
        ],
        rates: vec![[0.1, -0.1, 3.0], [0.0, -0.1, 0.0], [0.0, -0.2, 1.0]],
        width: 0.1,
        gamma: 2.0,
    };
    let end = 0.02;
    let reference = pile.located(5e-7, end);
    let errors = [8e-5, 4e-5, 2e-5, 1e-5].map(|step| difference(&pile.located(step, end), &reference));
    let order = order(errors[0], errors[3], 8.0);
    let verlet = [1e-6, 1e-7].map(|step| difference(&pile.verlet(step, end), &reference));
    println!("three disks: errors at 80, 40, 20, 10 us {errors:?}, order {order:.2}; Verlet at 1, 0.1 us {verlet:?}");
    assert!(order > 3.0 && errors[3] < 1e-6, "{errors:?}");
    // Two methods with nothing but the laws in common go to the same limit, Verlet at its first order.
    assert!(verlet[1] < 0.3 * verlet[0] && verlet[1] < 1e-5, "{verlet:?}");
}

/// Contacts go through the engine two by two. What a disk does must not depend on which contact its own are paired with, nor on
/// when other disks make the neighbour list be built: the same bits with other piles in front of it and behind it in the list.
#[test]
fn a_pile_has_the_same_bits_among_other_piles() {
    let pile_at = |x: f64| {
        [
            disk(x - 0.021, 0.0201, 0.02),
            disk(x + 0.0205, 0.0203, 0.02),
            disk(x + 0.001, 0.054_5, 0.02),
        ]
    };
    let rates = [[0.1, -0.1, 3.0], [0.0, -0.1, 0.0], [0.0, -0.2, 1.0]];
    let case = |disks: Vec<Disk>, rates: Vec<[f64; 3]>| Case {
        disks,
        rates,
        width: 4.0,
        gamma: 2.0,
    };
    let alone = case(pile_at(0.5).to_vec(), rates.to_vec()).located(5e-5, 0.5);
    let others = [
        vec![disk(-1.0, 0.0202, 0.02)],
        pile_at(0.5).to_vec(),
        pile_at(1.5).to_vec(),
    ];
    let their_rates = [
        vec![[0.2, -0.1, 9.0]],
        rates.to_vec(),
        rates.map(|[x, y, spin]| [x, 3.0 * y, -spin]).to_vec(),
    ];
    let among = case(others.concat(), their_rates.concat()).located(5e-5, 0.5);
    assert_eq!(alone[..], among[1..4]);
}

/// Sixty disks that settled on a shaken base, for a period of the base, started from where a run by Verlet had them.
#[test]
fn a_packing_converges_to_itself_and_to_verlet() {
    let radii = jostle::packing::RadiusDistribution::default().sample(60, 3).unwrap();
    let disks = jostle::packing::advancing_front(&radii, 0.4).unwrap();
    let mut packing = Case {
        rates: vec![[0.0; 3]; disks.len()],
        disks,
        width: 0.4,
        gamma: 4.0,
    };
    let (setup, drive) = packing.setup(1e-5);
    let mut engine = EventLocated::new(setup, &packing.disks, drive);
    engine.advance_to(0.5).unwrap();
    packing.rates.clone_from(&engine.now().disks.velocities);
    for (disk, place) in packing.disks.iter_mut().zip(&engine.now().disks.positions) {
        (disk.x, disk.y) = (place[0], place[1]);
    }
    let end = 0.0125;
    let reference = packing.located(1e-6, end);
    let errors = [6.4e-5, 3.2e-5, 1.6e-5, 8e-6].map(|step| difference(&packing.located(step, end), &reference));
    let order = order(errors[0], errors[3], 8.0);
    let verlet = [2e-6, 2e-7].map(|step| difference(&packing.verlet(step, end), &reference));
    println!("sixty disks: errors at 64, 32, 16, 8 us {errors:?}, order {order:.2}; Verlet at 2, 0.2 us {verlet:?}");
    assert!(order > 2.8 && errors[0] < 1e-4 && errors[3] < 1e-6, "{errors:?}");
    assert!(verlet[1] < 0.3 * verlet[0] && verlet[1] < 2e-5, "{verlet:?}");
}
