//! The libraries of one model, one for each system. Which system a library is for is read from the library itself.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use fmi_component::{Error, Result, Version};

use crate::platform::Platform;

/// Libraries of one model by the system that each is for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Libraries {
    files: BTreeMap<Platform, (PathBuf, Vec<u8>)>,
}

impl Libraries {
    /// The library in the file `path`, and no other.
    ///
    /// # Errors
    /// As [`Libraries::add_file`].
    pub fn from_file(path: &Path) -> Result<Self> {
        let mut libraries = Self::default();
        libraries.add_file(path)?;
        Ok(libraries)
    }

    /// The libraries of the model `identifier` in `folder`, each in the folder of its platform: `x86_64-windows/IDENTIFIER.dll`,
    /// `aarch64-linux/IDENTIFIER.so` and so on, by the names of FMI 3.0. `libIDENTIFIER.so`, as cargo writes it, serves too.
    ///
    /// # Errors
    /// `folder` is missing or has no folder of a platform; a folder of a platform has no such library, or one for another
    /// system; a library lies in a folder that is not of a platform.
    pub fn from_folder(folder: &Path, identifier: &str) -> Result<Self> {
        let names = Platform::ALL.map(Platform::name).join(", ");
        let entries = fs::read_dir(folder).map_err(|error| {
            Error::file(
                folder,
                error,
                format!("Name a folder that holds one folder for each platform: {names}."),
            )
        })?;
        let mut libraries = Self::default();
        for entry in entries {
            let path = entry
                .map_err(|error| Error::file(folder, error, "Allow reading it."))?
                .path();
            let name = path
                .file_name()
                .map(|name| name.to_string_lossy().into_owned())
                .unwrap_or_default();
            match Platform::from_name(&name) {
                Some(platform) if path.is_dir() => libraries.add_of_platform(&path, platform, identifier)?,
                _ => refuse_strange_folder(&path, &names)?,
            }
        }
        match libraries.files.is_empty() {
            true => Err(Error::file(
                folder,
                "it has no folder of a platform",
                format!("Allowed names are {names}."),
            )),
            false => Ok(libraries),
        }
    }

    /// The library of `identifier` in `folder`, which is that of `platform`.
    fn add_of_platform(&mut self, folder: &Path, platform: Platform, identifier: &str) -> Result<()> {
        let names = ["", "lib"].map(|prefix| format!("{prefix}{identifier}{}", platform.suffix()));
        let Some(path) = names.iter().map(|name| folder.join(name)).find(|path| path.is_file()) else {
            let there = match libraries_in(folder).as_slice() {
                [] => "it holds no library".into(),
                found => format!("it holds {}, but not {}", found.join(", "), names[0]),
            };
            return Err(Error::file(
                folder,
                there,
                format!("Build the library of {identifier} for {platform}, or remove the folder."),
            ));
        };
        let found = self.add_file(&path)?;
        match found == platform {
            true => Ok(()),
            false => Err(Error::file(
                &path,
                format!("it is a library for {found} in the folder of {platform}"),
                "Move it to the folder of its own platform.",
            )),
        }
    }

    /// Adds the library in the file `path`; the platform that it is for.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Libraries::add`].
    pub fn add_file(&mut self, path: &Path) -> Result<Platform> {
        let bytes = fs::read(path).map_err(|error| cannot_read(path, &error))?;
        self.add(path, bytes)
    }

    /// Adds the library `bytes`, which errors call `path`; the platform that it is for.
    ///
    /// # Errors
    /// It is no shared library for a known system, or not the first one for its system.
    pub fn add(&mut self, path: &Path, bytes: Vec<u8>) -> Result<Platform> {
        let names = Platform::ALL.map(Platform::name).join(", ");
        let platform = Platform::of_library(&bytes)
            .map_err(|what| Error::file(path, what, format!("Name a shared library for one of {names}.")))?;
        if let Some((first, held)) = self.files.get(&platform)
            && *held != bytes
        {
            let what = format!("it is for {platform} as is {}, with other bytes", first.display());
            return Err(Error::file(path, what, "Give one library for each platform."));
        }
        self.files.insert(platform, (path.into(), bytes));
        Ok(platform)
    }

    /// The bytes of the library for `platform`.
    pub fn get(&self, platform: Platform) -> Option<&[u8]> {
        self.files.get(&platform).map(|(_, bytes)| bytes.as_slice())
    }

    /// The file of the library for `platform`.
    pub fn path(&self, platform: Platform) -> Option<&Path> {
        self.files.get(&platform).map(|(path, _)| path.as_path())
    }

    /// Platforms and bytes, in the order of [`Platform::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = (Platform, &[u8])> {
        self.files
            .iter()
            .map(|(platform, (_, bytes))| (*platform, bytes.as_slice()))
    }

    /// Platforms whose library does not fit into an FMU of `version`.
    pub fn left_out(&self, version: Version) -> Vec<Platform> {
        self.files
            .keys()
            .copied()
            .filter(|platform| platform.folder(version).is_none())
            .collect()
    }
}

/// Names of the libraries of any system in `folder`.
fn libraries_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut found: Vec<_> = names
        .filter(|name| Platform::ALL.iter().any(|platform| name.ends_with(platform.suffix())))
        .collect();
    found.sort();
    found
}

/// A folder whose name is misspelt would be passed over otherwise.
fn refuse_strange_folder(path: &Path, names: &str) -> Result<()> {
    match libraries_in(path).first() {
        None => Ok(()),
        Some(library) => Err(Error::file(
            path,
            format!("it holds {library}, but its name is not that of a platform"),
            format!("Allowed names are {names}."),
        )),
    }
}

fn cannot_read(library: &Path, error: &io::Error) -> Error {
    let remedy = match error.kind() {
        ErrorKind::NotFound => "Build it: cargo build --release --workspace, or name the file where it is.",
        ErrorKind::PermissionDenied => "Allow reading it.",
        _ => "Name the file of the library.",
    };
    Error::file(library, error, remedy)
}
