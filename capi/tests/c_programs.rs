//! C programs against the header and the library: compiled with every warning an error, linked statically and
//! dynamically, run, and checked by valgrind where that is installed.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::Command;

use jostle::scene::Simulation;
use jostle::scene::packing::PackingOnInput;

/// Where cargo put this test and the libraries beside it.
fn built() -> PathBuf {
    std::env::current_exe().unwrap().parent().unwrap().to_owned()
}

fn run(command: &mut Command) -> String {
    let done = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let (out, errors) = (
        String::from_utf8_lossy(&done.stdout),
        String::from_utf8_lossy(&done.stderr),
    );
    assert!(done.status.success(), "{command:?}: {}\n{out}{errors}", done.status);
    out.into_owned()
}

/// Compiles `source` and links it with the shared (`so`) or static (`a`) library.
fn compile(source: &str, library: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let stem = Path::new(source).file_stem().unwrap().to_str().unwrap();
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{stem}_{library}"));
    let mut cc = Command::new("cc");
    cc.args([
        "-std=c11",
        "-O1",
        "-g",
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Werror",
        "-I",
    ]);
    cc.arg(folder.join("../include"))
        .arg(folder.join(source))
        .arg("-o")
        .arg(&program);
    cc.arg(built().join(format!("libjostle_c.{library}")))
        .args(["-lm", "-lpthread", "-ldl"]);
    cc.arg(format!("-Wl,-rpath,{}", built().display()));
    run(&mut cc);
    program
}

#[test]
fn every_function_answers_as_the_header_says() {
    for library in ["so", "a"] {
        assert_eq!(run(&mut Command::new(compile("tests/every_function.c", library))), "");
    }
}

#[test]
fn valgrind_finds_nothing() {
    if Command::new("valgrind").arg("--version").output().is_err() {
        eprintln!("left out: valgrind is not installed");
        return;
    }
    let mut valgrind = Command::new("valgrind");
    valgrind.args([
        "--quiet",
        "--error-exitcode=9",
        "--leak-check=full",
        "--show-leak-kinds=all",
    ]);
    run(valgrind
        .arg("--errors-for-leak-kinds=all")
        .arg(compile("tests/every_function.c", "so")));
}

#[test]
fn the_example_prints_the_bits_of_the_crate() {
    let printed = run(&mut Command::new(compile("examples/shaken_packing.c", "so")));
    let mut packing = Simulation::<PackingOnInput>::new(&[("disks", 60)], &[("seed", 1.into())]).unwrap();
    let omega = 2.0 * std::f64::consts::PI * 20.0;
    for n in 0..1024 {
        let time = f64::from(n) / 512.0;
        packing
            .set("base.displacement", 1e-3 * (1.0 - (omega * time).cos()))
            .unwrap();
        packing
            .set("base.velocity", 1e-3 * omega * (omega * time).sin())
            .unwrap();
        packing.advance_to(time + 1.0 / 512.0).unwrap();
    }
    let angle = packing.real("disk.angle[1]").unwrap();
    let line = printed.lines().next().unwrap();
    let observed: f64 = line.split_whitespace().nth(4).unwrap().parse().unwrap();
    assert_eq!(observed, angle, "{printed}");
}

#[test]
fn the_header_serves_a_cpp_compiler() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    if Command::new("c++").arg("--version").output().is_err() {
        eprintln!("left out: there is no C++ compiler");
        return;
    }
    let mut cpp = Command::new("c++");
    cpp.args([
        "-std=c++17",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-fsyntax-only",
        "-x",
        "c++",
    ]);
    run(cpp.arg(folder.join("../include/jostle.h")));
}
