//! The ratchet: hardness in the hardest cases, symmetry, conservation, bits, refusals, and two velocities of F IV.
#![allow(clippy::unwrap_used)]

mod support;

use jostle::collision::{Coulomb, Smooth, VelocityFloor};
use jostle::drive::{Drive, Sine};
use jostle::engine::event_driven::{EventDriven, Gravity, Moving, PeriodicAcross, Sawtooth, Settings};
use jostle::geometry::{Disk, SawtoothProfile};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine};
use jostle::scene::{Choice, Scene, Value, Values};
use support::sawtooth_distance::Profile;
use support::{outputs_of, values_of};

const DEFAULT: Choice = Choice { disks: 20 };

fn sine_values(choice: Choice, changes: &[(&str, f64)]) -> Values {
    values_of::<RatchetOnSine>(choice, changes)
}

/// Deepest penetration into the base and deepest overlap of two disks [m], now and, for the base, where each disk last
/// met something.
fn depths(ratchet: &RatchetOnSine, profile: &Profile, time: f64, count: usize, width: f64) -> [f64; 2] {
    let state = ratchet.engine().state();
    let base_at = |local: f64| state.boundary.local_motion(local).displacement;
    let base = base_at(time - state.epoch);
    let seen: Vec<[f64; 2]> = (0..count).map(|disk| ratchet.engine().seen(disk, time).0).collect();
    let radius = |disk: usize| ratchet.engine().state().bodies[disk].radius;
    let (mut into_base, mut into_disk) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
    for i in 0..count {
        let [x, y] = seen[i];
        assert!(y - base > 0.0 && y + radius(i) < 0.6 + 1e-9, "disk {i} lost at {x} {y}");
        into_base = f64::max(into_base, radius(i) - profile.distance(x, y - base));
        let last = &state.bodies[i];
        let lift = base_at(last.time);
        into_base = f64::max(into_base, last.radius - profile.distance(last.x, last.y - lift));
        for (j, other) in seen[..i].iter().enumerate() {
            let apart = (x - other[0]).rem_euclid(width);
            let distance = apart.min(width - apart).hypot(y - other[1]);
            into_disk = f64::max(into_disk, radius(i) + radius(j) - distance);
        }
    }
    [into_base, into_disk]
}

/// F's hardest: deep steep teeth, strong shaking, many layers; and shapes at the edges of what exists.
#[test]
fn nothing_penetrates_and_nobody_is_lost() {
    let amplitude = 2e-3;
    let frequency = |gamma: f64| (gamma * 9.81_f64 / amplitude).sqrt() / std::f64::consts::TAU;
    for (disks, height, asymmetry, tip, gamma, seconds) in [
        (120, 16e-3, 0.05, 4e-5, 40.0, 4.0),
        (120, 16e-3, 0.05, 1e-4, 40.0, 4.0),
        (30, 6e-3, 0.0, 4e-4, 40.0, 4.0),
        (30, 6e-3, 1.0, 4e-4, 40.0, 4.0),
        (30, 5e-3, 0.25, 0.0, 40.0, 4.0),
        (60, 3e-3, 0.1, 4e-4, 5.0, 4.0),
    ] {
        let changes = [
            ("tooth.height", height),
            ("tooth.asymmetry", asymmetry),
            ("tooth.tip_radius", tip),
            ("drive.frequency", frequency(gamma)),
        ];
        let choice = Choice { disks };
        let values = sine_values(choice, &changes);
        let profile = Profile::new(6e-3, height, asymmetry, tip);
        let mut ratchet = RatchetOnSine::new(choice, 0.0, &values).unwrap();
        let mut deepest = [f64::NEG_INFINITY; 2];
        for look in 1..=2000 {
            let time = f64::from(look) * seconds / 2000.0;
            ratchet.advance_to(time, &values).unwrap();
            let now = depths(&ratchet, &profile, time, disks as usize, 60e-3);
            deepest = [deepest[0].max(now[0]), deepest[1].max(now[1])];
        }
        let events = outputs_of(&ratchet, &values).real("collisions");
        println!(
            "h {height} a {asymmetry} s {tip} Gamma {gamma}: {events} impacts, into base {:.1e} m, into disks {:.1e} m",
            deepest[0], deepest[1]
        );
        assert!(events > 1e3 && deepest[0] < 1e-9 && deepest[1] < 1e-9);
    }
}

