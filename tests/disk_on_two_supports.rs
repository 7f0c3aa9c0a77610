//! The disk on two supports against independent integrations, closed forms and conservation laws.

#![allow(clippy::unwrap_used)]

#[path = "support/raw_three_disk.rs"]
mod raw_three_disk;

use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Degree;
use jostle::drive::Sine;
use jostle::drive::excitation::{Excitation, HarmonicTorque, InputTorque, SineSupports, SupportMotion};
use jostle::engine::disk_on_two_supports::{
    DiskOnTwoSupports, ENERGY_INPUT, ENERGY_LOST, SupportFrame, TimeStepLimits, TwoSupportsRig, TwoSupportsSetup,
    equilibrium,
};
use raw_three_disk::{Motion, Raw};

/// P 5.1.
const THESIS: Raw = Raw {
    radius: 1.0,
    mass: 0.1,
    gravity: 10.0,
    normal_stiffness: 1e3,
    tangential_stiffness: 1e6,
    damping: 10.0,
    friction: 0.1,
    opening: std::f64::consts::FRAC_PI_6,
    tilt: 0.1,
    walls: false,
    torque: [0.0; 3],
    shaking: [0.0; 2],
};

fn rig(raw: &Raw) -> TwoSupportsRig {
    TwoSupportsRig {
        radius: raw.radius,
        mass: raw.mass,
        gravity: raw.gravity,
        normal: LinearDashpot {
            stiffness: raw.normal_stiffness,
            damping: raw.damping,
        },
        tangential: TangentialSpring {
            stiffness: raw.tangential_stiffness,
            friction: raw.friction,
        },
        frames: [
            SupportFrame::new(raw.tilt - raw.opening),
            SupportFrame::new(raw.opening + raw.tilt),
        ],
        curvature: if raw.walls { 0.0 } else { 0.5 / raw.radius },
    }
}

/// The disk with `radians` of the fastest mode in a step.
fn disk<E: Excitation>(
    raw: &Raw,
    excitation: E,
    radians: f64,
    place: [f64; 3],
    rates: [f64; 3],
) -> DiskOnTwoSupports<E> {
    let rig = rig(raw);
    let step = TimeStepLimits::of(&rig, None).largest * radians;
    DiskOnTwoSupports::new(TwoSupportsSetup::new(rig, step), excitation, 0.0, place, rates)
}

fn rest(raw: &Raw) -> [f64; 3] {
    let [x, y] = equilibrium(&rig(raw), &[SupportMotion::REST; 2]).unwrap();
    [x, y, 0.0]
}

fn motion<E: Excitation>(disk: &DiskOnTwoSupports<E>) -> Motion {
    let now = &disk.state().now;
    [
        now.disk[0],
        now.disk[1],
        now.angle(),
        now.disk[3],
        now.disk[4],
        now.disk[5],
    ]
}

/// Largest difference of two motions, velocities in units of `speed` \[m/s\], places in units of `speed` times 1 s.
fn distance(one: &Motion, other: &Motion) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// What brute force with two resolutions, one sixteen times the other, is off the engine.
fn compared<E: Excitation>(name: &str, raw: &Raw, excitation: E, start: Motion, duration: f64, steps: u64) -> [f64; 2] {
    let (place, rates) = ([start[0], start[1], start[2]], [start[3], start[4], start[5]]);
    let mut engine = disk(raw, excitation, 0.5, place, rates);
    engine.advance(duration, false).unwrap();
    let record = engine.state().now.record;
    let off = [1, 16].map(|finer| {
        let brute = raw.run(start, duration, finer * steps);
        assert_eq!(record.detachments > 0, brute.opened.is_some(), "{name}");
        if let (Some(found), Some(brute)) = (record.first_detachment, brute.opened) {
            let step = duration / (finer * steps) as f64;
            assert!(
                (found - brute).abs() < 3.0 * step + 1e-9,
                "{name}: opened at {found}, {brute}"
            );
        }
        distance(&motion(&engine), &brute.motion)
    });
    println!(
        "{name}: {:.1e}, {:.1e} off, motion {:.1e}, slips {}, opened {}",
        off[0],
        off[1],
        motion(&engine).iter().map(|number| number.abs()).fold(0.0, f64::max),
        record.slips,
        record.detachments
    );
    off
}

