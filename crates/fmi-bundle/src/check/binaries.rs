//! Libraries in an FMU: each in the folder of the system that its header says, under the name of the model.

use fmi_component::Version;

use super::description::Described;
use super::findings::CheckReport;
use crate::archive::Member;
use crate::platform::Platform;

/// Folders of FMI 2.0 that this crate writes no libraries for.
const OTHERS: [&str; 3] = ["win32", "linux32", "darwin32"];

/// Checks the folder `binaries` and gives the libraries with their systems.
pub fn check<'a>(
    described: &Described,
    members: &'a [Member],
    report: &mut CheckReport,
) -> Vec<(Platform, &'a Member)> {
    let mut libraries = Vec::new();
    for member in members {
        let Some((folder, file)) = member
            .path
            .strip_prefix("binaries/")
            .and_then(|rest| rest.split_once('/'))
        else {
            continue;
        };
        let of_folder = Platform::ALL
            .into_iter()
            .find(|platform| platform.folder(described.version) == Some(folder));
        let Some(platform) = of_folder else {
            // A later FMI 3 may know other systems, whose names are made like these.
            if described.version == Version::Two && !OTHERS.contains(&folder) {
                let allowed: Vec<_> = Platform::ALL
                    .iter()
                    .filter_map(|platform| platform.folder(Version::Two))
                    .collect();
                let what = format!(
                    "the folder {folder} is not allowed: {}, {}",
                    allowed.join(", "),
                    OTHERS.join(", ")
                );
                report.fault(&member.path, what, "Rename the folder.");
            }
            continue;
        };
        if file != format!("{}{}", described.identifier, platform.suffix()) {
            continue; // what the library needs beside it
        }
        match Platform::of_library(&member.bytes) {
            Ok(found) if found == platform => libraries.push((platform, member)),
            Ok(found) => report.fault(
                &member.path,
                format!("it is a library for {found} in the folder of {platform}"),
                "Move it to the folder of its own system.",
            ),
            Err(what) => report.fault(
                &member.path,
                what,
                format!("Put a shared library for {platform} there."),
            ),
        }
    }
    let any = members
        .iter()
        .any(|member| member.path.starts_with("binaries/") || member.path.starts_with("sources/"));
    if !any {
        report.fault(
            "binaries",
            "the FMU holds neither a library nor sources",
            "Add a library.",
        );
    }
    check_named(described, members, report);
    libraries
}

/// Each folder of a system holds a library by the name of the model.
fn check_named(described: &Described, members: &[Member], report: &mut CheckReport) {
    for platform in Platform::ALL {
        let Some(folder) = platform.folder(described.version) else {
            continue;
        };
        let prefix = format!("binaries/{folder}/");
        let held: Vec<&str> = members
            .iter()
            .filter_map(|member| member.path.strip_prefix(&prefix))
            .collect();
        let name = format!("{}{}", described.identifier, platform.suffix());
        if !held.is_empty() && !held.contains(&name.as_str()) {
            let what = format!(
                "it holds {}, but not {name}, the library of modelIdentifier",
                held.join(", ")
            );
            report.fault(prefix.trim_end_matches('/'), what, "Name the library so.");
        }
    }
}
