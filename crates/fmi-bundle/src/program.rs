//! The program that writes the FMUs of one model: `fn main() -> ExitCode { fmi_bundle::main::<MyModel>() }` in the package of the model.

use std::env;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use fmi_component::{Error, Export, Model, ModelType, Result, Version};

use crate::component::Component;
use crate::libraries::Libraries;
use crate::outputs::write_versions;

const USAGE: &str = "\
Writes the model as FMUs for FMI 2.0 and FMI 3.0 into the present folder.

  --fmi 2|3        that version alone
  --out FILE.fmu   file to write, with --fmi
  --library PATH   the library that exports the model, or a folder with those of several
                   systems; else the one that cargo built for this program
  --arrays         the elements of an array as one variable (FMI 3.0)
";

/// What the command line asks for.
#[derive(Debug, Default, PartialEq)]
struct Asked {
    version: Option<Version>,
    out: Option<PathBuf>,
    library: Option<PathBuf>,
    arrays: bool,
}

/// The `main` of a program that writes the FMUs of the model `M`. Its package makes a library too, which exports the model:
/// `crate-type = ["cdylib", "rlib"]` under `[lib]`. `cargo run --release` then does it all. Arguments: see `--help`.
pub fn main<M: Export>() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if arguments
        .iter()
        .any(|argument| argument == "--help" || argument == "-h")
    {
        print!("{USAGE}");
        return ExitCode::SUCCESS;
    }
    let asked = match Asked::read(&arguments) {
        Ok(asked) => asked,
        Err(error) => {
            eprintln!("error: {error}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    match write_all::<M>(&asked) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

impl Asked {
    fn read(arguments: &[String]) -> Result<Self> {
        let mut asked = Self::default();
        let mut rest = arguments.iter();
        while let Some(argument) = rest.next() {
            let mut value = || {
                rest.next()
                    .ok_or_else(|| Error::call(format!("{argument} has no value"), "Give one."))
            };
            match argument.as_str() {
                "--fmi" => {
                    asked.version = Some(match value()?.as_str() {
                        "2" => Version::Two,
                        "3" => Version::Three,
                        other => return Err(Error::parameter("--fmi", other, "2 or 3", "Choose one.")),
                    });
                }
                "--out" => asked.out = Some(value()?.into()),
                "--library" => asked.library = Some(value()?.into()),
                "--arrays" => asked.arrays = true,
                other => return Err(Error::call(format!("{other} has no meaning"), "See --help.")),
            }
        }
        match (&asked.out, asked.version) {
            (Some(out), None) => Err(Error::parameter(
                "--out",
                out.display(),
                "a file for one version of FMI",
                "Add --fmi 2 or --fmi 3.",
            )),
            _ => Ok(asked),
        }
    }
}

fn write_all<M: Export>(asked: &Asked) -> Result<()> {
    let mut component = Component::new(&ModelType::of::<M::Model>(), &[])?;
    component.arrays = asked.arrays;
    let identifier = component.info().identifier.to_string();
    let path = match &asked.library {
        Some(path) => path.clone(),
        None => built_library(M::LIBRARY, &M::Model::info().package.replace('-', "_"))?,
    };
    let libraries = match path.is_dir() {
        true => Libraries::from_folder(&path, &identifier)?,
        false => Libraries::from_file(&path)?,
    };
    let versions = match (asked.version, asked.arrays) {
        (Some(version), _) => vec![version],
        (None, true) => vec![Version::Three],
        (None, false) => vec![Version::Two, Version::Three],
    };
    for line in write_versions(&component, &versions, &libraries, asked.out.as_deref())? {
        println!("{line}");
    }
    Ok(())
}

/// The library that cargo has built together with this program, beside it: the same build writes both, so that it is never an old one.
fn built_library(of_crate: Option<&str>, of_package: &str) -> Result<PathBuf> {
    let program = env::current_exe().map_err(|error| {
        let what = format!("the folder of this program is not known: {error}");
        Error::call(what, "Name the library: --library PATH.")
    })?;
    let folder = program.parent().unwrap_or(Path::new("."));
    // An example or a test is one folder further down.
    let folders = [folder.join("deps"), folder.join("../deps"), folder.to_path_buf()];
    let names = of_crate.into_iter().chain([of_package]);
    let names: Vec<String> = names.map(|name| format!("{DLL_PREFIX}{name}{DLL_SUFFIX}")).collect();
    let paths = folders
        .iter()
        .flat_map(|folder| names.iter().map(|name| folder.join(name)));
    paths.into_iter().find(|path| path.is_file()).ok_or_else(|| {
        Error::file(
            &folders[0].join(&names[0]),
            "there is no such library beside this program",
            "Write crate-type = [\"cdylib\", \"rlib\"] under [lib] in Cargo.toml; or name the library: --library PATH.",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<Asked> {
        let words: Vec<String> = line.split_whitespace().map(String::from).collect();
        Asked::read(&words)
    }

    #[test]
    fn arguments_are_read_and_wrong_ones_refused_with_a_remedy() {
        let asked = read("--fmi 2 --out a.fmu --library lib --arrays").unwrap();
        let expected = Asked {
            version: Some(Version::Two),
            out: Some("a.fmu".into()),
            library: Some("lib".into()),
            arrays: true,
        };
        assert_eq!(asked, expected);
        for (line, words) in [
            ("--fmi 1", "2 or 3"),
            ("--fmi", "has no value"),
            ("--out a.fmu", "Add --fmi 2"),
            ("a.fmu", "See --help"),
        ] {
            let message = read(line).unwrap_err().to_string();
            assert!(message.contains(words), "{line}: {message}");
        }
    }
}
