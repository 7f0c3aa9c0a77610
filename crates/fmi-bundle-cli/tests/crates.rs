//! Crates become FMUs that pass their check and their replay; what cannot become one is refused with the remedy.
//!
//! The crates are those of a stranger: a workspace of its own, in a folder with a space in its name, with two models.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const MODEL: &str = r#"
use fmi_component::{CoSimulation, Component, Result, Step};

/// Exponential growth.
#[derive(Component)]
pub struct NAME {
    /// Rate.
    #[parameter(start = 1.0, min = 0.0, max = 1e3, unit = "1/s")]
    k: f64,
    /// What is changed.
    #[output(start = 1.0)]
    x: f64,
}

impl CoSimulation for NAME {
    fn initialize(&mut self, _: f64) -> Result<()> {
        INITIALIZE
    }

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        self.x *= (SIGN self.k * step.size()).exp();
        Ok(())
    }
}

EXPORT
"#;

/// The workspace, made anew, with the versions of crates that this workspace has.
fn workspace() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("my models");
    let _ = fs::remove_dir_all(&folder);
    let write = |path: &str, text: String| {
        let path = folder.join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let members = "growth\", \"decay\", \"panics\", \"silent\", \"plain";
    write(
        "Cargo.toml",
        format!("[workspace]\nmembers = [\"{members}\"]\nresolver = \"3\"\n"),
    );
    write("Cargo.lock", fs::read_to_string(here.join("../../Cargo.lock")).unwrap());
    write("LICENSE", "Copyright (c) 2026 A. Author\n\nAll rights.\n".into());
    let component = here.join("../fmi-component").canonicalize().unwrap();
    let export = "fmi_component::export_fmu!(NAME);";
    for (package, name, sign, initialize, export) in [
        ("growth", "Growth", "", "Ok(())", export),
        ("decay", "Decay", "-", "Ok(())", export),
        ("panics", "Panics", "", "panic!(\"x is {}\", self.x)", export),
        ("silent", "Silent", "", "Ok(())", ""),
    ] {
        let manifest = format!(
            "[package]\nname = \"{package}\"\nversion = \"0.3.0\"\nedition = \"2024\"\nlicense = \"MIT\"\nauthors = [\"A. Author\"]\n\n\
             [lib]\ncrate-type = [\"cdylib\"]\n\n[dependencies]\nfmi-component = {{ path = {component:?} }}\n"
        );
        write(&format!("{package}/Cargo.toml"), manifest);
        let text = MODEL.replace("EXPORT", export).replace("INITIALIZE", initialize);
        write(
            &format!("{package}/src/lib.rs"),
            text.replace("NAME", name).replace("SIGN", sign),
        );
    }
    write(
        "plain/Cargo.toml",
        "[package]\nname = \"plain\"\nversion = \"0.1.0\"\nedition = \"2024\"\n".into(),
    );
    write("plain/src/main.rs", "fn main() {}\n".into());
    folder
}

struct Said {
    success: bool,
    output: String,
    errors: String,
}

fn run(program: &str, folder: &Path, words: &[&str]) -> Said {
    let mut command = Command::new(program);
    command.current_dir(folder).args(words).env_remove("RUST_BACKTRACE");
    let done = command.output().unwrap();
    Said {
        success: done.status.success(),
        output: String::from_utf8(done.stdout).unwrap(),
        errors: String::from_utf8(done.stderr).unwrap(),
    }
}

const PROGRAM: &str = env!("CARGO_BIN_EXE_fmu-bundle");
const PLUGIN: &str = env!("CARGO_BIN_EXE_cargo-fmu-bundle");

