//! The ratchet: hardness in the hardest cases, symmetry, conservation, bits, refusals, and two velocities of F IV.
#![allow(clippy::unwrap_used)]

#[path = "../support/mod.rs"]
mod support;

mod conservation;
mod hardness;
mod transport;

use jostle::collision::{Coulomb, Smooth, VelocityFloor};
use jostle::drive::{Drive, Sine};
use jostle::engine::event_driven::{EventDriven, Model, Moving, PeriodicAcross, Region, Sawtooth, Settings};
use jostle::geometry::{Disk, SawtoothProfile, Vector2};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine};
use jostle::scene::{Choice, Scene, Value, Values};
use support::sawtooth_distance::Profile;
use support::{outputs_of, values_of};

const DEFAULT: Choice = Choice { disks: 20 };

fn sine_values(choice: Choice, changes: &[(&str, f64)]) -> Values {
    values_of::<RatchetOnSine>(choice, changes)
}

/// A cell of the width of ten teeth.
fn cell() -> PeriodicAcross {
    PeriodicAcross(Region {
        corner: Vector2::zeros(),
        size: Vector2::new(60e-3, 60e-3),
    })
}

/// The base as inputs give it at `time` \[s\]: 2 mm at 25 Hz.
fn aim(values: &mut Values, time: f64) {
    let omega = std::f64::consts::TAU * 25.0;
    let (sine, cosine) = (omega * time).sin_cos();
    for (name, value) in [
        ("base.displacement", 2e-3 * sine),
        ("base.velocity", 2e-3 * omega * cosine),
    ] {
        values.set_by_name(name, Value::Real(value)).unwrap();
    }
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
            let time = f64::from(step) * 1e-3;
            aim(&mut values, time);
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

#[test]
fn impossible_ratchets_are_refused_by_name() {
    let message = |changes: &[(&str, f64)]| {
        let values = sine_values(DEFAULT, changes);
        RatchetOnSine::new(DEFAULT, 0.0, &values).unwrap_err().to_string()
    };
    assert!(message(&[("tooth.tip_radius", 3.1e-3)]).contains("narrower than its tip"));
    assert!(
        message(&[
            ("tooth.tip_radius", 1e-3),
            ("tooth.height", 1e-3),
            ("tooth.asymmetry", 0.0)
        ])
        .contains("touch both")
    );
    assert!(message(&[("disk.radius_min", 2e-3)]).starts_with("disk.radius_min"));
    assert!(message(&[("disk.radius_max", 9e-3)]).starts_with("tooth.count"));
    assert!(message(&[("tooth.width", 2e-6), ("tooth.tip_radius", 0.0)]).starts_with("tooth.width"));
    assert!(message(&[("cell.height", 8e-3)]).starts_with("cell.height"));
    assert!(message(&[("drive.amplitude", 0.7)]).starts_with("cell.height"));
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
