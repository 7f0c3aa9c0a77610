//! `jostle replay`: runs the library in an FMU against the reference trajectory in it.

use std::path::PathBuf;

use clap::Args;
use fmi_bundle::{TOLERANCE, replay};

use crate::failure::Failure;
use crate::standard_output;

/// Check that an FMU computes here what it computed where it was made.
///
/// Runs the library in the FMU along the reference trajectory beside it and compares every output. Bits are equal on every
/// system; a library of another version may differ in the last ones. Differences up to a millionth of a variable's size pass,
/// unless --exact is given.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  jostle replay packing.fmu")]
pub struct Replay {
    /// FMU to run. Its library is run with your rights: replay only what you trust.
    #[arg(value_name = "FILE.fmu")]
    fmu: PathBuf,
    /// Ask for every bit.
    #[arg(long)]
    exact: bool,
}

impl Replay {
    /// Runs and compares.
    ///
    /// # Errors
    /// The file is no FMU of jostle's, its library does not run here, or the outputs differ.
    pub fn execute(self) -> Result<(), Failure> {
        let report = replay(&self.fmu)?;
        standard_output::write(&format!("{}\n", report.summary(&self.fmu)))?;
        let allowed = if self.exact { 0.0 } else { TOLERANCE };
        match report.judge(&self.fmu, allowed)? {
            Some(line) => standard_output::write(&format!("{line}\n")),
            None => Ok(()),
        }
    }
}
