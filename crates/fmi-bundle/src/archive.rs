//! The zip archive that an FMU is: the same members give the same bytes.

use std::io::{Cursor, Read, Write};

use fmi_component::{Error, Result};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// A file in an FMU.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Member {
    /// Path in the archive, with `/`.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// The archive of these members in their order. Files in `binaries/` may be executed, where permissions say so.
///
/// # Errors
/// The archive cannot be made.
pub fn write(members: &[Member]) -> Result<Vec<u8>> {
    let failed = |error: &dyn ToString| Error::call(format!("the archive: {}", error.to_string()), "Try again.");
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for member in members {
        let is_library = member.path.starts_with("binaries/");
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::default())
            .unix_permissions(if is_library { 0o755 } else { 0o644 });
        archive
            .start_file(member.path.as_str(), options)
            .map_err(|error| failed(&error))?;
        archive.write_all(&member.bytes).map_err(|error| failed(&error))?;
    }
    Ok(archive.finish().map_err(|error| failed(&error))?.into_inner())
}

/// The members of the archive `bytes`, in their order; folders are none.
///
/// # Errors
/// It is no zip archive, or a damaged one; the text says what is wrong with it.
pub fn read(bytes: &[u8]) -> std::result::Result<Vec<Member>, String> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let mut members = Vec::new();
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).map_err(|error| error.to_string())?;
        if entry.is_dir() {
            continue;
        }
        let path = entry.name().map_err(|error| error.to_string())?.into_owned();
        let mut bytes = Vec::new();
        entry
            .read_to_end(&mut bytes)
            .map_err(|error| format!("{path}: {error}"))?;
        members.push(Member { path, bytes });
    }
    Ok(members)
}
