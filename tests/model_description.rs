//! The model descriptions under `modelDescription/` are what the scenes generate, for three disks or as many as a scene has.
//!
//! Regression test: it shows each change of an interface in the diff. To accept one:
//! `UPDATE_MODEL_DESCRIPTIONS=1 cargo test --test model_description`, and a line in the change log.

#![allow(clippy::unwrap_used)]

use std::path::Path;

use jostle::fmi::Version;
use jostle::fmi::bundle::Component;
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::packing::{LocatedPackingOnInput, LocatedPackingOnSine, PackingOnInput, PackingOnSine};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine};
use jostle::scene::three_disk::{
    ThreeDiskOnHarmonicTorque, ThreeDiskOnInput, ThreeDiskOnRandomSupports, ThreeDiskOnSine,
};
use jostle::scene::wedge::{
    WedgeEventDrivenOnInput, WedgeEventDrivenOnSine, WedgeMap, WedgeMolecularDynamicsOnInput,
    WedgeMolecularDynamicsOnSine,
};
use jostle::scene::{Choice, Scene};

/// More disks repeat the same rows.
const DISKS: u32 = 3;

fn committed<S: Scene>() {
    let disks = DISKS.min(*S::card().disks.end());
    let component = Component::of::<S>(Choice { disks }).unwrap();
    for (version, suffix) in [(Version::Two, "fmi2"), (Version::Three, "fmi3")] {
        let name = format!("{}.{suffix}.xml", component.card.identifier);
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("modelDescription")
            .join(&name);
        let generated = component.model_description(version);
        if std::env::var_os("UPDATE_MODEL_DESCRIPTIONS").is_some() {
            std::fs::write(&path, &generated).unwrap();
        }
        let same = std::fs::read_to_string(&path).is_ok_and(|kept| kept == generated);
        assert!(
            same,
            "modelDescription/{name} is not what the scene generates; see the head of this test"
        );
    }
}

#[test]
fn packing_on_input() {
    committed::<PackingOnInput>();
}

#[test]
fn packing_on_sine() {
    committed::<PackingOnSine>();
}

#[test]
fn located_packing_on_input() {
    committed::<LocatedPackingOnInput>();
}

#[test]
fn located_packing_on_sine() {
    committed::<LocatedPackingOnSine>();
}

#[test]
fn hard_packing_on_input() {
    committed::<HardPackingOnInput>();
}

#[test]
fn hard_packing_on_sine() {
    committed::<HardPackingOnSine>();
}

#[test]
fn wedge_map() {
    committed::<WedgeMap>();
}

#[test]
fn wedge_event_driven() {
    committed::<WedgeEventDrivenOnSine>();
    committed::<WedgeEventDrivenOnInput>();
}

#[test]
fn wedge_molecular_dynamics() {
    committed::<WedgeMolecularDynamicsOnSine>();
    committed::<WedgeMolecularDynamicsOnInput>();
}

#[test]
fn ratchet_on_input() {
    committed::<RatchetOnInput>();
}

#[test]
fn ratchet_on_sine() {
    committed::<RatchetOnSine>();
}

#[test]
fn three_disk() {
    committed::<ThreeDiskOnInput>();
    committed::<ThreeDiskOnHarmonicTorque>();
    committed::<ThreeDiskOnRandomSupports>();
    committed::<ThreeDiskOnSine>();
}