/// The hardest case over a thousand million events, also as a second variant with sharper tips. Tells what it has every
/// hundred million: `cargo test --release --test ratchet -- --ignored --nocapture billion`.
fn nothing_penetrates_in(events: u64, tip: f64) {
    let choice = Choice { disks: 120 };
    let frequency = (40.0 * 9.81_f64 / 2e-3).sqrt() / std::f64::consts::TAU;
    let changes = [
        ("tooth.height", 16e-3),
        ("tooth.asymmetry", 0.05),
        ("tooth.tip_radius", tip),
        ("drive.frequency", frequency),
    ];
    let values = sine_values(choice, &changes);
    let profile = Profile::new(6e-3, 16e-3, 0.05, tip);
    let mut ratchet = RatchetOnSine::new(choice, 0.0, &values).unwrap();
    let (mut deepest, mut look, mut told) = ([f64::NEG_INFINITY; 2], 0_u32, 0);
    let begin = cpu_time::ProcessTime::now();
    loop {
        look += 1;
        let time = 0.1 * f64::from(look);
        ratchet.advance_to(time, &values).unwrap();
        let now = depths(&ratchet, &profile, time, 120, 60e-3);
        deepest = [deepest[0].max(now[0]), deepest[1].max(now[1])];
        let counts = &ratchet.engine().state().counts;
        let impacts = counts.disk_impacts + counts.wall_impacts;
        let done = impacts + counts.listings + counts.stale;
        if done / 100_000_000 > told || done >= events {
            told = done / 100_000_000;
            println!(
                "tip {tip} m: {done} events, {impacts} impacts ({} on base and ceiling) in {time:.0} s, CPU {:.0} s; deepest \
                 into base {:.1e} m, into disks {:.1e} m; resident {} kB",
                counts.wall_impacts,
                begin.elapsed().as_secs_f64(),
                deepest[0],
                deepest[1],
                resident_kilobytes()
            );
        }
        assert!(deepest[0] < 1e-9 && deepest[1] < 1e-9);
        if done >= events {
            return;
        }
    }
}

/// Memory of this process as the system tells it; 0 where there is no /proc.
fn resident_kilobytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS"));
    line.and_then(|line| line.split_whitespace().nth(1)?.parse().ok())
        .unwrap_or(0)
}

#[test]
#[ignore = "takes tens of minutes"]
fn nothing_penetrates_in_a_billion_events() {
    nothing_penetrates_in(1_000_000_000, 1e-4);
}

#[test]
#[ignore = "takes tens of minutes"]
fn nothing_penetrates_in_a_billion_events_with_sharp_tips() {
    nothing_penetrates_in(1_000_000_000, 4e-5);
}

/// Mean transport velocity and its standard error [m/s] over seeds, after a second of transient.
fn transport(disks: u32, changes: &[(&str, f64)], seeds: u32, seconds: f64) -> (f64, f64) {
    let choice = Choice { disks };
    let velocities: Vec<f64> = (1..=seeds)
        .map(|seed| {
            let mut changes = changes.to_vec();
            changes.extend([("seed", f64::from(seed)), ("measure.start", 1.0)]);
            let values = sine_values(choice, &changes);
            let mut ratchet = RatchetOnSine::new(choice, 0.0, &values).unwrap();
            ratchet.advance_to(1.0 + seconds, &values).unwrap();
            outputs_of(&ratchet, &values).real("transport_velocity")
        })
        .collect();
    let count = f64::from(seeds);
    let mean = velocities.iter().sum::<f64>() / count;
    let variance = velocities.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (count - 1.0);
    (mean, (variance / count).sqrt())
}

