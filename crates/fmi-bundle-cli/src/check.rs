//! `fmu-bundle check`.

use std::path::PathBuf;

use clap::Args;
use fmi_bundle::{Error, Result, check};

/// Check an FMU: its files, and what its library does, against its model description.
///
/// Paths, structure of the XML files, names, ranges, units, references, folders of the libraries, files that others name; and by the library for this
/// system its model, the start values, and what outputs depend on, by variation of every parameter and input. Each fault is told with its
/// file and line.
#[derive(Args)]
#[command(after_help = "Example:\n  fmu-bundle check pendulum.fmi3.fmu")]
pub struct Check {
    /// FMU, or the folder of an unpacked one. Its library is run with your rights: check only what you trust.
    #[arg(value_name = "FILE.fmu")]
    fmu: PathBuf,
}

impl Check {
    /// Checks and reports.
    ///
    /// # Errors
    /// The file is no FMU, or has faults.
    pub fn execute(self) -> Result<()> {
        let report = check(&self.fmu)?;
        let fmu = self.fmu.display();
        for line in report.done.iter().chain(&report.left_out) {
            println!("{fmu}: {line}");
        }
        for fault in &report.faults {
            println!("{fmu}: {fault}");
        }
        match report.faults.len() {
            0 => println!("{fmu}: no faults"),
            1 => return Err(Error::file(&self.fmu, "1 fault", "It is above, with its remedy.")),
            count => {
                return Err(Error::file(
                    &self.fmu,
                    format!("{count} faults"),
                    "They are above, with their remedies.",
                ));
            }
        }
        Ok(())
    }
}
