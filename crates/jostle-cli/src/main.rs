//! The command line. Thin: arguments in, library calls out, refusals to standard error.
//!
//! Exit codes: 0 done; 2 an argument or parameter is wrong and nothing was run; 1 the run or a file failed on the way; 130 and
//! 143 a run was stopped by Ctrl-C or SIGTERM.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // those of clippy.toml

mod assignments;
mod changes;
#[cfg(test)]
mod clock;
mod describe;
mod failure;
mod fields;
mod fmu;
mod icon;
mod interruption;
mod laboratory;
mod nearest;
mod output_file;
mod progress;
mod replay;
mod run;
mod run_files;
mod sample_times;
mod samples;
mod selection;
mod standard_output;
mod system;
mod table;
mod text;
mod theory;
mod trajectory;
mod view;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Vibrated granular disks as components for other people's simulations.
#[derive(Parser)]
#[command(name = "jostle", version, max_term_width = 100, after_help = selection::list())]
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
    System(system::System),
    Theory(theory::Theory),
    View(view::View),
}

/// Reads the arguments, does what they say, reports.
fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Describe(describe) => describe.execute(),
        Command::Replay(replay) => replay.execute(),
        Command::Fields(fields) => fields.execute(),
        Command::Fmu(fmu) => fmu.execute(),
        Command::Run(run) => run.execute(),
        Command::System(system) => system.execute(),
        Command::Theory(theory) => theory.execute(),
        Command::View(view) => view.execute(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            let code = failure.exit_code();
            if code != 0 {
                eprintln!("jostle: {failure}");
            }
            ExitCode::from(code)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::any::TypeId;

    use clap::CommandFactory;
    use clap::error::ErrorKind;

    use super::*;

    /// Otherwise a number below zero is taken for an option, and the message is about that.
    #[test]
    fn every_number_may_be_negative_as_far_as_the_parser_goes() {
        let numbers = [TypeId::of::<f64>(), TypeId::of::<u32>(), TypeId::of::<i64>()];
        let mut count = 0;
        for command in Arguments::command().get_subcommands() {
            for argument in command
                .get_arguments()
                .filter(|argument| argument.get_action().takes_values())
            {
                let of_type = argument.get_value_parser().type_id();
                let Some(option) = argument
                    .get_long()
                    .filter(|_| numbers.iter().any(|number| of_type == *number))
                else {
                    continue;
                };
                let words = ["jostle", command.get_name(), &format!("--{option}"), "-5"];
                let kind = Arguments::command()
                    .try_get_matches_from(words)
                    .map_err(|error| error.kind());
                assert_ne!(kind.err(), Some(ErrorKind::UnknownArgument), "{words:?}");
                count += 1;
            }
        }
        assert!(count >= 9, "{count}");
    }
}
