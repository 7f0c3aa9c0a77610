//! The scene `three_disk` as its users see it: rules of the house, limits of friction, what is refused and what reported.

#![allow(clippy::unwrap_used)]

use std::f64::consts::FRAC_PI_6;

use jostle::drive::excitation::{HarmonicTorque, InputTorque, RandomSupports, SineSupports};
use jostle::scene::disk_on_two_supports::{
    DiskOnTwoSupportsDrive, DiskOnTwoSupportsOnHarmonicTorque, DiskOnTwoSupportsOnInput,
    DiskOnTwoSupportsOnRandomSupports, DiskOnTwoSupportsOnSine, DiskOnTwoSupportsScene,
};
use jostle::scene::{Model, Simulation, Value};

/// Runs of some 0.3 s with slip, one for each drive: name of the parameter and value.
const BUSY: [(&str, f64); 2] = [("tilt", 0.2), ("contact.stiffness_ratio", 30.0)];

fn busy<M: Model>(more: &[(&str, Value)]) -> Simulation<M> {
    let mut given: Vec<(&str, Value)> = BUSY.iter().map(|(name, value)| (*name, (*value).into())).collect();
    given.extend_from_slice(more);
    Simulation::new(&[], &given).unwrap()
}

/// State of the engine but for its drive, which keeps the history of inputs: it does not depend on how a run is cut into steps.
fn engine_state<E: DiskOnTwoSupportsDrive>(disk: &Simulation<DiskOnTwoSupportsScene<E>>) -> impl PartialEq {
    let state = disk.model().unwrap().engine().state();
    (state.origin, state.step, state.start, state.time, state.now)
}

/// One step, many steps and events on the way lead to the same bits; so does a saved state.
fn any_way_there_gives_the_same_bits<E: DiskOnTwoSupportsDrive>(more: &[(&str, Value)]) {
    let end = 0.3;
    let mut once = busy::<DiskOnTwoSupportsScene<E>>(more);
    once.advance_to(end).unwrap();
    let slips = once.integer("slips").unwrap();
    assert!(slips > 2, "{slips} slips");

    let mut often = busy::<DiskOnTwoSupportsScene<E>>(more);
    let mut middle = None;
    for step in 1..=1000 {
        often.advance_to(end * f64::from(step) / 1000.0).unwrap();
        if step == 500 {
            middle = Some(often.to_bytes().unwrap());
        }
    }
    assert!(engine_state(&often) == engine_state(&once), "many steps");

    let mut restored = busy::<DiskOnTwoSupportsScene<E>>(more);
    restored.restore_bytes(&middle.unwrap()).unwrap();
    restored.advance_to(end).unwrap();
    assert!(engine_state(&restored) == engine_state(&once), "restored");

    let mut by_events = busy::<DiskOnTwoSupportsScene<E>>(more);
    let (mut last, mut events) = (0.0, 0_u32);
    loop {
        let reached = by_events.advance_to_event(end).unwrap();
        assert!(reached.time > last || !reached.event);
        last = reached.time;
        if !reached.event {
            break;
        }
        events += 1;
    }
    assert!(engine_state(&by_events) == engine_state(&once), "by events");
    assert!(i64::from(events) >= slips, "{events} events, {slips} slips");
}

/// An importer to which events within a step are reported gives its inputs at the beginning alone: the torque goes on at its
/// rate, and the outputs at the end of the step are those of a step without events.
#[test]
fn a_step_interrupted_by_events_is_one_step() {
    let more = [
        ("torque", (-0.14).into()),
        ("torque.rate", 1.5.into()),
        ("disk.initial_angular_velocity", 1.0.into()),
    ];
    let mut once = busy::<DiskOnTwoSupportsOnInput>(&more);
    let mut interrupted = busy::<DiskOnTwoSupportsOnInput>(&more);
    let mut events = 0;
    for step in 1..=10 {
        let end = 0.03 * f64::from(step);
        once.advance_to(end).unwrap();
        let mut reached = interrupted.advance_to_event(end).unwrap();
        while reached.time < end {
            events += 1;
            reached = interrupted.resume_to_event(end).unwrap();
        }
        assert!(interrupted.save() == once.save(), "at {end} s");
        assert_eq!(interrupted.all_values(), once.all_values());
    }
    assert!(events > 2, "{events} events");
}

#[test]
fn a_held_torque_gives_the_same_bits_by_any_steps() {
    any_way_there_gives_the_same_bits::<InputTorque>(&[
        ("torque", (-0.14).into()),
        ("disk.initial_angular_velocity", 1.0.into()),
        ("disk.drop_height", 0.02.into()),
    ]);
}

