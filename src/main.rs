//! Command line: argument -> library call.

mod command_line;

use std::process::ExitCode;

fn main() -> ExitCode {
    command_line::main()
}
