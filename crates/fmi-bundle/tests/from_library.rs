//! A library alone gives the FMU that the model itself gives, to the byte.

#![allow(clippy::unwrap_used)]

mod support;

use fmi_bundle::{Component, Version, pack};
use support::{MODEL, fakes, libraries, library};

#[test]
fn the_fmu_of_a_library_alone_is_that_of_its_model() {
    let bytes = std::fs::read(library()).unwrap();
    for structure in [&[][..], &[("bodies", 5)]] {
        let mut alone = Component::from_library(&bytes, structure).unwrap();
        let mut linked = Component::new(&MODEL, structure).unwrap();
        assert!(alone.contains_panics() && alone.model().is_none());
        assert_eq!(alone.token(), linked.token());
        for (version, arrays) in [(Version::Two, false), (Version::Three, false), (Version::Three, true)] {
            (alone.arrays, linked.arrays) = (arrays, arrays);
            let fmus = [&alone, &linked].map(|component| pack(component, version, &libraries()).unwrap());
            assert!(fmus[0] == fmus[1], "{structure:?} {version:?} {arrays}");
        }
    }
}

#[test]
fn a_library_that_describes_nothing_is_refused_with_the_remedy() {
    let refused =
        |bytes: &[u8], structure: &[(&str, u32)]| Component::from_library(bytes, structure).unwrap_err().to_string();
    let library = std::fs::read(library()).unwrap();
    let message = refused(&library, &[("bodies", 101)]);
    assert!(
        message.contains("number of bodies = 101 is not allowed: 1 to 100. Give a number"),
        "{message}"
    );
    let host = fmi_bundle::Platform::host().unwrap();
    let message = refused(&fakes::library(host, ""), &[]);
    assert!(message.contains("its library is not loaded"), "{message}");
}
