//! `fmu-bundle pack`: libraries in, FMUs out. What `build` does once cargo has made the libraries.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use fmi_bundle::{Component, Error, Libraries, Platform, Result, Version, write_versions};

use crate::about;

/// Write the FMUs of a model of which you have the libraries.
///
/// One library has to be for this system: it tells what its model is, and is run for the reference trajectory.
#[derive(Args)]
#[command(after_help = "Example:\n  fmu-bundle pack libpendulum.so pendulum.dll --out fmus/")]
pub struct Pack {
    /// Libraries of one model that `fmi_component::export_fmu!` exports, one for each system.
    #[arg(value_name = "LIBRARY", required = true)]
    libraries: Vec<PathBuf>,
    #[command(flatten)]
    wanted: Wanted,
}

/// What FMUs are wanted, and where.
#[derive(Args)]
pub struct Wanted {
    /// Version of the standard.
    #[arg(long, value_enum, default_value = "both")]
    fmi: Standard,
    /// Folder for the FMUs, which are called NAME.fmi2.fmu and NAME.fmi3.fmu, or the file where --fmi asks for one version. The
    /// present folder without it.
    #[arg(long, value_name = "FILE.fmu|FOLDER")]
    out: Option<PathBuf>,
    /// A structural parameter of the model; may be repeated.
    #[arg(long = "structure", value_name = "NAME=NUMBER")]
    structure: Vec<String>,
    /// The elements of an array as one variable: FMI 3.0 alone, and not every importer reads arrays.
    #[arg(long)]
    arrays: bool,
}

/// Versions of the standard.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Standard {
    /// FMI 2.0.
    #[value(name = "2")]
    Two,
    /// FMI 3.0.
    #[value(name = "3")]
    Three,
    /// Both; with --arrays FMI 3.0.
    Both,
}

impl Pack {
    /// Writes them.
    ///
    /// # Errors
    /// A library that is none, or no model of fmi-component, or none for this system; as of [`Wanted::write`].
    pub fn execute(self) -> Result<()> {
        let mut libraries = Libraries::default();
        for path in &self.libraries {
            libraries.add_file(path)?;
        }
        self.wanted.write(&libraries, |_| ())
    }
}

impl Wanted {
    /// Writes the FMUs of `libraries` after `complete` has added what is known of the model besides.
    ///
    /// # Errors
    /// No library for this system; a library without a model; a panic of the model; no place to write to.
    pub fn write(&self, libraries: &Libraries, complete: impl FnOnce(&mut Component)) -> Result<()> {
        let structure = self
            .structure
            .iter()
            .map(|text| structural(text))
            .collect::<Result<Vec<_>>>()?;
        let versions = self.versions()?;
        let host = Platform::host();
        let library = host.and_then(|host| Some((libraries.path(host)?, libraries.get(host)?)));
        let (path, bytes) = library.ok_or_else(|| {
            let names: Vec<_> = libraries.iter().map(|(platform, _)| platform.name()).collect();
            let host = host.map_or("an unknown system", Platform::name);
            Error::parameter(
                "libraries",
                names.join(", "),
                format!("one for this system, {host}, among them: it tells what its model is"),
                "Build it too.",
            )
        })?;
        let write = || {
            let mut component = Component::from_library(bytes, &structure)?;
            component.arrays = self.arrays;
            component.replay_command = Some("fmu-bundle replay FILE.fmu".into());
            complete(&mut component);
            warn_of_aborts(path, &component);
            write_versions(&component, &versions, libraries, self.out.as_deref())
        };
        for line in write().map_err(|error| about(path, error))? {
            println!("{line}");
        }
        Ok(())
    }

    fn versions(&self) -> Result<Vec<Version>> {
        match (self.fmi, self.arrays) {
            (Standard::Two, true) => {
                let allowed = "3 with --arrays, since FMI 2.0 has no array variables";
                Err(Error::parameter(
                    "--fmi",
                    2,
                    allowed,
                    "Give --fmi 3, or leave --arrays out.",
                ))
            }
            (Standard::Two, false) => Ok(vec![Version::Two]),
            (Standard::Three, _) | (Standard::Both, true) => Ok(vec![Version::Three]),
            (Standard::Both, false) => Ok(vec![Version::Two, Version::Three]),
        }
    }
}

fn structural(text: &str) -> Result<(&str, u32)> {
    let parts = text
        .split_once('=')
        .and_then(|(name, number)| Some((name, number.parse().ok()?)));
    parts.ok_or_else(|| Error::parameter("--structure", text, "NAME=NUMBER, a whole number", "Write it so."))
}

/// The one promise of fmi-component that the author of a crate can take back unseen.
fn warn_of_aborts(library: &Path, component: &Component) {
    if !component.contains_panics() {
        eprintln!(
            "warning: {}: it was built with panic = \"abort\": a panic of the model ends the importer's program. Write panic = \
             \"unwind\" into the profile, or build with another.",
            library.display()
        );
    }
}
