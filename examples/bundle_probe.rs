//! Writes the probe, the test scene of the FMI boundary, as FMUs: `cargo run --example bundle_probe -- FOLDER`.
//!
//! For trying an importer on both versions without any physics in the way. Build the library first:
//! `cargo build -p fmu-probe`.

use std::path::PathBuf;

use fmu_probe::Probe;
use jostle::fmi::Version;
use jostle::fmi::bundle::{self, Component};
use jostle::scene::{Choice, Scene};

fn main() -> jostle::Result<()> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".into()));
    let card = Probe::card();
    let component = Component::of::<Probe>(Choice {
        disks: card.default_disks,
    })?;
    let library = bundle::find_library(card.identifier)?;
    for (version, name) in [(Version::Two, "probe-fmi2.fmu"), (Version::Three, "probe-fmi3.fmu")] {
        let out = folder.join(name);
        bundle::write(&component, version, &library, &out)?;
        println!("{}", out.display());
    }
    Ok(())
}
