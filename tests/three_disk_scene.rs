//! The scene `three_disk` as its users see it: rules of the house, limits of friction, what is refused and what reported.

#![allow(clippy::unwrap_used)]

mod support;

use std::f64::consts::FRAC_PI_6;

use jostle::scene::three_disk::{
    ThreeDisk, ThreeDiskDrive, ThreeDiskOnHarmonicTorque, ThreeDiskOnInput, ThreeDiskOnRandomSupports, ThreeDiskOnSine,
};
use jostle::scene::{Choice, Scene, Simulation, Value, Values};
use support::{outputs_of, values_of};

const ONE: Choice = Choice { disks: 1 };

fn values<S: Scene>(changes: &[(&str, Value)]) -> Values {
    let mut values = values_of::<S>(ONE, &[]);
    for (name, value) in changes {
        values.set_by_name(name, *value).unwrap();
    }
    values
}

/// Runs of some 0.3 s with slip, one for each drive: name of the parameter and value.
const BUSY: [(&str, f64); 2] = [("tilt", 0.2), ("contact.stiffness_ratio", 30.0)];

fn busy<S: Scene>(more: &[(&str, Value)]) -> (Values, S) {
    let mut changes: Vec<(&str, Value)> = BUSY.iter().map(|(name, value)| (*name, (*value).into())).collect();
    changes.extend_from_slice(more);
    let values = values::<S>(&changes);
    let scene = S::new(ONE, 0.0, &values).unwrap();
    (values, scene)
}

/// One step, many steps and events on the way lead to the same bits; so does a saved state.
fn any_way_there_gives_the_same_bits<E: ThreeDiskDrive>(more: &[(&str, Value)]) {
    let end = 0.3;
    let (given, mut once) = busy::<ThreeDisk<E>>(more);
    once.advance_to(end, &given).unwrap();
    let slips = outputs_of(&once, &given).integer("slips");
    assert!(slips > 2, "{slips} slips");

    let (_, mut often) = busy::<ThreeDisk<E>>(more);
    let mut middle = None;
    for step in 1..=1000 {
        often.advance_to(end * f64::from(step) / 1000.0, &given).unwrap();
        if step == 500 {
            middle = Some(postcard::to_allocvec(&often.state()).unwrap());
        }
    }
    assert!(often.state().engine == once.state().engine, "many steps");

    let (_, mut restored) = busy::<ThreeDisk<E>>(more);
    restored
        .restore(&postcard::from_bytes(&middle.unwrap()).unwrap())
        .unwrap();
    restored.advance_to(end, &given).unwrap();
    assert!(restored.state().engine == once.state().engine, "restored");

    let (_, mut by_events) = busy::<ThreeDisk<E>>(more);
    let (mut last, mut events) = (0.0, 0_u32);
    loop {
        let reached = by_events.advance_to_event(end, &given).unwrap();
        assert!(reached.time > last || !reached.event);
        last = reached.time;
        if !reached.event {
            break;
        }
        events += 1;
    }
    assert!(by_events.state().engine == once.state().engine, "by events");
    assert!(i64::from(events) >= slips, "{events} events, {slips} slips");
}

/// An importer that is told of events within a step gives its inputs at the beginning alone: the torque goes on at its rate,
/// and what is told of the step at its end is what a step without events tells.
#[test]
fn a_step_told_of_by_events_is_one_step() {
    let inputs = [("torque", (-0.14).into()), ("torque.rate", 1.5.into())];
    let spin = ("disk.initial_angular_velocity", 1.0.into());
    let (given, mut once) = busy::<ThreeDiskOnInput>(&[inputs[0], inputs[1], spin]);
    let (_, mut told) = busy::<ThreeDiskOnInput>(&[inputs[0], inputs[1], spin]);
    let mut events = 0;
    for step in 1..=10 {
        let end = 0.03 * f64::from(step);
        once.advance_to(end, &given).unwrap();
        let mut reached = told.advance_to_event(end, &given).unwrap();
        while reached.time < end {
            events += 1;
            reached = told.go_on_to_event(end, &given).unwrap();
        }
        assert!(told.state() == once.state(), "at {end} s");
        assert_eq!(outputs_of(&told, &given), outputs_of(&once, &given));
    }
    assert!(events > 2, "{events} events");
}

