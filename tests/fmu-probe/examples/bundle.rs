//! Writes the probe as an FMU, for tests of a library through an importer: `bundle LIBRARY FMI_VERSION OUT.fmu`.

use std::path::Path;
use std::process::ExitCode;

use fmu_probe::Probe;
use jostle::fmi::Version;
use jostle::fmi::bundle::{self, Component};
use jostle::scene::{Choice, Scene};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (library, version, out) = match arguments.as_slice() {
        [library, version, out] if version == "2" => (library, Version::Two, out),
        [library, version, out] if version == "3" => (library, Version::Three, out),
        _ => {
            eprintln!("usage: bundle LIBRARY 2|3 OUT.fmu");
            return ExitCode::from(2);
        }
    };
    let choice = Choice {
        disks: Probe::card().default_disks,
    };
    let written = Component::of::<Probe>(choice)
        .and_then(|component| bundle::write(&component, version, Path::new(library), Path::new(out)));
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
