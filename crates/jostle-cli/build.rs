//! Tells the program which compiler built it, for the data sheets of the FMUs that it writes.

use std::process::Command;

fn main() {
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let answer = Command::new(compiler).arg("--version").output();
    let version = answer.ok().and_then(|answer| String::from_utf8(answer.stdout).ok());
    println!("cargo:rustc-env=JOSTLE_COMPILER={}", version.unwrap_or_default().trim());
    println!("cargo:rerun-if-changed=build.rs");
}
