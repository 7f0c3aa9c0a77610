//! Writes the oscillators of `fmi-component` as an FMU: `bundle LIBRARY 2|3 OUT.fmu`, with the library that cargo built, such
//! as `target/release/liboscillators.so`.

use std::path::Path;
use std::process::ExitCode;

use fmi_bundle::{Component, Version, write};
use fmi_component::ModelType;
use oscillators::Oscillators;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (library, version, out) = match arguments.as_slice() {
        [library, "2", out] => (library, Version::Two, out),
        [library, "3", out] => (library, Version::Three, out),
        _ => {
            eprintln!("usage: bundle LIBRARY 2|3 OUT.fmu");
            return ExitCode::from(2);
        }
    };
    let written = Component::new(&ModelType::of::<Oscillators>(), &[])
        .and_then(|component| write(&component, version, Path::new(library), Path::new(out)));
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
