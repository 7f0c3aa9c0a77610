//! What the Cargo.toml of a package says of its authors and licence, for the FMU.

use std::fs;
use std::path::PathBuf;

use fmi_bundle::{Notices, Origin};

use crate::cargo::compiler;
use crate::package::Chosen;

/// Beginnings of the names of files with licences and notices.
const LICENCES: [&str; 5] = ["LICENSE", "LICENCE", "COPYING", "NOTICE", "COPYRIGHT"];

/// Licence, copyright and texts: the `license-file`, else the files of such names in the folder of the package, else those in the folder of
/// the workspace.
pub fn notices(chosen: &Chosen) -> Notices {
    let package = &chosen.package;
    let folder = package
        .manifest_path
        .parent()
        .map(|folder| folder.as_std_path().to_path_buf())
        .unwrap_or_default();
    let named = package.license_file().map(|path| vec![path.into_std_path_buf()]);
    let paths = named.unwrap_or_else(|| match licences_in(folder) {
        found if found.is_empty() => licences_in(chosen.workspace.clone()),
        found => found,
    });
    let mut files = Vec::new();
    for path in paths {
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned())
            .unwrap_or_default();
        match fs::read_to_string(&path) {
            Ok(text) => files.push((name, text)),
            Err(error) => eprintln!("warning: {}: {error}: the FMU lacks it.", path.display()),
        }
    }
    let copyright = files
        .iter()
        .flat_map(|(_, text)| text.lines())
        .map(str::trim)
        .find(|line| line.starts_with("Copyright (c)"));
    Notices {
        license: package.license.clone().unwrap_or_default(),
        copyright: copyright.unwrap_or_default().into(),
        files,
    }
}

fn licences_in(folder: PathBuf) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path());
    let is_licence = |path: &PathBuf| {
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().to_uppercase())
            .unwrap_or_default();
        path.is_file() && LICENCES.iter().any(|beginning| name.starts_with(beginning))
    };
    let mut found: Vec<PathBuf> = entries.filter(is_licence).collect();
    found.sort();
    found
}

/// Authors and addresses.
pub fn origin(chosen: &Chosen) -> Origin {
    let package = &chosen.package;
    Origin {
        authors: package.authors.join(", "),
        repository: package.repository.clone().unwrap_or_default(),
        contact: package.homepage.clone().unwrap_or_default(),
        tools: compiler(),
        changes: String::new(),
    }
}