const POSITIVE: [(&str, f64); 3] = [
    ("tooth.height", 3e-3),
    ("tooth.asymmetry", 0.1),
    ("drive.frequency", 25.0),
];
const NEGATIVE: [(&str, f64); 3] = [
    ("tooth.height", 6e-3),
    ("tooth.asymmetry", 0.25),
    ("drive.frequency", 30.0),
];

/// F IV: 3.9 +- 0.3 cm/s (n = 0.7) and -3.2 +- 0.3 cm/s (n = 0.35), sign and rough size.
#[test]
fn two_velocities_of_the_paper() {
    let (forward, error) = transport(20, &POSITIVE, 10, 30.0);
    let (backward, backward_error) = transport(10, &NEGATIVE, 10, 30.0);
    println!("positive case: {:.2} +- {:.2} cm/s", 100.0 * forward, 100.0 * error);
    println!(
        "negative case: {:.2} +- {:.2} cm/s",
        100.0 * backward,
        100.0 * backward_error
    );
    assert!((forward - 0.039).abs() < 0.012, "{forward} +- {error}");
    assert!((backward + 0.032).abs() < 0.012, "{backward} +- {backward_error}");
}

/// Symmetric teeth carry nothing, and mirrored teeth carry as much the other way.
#[test]
fn symmetry_of_the_teeth_is_that_of_the_flow() {
    let even = [("tooth.asymmetry", 0.5), ("tooth.height", 3e-3)];
    let (none, error) = transport(20, &even, 10, 20.0);
    println!("symmetric: {:.2} +- {:.2} cm/s", 100.0 * none, 100.0 * error);
    assert!(none.abs() < 4.0 * error && error < 5e-3, "{none} +- {error}");
    let mirrored = [
        ("tooth.height", 3e-3),
        ("tooth.asymmetry", 0.9),
        ("drive.frequency", 25.0),
    ];
    let (right, right_error) = transport(20, &POSITIVE, 10, 20.0);
    let (left, left_error) = transport(20, &mirrored, 10, 20.0);
    println!("a = 0.1: {right:.4} +- {right_error:.4} m/s, a = 0.9: {left:.4} +- {left_error:.4} m/s");
    assert!((right + left).abs() < 4.0 * right_error.hypot(left_error));
    assert!(right > 10.0 * right_error);
}

/// Elastic smooth disks under gravity on a base at rest.
fn elastic(height: f64) -> EventDriven<Smooth, Sawtooth<Sine>, Gravity, PeriodicAcross> {
    let at_rest = Sine {
        amplitude: 0.0,
        frequency: 25.0,
        phase: 0.0,
    };
    let base = Moving {
        drive: at_rest,
        farthest: 0.0,
    };
    let profile = SawtoothProfile::new(6e-3, height, 0.2, 4e-4).unwrap();
    let boundary = Sawtooth::new(profile, base, 0.6, 0.0);
    let space = PeriodicAcross {
        width: 60e-3,
        bottom: 0.0,
        height: 60e-3,
    };
    let disks: Vec<Disk> = (0..40)
        .map(|index| Disk {
            x: 5e-3 * (f64::from(index % 12) + 0.5),
            y: 8e-3 + 5e-3 * f64::from(index / 12),
            radius: 1e-3 + 5e-6 * f64::from(index),
        })
        .collect();
    let velocities: Vec<[f64; 3]> = (0..40)
        .map(|index| {
            [
                0.3 * f64::from(index).sin() + 0.05,
                0.3 * f64::from(7 * index).cos(),
                0.0,
            ]
        })
        .collect();
    let types = (Smooth::ELASTIC, boundary, Gravity(9.81), space);
    EventDriven::new(types, &disks, &[1.0; 40], &velocities, Settings::default())
}

