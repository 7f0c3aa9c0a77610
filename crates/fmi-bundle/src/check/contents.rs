//! The files of an FMU, from an archive or from the folder that it was unpacked to.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use fmi_component::{Error, Result};

use super::findings::CheckReport;
use crate::archive::{self, Member};

/// The files of `fmu`, with what is wrong with their paths.
///
/// # Errors
/// It cannot be read, or is neither an archive nor a folder.
pub fn read(fmu: &Path, report: &mut CheckReport) -> Result<Vec<Member>> {
    let unreadable =
        |error: &dyn ToString| Error::file(fmu, error.to_string(), "Name an FMU, or the folder of an unpacked one.");
    let members = match fmu.is_dir() {
        true => {
            let mut members = Vec::new();
            read_folder(fmu, "", &mut members).map_err(|error| unreadable(&error))?;
            members
        }
        false => {
            let bytes = fs::read(fmu).map_err(|error| unreadable(&error))?;
            archive::read(&bytes).map_err(|what| unreadable(&what))?
        }
    };
    let mut known = HashSet::new();
    for member in &members {
        let path = &member.path;
        let is_legal = !path.starts_with('/')
            && !path.contains(['\\', ':'])
            && path.split('/').all(|part| !matches!(part, "" | "." | ".."));
        if !is_legal {
            let what = "the path of this file is not allowed: a path below the FMU, with / between its parts";
            report.fault(path, what, "Write the archive anew.");
        }
        if !known.insert(path.to_lowercase()) {
            report.fault(
                path,
                "there is a second file of this name, but for small and large letters",
                "Keep one.",
            );
        }
    }
    Ok(members)
}

fn read_folder(folder: &Path, prefix: &str, members: &mut Vec<Member>) -> std::io::Result<()> {
    let mut entries = fs::read_dir(folder)?.collect::<std::io::Result<Vec<_>>>()?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let path = format!("{prefix}{}", entry.file_name().to_string_lossy());
        match entry.path().is_dir() {
            true => read_folder(&entry.path(), &format!("{path}/"), members)?,
            false => members.push(Member {
                bytes: fs::read(entry.path())?,
                path,
            }),
        }
    }
    Ok(())
}
