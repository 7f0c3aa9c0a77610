//! Writes the example model of `fmi-component` as FMUs of both versions: `van_der_pol_fmu LIBRARY FOLDER`, with the library that
//! `cargo build --release -p fmi-component --example van_der_pol` makes.
#![allow(unsafe_code)] // the model's file exports C functions

use std::path::Path;
use std::process::ExitCode;

use fmi_bundle::{Component, Version, write};
use fmi_component::{ModelType, Result};

#[path = "../../fmi-component/examples/van_der_pol.rs"]
mod van_der_pol;
use van_der_pol::VanDerPol;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [library, folder] = arguments.as_slice() else {
        eprintln!("usage: van_der_pol_fmu LIBRARY FOLDER");
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
    let component = Component::new(&ModelType::of::<VanDerPol>(), &[])?;
    for (version, name) in [
        (Version::Two, "van_der_pol.fmi2.fmu"),
        (Version::Three, "van_der_pol.fmi3.fmu"),
    ] {
        write(&component, version, library, &folder.join(name))?;
    }
    Ok(())
}
