//! `fmu-bundle replay`.

use std::path::PathBuf;

use clap::Args;
use fmi_bundle::{Error, Result, TOLERANCE, replay, replay_against};

/// Check that an FMU computes here what it computed where it was made.
///
/// Runs the library in the FMU along the reference trajectory beside it and compares every output. Bits are equal where the model takes its
/// sines and exponentials from Rust code; those of the system's C library may differ in the last ones. Differences up to a millionth
/// of a variable's size pass.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  fmu-bundle replay pendulum.fmi3.fmu\n  fmu-bundle replay pendulum.fmi3.fmu --reference measured.csv --tolerance 1e-3"
)]
pub struct Replay {
    /// FMU to run. Its library is run with your rights: replay only what you trust.
    #[arg(value_name = "FILE.fmu")]
    fmu: PathBuf,
    /// Ask for every bit.
    #[arg(long, conflicts_with = "tolerance")]
    exact: bool,
    /// Greatest difference that passes, relative to the greater of a variable's nominal and its largest value in the table.
    #[arg(long, value_name = "NUMBER", default_value_t = TOLERANCE, allow_negative_numbers = true)]
    tolerance: f64,
    /// Another trajectory: CSV with a header, the time [s] first. Inputs are set, every other column is compared.
    #[arg(long, value_name = "FILE.csv")]
    reference: Option<PathBuf>,
}

impl Replay {
    /// Runs and compares.
    ///
    /// # Errors
    /// The file is no FMU of fmi-bundle's, its library does not run here, or the outputs differ.
    pub fn execute(self) -> Result<()> {
        if !(self.tolerance >= 0.0 && self.tolerance.is_finite()) {
            let remedy = "Give a number in this range.";
            return Err(Error::parameter("--tolerance", self.tolerance, "0 or more", remedy));
        }
        let report = match &self.reference {
            Some(reference) => replay_against(&self.fmu, reference)?,
            None => replay(&self.fmu)?,
        };
        println!("{}", report.summary(&self.fmu));
        let allowed = if self.exact { 0.0 } else { self.tolerance };
        if let Some(line) = report.judge(&self.fmu, allowed)? {
            println!("{line}");
        }
        Ok(())
    }
}
