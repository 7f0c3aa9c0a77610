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
use jostle::scene::{Model as SceneModel, Simulation};
use support::sawtooth_distance::Profile;
use support::simulation_of;

fn on_sine(disks: u32, changes: &[(&str, f64)]) -> Simulation<RatchetOnSine> {
    simulation_of(disks, changes)
}

/// A cell of the width of ten teeth.
fn cell() -> PeriodicAcross {
    PeriodicAcross(Region {
        corner: Vector2::zeros(),
        size: Vector2::new(60e-3, 60e-3),
    })
}

/// Sets the base as inputs give it at `time` \[s\]: 2 mm at 25 Hz.
fn set_base(ratchet: &mut Simulation<RatchetOnInput>, time: f64) {
    let omega = std::f64::consts::TAU * 25.0;
    let (sine, cosine) = (omega * time).sin_cos();
    for (name, value) in [
        ("base.displacement", 2e-3 * sine),
        ("base.velocity", 2e-3 * omega * cosine),
    ] {
        ratchet.set(name, value).unwrap();
    }
}

/// One step is many odd pieces, to the bit, with the mark of the average inside a step.
#[test]
fn split_steps_give_the_same_bits() {
    let states = [vec![2.0], vec![1.0, 2.0], vec![1e-9, 0.1, 0.100_000_1, 0.3, 2.0]].map(|ends| {
        let mut ratchet = on_sine(20, &[("measure.start", 0.3)]);
        ends.iter().for_each(|end| ratchet.advance_to(*end).unwrap());
        let names = ["transport_velocity", "disk.angle[3]", "disk.x[20]", "energy.lost"];
        let state = ratchet.model().unwrap().state().engine;
        (state, names.map(|name| ratchet.real(name).unwrap()))
    });
    assert!(states[0].1[0] != 0.0);
    assert!(states[0] == states[1] && states[0] == states[2]);
}

/// A state saved in the middle brings back the same bits, in this and in another instance, also on inputs.
#[test]
fn rollback_gives_the_same_bits() {
    let drive = |ratchet: &mut Simulation<RatchetOnInput>, steps: std::ops::Range<u32>| {
        for step in steps {
            let time = f64::from(step) * 1e-3;
            set_base(ratchet, time);
            ratchet.advance_to(time + 1e-3).unwrap();
        }
        (ratchet.save(), ratchet.all_values())
    };
    let start = || simulation_of::<RatchetOnInput>(20, &[]);
    let mut ratchet = start();
    let (saved, _) = drive(&mut ratchet, 0..700);
    let ahead = drive(&mut ratchet, 700..1500);
    assert!(ratchet.real("collisions.base").unwrap() > 100.0);
    let mut other = start();
    for again in [&mut ratchet, &mut other] {
        again.restore(&saved).unwrap();
        assert!(drive(again, 700..1500) == ahead);
    }
    let foreign = simulation_of::<RatchetOnInput>(20, &[("tooth.height", 3e-3)]);
    let mut model = RatchetOnInput::new(ratchet.structure(), 0.0, ratchet.values()).unwrap();
    assert!(model.restore(&foreign.model().unwrap().state()).is_err());
}

#[test]
fn impossible_ratchets_are_refused_by_name() {
    let refused = |changes: &[(&str, f64)]| {
        let given: Vec<_> = changes.iter().map(|(name, value)| (*name, (*value).into())).collect();
        let refusal = Simulation::<RatchetOnSine>::new(&[("disks", 20)], &given).unwrap_err();
        refusal.to_string()
    };
    assert!(refused(&[("tooth.tip_radius", 3.1e-3)]).contains("narrower than its tip"));
    assert!(
        refused(&[
            ("tooth.tip_radius", 1e-3),
            ("tooth.height", 1e-3),
            ("tooth.asymmetry", 0.0)
        ])
        .contains("touch both")
    );
    assert!(refused(&[("disk.radius_min", 2e-3)]).starts_with("disk.radius_min"));
    assert!(refused(&[("disk.radius_max", 9e-3)]).starts_with("tooth.count"));
    assert!(refused(&[("tooth.width", 2e-6), ("tooth.tip_radius", 0.0)]).starts_with("tooth.width"));
    assert!(refused(&[("cell.height", 8e-3)]).starts_with("cell.height"));
    assert!(refused(&[("drive.amplitude", 0.7)]).starts_with("cell.height"));
    let mut ratchet = simulation_of::<RatchetOnInput>(20, &[]);
    let before = ratchet.model().unwrap().state();
    let mut refused = |displacement: f64, velocity: f64| {
        ratchet.set("base.displacement", displacement).unwrap();
        ratchet.set("base.velocity", velocity).unwrap();
        let error = ratchet.advance_to(0.1).unwrap_err().to_string();
        assert!(ratchet.model().unwrap().state() == before, "{error}");
        error
    };
    assert!(refused(0.7, 0.0).contains("below the ceiling"));
    assert!(refused(0.0, -1e300).contains("accelerate"));
}
