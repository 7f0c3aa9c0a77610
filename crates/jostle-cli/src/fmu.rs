//! `jostle fmu`: writes a scene as an FMU.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use clap::{Args, ValueEnum};
use fmi_bundle::{Component, Libraries, Notices, Origin, Platform, Version, find_library, nominal_amplitude};
use jostle::Error;
use jostle::scene::{Kind, ModelType, Unit, Variable};

use crate::failure::Failure;
use crate::selection::{self, Selection};
use crate::{changes, icon, laboratory, output_file};

/// The last second of the year 9999.
const LATEST_DATE: u64 = 253_402_300_799;

/// Write a scene, or a component of the shaker laboratory, as an FMU.
///
/// The FMU holds the library, the model description, a documentation page, an icon and the licences. What drives the
/// scene and how many disks it has is decided here, since both change its list of variables.
#[derive(Args, Debug)]
#[command(after_help = format!("{}\n{}\nExample:\n  jostle fmu packing --fmi 3 --disks 60 --out packing.fmu", selection::list(), laboratory::list()))]
pub struct Fmu {
    #[command(flatten)]
    selection: Selection,
    /// Version of the standard.
    #[arg(long, value_enum, default_value = "3")]
    fmi: Standard,
    /// What moves the base, such as input (the importer) or sine. Without it the engine's first: input where it has one.
    #[arg(long)]
    drive: Option<String>,
    /// One array variable instead of scalars with an index, such as disk.angle for disk.angle[1] and so on. FMI 3.0 only,
    /// and not every importer reads arrays; for large counts.
    #[arg(long)]
    arrays: bool,
    /// Folder with the libraries of several systems, all of which the FMU gets: x86_64-windows/NAME.dll, aarch64-linux/NAME.so and so
    /// on, as scripts/release makes them. That of this system may be missing there: it is then taken from beside this program.
    #[arg(long, value_name = "FOLDER")]
    libraries: Option<PathBuf>,
    /// File to write.
    #[arg(long, value_name = "FILE.fmu")]
    out: PathBuf,
}

/// Version of the standard.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Standard {
    /// FMI 2.0, co-simulation.
    #[value(name = "2")]
    Two,
    /// FMI 3.0, co-simulation.
    #[value(name = "3")]
    Three,
}

impl Fmu {
    /// Writes the file.
    ///
    /// # Errors
    /// An unknown scene, engine or drive, a wrong disk count, no library to put in, no place to write to.
    pub fn execute(self) -> Result<(), Failure> {
        let mut component = match laboratory::find(&self.selection.scene) {
            Some(model) => {
                laboratory::refuse_options(&self.selection, self.drive.as_deref())?;
                prepared(&model, &[])?
            }
            None => {
                let selected = self.selection.find(self.drive.as_deref())?;
                let structure: Vec<_> = selected.structure.iter().collect();
                prepared(&selected.model, &structure)?
            }
        };
        output_file::check_fmu("--out", &self.out)?;
        if self.arrays && matches!(self.fmi, Standard::Two) {
            let allowed = "3 with --arrays, since FMI 2.0 has no array variables";
            return Err(Error::parameter("--fmi", 2, allowed, "Give --fmi 3, or leave --arrays out.").into());
        }
        component.arrays = self.arrays;
        let version = self.fmi.version();
        let libraries = libraries(&component, self.libraries.as_deref())?;
        fmi_bundle::write(&component, version, &libraries, &self.out)?;
        for platform in libraries.left_out(version) {
            eprintln!("jostle: FMI 2.0 has no folder for {platform}: its library is left out");
        }
        Ok(())
    }
}

impl Standard {
    /// The same for the library.
    pub fn version(self) -> Version {
        match self {
            Self::Two => Version::Two,
            Self::Three => Version::Three,
        }
    }
}

/// A model with all that each of our FMUs holds.
///
/// # Errors
/// A structural parameter that it does not take, a wrong date.
pub fn prepared(model: &ModelType, structure: &[(&str, u32)]) -> Result<Component, Failure> {
    let mut component = Component::new(model, structure)?;
    component.date = Some(date()?);
    component.notices = notices();
    component.origin = origin();
    component.icon = Some(icon::of(component.info().name)?);
    component.replay_command = Some("jostle replay FILE.fmu".into());
    component.amplitude = reference_amplitude;
    Ok(component)
}

