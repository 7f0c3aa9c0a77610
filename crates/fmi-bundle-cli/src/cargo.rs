//! A build by cargo: the library that it makes. What the compiler says goes to standard error as it comes.

use std::env;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use cargo_metadata::Message;
use clap::Args;
use fmi_bundle::{Error, Platform, Result};

use crate::package::Chosen;

/// What goes on to cargo.
#[derive(Args)]
pub struct Options {
    /// Profile of the build.
    #[arg(long, value_name = "NAME", default_value = "release")]
    profile: String,
    /// Build with the profile release, as without this option.
    #[arg(short, long, conflicts_with = "profile")]
    release: bool,
    /// Features of the package.
    #[arg(short = 'F', long, value_name = "FEATURES")]
    features: Vec<String>,
    /// All features of the package.
    #[arg(long)]
    all_features: bool,
    /// Without the default features of the package.
    #[arg(long)]
    no_default_features: bool,
    /// Folder for what cargo makes.
    #[arg(long, value_name = "FOLDER")]
    target_dir: Option<PathBuf>,
    /// More arguments for cargo build, after --.
    #[arg(last = true, value_name = "ARGUMENTS OF CARGO BUILD")]
    more: Vec<String>,
}

/// Builds the library that is `chosen`, for the system `triple` or else for this one; its file.
///
/// # Errors
/// Cargo fails, or makes no shared library.
pub fn build(chosen: &Chosen, options: &Options, triple: Option<&str>) -> Result<PathBuf> {
    let mut command = command(chosen, options, triple);
    let name = command.get_program().to_string_lossy().into_owned();
    let failed = |error: std::io::Error| {
        Error::call(
            format!("{name} does not run: {error}"),
            "Install Rust: https://rustup.rs.",
        )
    };
    let mut child = command.spawn().map_err(failed)?;
    let mut files = Vec::new();
    if let Some(output) = child.stdout.take() {
        for message in Message::parse_stream(BufReader::new(output)) {
            match message.map_err(failed)? {
                Message::CompilerArtifact(artifact)
                    if artifact.package_id == chosen.package.id && artifact.target.name == chosen.target.name =>
                {
                    files.extend(artifact.filenames.into_iter().map(PathBuf::from));
                }
                Message::TextLine(line) => println!("{line}"),
                _ => {}
            }
        }
    }
    let status = child.wait().map_err(failed)?;
    let what = match triple {
        Some(triple) => format!("{} for {triple}", chosen.package.name),
        None => chosen.package.name.to_string(),
    };
    if !status.success() {
        return Err(Error::call(
            format!("cargo could not build {what} ({status})"),
            remedy(triple),
        ));
    }
    let shared = |path: &PathBuf| {
        Platform::ALL
            .iter()
            .any(|platform| path.to_string_lossy().ends_with(platform.suffix()))
    };
    files.iter().find(|path| shared(path)).cloned().ok_or_else(|| {
        let made: Vec<_> = files.iter().map(|path| path.display().to_string()).collect();
        let what = format!("cargo made no shared library of {what}, but {}", made.join(", "));
        let names = Platform::ALL.map(Platform::name).join(", ");
        Error::call(
            what,
            format!("An FMU holds libraries for {names}: build for one of these."),
        )
    })
}

fn command(chosen: &Chosen, options: &Options, triple: Option<&str>) -> Command {
    // Set by cargo for its plugins.
    let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(program);
    command.args(["build", "--message-format=json-render-diagnostics", "--manifest-path"]);
    command.arg(&chosen.package.manifest_path);
    command.args(["--package", &chosen.package.id.repr, "--profile", &options.profile]);
    match chosen.target.is_example() {
        true => command.args(["--example", &chosen.target.name]),
        false => command.arg("--lib"),
    };
    for feature in &options.features {
        command.args(["--features", feature]);
    }
    command.args(options.all_features.then_some("--all-features"));
    command.args(options.no_default_features.then_some("--no-default-features"));
    if let Some(folder) = &options.target_dir {
        command.arg("--target-dir").arg(folder);
    }
    if let Some(triple) = triple {
        command.args(["--target", triple]);
    }
    command.args(&options.more).stdout(Stdio::piped());
    command
}

/// What to do about a build that failed: of a target that is not installed, to install it.
fn remedy(triple: Option<&str>) -> String {
    const MEND: &str = "Mend what the compiler says above.";
    let Some(triple) = triple else { return MEND.into() };
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let asked = Command::new(rustc)
        .args(["--print", "target-libdir", "--target", triple])
        .stderr(Stdio::null())
        .output();
    match asked {
        Ok(output) if output.status.success() => {
            let folder = String::from_utf8_lossy(&output.stdout).trim().to_string();
            match Path::new(&folder).is_dir() {
                true => {
                    format!("{MEND} A linker for {triple} is needed too: see `linker` in the configuration of cargo.")
                }
                false => {
                    format!("Rust's standard library for {triple} is not installed here: rustup target add {triple}.")
                }
            }
        }
        _ => format!("rustc knows no system {triple}: rustc --print target-list names those that it knows."),
    }
}

/// The version of the compiler in one line.
pub fn compiler() -> String {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let asked = Command::new(rustc).arg("--version").output();
    let text = asked.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_string());
    text.unwrap_or_default()
}
