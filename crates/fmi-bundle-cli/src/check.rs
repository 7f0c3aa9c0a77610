//! `fmu-bundle check`.
use std::path::PathBuf;

use clap::Args;
use fmi_bundle::Result;

/// Check
#[derive(Args)]
pub struct Check {
    fmu: PathBuf,
}

impl Check {
    pub fn execute(self) -> Result<()> {
        let _ = self.fmu;
        Ok(())
    }
}