/// Energy stays on any base at rest, and horizontal momentum on a flat one, over some 100,000 impacts.
#[test]
fn elastic_smooth_disks_keep_energy_and_momentum() {
    for height in [0.0, 6e-3] {
        let mut disks = elastic(height);
        let sums = |disks: &EventDriven<Smooth, Sawtooth<Sine>, Gravity, PeriodicAcross>, time: f64| {
            (0..40).fold((0.0, 0.0), |(energy, momentum), disk| {
                let ([_, y], [vx, vy], _, _) = disks.seen(disk, time);
                (energy + 0.5 * (vx * vx + vy * vy) + 9.81 * y, momentum + vx)
            })
        };
        let (energy, momentum) = sums(&disks, 0.0);
        disks.advance_to(40.0).unwrap();
        let (energy_now, momentum_now) = sums(&disks, 40.0);
        let impacts = disks.state().counts.disk_impacts + disks.state().counts.wall_impacts;
        let drift = (energy_now / energy - 1.0).abs();
        let push = (momentum_now - momentum).abs();
        println!("height {height}: {impacts} impacts, energy drift {drift:.1e}, momentum {push:.1e}");
        assert!(impacts > 30_000 && drift < 1e-10);
        assert!(if height == 0.0 { push < 1e-11 } else { push > 0.0 });
    }
}

/// Disks seen in a mirror do what mirrored disks do, until rounding is heard: the images of some hundred impacts.
#[test]
fn mirrored_teeth_give_mirrored_motion() {
    let drive = Sine {
        amplitude: 2e-3,
        frequency: 25.0,
        phase: 0.3,
    };
    let space = PeriodicAcross {
        width: 60e-3,
        bottom: 0.0,
        height: 60e-3,
    };
    let [mut plain, mut mirrored] = [false, true].map(|mirror| {
        let asymmetry = if mirror { 0.8 } else { 0.2 };
        let profile = SawtoothProfile::new(6e-3, 6e-3, asymmetry, 4e-4).unwrap();
        let boundary = Sawtooth::new(profile, Moving { drive, farthest: 2e-3 }, 0.6, 0.0);
        let disks: Vec<Disk> = (0..12)
            .map(|index| {
                let x = 5e-3 * (f64::from(index) + 0.4);
                Disk {
                    x: if mirror { 60e-3 - x } else { x },
                    y: 12e-3,
                    radius: 1e-3 + 1e-5 * f64::from(index),
                }
            })
            .collect();
        let sign = if mirror { -1.0 } else { 1.0 };
        let velocities: Vec<[f64; 3]> = (0..12)
            .map(|index| [sign * 0.2 * f64::from(index).sin(), 0.1, sign * 30.0])
            .collect();
        let law = VelocityFloor::new(Coulomb::new(0.8, 0.1).unwrap(), 5e-3).unwrap();
        let types = (law, boundary, Gravity(9.81), space);
        EventDriven::new(types, &disks, &[1e-5; 12], &velocities, Settings::default())
    });
    let time = 0.25;
    plain.advance_to(time).unwrap();
    mirrored.advance_to(time).unwrap();
    let (one, two) = (plain.state().counts, mirrored.state().counts);
    assert!(one.disk_impacts > 20 && one.wall_impacts > 80, "{one:?}");
    assert!((one.disk_impacts, one.wall_impacts) == (two.disk_impacts, two.wall_impacts));
    let mut off: f64 = 0.0;
    for disk in 0..12 {
        let (place, velocity, angle, _) = plain.seen(disk, time);
        let (image, image_velocity, image_angle, _) = mirrored.seen(disk, time);
        off = off
            .max((place[0] + image[0] - 60e-3).abs())
            .max((place[1] - image[1]).abs());
        off = off
            .max((velocity[0] + image_velocity[0]).abs())
            .max(1e-3 * (angle + image_angle).abs());
    }
    println!(
        "{} and {} impacts, images off by {off:.1e}",
        one.disk_impacts, one.wall_impacts
    );
    assert!(off < 1e-6, "{off:e}");
}