#[test]
fn a_harmonic_torque_gives_the_same_bits_by_any_steps() {
    any_way_there_gives_the_same_bits::<HarmonicTorque>(&[
        ("torque.amplitude", 0.2.into()),
        ("torque.angular_frequency", 40.0.into()),
    ]);
}

#[test]
fn random_supports_give_the_same_bits_by_any_steps() {
    any_way_there_gives_the_same_bits::<RandomSupports>(&[]);
}

#[test]
fn sinusoidal_supports_give_the_same_bits_by_any_steps() {
    any_way_there_gives_the_same_bits::<SineSupports>(&[("drive.phase_difference", 1.0.into())]);
}

/// A state at an event is the one after it, and stays so when it is saved there.
#[test]
fn an_event_shows_in_the_state_at_which_it_stops_a_step() {
    let more = [
        ("torque.amplitude", 0.2.into()),
        ("torque.angular_frequency", 40.0.into()),
    ];
    let mut disk = busy::<DiskOnTwoSupportsOnHarmonicTorque>(&more);
    let contact_states = |disk: &Simulation<DiskOnTwoSupportsOnHarmonicTorque>| {
        [1, 2].map(|index| disk.integer(&format!("contact[{index}].state")).unwrap())
    };
    let mut before = contact_states(&disk);
    for _ in 0..6 {
        assert!(disk.advance_to_event(0.3).unwrap().event);
        let after = contact_states(&disk);
        assert_ne!(before, after);
        assert!(disk.real("amonton_margin").unwrap() < 1e-9 || after == [2, 2]);
        let mut restored = busy::<DiskOnTwoSupportsOnHarmonicTorque>(&more);
        restored.restore(&disk.save()).unwrap();
        assert_eq!(restored.all_values(), disk.all_values());
        before = after;
    }
}