#[test]
fn ways_under_a_held_torque() {
    any_way_there_gives_the_same_bits::<jostle::drive::excitation::HeldTorque>(&[
        ("torque", (-0.14).into()),
        ("disk.initial_angular_velocity", 1.0.into()),
        ("disk.drop_height", 0.02.into()),
    ]);
}

#[test]
fn ways_under_a_harmonic_torque() {
    any_way_there_gives_the_same_bits::<jostle::drive::excitation::HarmonicTorque>(&[
        ("torque.amplitude", 0.2.into()),
        ("torque.angular_frequency", 40.0.into()),
    ]);
}

#[test]
fn ways_on_random_supports() {
    any_way_there_gives_the_same_bits::<jostle::drive::excitation::RandomSupports>(&[]);
}

#[test]
fn ways_on_sinusoidal_supports() {
    any_way_there_gives_the_same_bits::<jostle::drive::excitation::SineSupports>(&[(
        "drive.phase_difference",
        1.0.into(),
    )]);
}

/// A state at an event is the one after it, and stays so when it is saved there.
#[test]
fn an_event_is_seen_where_it_stops_a_step() {
    let more = [
        ("torque.amplitude", 0.2.into()),
        ("torque.angular_frequency", 40.0.into()),
    ];
    let (given, mut scene) = busy::<ThreeDiskOnHarmonicTorque>(&more);
    let mut before = outputs_of(&scene, &given);
    for _ in 0..6 {
        assert!(scene.advance_to_event(0.3, &given).unwrap().event);
        let after = outputs_of(&scene, &given);
        let state = |values: &Values| [1, 2].map(|index| values.integer(&format!("contact[{index}].state")));
        assert_ne!(state(&before), state(&after));
        assert!(after.real("amonton_margin") < 1e-9 || state(&after) == [2, 2]);
        let (_, mut restored) = busy::<ThreeDiskOnHarmonicTorque>(&more);
        restored.restore(&scene.state()).unwrap();
        assert_eq!(outputs_of(&restored, &given), after);
        before = after;
    }
}

/// A change of the torque counts from the communication point on, wherever that is in the grid of time.
#[test]
fn a_torque_acts_from_where_it_is_set() {
    let run = |split: f64| {
        let mut disk = Simulation::<ThreeDiskOnInput>::new(1, &[("contact.friction", 0.0.into())]).unwrap();
        disk.advance_to(split).unwrap();
        disk.set("torque", 0.05).unwrap();
        disk.set("torque.rate", 0.3).unwrap();
        disk.advance_to(split + 0.02).unwrap();
        disk.real("disk.angular_velocity[1]").unwrap()
    };
    // I = 0.05 kg.m2: (0.05 t + 0.15 t^2) / I.
    let expected = (0.05 * 0.02 + 0.15 * 0.02 * 0.02) / 0.05;
    for split in [0.01, 0.010_000_7, 0.012_34] {
        assert!(
            (run(split) / expected - 1.0).abs() < 1e-10,
            "{split}: {} {expected}",
            run(split)
        );
    }
}

/// What is mirrored: tilt, torque, sense of turning, contacts.
fn mirrored(one: &Values, other: &Values) {
    for name in [
        "disk.angle[1]",
        "disk.x[1]",
        "mean_velocity",
        "mean_angular_velocity",
        "skin.departure",
    ] {
        assert_eq!(one.real(name), -other.real(name), "{name}");
    }
    for name in [
        "disk.y[1]",
        "energy.lost",
        "energy.input",
        "amonton_margin",
        "skin.stretch",
    ] {
        assert_eq!(one.real(name), other.real(name), "{name}");
    }
    for (left, right) in [(1, 2), (2, 1)] {
        let name = |index: i32, what: &str| format!("contact[{index}].{what}");
        assert_eq!(
            one.real(&name(left, "normal_force")),
            other.real(&name(right, "normal_force"))
        );
        assert_eq!(
            one.real(&name(left, "slip_time")),
            other.real(&name(right, "slip_time"))
        );
    }
}

#[test]
fn a_mirrored_disk_turns_the_other_way_to_the_bit() {
    let run = |sign: f64| {
        let more = [
            ("tilt", (0.2 * sign).into()),
            ("torque", (0.14 * sign).into()),
            ("disk.initial_angular_velocity", sign.into()),
            ("disk.drop_height", 0.02.into()),
        ];
        let (given, mut scene) = busy::<ThreeDiskOnInput>(&more);
        scene.advance_to(0.4, &given).unwrap();
        outputs_of(&scene, &given)
    };
    let one = run(1.0);
    assert!(one.integer("slips") > 2 && one.integer("detachments") > 0);
    mirrored(&one, &run(-1.0));

    let run = |tilt: f64, noise: i64| {
        let (given, mut scene) =
            busy::<ThreeDiskOnRandomSupports>(&[("tilt", tilt.into()), ("support.noise", noise.into())]);
        scene.advance_to(0.5, &given).unwrap();
        outputs_of(&scene, &given)
    };
    mirrored(&run(0.1, 1), &run(-0.1, 3));
}