/// Brute force rounds distances of 2 m to 4e-16 m, which a tangential spring of 1e6 N/m makes some 1e-11 m/s.
const ROUNDING: f64 = 5e-11;

fn still(place: [f64; 3]) -> Motion {
    [place[0], place[1], place[2], 0.0, 0.0, 0.0]
}

fn held(torque: f64) -> InputTorque {
    InputTorque::starting(0.0, torque, 0.0, Degree::Automatic)
}

#[test]
fn sticks_as_brute_force_does() {
    for walls in [false, true] {
        let raw = Raw {
            torque: [0.02, 0.0, 0.0],
            walls,
            ..THESIS
        };
        let off = compared("sticking", &raw, held(0.02), still(rest(&raw)), 0.02, 12_500);
        assert!(off[1] < ROUNDING, "{off:?}");
    }
}

#[test]
fn slides_and_comes_to_rest_as_brute_force_does() {
    for walls in [false, true] {
        let raw = Raw {
            torque: [0.0, 0.2, 40.0],
            walls,
            ..THESIS
        };
        let torque = HarmonicTorque {
            amplitude: 0.2,
            angular_frequency: 40.0,
        };
        let off = compared("sliding", &raw, torque, still(rest(&raw)), 0.25, 100_000);
        assert!(off[1] < ROUNDING && off[1] < off[0], "{off:?}");
    }
}

/// Without damping forces are continuous at every event: brute force is of second order.
#[test]
fn bounces_as_brute_force_does() {
    for (walls, ratio, friction) in [
        (false, 1.0, 0.3),
        (true, 1.0, 0.3),
        (false, 30.0, 0.1),
        (true, 0.1, 0.0),
    ] {
        let raw = Raw {
            tangential_stiffness: ratio * 1e3,
            damping: 0.0,
            friction,
            walls,
            ..THESIS
        };
        let [x, y, _] = rest(&raw);
        let start = [x, y + 5e-3, 0.0, 0.0, 0.0, 0.2];
        let off = compared("bouncing", &raw, held(0.0), start, 0.4, 25_000);
        assert!(off[1] < 5e-8 && off[1] < 0.1 * off[0], "{off:?}");
    }
}

/// With damping the force jumps where the disk lands: brute force is of first order, and the engine is its limit.
#[test]
fn lands_as_brute_force_does() {
    for walls in [false, true] {
        let raw = Raw {
            tangential_stiffness: 3e3,
            damping: 3.0,
            friction: 0.3,
            walls,
            ..THESIS
        };
        let [x, y, _] = rest(&raw);
        let start = [x, y + 5e-3, 0.0, 0.0, 0.0, 0.2];
        let off = compared("landing", &raw, held(0.0), start, 0.2, 50_000);
        assert!(off[1] < 1e-6 && off[1] < 0.3 * off[0], "{off:?}");
    }
}

/// Supports that fall faster than the disk: it is thrown off, and the contacts open when brute force says so.
#[test]
fn shaken_off_its_supports_as_brute_force_says() {
    let omega = 60.0;
    let raw = Raw {
        tangential_stiffness: 1e4,
        damping: 0.0,
        shaking: [4e-3, omega],
        ..THESIS
    };
    let sine = SineSupports {
        sine: Sine {
            amplitude: 4e-3,
            frequency: omega / std::f64::consts::TAU,
            phase: 0.0,
        },
        phase_difference: 0.0,
        direction: [0.0, 1.0],
    };
    let off = compared("shaken", &raw, sine, still(rest(&raw)), 0.15, 25_000);
    assert!(off[1] < 5e-8 && off[1] < 0.1 * off[0], "{off:?}");
}

