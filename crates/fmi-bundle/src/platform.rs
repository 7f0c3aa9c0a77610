//! Where the binary of this platform is in an FMU.

use std::env::consts::{ARCH, OS};

use fmi_component::Version;

/// Folder of the binary as each standard names this platform.
pub fn platform(version: Version) -> String {
    match (version, OS) {
        (Version::Two, "linux") => "linux64".into(),
        (Version::Two, "macos") => "darwin64".into(),
        (Version::Two, "windows") => "win64".into(),
        (Version::Three, "macos") => format!("{ARCH}-darwin"),
        (_, system) => format!("{ARCH}-{system}"),
    }
}