/// P 5.3 to 5.5, less what the overlap shifts.
fn limits(tilt: f64, friction: f64) -> [f64; 2] {
    let base = friction / (FRAC_PI_6.cos() * (1.0 + friction * friction));
    [-1.0, 1.0].map(|sign| base * (tilt.cos() + sign * friction * tilt.sin()))
}

#[test]
fn sliding_regimes_are_those_of_the_limits() {
    let [counter_clockwise, clockwise] = limits(0.3, 0.2);
    for (amplitude, regime) in [
        (0.99 * counter_clockwise, 1),
        (0.5 * (counter_clockwise + clockwise), 2),
        (1.02 * clockwise, 3),
    ] {
        let (given, mut scene) = busy::<ThreeDiskOnHarmonicTorque>(&[
            ("tilt", 0.3.into()),
            ("contact.friction", 0.2.into()),
            ("torque.amplitude", amplitude.into()),
            ("torque.angular_frequency", 2.0.into()),
        ]);
        scene.advance_to(7.0, &given).unwrap();
        let seen = outputs_of(&scene, &given);
        assert_eq!(seen.integer("sliding_regime"), regime, "A_e = {amplitude}");
        assert_eq!(seen.integer("detachments"), 0);
        let turned = seen.real("disk.angle[1]");
        println!("A_e = {amplitude}: turned by {turned} rad");
        // Below the limits the disk rolls a little, as far as the contacts yield: some tau / k_n.
        assert!(if regime == 1 {
            turned.abs() < 1e-3
        } else {
            turned > 0.01
        });
    }
}

/// P 4.51: slow torques open a contact beyond theta_0 - atan mu, and not below; when it happens it is told.
#[test]
fn detachment_tilt_is_that_of_the_thesis() {
    let friction = 0.2_f64;
    let limit = FRAC_PI_6 - friction.atan();
    for (tilt, opens) in [(limit - 0.02, false), (limit + 0.02, true)] {
        let (given, mut scene) = busy::<ThreeDiskOnHarmonicTorque>(&[
            ("tilt", tilt.into()),
            ("contact.friction", friction.into()),
            ("torque.amplitude", 0.3.into()),
            ("torque.angular_frequency", 2.0.into()),
        ]);
        scene.advance_to(4.0, &given).unwrap();
        let seen = outputs_of(&scene, &given);
        assert_eq!(seen.integer("detachments") > 0, opens, "{tilt}");
        assert_eq!(seen.real("detachment.time") > 0.0, opens);
        assert_eq!(seen.real("contact[2].open_time") > 0.0, opens);
    }
}

#[test]
fn starts_at_rest_and_stays() {
    for (tilt, shape) in [(0.0, 1), (0.3, 1), (-0.2, 2)] {
        let given = [("tilt", tilt.into()), ("support.shape", Value::Integer(shape))];
        let mut disk = Simulation::<ThreeDiskOnInput>::new(1, &given).unwrap();
        let before: Vec<f64> = ["disk.x[1]", "disk.y[1]"].map(|name| disk.real(name).unwrap()).to_vec();
        disk.advance_to(1.0).unwrap();
        for (name, before) in ["disk.x[1]", "disk.y[1]"].iter().zip(before) {
            assert!((disk.real(name).unwrap() - before).abs() < 1e-15);
        }
        assert!(disk.real("disk.angle[1]").unwrap().abs() < 1e-14);
        assert!((disk.real("base.reaction_force").unwrap() + 1.0).abs() < 1e-12);
        if shape == 2 {
            // P 4.25, 4.26 without tangential forces.
            let (left, right) = (FRAC_PI_6 - tilt, FRAC_PI_6 + tilt);
            for (index, other) in [(1, right), (2, left)] {
                let force = disk.real(&format!("contact[{index}].normal_force")).unwrap();
                assert!((force - other.sin() / (2.0 * FRAC_PI_6).sin()).abs() < 1e-12, "{force}");
            }
        }
    }
}

