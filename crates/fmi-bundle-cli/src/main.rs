//! The command `fmu-bundle`: see the library of this package.

use std::process::ExitCode;

fn main() -> ExitCode {
    fmi_bundle_cli::run("fmu-bundle", std::env::args_os().skip(1))
}
