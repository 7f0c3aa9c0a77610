//! The command `fmu-bundle`. Exit codes: 0 done; 2 an argument is wrong; 1 a file is refused.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use fmi_bundle::{Platform, merge};

/// Works on FMUs that the crate fmi-bundle wrote.
#[derive(Parser)]
#[command(name = "fmu-bundle", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Join FMUs of one model that were made on different systems.
    ///
    /// They must be of one model description and one reference trajectory: only their date and their libraries may differ.
    #[command(after_help = "Example:\n  fmu-bundle merge linux.fmu windows.fmu --out both.fmu")]
    Merge {
        /// FMUs to join. Date and order of the files are those of the first.
        #[arg(value_name = "FILE.fmu", num_args = 2.., required = true)]
        parts: Vec<PathBuf>,
        /// File to write; it may be one of those that are joined.
        #[arg(long, value_name = "FILE.fmu")]
        out: PathBuf,
    },
}

fn main() -> ExitCode {
    let Command::Merge { parts, out } = Arguments::parse().command;
    match merge(&parts, &out) {
        Ok(platforms) => {
            println!("{}", report(&out, &platforms));
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("fmu-bundle: {error}");
            ExitCode::FAILURE
        }
    }
}

fn report(out: &Path, platforms: &[Platform]) -> String {
    let names: Vec<_> = platforms.iter().map(|platform| platform.name()).collect();
    format!("{}: libraries for {}", out.display(), names.join(", "))
}
