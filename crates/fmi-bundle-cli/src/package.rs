//! Which package of a workspace, and which library of it, is to become an FMU.

use std::path::{Path, PathBuf};

use cargo_metadata::{CrateType, Metadata, MetadataCommand, Package, Target};
use fmi_bundle::{Error, Result};

/// What the command line says of it.
pub struct Wish<'a> {
    /// Name of the package.
    pub package: Option<&'a str>,
    /// Name of an example of it.
    pub example: Option<&'a str>,
    /// Path of a Cargo.toml.
    pub manifest: Option<&'a Path>,
}

/// A package with the library that is wanted.
pub struct Chosen {
    /// The package.
    pub package: Package,
    /// The library.
    pub target: Target,
    /// Folder of the workspace.
    pub workspace: PathBuf,
}

const CDYLIB: &str = "Write these lines into its Cargo.toml:\n\n[lib]\ncrate-type = [\"cdylib\", \"rlib\"]\n\nand fmi_component::export_fmu!(MyModel); into src/lib.rs";

impl Chosen {
    /// The one that is meant.
    ///
    /// # Errors
    /// No Cargo.toml, no such package, none or several packages with a cdylib where none is named.
    pub fn find(wish: &Wish) -> Result<Self> {
        let mut command = MetadataCommand::new();
        command.no_deps();
        if let Some(manifest) = wish.manifest {
            command.manifest_path(manifest);
        }
        let metadata = command.exec().map_err(|error| {
            let place = wish.manifest.unwrap_or(Path::new("Cargo.toml"));
            let said = error.to_string();
            let said = said.split_once("error: ").map_or(said.as_str(), |(_, rest)| rest);
            Error::file(
                place,
                said.trim().trim_end_matches('.'),
                "Go into the folder of a crate, or name its Cargo.toml by --manifest-path.",
            )
        })?;
        let package = choose(&metadata, wish)?.clone();
        let target = library(&package, wish.example)?.clone();
        Ok(Self {
            package,
            target,
            workspace: metadata.workspace_root.into_std_path_buf(),
        })
    }
}

fn choose<'a>(metadata: &'a Metadata, wish: &Wish) -> Result<&'a Package> {
    let members = metadata.workspace_packages();
    let names = |list: &[&Package]| {
        list.iter()
            .map(|package| package.name.to_string())
            .collect::<Vec<_>>()
            .join(", ")
    };
    if let Some(name) = wish.package {
        let found = members.iter().find(|package| package.name.as_str() == name);
        return found.copied().ok_or_else(|| {
            let allowed = format!(
                "a package of the workspace {}: {}",
                metadata.workspace_root,
                names(&members)
            );
            Error::parameter("--package", name, allowed, "Name one of these.")
        });
    }
    // The package that the present folder is in, as cargo build takes it.
    let here = manifest_here(wish.manifest);
    let in_here = members
        .iter()
        .find(|package| here.as_deref() == package.manifest_path.as_std_path().canonicalize().ok().as_deref());
    if let Some(package) = in_here {
        return Ok(package);
    }
    let fit: Vec<&Package> = members
        .iter()
        .copied()
        .filter(|package| library(package, wish.example).is_ok())
        .collect();
    match fit.as_slice() {
        [package] => Ok(package),
        [] => Err(Error::file(
            metadata.workspace_root.as_std_path(),
            format!(
                "no package of this workspace has a library of type cdylib; its packages are {}",
                names(&members)
            ),
            CDYLIB.replace("its Cargo.toml", "the Cargo.toml of one") + ".",
        )),
        several => Err(Error::parameter(
            "--package",
            "nothing",
            format!("one of the packages with a library of type cdylib: {}", names(several)),
            "Name one of these.",
        )),
    }
}

/// The Cargo.toml that cargo would take, without links in its path.
fn manifest_here(given: Option<&Path>) -> Option<PathBuf> {
    match given {
        Some(manifest) => manifest.canonicalize().ok(),
        None => {
            let folder = std::env::current_dir().ok()?;
            let paths = folder.ancestors().map(|folder| folder.join("Cargo.toml"));
            paths.into_iter().find(|path| path.is_file())?.canonicalize().ok()
        }
    }
}

fn library<'a>(package: &'a Package, example: Option<&str>) -> Result<&'a Target> {
    let is_shared = |target: &&Target| target.crate_types.contains(&CrateType::CDyLib);
    let manifest = package.manifest_path.as_std_path();
    let Some(name) = example else {
        let found = package
            .targets
            .iter()
            .find(|target| is_shared(target) && !target.is_example());
        return found.ok_or_else(|| {
            let what = match package.targets.iter().find(|target| target.is_lib()) {
                Some(_) => format!(
                    "the library of package {} is not of type cdylib, which an FMU holds",
                    package.name
                ),
                None => format!(
                    "package {} has no library of type cdylib, which an FMU holds",
                    package.name
                ),
            };
            Error::file(manifest, what, format!("{CDYLIB}."))
        });
    };
    let shared: Vec<&Target> = package
        .targets
        .iter()
        .filter(is_shared)
        .filter(|target| target.is_example())
        .collect();
    shared
        .iter()
        .find(|target| target.name == name)
        .copied()
        .ok_or_else(|| {
            let names: Vec<&str> = shared.iter().map(|target| target.name.as_str()).collect();
            let allowed = match names.as_slice() {
                [] => format!(
                    "an example of package {} that is a cdylib, of which there is none",
                    package.name
                ),
                names => format!("one of package {}: {}", package.name, names.join(", ")),
            };
            let remedy = format!("Name one of these, or add: [[example]] name = \"{name}\" crate-type = [\"cdylib\"].");
            Error::parameter("--example", name, allowed, remedy)
        })
}
