//! No call of the allocator inside of a communication step: set inputs, step, read outputs, through the functions that an
//! FMU exports, in both versions of FMI, for every scene, engine and drive.
#![allow(unsafe_code, clippy::unwrap_used, clippy::undocumented_unsafe_blocks)] // plays the importer

mod counting;
mod importer;

use std::f64::consts::TAU;

use fmi_component::Version;
use jostle::scene::ModelType;
use jostle::scene::catalogue::{MODELS, Names};

use counting::Counting;
use importer::Importer;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A base, or a support, that is shaken at twice gravity with 80 Hz, a torque, or the mark of an average.
fn input(name: &str, time: f64) -> f64 {
    let omega = TAU * 80.0;
    let (sine, cosine) = (omega * time).sin_cos();
    let amplitude = 2.0 * 9.81 / omega.powi(2);
    match name {
        "base.displacement" => amplitude * sine,
        "base.velocity" => amplitude * omega * cosine,
        "base.acceleration_input" => -amplitude * omega * omega * sine,
        "torque" => 1e-3 * sine,
        "torque.rate" => 1e-3 * omega * cosine,
        // A new average four times a second.
        "measure.mark" => (4.0 * time).floor(),
        _ => panic!("the test knows no motion of the input {name}"),
    }
}

/// Calls of the allocator in each of `count` steps at `rate` \[Hz\] after a second of warm-up, as (step, calls).
fn allocations(model: &ModelType, disks: u32, version: Version, rate: u32, count: u32) -> Vec<(u32, u64)> {
    let mut importer = Importer::new(model, disks, version);
    let (step, mut found) = (1.0 / f64::from(rate), Vec::new());
    for number in 0..rate + count {
        let current = f64::from(number) * step;
        let before = counting::calls();
        importer.exchange(current, step, |name| input(name, current));
        let made = counting::calls() - before;
        if made > 0 && number >= rate {
            found.push((number, made));
        }
    }
    found
}

fn check(disks: u32, rate: u32, count: u32) {
    let mut found = Vec::new();
    for model in MODELS {
        let names = Names::from(&(model.info)());
        for version in [Version::Two, Version::Three] {
            let steps = allocations(model, disks, version, rate, count);
            if !steps.is_empty() {
                let (of, first) = (steps.len(), &steps[..steps.len().min(5)]);
                found.push(format!(
                    "{names:?}, {version:?}: {of} of {count} steps allocate, {first:?}"
                ));
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_step_of_a_millisecond_allocates_nothing() {
    check(20, 1000, 2000);
}

/// The time step of soft disks does not divide this step, so that each ends between two points of the grid of times.
#[test]
fn a_step_that_ends_between_time_steps_allocates_nothing() {
    check(20, 4999, 5000);
}
