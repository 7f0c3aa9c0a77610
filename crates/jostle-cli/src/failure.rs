//! Why a command ended early, and the exit code that says so.

use std::fmt;
use std::io;
use std::path::Path;

use fmi_bundle::cannot_write;
use jostle::Error;

use crate::interruption::Signal;

/// Why a command ended early.
#[derive(Debug)]
pub enum Failure {
    /// The library refused.
    Refused(Error),
    /// A step was refused or the disk is full; what was written before is kept.
    Stopped { error: Error, kept: String },
    /// A file could not be written.
    File(Error),
    /// Standard output could not be written.
    Output(io::Error),
    /// The reader of standard output, such as `head`, has read enough: no failure.
    ReaderGone,
    /// The system lets nobody listen to signals.
    Signals(io::Error),
    /// A signal ended the run.
    Interrupted { signal: Signal, kept: String },
}

impl Failure {
    /// A file could not be written.
    pub fn file(path: &Path, error: &io::Error) -> Self {
        Self::File(cannot_write(path, error))
    }

    /// Standard output could not be written.
    pub fn standard_output(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ReaderGone,
            _ => Self::Output(error),
        }
    }

    /// This failure with what is left of the run.
    pub fn keeping(self, kept: String) -> Self {
        match self {
            Self::Refused(error) | Self::File(error) => Self::Stopped { error, kept },
            other => other,
        }
    }

    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Refused(Error::Parameter { .. }) => 2,
            Self::ReaderGone => 0,
            Self::Interrupted { signal, .. } => signal.exit_code(),
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
            Self::Refused(error) | Self::File(error) => write!(formatter, "{error}"),
            Self::Stopped { error, kept } => write!(formatter, "{error}\n{kept}"),
            Self::ReaderGone => Ok(()),
            Self::Signals(error) => write!(formatter, "signals such as that of Ctrl-C cannot be noticed: {error}"),
            Self::Interrupted { signal, kept } => write!(formatter, "stopped by {}\n{kept}", signal.name()),
            Self::Output(error) => write!(
                formatter,
                "standard output cannot be written: {error}. Check where it is sent to, and the free space there."
            ),
        }
    }
}