/// A change of the torque counts from the communication point on, wherever that is in the grid of time.
#[test]
fn a_torque_acts_from_where_it_is_set() {
    let run = |split: f64| {
        let mut disk = Simulation::<DiskOnTwoSupportsOnInput>::new(&[], &[("contact.friction", 0.0.into())]).unwrap();
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
fn assert_mirrored<M: Model>(one: &Simulation<M>, other: &Simulation<M>) {
    let [one, other] = [one, other].map(|disk| |name: &str| disk.real(name).unwrap());
    for name in [
        "disk.angle[1]",
        "disk.x[1]",
        "mean_velocity",
        "mean_angular_velocity",
        "skin.departure",
    ] {
        assert_eq!(one(name), -other(name), "{name}");
    }
    for name in [
        "disk.y[1]",
        "energy.lost",
        "energy.input",
        "amonton_margin",
        "skin.stretch",
    ] {
        assert_eq!(one(name), other(name), "{name}");
    }
    for (left, right) in [(1, 2), (2, 1)] {
        let name = |index: i32, what: &str| format!("contact[{index}].{what}");
        assert_eq!(one(&name(left, "normal_force")), other(&name(right, "normal_force")));
        assert_eq!(one(&name(left, "slip_time")), other(&name(right, "slip_time")));
    }
}

#[test]
fn a_mirrored_disk_turns_oppositely_to_the_bit() {
    let run = |sign: f64| {
        let more = [
            ("tilt", (0.2 * sign).into()),
            ("torque", (0.14 * sign).into()),
            ("disk.initial_angular_velocity", sign.into()),
            ("disk.drop_height", 0.02.into()),
        ];
        let mut disk = busy::<DiskOnTwoSupportsOnInput>(&more);
        disk.advance_to(0.4).unwrap();
        disk
    };
    let one = run(1.0);
    assert!(one.integer("slips").unwrap() > 2 && one.integer("detachments").unwrap() > 0);
    assert_mirrored(&one, &run(-1.0));

    let run = |tilt: f64, noise: i64| {
        let more = [("tilt", tilt.into()), ("support.noise", noise.into())];
        let mut disk = busy::<DiskOnTwoSupportsOnRandomSupports>(&more);
        disk.advance_to(0.5).unwrap();
        disk
    };
    assert_mirrored(&run(0.1, 1), &run(-0.1, 3));
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
        let mut disk = busy::<DiskOnTwoSupportsOnHarmonicTorque>(&[
            ("tilt", 0.3.into()),
            ("contact.friction", 0.2.into()),
            ("torque.amplitude", amplitude.into()),
            ("torque.angular_frequency", 2.0.into()),
        ]);
        disk.advance_to(7.0).unwrap();
        assert_eq!(disk.integer("sliding_regime").unwrap(), regime, "A_e = {amplitude}");
        assert_eq!(disk.integer("detachments").unwrap(), 0);
        let turned = disk.real("disk.angle[1]").unwrap();
        println!("A_e = {amplitude}: turned by {turned} rad");
        // Below the limits the disk rolls a little, as far as the contacts yield: some tau / k_n.
        assert!(if regime == 1 {
            turned.abs() < 1e-3
        } else {
            turned > 0.01
        });
    }
}

/// P 4.51: slow torques open a contact beyond theta_0 - atan mu, and not below; when it happens it is reported.
#[test]
fn detachment_tilt_is_that_of_the_thesis() {
    let friction = 0.2_f64;
    let limit = FRAC_PI_6 - friction.atan();
    for (tilt, opens) in [(limit - 0.02, false), (limit + 0.02, true)] {
        let mut disk = busy::<DiskOnTwoSupportsOnHarmonicTorque>(&[
            ("tilt", tilt.into()),
            ("contact.friction", friction.into()),
            ("torque.amplitude", 0.3.into()),
            ("torque.angular_frequency", 2.0.into()),
        ]);
        disk.advance_to(4.0).unwrap();
        assert_eq!(disk.integer("detachments").unwrap() > 0, opens, "{tilt}");
        assert_eq!(disk.real("detachment.time").unwrap() > 0.0, opens);
        assert_eq!(disk.real("contact[2].open_time").unwrap() > 0.0, opens);
    }
}

#[test]
fn starts_at_rest_and_stays() {
    for (tilt, shape) in [(0.0, 1), (0.3, 1), (-0.2, 2)] {
        let given = [("tilt", tilt.into()), ("support.shape", Value::Integer(shape))];
        let mut disk = Simulation::<DiskOnTwoSupportsOnInput>::new(&[], &given).unwrap();
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
fn nothing_overflows_and_energy_is_accounted_for() {
    for friction in [0.0, 1e-9, 0.05, 0.1, 0.3, 0.45] {
        for ratio in [1e-2, 1.0, 1e3, 1e6] {
            let given = [
                ("contact.friction", friction.into()),
                ("contact.stiffness_ratio", ratio.into()),
                ("tilt", 0.08.into()),
            ];
            let mut disk = Simulation::<DiskOnTwoSupportsOnInput>::new(&[], &given).unwrap();
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
    let refused = |changes: &[(&str, Value)]| match Simulation::<DiskOnTwoSupportsOnSine>::new(&[], changes) {
        Ok(_) => panic!("{changes:?} are not refused"),
        Err(error) => error.to_string(),
    };
    assert!(refused(&[("tilt", 0.6.into())]).starts_with("tilt = 0.6 rad is not allowed"));
    assert!(refused(&[("support.angle", 0.4.into())]).contains("support.shape walls"));
    assert!(refused(&[("time_step", 0.1.into())]).starts_with("time_step = 1e-1 s"));
    assert!(refused(&[("contact.normal_stiffness", 0.5.into())]).starts_with("contact.normal_stiffness = 0.5"));
    assert!(refused(&[("contact.friction", (-0.1).into())]).starts_with("contact.friction"));
    let walls = [("support.angle", 0.4.into()), ("support.shape", Value::Integer(2))];
    assert!(Simulation::<DiskOnTwoSupportsOnSine>::new(&[], &walls).is_ok());
}

/// A disk thrown off is reported with place and remedy, and the step before can be done otherwise.
#[test]
fn a_disk_that_falls_off_is_refused() {
    let given = [("drive.amplitude", 0.5.into()), ("drive.direction", 0.7.into())];
    let mut disk = Simulation::<DiskOnTwoSupportsOnSine>::new(&[], &given).unwrap();
    let mut step = 0;
    let error = loop {
        step += 1;
        let before = disk.all_values();
        if let Err(error) = disk.advance_to(0.05 * f64::from(step)) {
            assert_eq!(disk.all_values(), before);
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
    let mut disk = busy::<DiskOnTwoSupportsOnRandomSupports>(&[]);
    let other = busy::<DiskOnTwoSupportsOnRandomSupports>(&[("support.amplitude", 2e-5.into())]);
    disk.advance_to(0.1).unwrap();
    let model_of = |disk: &Simulation<DiskOnTwoSupportsOnRandomSupports>| {
        DiskOnTwoSupportsOnRandomSupports::new(disk.structure(), 0.0, disk.values()).unwrap()
    };
    let state = disk.model().unwrap().state();
    let mut other = model_of(&other);
    let before = other.state();
    assert!(other.restore(&state).is_err());
    assert!(other.state() == before);
    let mut damaged = state;
    damaged.engine.now.offset = 1.0;
    assert!(model_of(&disk).restore(&damaged).is_err());
}
