//! Text to standard output.

use std::io::{self, Write};

use crate::failure::Failure;

/// Writes `text`. A reader that has read enough, such as `head`, is no failure.
///
/// # Errors
/// It cannot be written.
pub fn write(text: &str) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    let written = output.write_all(text.as_bytes()).and_then(|()| output.flush());
    match written.map_err(Failure::standard_output) {
        Err(Failure::ReaderGone) => Ok(()),
        done => done,
    }
}
