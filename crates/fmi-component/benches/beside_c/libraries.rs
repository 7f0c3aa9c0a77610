//! Where the two libraries come from: cargo builds the example, the C compiler the file beside this one.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Folder with `fmi2Functions.h` and `fmi3Functions.h`: that of `FMI_HEADERS`, or fmpy's in the environment that `scripts/setup` makes.
pub fn headers() -> Result<PathBuf, String> {
    let named = std::env::var_os("FMI_HEADERS").map(PathBuf::from);
    let packages = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../.venv/lib");
    let pythons = packages.read_dir().into_iter().flatten().flatten();
    let fmpy = pythons.map(|python| python.path().join("site-packages/fmpy/c-code"));
    let mut folders = named.into_iter().chain(fmpy);
    folders
        .find(|folder| folder.join("fmi2Functions.h").is_file() && folder.join("fmi3Functions.h").is_file())
        .ok_or_else(|| {
            "no fmi2Functions.h and fmi3Functions.h found. Set FMI_HEADERS to their folder, or run scripts/setup".into()
        })
}

/// The model in C, optimised as far as compilers do without changing results.
pub fn in_c() -> Result<PathBuf, String> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/beside_c/ten_reals.c");
    let library = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("ten_reals_{}.so", std::process::id()));
    let mut compiler = Command::new("cc");
    compiler.args(["-O3", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-I"]);
    compiler.arg(headers()?).arg(source).arg("-o").arg(&library).arg("-lm");
    run(&mut compiler)?;
    Ok(library)
}

/// File of the model in Rust, in a folder of cargo's.
pub fn in_rust(examples: &Path) -> PathBuf {
    examples.join(format!(
        "{}ten_reals{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    ))
}

/// Runs a program that must succeed.
pub fn run(command: &mut Command) -> Result<String, String> {
    let done = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    match done.status.success() {
        true => Ok(String::from_utf8_lossy(&done.stdout).into_owned()),
        false => Err(format!("{command:?}: {}", String::from_utf8_lossy(&done.stderr))),
    }
}
