//! The command `cargo fmu-bundle`, which cargo calls as `cargo-fmu-bundle fmu-bundle ARGUMENTS`.

use std::process::ExitCode;

fn main() -> ExitCode {
    let mut words = std::env::args_os().skip(1).peekable();
    words.next_if(|word| word == "fmu-bundle");
    fmi_bundle_cli::run("cargo fmu-bundle", words)
}
