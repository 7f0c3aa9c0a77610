//! Scene, choice and library in, an `.fmu` file out. The same input gives the same bytes: fixed order, no date but that of the
//! component.
//!
//! What is inside:
//! ```text
//! modelDescription.xml
//! binaries/linux64/<identifier>.so          FMI 2.0
//! binaries/x86_64-linux/<identifier>.so     FMI 3.0
//! documentation/index.html, documentation/licenses/
//! extra/jostle/reference.csv                what it computes, for `jostle replay`
//! model.png                                 FMI 2.0
//! terminalsAndIcons/                        FMI 3.0: flange and icon
//! ```

use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::life_cycle::Version;
use super::{documentation, icon, model_description, reference, terminals, token};
use crate::error::{Error, Result};
use crate::scene::{Card, Choice, Scene, Variable};

pub(super) const MIT: &str = include_str!("../../LICENSE-MIT");
const APACHE: &str = include_str!("../../LICENSE-APACHE");
/// Of the crates that an FMU's library holds; written by `python -m jostle_lab notices`.
const THIRD_PARTY: &str = include_str!("../../LICENSE-THIRD-PARTY.txt");

/// A scene without its type: all that a bundle says about it.
#[derive(Debug, Clone)]
pub struct Component {
    /// Static facts.
    pub card: Card,
    /// What is decided now.
    pub choice: Choice,
    /// Variables for this choice.
    pub rows: Vec<Variable>,
    /// Whether the scene has events for event mode ([`Scene::EVENTS`]).
    pub events: bool,
    /// Computed variables with an index become arrays (FMI 3.0), see [`super::arrays`].
    pub arrays: bool,
    /// When the FMU was made, as `2026-11-24T06:00:00Z`; none where the same bytes are wanted each time.
    pub date: Option<String>,
    /// What each computed row depends on at first ([`Scene::initial_dependencies`]).
    pub initial_dependencies: fn(&str) -> Option<Vec<&'static str>>,
    /// Runs the scene for its reference trajectory.
    record: fn(Choice) -> Result<String>,
}

impl Component {
    /// The scene `S` with `choice`.
    ///
    /// # Errors
    /// A disk count that the scene does not allow.
    pub fn of<S: Scene>(choice: Choice) -> Result<Self> {
        let card = S::card();
        if !card.disks.contains(&choice.disks) {
            return Err(Error::parameter(
                "disks",
                choice.disks,
                format!("{} to {}", card.disks.start(), card.disks.end()),
                "Give a number in this range.",
            ));
        }
        let rows = S::variables(choice);
        Ok(Self {
            card,
            choice,
            rows,
            events: S::EVENTS,
            arrays: false,
            date: None,
            initial_dependencies: S::initial_dependencies,
            record: reference::record::<S>,
        })
    }

    /// Instantiation token (FMI 3.0) or GUID (FMI 2.0).
    pub fn token(&self) -> String {
        token::compose(&self.card, self.choice, &self.rows, self.arrays)
    }

    /// The reference trajectory, see [`mod@reference`].
    ///
    /// # Errors
    /// The table cannot be written.
    pub fn reference(&self) -> Result<String> {
        (self.record)(self.choice)
    }

    /// The `modelDescription.xml` of this component.
    pub fn model_description(&self, version: Version) -> String {
        model_description::write(self, version)
    }
}

/// The FMU library of `identifier` beside the running program, where cargo puts both.
///
/// # Errors
/// There is none.
pub fn find_library(identifier: &str) -> Result<PathBuf> {
    let program = std::env::current_exe().map_err(|error| {
        Error::call(
            format!("the running program cannot be found: {error}"),
            "Name the library.",
        )
    })?;
    let name = format!("{DLL_PREFIX}{identifier}{DLL_SUFFIX}");
    // Tests and examples run one folder below.
    let folders = program.ancestors().skip(1).take(2);
    let found = folders.map(|folder| folder.join(&name)).find(|path| path.is_file());
    found.ok_or_else(|| {
        let expected = program.with_file_name(&name);
        Error::file(
            &expected,
            "not found",
            "Build the FMU libraries: cargo build --release --workspace",
        )
    })
}

/// Writes the FMU of `component` for `version` to `out`, with the binary `library`.
///
/// # Errors
/// The library cannot be read or the FMU cannot be written.
pub fn write(component: &Component, version: Version, library: &Path, out: &Path) -> Result<()> {
    let binary = fs::read(library)
        .map_err(|error| Error::file(library, error, "Build it: cargo build --release --workspace"))?;
    let bytes = pack(component, version, &binary)?;
    // Beside the target and then renamed, so that nobody meets half an FMU.
    let partial = out.with_extension("fmu.part");
    fs::write(&partial, bytes)
        .and_then(|()| fs::rename(&partial, out))
        .map_err(|error| Error::file(out, error, "Choose a folder that exists and may be written to."))
}

/// The bytes of the FMU.
///
/// # Errors
/// Arrays in FMI 2.0, or the archive cannot be made.
pub fn pack(component: &Component, version: Version, binary: &[u8]) -> Result<Vec<u8>> {
    if component.arrays && version == Version::Two {
        return Err(Error::parameter(
            "--arrays",
            "with FMI 2.0",
            "FMI 3.0, since FMI 2.0 has no arrays",
            "Add --fmi 3 or leave --arrays out.",
        ));
    }
    let failed = |error: &dyn ToString| Error::call(format!("the archive: {}", error.to_string()), "Try again.");
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let plain = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    for (path, content) in files(component, version, binary)? {
        archive
            .start_file(path, plain.unix_permissions(0o644))
            .map_err(|error| failed(&error))?;
        archive.write_all(&content).map_err(|error| failed(&error))?;
    }
    let path = format!(
        "binaries/{}/{}{DLL_SUFFIX}",
        platform(version),
        component.card.identifier
    );
    archive
        .start_file(path, plain.unix_permissions(0o755))
        .map_err(|error| failed(&error))?;
    archive.write_all(binary).map_err(|error| failed(&error))?;
    Ok(archive.finish().map_err(|error| failed(&error))?.into_inner())
}

fn files(component: &Component, version: Version, binary: &[u8]) -> Result<Vec<(&'static str, Vec<u8>)>> {
    let license = format!(
        "SPDX-License-Identifier: {}\n\nThe texts are beside this file: LICENSE-MIT.txt, LICENSE-APACHE.txt.\n\
         Notices of the software inside the library: LICENSE-THIRD-PARTY.txt.\n",
        model_description::LICENSE
    );
    let mut list = vec![
        (
            "modelDescription.xml",
            component.model_description(version).into_bytes(),
        ),
        (
            "documentation/index.html",
            documentation::write(component, version, binary).into_bytes(),
        ),
        ("documentation/licenses/license.txt", license.into_bytes()),
        ("documentation/licenses/LICENSE-MIT.txt", MIT.into()),
        ("documentation/licenses/LICENSE-APACHE.txt", APACHE.into()),
        ("documentation/licenses/LICENSE-THIRD-PARTY.txt", THIRD_PARTY.into()),
        (reference::PATH, component.reference()?.into_bytes()),
    ];
    match version {
        Version::Two => list.push(("model.png", icon::png()?)),
        Version::Three => {
            list.push((
                "terminalsAndIcons/terminalsAndIcons.xml",
                terminals::write(&component.rows).into_bytes(),
            ));
            list.push(("terminalsAndIcons/icon.png", icon::png()?));
        }
    }
    Ok(list)
}

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
