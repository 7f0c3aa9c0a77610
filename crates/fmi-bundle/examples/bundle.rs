//! Writes the oscillators of `fmi-component` as an FMU: `bundle LIBRARY 2|3 OUT.fmu`, with the library that cargo built, such
//! as `target/release/liboscillators.so`, or with those in a folder that has one folder for each system.

use std::path::Path;
use std::process::ExitCode;

use fmi_bundle::{Component, Libraries, Version, write};
use fmi_component::{ModelType, Result};
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
    match bundle(Path::new(library), version, Path::new(out)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn bundle(library: &Path, version: Version, out: &Path) -> Result<()> {
    let component = Component::new(&ModelType::of::<Oscillators>(), &[])?;
    let libraries = match library.is_dir() {
        true => Libraries::from_folder(library, &component.info().identifier)?,
        false => Libraries::from_file(library)?,
    };
    write(&component, version, &libraries, out)
}
