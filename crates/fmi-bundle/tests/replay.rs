//! The reference trajectory in an FMU is what its library computes.

#![allow(clippy::unwrap_used)]

mod support;

use fmi_bundle::{Component, Platform, Version, pack, reference, replay, write};
use fmi_component::{ModelType, Value};
use support::{MODEL, component, fakes, folder, libraries};

#[test]
fn a_replay_is_equal_to_the_bit_in_every_form() {
    let folder = folder("replay");
    let fmu = folder.join("oscillators.fmu");
    let mut component = component();
    for (version, arrays) in [(Version::Two, false), (Version::Three, false), (Version::Three, true)] {
        component.arrays = arrays;
        write(&component, version, &libraries(), &fmu).unwrap();
        let report = replay(&fmu).unwrap();
        assert!(report.passes() && report.values > 400, "{report:?}");
        assert_eq!((report.differing, report.rows), (0, 97), "{report:?}");
    }
    std::fs::write(&fmu, "no archive").unwrap();
    assert!(replay(&fmu).unwrap_err().to_string().contains("oscillators.fmu"));
    let refused = |platforms: &[Platform], version| {
        let bytes = pack(&self::component(), version, &fakes::libraries(platforms)).unwrap();
        std::fs::write(&fmu, bytes).unwrap();
        replay(&fmu).unwrap_err().to_string()
    };
    let message = refused(&[Platform::host().unwrap()], Version::Three);
    assert!(
        message.contains("oscillators.fmu: its library is not loaded"),
        "{message}"
    );
    let foreign: Vec<_> = Platform::ALL
        .into_iter()
        .filter(|&platform| Some(platform) != Platform::host())
        .collect();
    let message = refused(&foreign, Version::Three);
    assert!(
        message.contains("it holds libraries for aarch64-linux, x86_64-windows,"),
        "{message}"
    );
    assert!(
        message.contains("but not binaries/x86_64-linux/oscillators.so"),
        "{message}"
    );
    let message = refused(&foreign, Version::Two);
    assert!(
        message.contains("it holds libraries for win64, darwin64, but not binaries/linux64/"),
        "{message}"
    );
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The table is that of springs that are stiffer than those of the library.
#[test]
fn a_library_that_computes_something_else_does_not_pass() {
    let folder = folder("differs");
    let fmu = folder.join("oscillators.fmu");
    let stiffer = ModelType {
        prepare: |structure| {
            let mut simulation = (MODEL.prepare)(structure);
            let stiffness = simulation.position("spring.stiffness").unwrap();
            simulation.set_at(stiffness, Value::Real(101.0)).unwrap();
            simulation
        },
        ..MODEL
    };
    let component = Component::new(&stiffer, &[]).unwrap();
    let written = write(&component, Version::Three, &libraries(), &fmu);
    let message = written.unwrap_err().to_string();
    assert!(
        message.contains("of its size from what this program computes") && !fmu.exists(),
        "{message}"
    );
    std::fs::write(&fmu, pack(&component, Version::Three, &libraries()).unwrap()).unwrap();
    let report = replay(&fmu).unwrap();
    assert!(!report.passes() && report.differing > 100, "{report:?}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn inputs_with_a_derivative_oscillate_with_the_amplitude_that_is_asked_for() {
    let mut component = component();
    component.amplitude = |_, omega| 3.0 / omega;
    let table = reference::record(&component).unwrap();
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|value| value.parse().unwrap()).collect())
        .collect();
    let largest = |column: usize| rows.iter().map(|row| row[column].abs()).fold(0.0, f64::max);
    assert!((largest(2) - 3.0).abs() < 1e-9, "{}", largest(2));
    let omega = std::f64::consts::TAU * 1024.0 / 12.0;
    assert!((largest(1) - 6.0 / omega).abs() < 1e-9, "{}", largest(1));
}