/// One test, since there is one folder for what cargo compiles.
#[test]
fn crates_become_fmus_or_are_refused_with_the_remedy() {
    let folder = workspace();
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("built");
    let build = |words: &[&str]| {
        let start = ["build", "--profile", "dev", "--target-dir", target.to_str().unwrap()];
        run(PROGRAM, &folder, &[&start, words, &["--", "--offline"]].concat())
    };
    let made = build(&["-p", "growth", "--out", "fmus/"]);
    assert!(made.success, "{}", made.errors);
    for version in [2, 3] {
        let file = format!("fmus/Growth.fmi{version}.fmu");
        assert!(
            made.output
                .contains(&format!("Growth.fmi{version}.fmu: FMI {version}.0 for ")),
            "{}",
            made.output
        );
        let checked = run(PROGRAM, &folder, &["check", &file]);
        assert!(
            checked.success && checked.output.contains("no faults"),
            "{}{}",
            checked.output,
            checked.errors
        );
        // As cargo calls its plugins.
        let replayed = run(PLUGIN, &folder, &["fmu-bundle", "replay", &file, "--exact"]);
        assert!(
            replayed.success && replayed.output.contains("97 values at 97 times, 0 differ"),
            "{}",
            replayed.errors
        );
        assert_eq!(run(PROGRAM, &folder, &["replay", &file]).output, replayed.output);
    }
    // x = exp(t) at the start and after a second, against the library.
    let exact = |x: f64| format!("time,x\n0,1\n1,{x}\n");
    for (name, x, success) in [("true.csv", std::f64::consts::E, true), ("false.csv", 2.7, false)] {
        fs::write(folder.join(name), exact(x)).unwrap();
        let replayed = run(
            PROGRAM,
            &folder,
            &["replay", "fmus/Growth.fmi3.fmu", "--reference", name],
        );
        assert_eq!(
            replayed.success, success,
            "{name}: {}{}",
            replayed.output, replayed.errors
        );
    }
    // The library alone, and from inside of the package.
    let library = target.join("debug").join(format!(
        "{}growth{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    ));
    let packed = run(
        PROGRAM,
        &folder,
        &["pack", library.to_str().unwrap(), "--fmi", "3", "--out", "alone.fmu"],
    );
    assert!(
        packed.success && packed.output.starts_with("alone.fmu: FMI 3.0 for"),
        "{}",
        packed.errors
    );

    let (root, plain) = (folder.join("Cargo.toml"), folder.join("plain/Cargo.toml"));
    for (words, what) in [
        (
            &[][..],
            "one of the packages with a library of type cdylib: growth, decay, panics, silent. Name one",
        ),
        (
            &["-p", "none"],
            "--package = none is not allowed: a package of the workspace",
        ),
        (
            &["--manifest-path", plain.to_str().unwrap()],
            "crate-type = [\"cdylib\", \"rlib\"]",
        ),
        (
            &["--manifest-path", "nowhere/Cargo.toml"],
            "name its Cargo.toml by --manifest-path",
        ),
        (
            &[
                "--manifest-path",
                root.to_str().unwrap(),
                "-p",
                "growth",
                "--example",
                "e",
            ],
            "an example of package growth that is a cdylib",
        ),
        (
            &["-p", "silent"],
            "has no function fmi_component_describe. Write fmi_component::export_fmu!(MyModel);",
        ),
        (
            &["-p", "panics"],
            "the reference trajectory: internal defect, please report it: x is 1. The model has to be mended.",
        ),
        (
            &["-p", "growth", "--out", "a.fmu"],
            "a.fmu: it is no folder, and there is an FMU for each version",
        ),
        (
            &["-p", "growth", "--fmi", "3", "--out", "no/where/a.fmu"],
            "the folder no/where does not exist. Create it",
        ),
        (
            &["-p", "growth", "--fmi", "2", "--arrays"],
            "FMI 2.0 has no array variables",
        ),
        (
            &["-p", "growth", "--structure", "n=3"],
            "structural parameter = n is not allowed",
        ),
        (&["-p", "growth", "--target", "moon"], "rustc knows no system moon"),
    ] {
        let refused = build(words);
        assert!(
            !refused.success && refused.errors.contains(what),
            "{words:?}: {}",
            refused.errors
        );
        assert!(!folder.join("a.fmu").exists());
    }
    // A library of another model in the FMU.
    let other = build(&["-p", "decay", "--fmi", "3", "--out", "decay.fmu"]);
    assert!(other.success, "{}", other.errors);
    let merged = run(
        PROGRAM,
        &folder,
        &["merge", "alone.fmu", "decay.fmu", "--out", "both.fmu"],
    );
    assert!(
        !merged.success && merged.errors.contains("the model identifier is \"Decay\""),
        "{}",
        merged.errors
    );
}
