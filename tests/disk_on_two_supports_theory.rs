//! The theory of the disk on two supports against the engine: two codes that share no formula but the law of contact.
#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use jostle::measure::disk_on_two_supports::{
    Corner, HarmonicTorque, Setting, closed_form, closed_form_with_inertia, cycle, limits, relaxed,
};
use jostle::scene::Simulation;
use jostle::scene::disk_on_two_supports::DiskOnTwoSupportsOnHarmonicTorque;

/// Largest step that the default tangential spring allows; runs of theirs with smaller ones differ by 1e-12.
const TIME_STEP: f64 = 5e-5;

struct Ran {
    /// Over the last period \[rad/s\].
    angular_velocity: f64,
    /// Departures and stretches sampled in it \[rad\].
    path: Vec<(f64, f64)>,
}

/// The period after so many `forgotten` ones, sampled `samples` times.
fn run(setting: &Setting, stiffness: f64, torque: HarmonicTorque, forgotten: u32, samples: u32) -> Ran {
    let period = TAU / torque.angular_frequency;
    let changes = [
        ("tilt", setting.tilt),
        ("contact.normal_stiffness", stiffness),
        ("contact.stiffness_ratio", setting.tangential_stiffness / stiffness),
        ("torque.amplitude", torque.amplitude),
        ("torque.angular_frequency", torque.angular_frequency),
        ("time_step", TIME_STEP),
    ];
    let given = changes.map(|(name, value)| (name, value.into()));
    let mut disk = Simulation::<DiskOnTwoSupportsOnHarmonicTorque>::new(&[], &given).unwrap();
    disk.advance_to(period * f64::from(forgotten)).unwrap();
    let before = disk.real("disk.angle[1]").unwrap();
    let mut path = Vec::new();
    for sample in 1..=samples {
        let time = period * (f64::from(forgotten) + f64::from(sample) / f64::from(samples));
        disk.advance_to(time).unwrap();
        path.push((disk.real("skin.departure").unwrap(), disk.real("skin.stretch").unwrap()));
    }
    let after = disk.real("disk.angle[1]").unwrap();
    Ran {
        angular_velocity: (after - before) / period,
        path,
    }
}

/// Overlap shifts the limits, inertia adds to the slides: each brings 5.9 closer, and both come within 1e-4.
#[test]
fn the_error_of_the_closed_form_is_within_its_corrections() {
    let setting = Setting::THESIS.tilted(0.08 * std::f64::consts::PI);
    let stiffness = 1e3;
    let torque = HarmonicTorque {
        amplitude: 0.125,
        angular_frequency: 2.0,
    };
    let found = run(&setting, stiffness, torque, 1, 1).angular_velocity;
    let soft = relaxed(&setting, stiffness, setting.radius).unwrap().limits();
    let printed = closed_form(&setting, &limits(&setting), torque).unwrap();
    let with_overlap = closed_form(&setting, &soft, torque).unwrap();
    let with_both = closed_form_with_inertia(&setting, &soft, stiffness, torque).unwrap();
    let off = [printed, with_overlap, with_both].map(|theory| (found / theory - 1.0).abs());
    println!("off by {off:?}");
    assert!(off[0] < 1e-2 && off[1] < 0.7 * off[0] && off[2] < 1e-4, "{off:?}");
}

/// Beyond the range of 5.9 the marched cycle goes on; a disk that never rests forgets its start in some periods.
#[test]
fn a_disk_that_never_rests_turns_as_marched() {
    let setting = Setting::THESIS.tilted(0.2);
    let torque = HarmonicTorque {
        amplitude: 0.35,
        angular_frequency: 2.0,
    };
    let soft = relaxed(&setting, 1e5, setting.radius).unwrap().limits();
    assert_eq!(closed_form(&setting, &soft, torque), None);
    let marched = cycle(&setting, &soft, torque);
    assert_eq!(marched.resting, 0.0);
    let found = run(&setting, 1e5, torque, 15, 1).angular_velocity;
    println!("{found} for {}", marched.angular_velocity);
    assert!((found / marched.angular_velocity - 1.0).abs() < 1e-3);
}

/// The tangential spring comes to S1 and S2 of soft contacts and never leaves the band between them.
#[test]
fn tangential_spring_passes_both_corners() {
    let setting = Setting::THESIS.tilted(0.1 * std::f64::consts::PI);
    let torque = HarmonicTorque {
        amplitude: 0.113,
        angular_frequency: 2.0,
    };
    let soft = relaxed(&setting, 1e3, setting.radius).unwrap();
    let [s1, s2] = [Corner::S1, Corner::S2].map(|corner| soft.point(corner));
    let size = (s2.departure - s1.departure).hypot(s2.stretch - s1.stretch);
    let path = run(&setting, 1e3, torque, 1, 800).path;
    for corner in [s1, s2] {
        let nearest = path
            .iter()
            .map(|(departure, stretch)| (departure - corner.departure).hypot(stretch - corner.stretch) / size)
            .fold(f64::INFINITY, f64::min);
        println!("nearest: {nearest:e}");
        assert!(nearest < 1e-5, "{nearest:e}");
    }
    for (_, stretch) in path {
        assert!(stretch > s1.stretch - 1e-2 * size && stretch < s2.stretch + 1e-2 * size);
    }
}
