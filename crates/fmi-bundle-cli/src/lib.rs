//! The commands `fmu-bundle` and `cargo fmu-bundle`. Thin: arguments in, calls of `fmi-bundle` out, refusals to standard error.
//!
//! Exit codes: 0 done; 2 an argument is wrong; 1 a crate or a file is refused.
#![doc = include_str!("../README.md")]

mod build;
mod cargo;
mod check;
mod merge;
mod origin;
mod pack;
mod package;
mod replay;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use fmi_bundle::Error;

/// FMUs of Rust models: made of a crate or of a library, checked, replayed, joined.
#[derive(Parser)]
#[command(version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Build(build::Build),
    Pack(pack::Pack),
    Check(check::Check),
    Replay(replay::Replay),
    Merge(merge::Merge),
}

/// Does what the `words` after the name of the program say; `name` is that name, for texts.
pub fn run(name: &'static str, words: impl Iterator<Item = OsString>) -> ExitCode {
    let words = [OsString::from(name)].into_iter().chain(words);
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(error) => {
            let _ = error.print(); // help and version come here too
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    let done = match arguments.command {
        Command::Build(build) => build.execute(),
        Command::Pack(pack) => pack.execute(),
        Command::Check(check) => check.execute(),
        Command::Replay(replay) => replay.execute(),
        Command::Merge(merge) => merge.execute(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{name}: {error}");
            ExitCode::FAILURE
        }
    }
}

/// `error` with the file that it is about, where it does not name one.
fn about(file: &std::path::Path, error: Error) -> Error {
    match error {
        Error::Call { what, remedy } => Error::file(file, what, remedy),
        other => other,
    }
}