/// Walls, no damping, no slip: Newton's equations are linear, with two modes in x and theta and one in y.
#[test]
fn stuck_modes_are_those_of_the_linear_equations() {
    let raw = Raw {
        walls: true,
        damping: 0.0,
        friction: 10.0,
        tilt: 0.0,
        ..THESIS
    };
    let (sine, cosine) = raw.opening.sin_cos();
    let (kn, kt, m) = (raw.normal_stiffness, raw.tangential_stiffness, raw.mass);
    // In x and q = R theta: K = [[a, b], [b, d]], M = diag(m, m / 2). omega^2 solves the quadratic.
    let (a, b, d) = (
        2.0 * (kn * sine * sine + kt * cosine * cosine),
        2.0 * kt * cosine,
        2.0 * kt,
    );
    let (p, q, r) = (a / m, b / m, 2.0 * d / m);
    let root = ((p - r).powi(2) + 8.0 * q * q).sqrt();
    let squares = [
        0.5 * (p + r + root),
        4.0 * kn * kt * sine * sine * 4.0 / (m * m) / (p + r + root) * 1.0,
    ];
    // Product of both is det K / det M = 2 (a d - b^2) / m^2 = 8 kn kt sin^2 / m^2.
    let product = 8.0 * kn * kt * sine * sine / (m * m);
    let squares = [squares[0], product / squares[0]];
    let spin = 1e-3;
    let mut engine = disk(&raw, held(0.0), 0.25, rest(&raw), [0.0, 0.0, spin]);
    let mut worst = 0.0_f64;
    for step in 1..=50 {
        let time = 0.02 * f64::from(step);
        engine.advance(time, false).unwrap();
        // Modes (1, c_i): p + q c_i = omega_i^2. Kick (0, spin) = sum of A_i (1, c_i).
        let shapes = squares.map(|square| (square - p) / q);
        let kick = spin / (shapes[0] - shapes[1]);
        let wave = |index: usize| (squares[index].sqrt() * time).sin() / squares[index].sqrt();
        let x = kick * (wave(0) - wave(1));
        let theta = kick * (shapes[0] * wave(0) - shapes[1] * wave(1));
        let found = motion(&engine);
        worst = worst.max((found[0] - x).abs()).max((found[2] - theta).abs());
    }
    let amplitude = spin / squares[1].sqrt();
    println!(
        "modes at {:.3} and {:.3} rad/s: off by {:.1e} of the amplitude",
        squares[0].sqrt(),
        squares[1].sqrt(),
        worst / amplitude
    );
    assert_eq!(engine.state().now.record.slips, 0);
    assert!(worst < 1e-7 * amplitude, "{worst:e} of {amplitude:e}");
}

fn energy<E: Excitation>(disk: &DiskOnTwoSupports<E>) -> f64 {
    let (setup, now, observed) = (disk.setup(), disk.state().now.disk, disk.observe());
    let elastic: f64 = observed
        .contacts
        .iter()
        .map(|at| setup.normal.energy(at.overlap.max(0.0)) + setup.tangential.energy(at.stretch))
        .sum();
    0.5 * setup.mass * (now[3] * now[3] + now[4] * now[4])
        + 0.5 * setup.inertia() * now[5] * now[5]
        + setup.mass * setup.gravity * now[1]
        + elastic
        + now[ENERGY_LOST]
        - now[ENERGY_INPUT]
}

/// Work and losses are integrated beside the motion, so that the balance closes as well as the steps are exact.
#[test]
fn energy_is_accounted_for() {
    let raw = Raw {
        tangential_stiffness: 3e4,
        friction: 0.3,
        ..THESIS
    };
    let torque = HarmonicTorque {
        amplitude: 0.6,
        angular_frequency: 30.0,
    };
    let mut previous = f64::INFINITY;
    for radians in [1.0, 0.5, 0.25] {
        let [x, y, _] = rest(&raw);
        let mut engine = disk(&raw, torque, radians, [x, y + 0.01, 0.0], [0.0, 0.0, 1.0]);
        let start = energy(&engine);
        engine.advance(3.0, false).unwrap();
        let (now, record) = (engine.state().now.disk, engine.state().now.record);
        let residual = (energy(&engine) - start).abs() / now[ENERGY_LOST];
        println!(
            "{radians} rad: residual {residual:.1e} of what is lost, {} slips, {} openings",
            record.slips, record.detachments
        );
        assert!(record.detachments > 3 && record.slips > 30);
        assert!(
            residual < 1e-8 && (residual < previous || residual < 1e-13),
            "{radians}: {residual:e}"
        );
        previous = residual;
    }
}

