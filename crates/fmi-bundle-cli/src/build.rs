//! `fmu-bundle build`: a crate in, its FMUs out.

use std::path::PathBuf;

use clap::Args;
use fmi_bundle::{Libraries, Platform, Result};

use crate::cargo::{self, Options};
use crate::origin;
use crate::pack::Wanted;
use crate::package::{Chosen, Wish};

/// Build a crate and write the FMUs of the model that it exports.
///
/// The crate makes a library of type cdylib and exports its model by fmi_component::export_fmu!. The FMUs hold the library for this system
/// and those for each --target. Licence, authors and addresses are those of its Cargo.toml.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  cargo fmu-bundle build\n  cargo fmu-bundle build --package pendulum --target x86_64-pc-windows-gnu \
                        --out fmus/\n  cargo fmu-bundle build --fmi 3 --out pendulum.fmu -- --locked"
)]
pub struct Build {
    /// Package of the workspace, if it has several.
    #[arg(short, long, value_name = "NAME")]
    package: Option<String>,
    /// Example of the package that is a cdylib, instead of its library.
    #[arg(long, value_name = "NAME")]
    example: Option<String>,
    /// Path of the Cargo.toml; that of the present folder or one above without it.
    #[arg(long, value_name = "PATH")]
    manifest_path: Option<PathBuf>,
    #[command(flatten)]
    options: Options,
    /// Another system to build for, by the name that rustc has for it; may be repeated.
    #[arg(long = "target", value_name = "TRIPLE")]
    targets: Vec<String>,
    #[command(flatten)]
    wanted: Wanted,
}

impl Build {
    /// Builds and writes.
    ///
    /// # Errors
    /// No such package or library, a build that fails, a library that exports no model; as of [`Wanted::write`].
    pub fn execute(self) -> Result<()> {
        let chosen = Chosen::find(&Wish {
            package: self.package.as_deref(),
            example: self.example.as_deref(),
            manifest: self.manifest_path.as_deref(),
        })?;
        let mut libraries = Libraries::default();
        for target in &self.targets {
            libraries.add_file(&cargo::build(&chosen, &self.options, Some(target))?)?;
        }
        if Platform::host().is_none_or(|host| libraries.get(host).is_none()) {
            libraries.add_file(&cargo::build(&chosen, &self.options, None)?)?;
        }
        self.wanted.write(&libraries, |component| {
            component.notices = origin::notices(&chosen);
            component.origin = origin::origin(&chosen);
        })
    }
}