/// The libraries of a component: those in `folder`, and for this system that beside the program where `folder` has none.
///
/// # Errors
/// There is none, or a folder that holds what is no library.
pub fn libraries(component: &Component, folder: Option<&Path>) -> Result<Libraries, Error> {
    // Libraries of the laboratory are told from others in one folder by the beginning of their names.
    let identifier = &component.info().identifier;
    let identifier = format!("jostle_{}", identifier.trim_start_matches("jostle_"));
    let mut libraries = match folder {
        Some(folder) => Libraries::from_folder(folder, &identifier)?,
        None => Libraries::default(),
    };
    if Platform::host().is_none_or(|host| libraries.get(host).is_none()) {
        libraries.add_file(&library(&identifier)?)?;
    }
    Ok(libraries)
}

/// The library of a scene: beside this program, or one folder above, where tests and examples run.
fn library(identifier: &str) -> Result<PathBuf, Error> {
    let program = std::env::current_exe();
    let program = program.map_err(|error| Error::file("this program".as_ref(), error, "Call it by its path."))?;
    let folders: Vec<_> = program.ancestors().skip(1).take(2).collect();
    find_library(identifier, &folders).map_err(|error| match error {
        Error::File { path, what, .. } => {
            let package = identifier.replace("jostle_", "fmu-").replace('_', "-");
            let remedy = format!("Build it: cargo build --release -p jostle-cli -p {package}");
            Error::File { path, what, remedy }
        }
        other => other,
    })
}

/// Licence of the FMUs and notices of what their libraries hold.
fn notices() -> Notices {
    const MIT: &str = include_str!("../../../LICENSE-MIT");
    const APACHE: &str = include_str!("../../../LICENSE-APACHE");
    /// Written by `python -m tools notices`.
    const THIRD_PARTY: &str = include_str!("../../../LICENSE-THIRD-PARTY.txt");
    let copyright = MIT
        .lines()
        .find(|line| line.starts_with("Copyright"))
        .unwrap_or_default();
    let files = [
        ("LICENSE-MIT.txt", MIT),
        ("LICENSE-APACHE.txt", APACHE),
        ("LICENSE-THIRD-PARTY.txt", THIRD_PARTY),
    ];
    Notices {
        license: env!("CARGO_PKG_LICENSE").into(),
        copyright: copyright.into(),
        files: files.map(|(name, text)| (name.into(), text.into())).into(),
    }
}

/// Where the FMUs come from, as far as the manifest of this package says it: the page leaves out what is empty.
fn origin() -> Origin {
    const LOG: &str = include_str!("../../../CHANGELOG.md");
    Origin {
        authors: env!("CARGO_PKG_AUTHORS").into(),
        repository: env!("CARGO_PKG_REPOSITORY").into(),
        contact: env!("CARGO_PKG_HOMEPAGE").into(),
        tools: format!(
            "{}; the crates that are linked are listed in licenses/LICENSE-THIRD-PARTY.txt",
            env!("JOSTLE_COMPILER")
        ),
        changes: changes::of_version(LOG, env!("CARGO_PKG_VERSION")),
    }
}

/// Amplitude of an input in the reference trajectory: a base is shaken at twice gravity, so that grains leave it.
fn reference_amplitude(input: &Variable, omega: f64) -> f64 {
    const ACCELERATION: f64 = 20.0;
    match &input.kind {
        Kind::Real(quantity) if quantity.unit == Unit::METRE => ACCELERATION / (omega * omega),
        _ => nominal_amplitude(input, omega),
    }
}

/// Now, or what SOURCE_DATE_EPOCH says (seconds since 1970), for FMUs of the same bytes: as the schema's dateTime.
fn date() -> Result<String, Failure> {
    let time = match std::env::var("SOURCE_DATE_EPOCH") {
        Err(_) => SystemTime::now(),
        Ok(given) => {
            let seconds = given.parse().ok().filter(|seconds| *seconds <= LATEST_DATE);
            let seconds = seconds.ok_or_else(|| {
                let allowed = format!("whole seconds since 1970, up to {LATEST_DATE}");
                Error::parameter("SOURCE_DATE_EPOCH", &given, allowed, "Correct or unset it.")
            })?;
            UNIX_EPOCH + Duration::from_secs(seconds)
        }
    };
    Ok(humantime::format_rfc3339_seconds(time).to_string())
}
