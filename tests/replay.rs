//! The reference trajectory in an FMU: short enough that rounding stays rounding, and told apart from a wrong library.

#![allow(clippy::unwrap_used)]

use jostle::fmi::Version;
use jostle::fmi::bundle::{self, Component};
use jostle::fmi::replay::{TOLERANCE, replay};
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::packing::{LocatedPackingOnInput, PackingOnInput};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine};
use jostle::scene::three_disk::ThreeDiskOnInput;
use jostle::scene::wedge::{WedgeEventDrivenOnInput, WedgeMap, WedgeMolecularDynamicsOnInput};
use jostle::scene::{Choice, Kind, Scene, Simulation};

fn component<S: Scene>() -> Component {
    let disks = S::card().default_disks;
    Component::of::<S>(Choice { disks }).unwrap()
}

/// Largest relative difference between the reference and a run in which gravity is one unit in the last place greater:
/// that touches every collision, as another rounding of a sine would.
fn growth<S: Scene>() -> f64 {
    let component = component::<S>();
    let reference = component.reference().unwrap();
    let mut lines = reference.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|value| value.parse().unwrap()).collect())
        .collect();
    let gravity = component.rows.iter().find(|row| row.name == "gravity").unwrap();
    let Kind::Real(quantity) = &gravity.kind else {
        panic!("gravity is real")
    };
    let given = [("gravity", quantity.start.next_up().into())];
    let mut twin = Simulation::<S>::new(component.choice.disks, &given).unwrap();
    let table = twin.values().table().clone();
    assert!(rows.len() > 16, "{} refuses its reference", component.card.identifier);
    let mut largest: f64 = 0.0;
    for (number, row) in rows.iter().enumerate() {
        for (index, name) in names.iter().enumerate().skip(1) {
            let position = table.position(name).unwrap();
            let kept = &table.rows()[position];
            if kept.causality == jostle::scene::Causality::Input {
                twin.set(name, row[index]).unwrap();
                continue;
            }
            let (found, nominal) = match &kept.kind {
                Kind::Real(quantity) => (twin.real(name).unwrap(), quantity.nominal),
                _ => (twin.integer(name).unwrap() as f64, 1.0),
            };
            let size = rows.iter().map(|row| row[index].abs()).fold(nominal, f64::max);
            largest = largest.max((found - row[index]).abs() / size);
        }
        if let Some(next) = rows.get(number + 1) {
            twin.advance_to(next[0]).unwrap();
        }
    }
    println!("{}: {largest:e}", component.card.identifier);
    largest
}

#[test]
fn reference_trajectories_are_short() {
    let grown = [
        growth::<PackingOnInput>(),
        growth::<LocatedPackingOnInput>(),
        growth::<HardPackingOnInput>(),
        growth::<HardPackingOnSine>(),
        growth::<ThreeDiskOnInput>(),
        growth::<RatchetOnInput>(),
        growth::<RatchetOnSine>(),
        growth::<WedgeMap>(),
        growth::<WedgeEventDrivenOnInput>(),
        growth::<WedgeMolecularDynamicsOnInput>(),
    ];
    assert!(
        grown.iter().any(|grown| *grown > 0.0),
        "gravity has no effect: {grown:?}"
    );
    assert!(grown.iter().all(|grown| *grown < TOLERANCE / 1e3), "{grown:?}");
}

/// With the probe, whose library the tests build.
#[test]
fn a_replay_is_equal_to_the_bit_in_every_form() {
    let library = bundle::find_library("fmu_probe").unwrap();
    let folder = std::env::temp_dir().join(format!("jostle replay {}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let fmu = folder.join("probe.fmu");
    let mut component = component::<fmu_probe::Probe>();
    for (version, arrays) in [(Version::Two, false), (Version::Three, false), (Version::Three, true)] {
        component.arrays = arrays;
        bundle::write(&component, version, &library, &fmu).unwrap();
        let report = replay(&fmu).unwrap();
        assert!(report.passes() && report.values > 400, "{report:?}");
        assert_eq!((report.differing, report.rows), (0, 97), "{report:?}");
    }
    component.arrays = true;
    let message = bundle::write(&component, Version::Two, &library, &fmu)
        .unwrap_err()
        .to_string();
    assert!(message.contains("FMI 2.0 has no arrays"), "{message}");
    std::fs::write(&fmu, "no archive").unwrap();
    assert!(replay(&fmu).unwrap_err().to_string().contains("probe.fmu"));
    std::fs::remove_dir_all(&folder).unwrap();
}