/// The order of the step survives events: a run of slides, stops and openings.
#[test]
fn errors_fall_with_a_high_power_of_the_step() {
    let raw = Raw {
        tangential_stiffness: 1e4,
        friction: 0.2,
        ..THESIS
    };
    let torque = HarmonicTorque {
        amplitude: 0.4,
        angular_frequency: 30.0,
    };
    let run = |radians: f64| {
        let [x, y, _] = rest(&raw);
        let mut engine = disk(&raw, torque, radians, [x, y + 5e-3, 0.0], [0.0, 0.0, 0.1]);
        engine.advance(0.6, false).unwrap();
        let record = engine.state().now.record;
        (motion(&engine), record.slips, record.detachments)
    };
    let (exact, slips, openings) = run(0.25);
    let errors = [2.0, 1.0, 0.5].map(|radians| {
        let (found, ..) = run(radians);
        let error = distance(&found, &exact);
        println!("{radians} rad: error {error:.2e}, {slips} slips, {openings} openings");
        error
    });
    let order = (errors[1] / errors[2]).log2();
    assert!(slips > 10 && openings > 0, "{slips} {openings}");
    assert!(order > 6.0 && errors[1] < 1e-10, "{errors:?}: order {order}");
}

/// P's torque at 1 rad/s: the disk slides, stops and shivers with slips of microseconds. Each is found, whatever the step.
#[test]
fn short_slips_are_found_whatever_the_step() {
    let torque = HarmonicTorque {
        amplitude: 0.15,
        angular_frequency: 1.0,
    };
    let run = |radians: f64| {
        let mut engine = disk(&THESIS, torque, radians, rest(&THESIS), [0.0; 3]);
        engine.advance(4.0, false).unwrap();
        (motion(&engine), engine.state().now.record.slips)
    };
    let (fine, slips) = run(0.25);
    assert!(slips > 30, "{slips}");
    for radians in [0.5, 1.0] {
        let (found, counted) = run(radians);
        println!(
            "{radians} rad: {counted} slips of {slips}, off by {:.1e}",
            distance(&found, &fine)
        );
        assert_eq!(counted, slips);
        assert!(distance(&found, &fine) < 1e-10);
    }
}

/// A torque of ten times the limit, and no friction at all: plain spinning up between frictional torques.
#[test]
fn spins_up_as_coulomb_says() {
    for friction in [0.0, 0.1, 0.4] {
        let raw = Raw {
            friction,
            tilt: 0.05,
            walls: true,
            ..THESIS
        };
        let torque = 1.0 + 5.0 * friction;
        let mut engine = disk(&raw, held(torque), 0.5, rest(&raw), [0.0; 3]);
        let spin_at = |engine: &mut DiskOnTwoSupports<InputTorque>, time| {
            engine.advance(time, false).unwrap();
            engine.state().now.disk[5]
        };
        let (first, second) = (spin_at(&mut engine, 3.0), spin_at(&mut engine, 4.0));
        // Both slip counter-clockwise at rest in x and y: P 5.3, 5.4.
        let limit = raw.gravity * raw.mass * friction / (raw.opening.cos() * (1.0 + friction * friction))
            * (raw.tilt.cos() - friction * raw.tilt.sin());
        let expected = (torque - limit) / (0.5 * raw.mass);
        let found = second - first;
        println!("mu {friction}: {found} rad/s2, {expected} by P 5.3");
        assert!((found / expected - 1.0).abs() < 1e-9, "{friction}: {found} {expected}");
        // A jump of the torque throws the disk off where friction is strong.
        assert!(friction > 0.1 || engine.state().now.record.detachments == 0);
    }
}
