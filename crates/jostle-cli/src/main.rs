//! The command line. Thin: arguments in, library calls out, refusals to standard error.
//!
//! Exit codes: 0 done; 2 an argument or parameter is wrong and nothing was run; 1 the run or a file failed on the way.

mod assignments;
#[cfg(test)]
mod clock;
mod csv_file;
mod describe;
mod failure;
mod fields;
mod fmu;
mod icon;
mod progress;
mod replay;
mod run;
mod selection;
mod standard_output;
mod text;
mod theory;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

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
    Run(run::Run),
    Theory(theory::Theory),
}

/// Reads the arguments, does what they say, reports.
fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Describe(describe) => describe.execute(),
        Command::Replay(replay) => replay.execute(),
        Command::Fields(fields) => fields.execute(),
        Command::Fmu(fmu) => fmu.execute(),
        Command::Run(run) => run.execute(),
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
