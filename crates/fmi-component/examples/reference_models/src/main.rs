//! Writes the FMUs of all models for both versions of FMI: `cargo run -p reference-models FOLDER`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use fmi_bundle::{Component, Libraries, Version, find_library, write};
use fmi_component::{Result, arrays};

fn main() -> ExitCode {
    let Some(folder) = std::env::args().nth(1) else {
        eprintln!("usage: reference-models FOLDER");
        return ExitCode::from(2);
    };
    match write_all(Path::new(&folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}. The libraries: cargo build -p reference-models --examples");
            ExitCode::FAILURE
        }
    }
}

fn write_all(folder: &Path) -> Result<()> {
    let beside = std::env::current_exe().map(|program| program.with_file_name("examples"));
    let beside = beside.unwrap_or_else(|_| PathBuf::from("examples"));
    for (name, model) in &reference_models::ALL {
        let mut component = Component::new(model, &[])?;
        let libraries = Libraries::from_file(&find_library(name, &[&beside])?)?;
        for (version, suffix) in [(Version::Two, "fmi2"), (Version::Three, "fmi3")] {
            let file = format!("{}.{suffix}.fmu", component.info().identifier);
            write(&component, version, &libraries, &folder.join(file))?;
        }
        // The scalars of these models are named `x[1]`, or they are one variable.
        component.arrays = true;
        if component.table().variables().iter().any(arrays::begins) {
            let file = format!("{}.arrays.fmu", component.info().identifier);
            write(&component, Version::Three, &libraries, &folder.join(file))?;
        }
    }
    Ok(())
}
