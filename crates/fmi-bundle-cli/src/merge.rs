//! `fmu-bundle merge`.

use std::path::PathBuf;

use clap::Args;
use fmi_bundle::{Result, merge};

/// Join FMUs of one model that were made on different systems.
///
/// They must be of one model description and one reference trajectory: only their date and their libraries may differ.
#[derive(Args)]
#[command(after_help = "Example:\n  fmu-bundle merge linux.fmu windows.fmu --out both.fmu")]
pub struct Merge {
    /// FMUs to join. Date and order of the files are those of the first.
    #[arg(value_name = "FILE.fmu", num_args = 2.., required = true)]
    parts: Vec<PathBuf>,
    /// File to write; it may be one of those that are joined.
    #[arg(long, value_name = "FILE.fmu")]
    out: PathBuf,
}

impl Merge {
    /// Joins them.
    ///
    /// # Errors
    /// As of [`merge`].
    pub fn execute(self) -> Result<()> {
        let platforms = merge(&self.parts, &self.out)?;
        let names: Vec<_> = platforms.iter().map(|platform| platform.name()).collect();
        println!("{}: libraries for {}", self.out.display(), names.join(", "));
        Ok(())
    }
}
