//! The command line. Thin: arguments in, library calls out, refusals to standard error.
//!
//! Exit codes: 0 done; 2 an argument or parameter is wrong and nothing was run; 1 the run or a file failed on the way.

mod assignments;
mod describe;
mod fields;
mod fmu;
mod replay;
mod report;
mod run;
mod stability;
#[cfg(test)]
mod test_scene;
mod text;
mod theory;

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};
use jostle::Error;
use jostle::scene::{Choice, Scene};

/// Vibrated granular disks as components for other people's simulations.
#[derive(Parser)]
#[command(name = "jostle", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Describe(describe::Describe),
    Fields(fields::Fields),
    Fmu(fmu::Fmu),
    Replay(replay::Replay),
    Report(report::Report),
    Run(run::Run),
    Stability(stability::Stability),
    Theory(theory::Theory),
}

/// Which scene, as what component: shared by all commands.
#[derive(Args, Debug, Clone)]
pub struct Selection {
    /// Scene, such as packing.
    scene: String,
    /// Engine, such as molecular-dynamics. Without it the scene's first.
    #[arg(long)]
    engine: Option<String>,
    /// Number of disks. Without it the scene's usual number.
    #[arg(long, value_name = "N")]
    disks: Option<u32>,
}

impl Selection {
    /// The choice of a scene, with the disk count checked.
    fn choice<S: Scene>(&self) -> Result<Choice, Failure> {
        let card = S::card();
        let disks = self.disks.unwrap_or(card.default_disks);
        if card.disks.contains(&disks) {
            return Ok(Choice { disks });
        }
        let allowed = format!(
            "from {} to {} for the scene {}",
            card.disks.start(),
            card.disks.end(),
            card.scene
        );
        Err(Error::parameter("--disks", disks, allowed, "Give a number in this range.").into())
    }
}

/// Why a command ended early.
#[derive(Debug)]
pub enum Failure {
    /// The library refused.
    Refused(Error),
    /// The library refused a step; what was written before is kept.
    Stopped { error: Error, kept: String },
    /// A file could not be written.
    File { path: PathBuf, error: io::Error },
}

impl Failure {
    fn file(path: &Path, error: impl Into<io::Error>) -> Self {
        Self::File {
            path: path.to_owned(),
            error: error.into(),
        }
    }

    fn exit_code(&self) -> u8 {
        match self {
            Self::Refused(Error::Parameter { .. }) => 2,
            _ => 1,
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Refused(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(error) => write!(formatter, "{error}"),
            Self::Stopped { error, kept } => write!(formatter, "{error}\n{kept}"),
            Self::File { path, error } => write!(
                formatter,
                "{} cannot be written: {error}. Check the folder, its permissions and the free space.",
                path.display()
            ),
        }
    }
}

/// Reads the arguments, does what they say, reports.
pub fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Describe(describe) => describe.execute(),
        Command::Replay(replay) => replay.execute(),
        Command::Fields(fields) => fields.execute(),
        Command::Fmu(fmu) => fmu.execute(),
        Command::Report(report) => report.execute(),
        Command::Run(run) => run.execute(),
        Command::Stability(stability) => stability.execute(),
        Command::Theory(theory) => theory.execute(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("jostle: {failure}");
            ExitCode::from(failure.exit_code())
        }
    }
}
