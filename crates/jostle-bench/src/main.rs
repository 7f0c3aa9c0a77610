//! Measures jostle, for those who develop it or doubt it. Not shipped.
//!
//! Exit codes: 0 done; 2 an argument is wrong and nothing was run; 1 a run or a file failed on the way.

mod budget;
mod csv_file;
mod machine;
mod nearest;
mod real_time;
mod report;
mod stability;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use jostle::Error;

/// Error against run time, time of a step at the rates of controllers, and stability where it is hard.
#[derive(Parser)]
#[command(name = "jostle-bench", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    RealTime(real_time::RealTime),
    Report(report::ReportCommand),
    Stability(stability::Stability),
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::RealTime(real_time) => real_time.execute(),
        Command::Report(report) => report.execute(),
        Command::Stability(stability) => stability.execute(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("jostle-bench: {error:#}");
            match error.downcast_ref() {
                Some(Error::Parameter { .. }) => ExitCode::from(2),
                _ => ExitCode::from(1),
            }
        }
    }
}
