//! Why a command ended early, and the exit code that says so.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use jostle::Error;

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
    pub fn file(path: &Path, error: impl Into<io::Error>) -> Self {
        Self::File {
            path: path.to_owned(),
            error: error.into(),
        }
    }

    pub fn exit_code(&self) -> u8 {
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