/// No friction to nearly what opens the contacts, tangential springs 100 times softer to a million times stiffer than the contacts,
/// torques that jump to ten times the limit and back: all finite, and energy is accounted for.
#[test]
fn nothing_blows_up() {
    for friction in [0.0, 1e-9, 0.05, 0.1, 0.3, 0.45] {
        for ratio in [1e-2, 1.0, 1e3, 1e6] {
            let given = [
                ("contact.friction", friction.into()),
                ("contact.stiffness_ratio", ratio.into()),
                ("tilt", 0.08.into()),
            ];
            let mut disk = Simulation::<ThreeDiskOnInput>::new(1, &given).unwrap();
            let limit = limits(0.08, friction)[1].max(1e-3);
            for (step, torque) in [0.0, 10.0, -10.0, 0.5, 10.0, 0.0].into_iter().enumerate() {
                disk.set("torque", torque * limit).unwrap();
                let end = 0.01 * (step as f64 + 1.0);
                if let Err(error) = disk.advance_to(end) {
                    panic!("mu {friction}, k_t / k_n {ratio}: {error}");
                }
            }
            let energy = |name: &str| disk.real(&format!("energy.{name}")).unwrap();
            let size = energy("input").abs() + energy("lost") + energy("kinetic");
            assert!(
                energy("residual").abs() < 1e-9 * size + 1e-14,
                "{friction} {ratio}: {}",
                energy("residual")
            );
            for contact in [1, 2] {
                let read = |name: &str| disk.real(&format!("contact[{contact}].{name}")).unwrap();
                let (normal, tangential) = (read("normal_force"), read("tangential_force"));
                assert!(
                    tangential.abs() <= friction * normal * (1.0 + 1e-9) + 1e-12,
                    "{friction} {ratio}"
                );
                assert!(normal > 0.0 || disk.integer("detachments").unwrap() > 0);
            }
        }
    }
}

#[test]
fn refusals_name_the_parameter() {
    let told = |changes: &[(&str, Value)]| match Simulation::<ThreeDiskOnSine>::new(1, changes) {
        Ok(_) => panic!("{changes:?} are not refused"),
        Err(error) => error.to_string(),
    };
    assert!(told(&[("tilt", 0.6.into())]).starts_with("tilt = 0.6 rad is not allowed"));
    assert!(told(&[("support.angle", 0.4.into())]).contains("support.shape walls"));
    assert!(told(&[("time_step", 0.1.into())]).starts_with("time_step = 1e-1 s"));
    assert!(told(&[("contact.normal_stiffness", 0.5.into())]).starts_with("contact.normal_stiffness = 0.5"));
    assert!(told(&[("contact.friction", (-0.1).into())]).starts_with("contact.friction"));
    let walls = [("support.angle", 0.4.into()), ("support.shape", Value::Integer(2))];
    assert!(Simulation::<ThreeDiskOnSine>::new(1, &walls).is_ok());
}

/// A disk thrown off is told with place and remedy, and the step before can be done otherwise.
#[test]
fn a_disk_that_falls_off_is_refused() {
    let given = [("drive.amplitude", 0.5.into()), ("drive.direction", 0.7.into())];
    let mut disk = Simulation::<ThreeDiskOnSine>::new(1, &given).unwrap();
    let mut step = 0;
    let error = loop {
        step += 1;
        let before = disk.values().clone();
        if let Err(error) = disk.advance_to(0.05 * f64::from(step)) {
            assert_eq!(disk.values(), &before);
            break error.to_string();
        }
        assert!(step < 100, "it never falls");
    };
    assert!(disk.integer("detachments").unwrap() > 0);
    assert!(
        error.contains("fallen off its supports") && error.contains("support.shape walls"),
        "{error}"
    );
    disk.advance_to(disk.time() + 1e-6).unwrap();
}

#[test]
fn a_state_of_another_disk_is_refused() {
    let (given, mut scene) = busy::<ThreeDiskOnRandomSupports>(&[]);
    let (_, mut other) = busy::<ThreeDiskOnRandomSupports>(&[("support.amplitude", 2e-5.into())]);
    scene.advance_to(0.1, &given).unwrap();
    let before = other.state();
    assert!(other.restore(&scene.state()).is_err());
    assert!(other.state() == before);
    let mut damaged = scene.state();
    damaged.engine.now.offset = 1.0;
    assert!(scene.restore(&damaged).is_err());
}