/// Work of the base less losses is the change of energy, and the mean force on the base is the weight.
#[test]
fn energy_and_momentum_balance_to_rounding() {
    let mut values = sine_values(DEFAULT, &[("disk.inertia_factor", 0.4)]);
    values.set_by_name("disk.mass_rule", Value::Integer(2)).unwrap();
    let mut ratchet = RatchetOnSine::new(DEFAULT, 0.0, &values).unwrap();
    let mut impulse = 0.0;
    for i in 1..=10_000 {
        ratchet.advance_to(f64::from(i) * 2e-3, &values).unwrap();
        impulse += outputs_of(&ratchet, &values).real("base.reaction_force") * 2e-3;
    }
    let outputs = outputs_of(&ratchet, &values);
    let weight: f64 = (1..=20)
        .map(|disk| 9.81 * 1e-5 * (outputs.real(&format!("disk.radius[{disk}]")) / 1.1025e-3).powi(2))
        .sum();
    assert!(outputs.real("energy.residual").abs() < 1e-11 * outputs.real("energy.input"));
    assert!(
        (impulse / 20.0 + weight).abs() < 0.02 * weight,
        "{} of {weight}",
        impulse / 20.0
    );
    assert_eq!(outputs.real("collisions.ceiling"), 0.0);
    assert!((outputs.real("layers") - 0.7).abs() < 1e-12);
}

/// One step is many odd pieces, to the bit, with the mark of the average inside a step.
#[test]
fn split_steps_give_the_same_bits() {
    let values = sine_values(DEFAULT, &[("measure.start", 0.3)]);
    let states = [vec![2.0], vec![1.0, 2.0], vec![1e-9, 0.1, 0.100_000_1, 0.3, 2.0]].map(|ends| {
        let mut ratchet = RatchetOnSine::new(DEFAULT, 0.0, &values).unwrap();
        ends.iter().for_each(|end| ratchet.advance_to(*end, &values).unwrap());
        let outputs = outputs_of(&ratchet, &values);
        let names = ["transport_velocity", "disk.angle[3]", "disk.x[20]", "energy.lost"];
        (ratchet.state().engine, names.map(|name| outputs.real(name)))
    });
    assert!(states[0].1[0] != 0.0);
    assert!(states[0] == states[1] && states[0] == states[2]);
}

/// A state saved in the middle brings back the same bits, in this and in another instance, also on inputs.
#[test]
fn rollback_gives_the_same_bits() {
    let mut values = values_of::<RatchetOnInput>(DEFAULT, &[]);
    let mut drive = |ratchet: &mut RatchetOnInput, steps: std::ops::Range<u32>| {
        for step in steps {
            let (time, omega) = (f64::from(step) * 1e-3, std::f64::consts::TAU * 25.0);
            let (sine, cosine) = (omega * time).sin_cos();
            values
                .set_by_name("base.displacement", Value::Real(2e-3 * sine))
                .unwrap();
            values
                .set_by_name("base.velocity", Value::Real(2e-3 * omega * cosine))
                .unwrap();
            ratchet.advance_to(time + 1e-3, &values).unwrap();
        }
        (ratchet.state(), outputs_of(ratchet, &values))
    };
    let start = values_of::<RatchetOnInput>(DEFAULT, &[]);
    let mut ratchet = RatchetOnInput::new(DEFAULT, 0.0, &start).unwrap();
    let (saved, _) = drive(&mut ratchet, 0..700);
    let ahead = drive(&mut ratchet, 700..1500);
    assert!(ahead.1.real("collisions.base") > 100.0);
    let mut other = RatchetOnInput::new(DEFAULT, 0.0, &start).unwrap();
    for again in [&mut ratchet, &mut other] {
        again.restore(&saved).unwrap();
        assert!(drive(again, 700..1500) == ahead);
    }
    let foreign = values_of::<RatchetOnInput>(DEFAULT, &[("tooth.height", 3e-3)]);
    let foreign = RatchetOnInput::new(DEFAULT, 0.0, &foreign).unwrap().state();
    assert!(ratchet.restore(&foreign).is_err());
}

