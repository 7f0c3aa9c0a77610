//! Writes the example model of `fmi-component` as FMUs of both versions: `decay_fmu LIBRARY FOLDER`, with the library that
//! `cargo build --release -p fmi-component --example decay` makes.
#![allow(unsafe_code)] // the model's file exports C functions

use std::path::Path;
use std::process::ExitCode;

use fmi_bundle::{Component, Libraries, Version, write};
use fmi_component::{ModelType, Result};

#[path = "../../fmi-component/examples/decay.rs"]
mod decay;
use decay::Decay;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [library, folder] = arguments.as_slice() else {
        eprintln!("usage: decay_fmu LIBRARY FOLDER");
        return ExitCode::from(2);
    };
    match write_both(Path::new(library), Path::new(folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn write_both(library: &Path, folder: &Path) -> Result<()> {
    let component = Component::new(&ModelType::of::<Decay>(), &[])?;
    let libraries = Libraries::from_file(library)?;
    for (version, name) in [(Version::Two, "decay.fmi2.fmu"), (Version::Three, "decay.fmi3.fmu")] {
        write(&component, version, &libraries, &folder.join(name))?;
    }
    Ok(())
}
