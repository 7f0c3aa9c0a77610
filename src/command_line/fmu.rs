//! `jostle fmu`: writes a scene as an FMU.

use std::path::PathBuf;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use clap::{Args, ValueEnum};
use jostle::Error;
use jostle::fmi::Version;
use jostle::fmi::bundle::{self, Component};
use jostle::scene::catalogue::{Visitor, with_scene};
use jostle::scene::{Choice, Scene};

use super::{Failure, Selection};

/// The last second of the year 9999.
const LATEST_DATE: u64 = 253_402_300_799;

/// Write a scene as an FMU.
///
/// The FMU holds the library, the model description, a documentation page, an icon and the licences. What drives the
/// scene and how many disks it has is decided here, since both change its list of variables.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  jostle fmu packing --fmi 3 --disks 60 --out packing.fmu")]
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
    /// File to write.
    #[arg(long, value_name = "FILE.fmu")]
    out: PathBuf,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Standard {
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
        let engine = self.selection.engine.clone();
        let mut component = with_scene(
            &self.selection.scene,
            engine.as_deref(),
            self.drive.as_deref(),
            Bundled(&self.selection),
        )??;
        let version = match self.fmi {
            Standard::Two => Version::Two,
            Standard::Three => Version::Three,
        };
        component.arrays = self.arrays;
        component.date = Some(date()?);
        let library = bundle::find_library(component.card.identifier)?;
        Ok(bundle::write(&component, version, &library, &self.out)?)
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

struct Bundled<'a>(&'a Selection);

impl Visitor for Bundled<'_> {
    type Output = Result<Component, Failure>;

    fn visit<S: Scene>(self) -> Self::Output {
        let choice: Choice = self.0.choice::<S>()?;
        Ok(Component::of::<S>(choice)?)
    }
}