/// A base on inputs sampled finely carries what the sine carries, and nothing gets through it.
#[test]
fn a_base_on_inputs_is_hard_and_moves_disks() {
    let choice = Choice { disks: 20 };
    let mut values = values_of::<RatchetOnInput>(choice, &POSITIVE[..2]);
    let profile = Profile::new(6e-3, 3e-3, 0.1, 4e-4);
    let mut ratchet = RatchetOnInput::new(choice, 0.0, &values).unwrap();
    let (omega, step) = (std::f64::consts::TAU * 25.0, 1e-3);
    for index in 0..20_000_u32 {
        let time = f64::from(index) * step;
        let (sine, cosine) = (omega * time).sin_cos();
        values
            .set_by_name("base.displacement", Value::Real(2e-3 * sine))
            .unwrap();
        values
            .set_by_name("base.velocity", Value::Real(2e-3 * omega * cosine))
            .unwrap();
        ratchet.advance_to(time + step, &values).unwrap();
        let base = ratchet
            .engine()
            .state()
            .boundary
            .base()
            .drive
            .motion(time + step)
            .displacement;
        for disk in 0..20 {
            let [x, y] = ratchet.engine().seen(disk, time + step).0;
            let radius = ratchet.engine().state().bodies[disk].radius;
            assert!(profile.distance(x, y - base) > radius - 1e-9);
        }
    }
    let transport = outputs_of(&ratchet, &values).real("transport_velocity");
    println!("on inputs: {:.2} cm/s", 100.0 * transport);
    assert!(transport > 0.015 && transport < 0.06);
}

#[test]
fn impossible_ratchets_are_refused_by_name() {
    let told = |changes: &[(&str, f64)]| {
        let values = sine_values(DEFAULT, changes);
        RatchetOnSine::new(DEFAULT, 0.0, &values).unwrap_err().to_string()
    };
    assert!(told(&[("tooth.tip_radius", 3.1e-3)]).contains("narrower than its tip"));
    assert!(
        told(&[
            ("tooth.tip_radius", 1e-3),
            ("tooth.height", 1e-3),
            ("tooth.asymmetry", 0.0)
        ])
        .contains("touch both")
    );
    assert!(told(&[("disk.radius_min", 2e-3)]).starts_with("disk.radius_min"));
    assert!(told(&[("disk.radius_max", 9e-3)]).starts_with("tooth.count"));
    assert!(told(&[("tooth.width", 2e-6), ("tooth.tip_radius", 0.0)]).starts_with("tooth.width"));
    assert!(told(&[("cell.height", 8e-3)]).starts_with("cell.height"));
    assert!(told(&[("drive.amplitude", 0.7)]).starts_with("cell.height"));
    let mut values = values_of::<RatchetOnInput>(DEFAULT, &[]);
    let mut ratchet = RatchetOnInput::new(DEFAULT, 0.0, &values).unwrap();
    values.set_by_name("base.displacement", Value::Real(0.7)).unwrap();
    let before = ratchet.state();
    let error = ratchet.advance_to(0.1, &values).unwrap_err().to_string();
    assert!(
        error.contains("below the ceiling") && ratchet.state() == before,
        "{error}"
    );
    values.set_by_name("base.displacement", Value::Real(0.0)).unwrap();
    values.set_by_name("base.velocity", Value::Real(-1e300)).unwrap();
    let error = ratchet.advance_to(0.1, &values).unwrap_err().to_string();
    assert!(error.contains("accelerate") && ratchet.state() == before, "{error}");
}
