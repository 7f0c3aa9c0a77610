//! Libraries of several systems in one FMU: each in the folder that its header says, under the names of each standard.

#![allow(clippy::unwrap_used)]

mod support;

use std::fs;
use std::io::Cursor;
use std::path::Path;

use fmi_bundle::{Libraries, Platform, Version, pack, write};
use support::{component, fakes, folder, libraries};
use zip::ZipArchive;

/// Paths in `binaries/` with their permissions.
fn binaries(fmu: Vec<u8>) -> Vec<(String, u32)> {
    let mut archive = ZipArchive::new(Cursor::new(fmu)).unwrap();
    let mut found = Vec::new();
    for index in 0..archive.len() {
        let entry = archive.by_index(index).unwrap();
        let path = entry.name().unwrap().into_owned();
        match path.starts_with("binaries/") {
            true => found.push((path, entry.unix_mode().unwrap() & 0o777)),
            false => assert_eq!(entry.unix_mode().unwrap() & 0o777, 0o644, "{path}"),
        }
    }
    found
}

#[test]
fn each_library_is_in_the_folder_of_its_system_and_may_be_executed() {
    let all = fakes::libraries(&Platform::ALL);
    let three = binaries(pack(&component(), Version::Three, &all).unwrap());
    let expected = [
        "x86_64-linux/oscillators.so",
        "aarch64-linux/oscillators.so",
        "x86_64-windows/oscillators.dll",
        "aarch64-windows/oscillators.dll",
        "x86_64-darwin/oscillators.dylib",
        "aarch64-darwin/oscillators.dylib",
    ];
    assert_eq!(three, expected.map(|path| (format!("binaries/{path}"), 0o755)));
    let two = binaries(pack(&component(), Version::Two, &all).unwrap());
    let expected = [
        "linux64/oscillators.so",
        "win64/oscillators.dll",
        "darwin64/oscillators.dylib",
    ];
    assert_eq!(two, expected.map(|path| (format!("binaries/{path}"), 0o755)));
    assert_eq!(
        all.left_out(Version::Two),
        [Platform::ArmLinux, Platform::ArmWindows, Platform::ArmDarwin]
    );
    assert_eq!(all.left_out(Version::Three), []);
}

#[test]
fn an_fmu_without_a_library_is_refused() {
    let refused = |libraries: &Libraries, version| pack(&component(), version, libraries).unwrap_err().to_string();
    let message = refused(&Libraries::default(), Version::Three);
    assert!(
        message.contains("an FMU needs a library, and there is none. Add"),
        "{message}"
    );
    let message = refused(&fakes::libraries(&[Platform::ArmLinux]), Version::Two);
    assert!(message.contains("FMI 2.0 has no folder for aarch64-linux"), "{message}");
    let foreign = fakes::libraries(&[Platform::X86Windows, Platform::ArmLinux]);
    let message = write(&component(), Version::Three, &foreign, Path::new("never.fmu"))
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("no library for this system, ") && message.contains("none can be run"),
        "{message}"
    );
}

#[test]
fn what_is_no_shared_library_for_a_known_system_is_refused_by_what_it_is() {
    let mut riscv = fakes::library(Platform::X86Linux, "");
    riscv[18] = 243; // RISC-V
    for (bytes, what) in [
        (b"#!/bin/sh\n".to_vec(), "it is no library"),
        (b"\x7fELF".to_vec(), "it is no library"),
        (fakes::elf(62, 2), "it is no shared library but of kind Executable"),
        (riscv, "it is a library for Riscv64 in the format Elf"),
        (
            [&b"\xca\xfe\xba\xbe\0\0\0\x02"[..], &[0; 40]].concat(),
            "universal library of macOS",
        ),
    ] {
        let message = Libraries::default()
            .add("some.so".as_ref(), bytes)
            .unwrap_err()
            .to_string();
        assert!(message.starts_with("some.so: ") && message.contains(what), "{message}");
    }
}

#[test]
fn a_folder_gives_the_libraries_of_its_platforms() {
    let folder = folder("libraries");
    let place = |path: &str, bytes: Vec<u8>| {
        let file = folder.join(path);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, bytes).unwrap();
    };
    place(
        "x86_64-windows/oscillators.dll",
        fakes::library(Platform::X86Windows, ""),
    );
    place(
        "aarch64-linux/liboscillators.so",
        fakes::library(Platform::ArmLinux, ""),
    );
    place("fmu/other.fmu", b"passed over".into());
    place("README", b"passed over".into());
    let mut found = Libraries::from_folder(&folder, "oscillators").unwrap();
    assert_eq!(found, {
        let mut expected = Libraries::default();
        expected
            .add_file(&folder.join("x86_64-windows/oscillators.dll"))
            .unwrap();
        expected
            .add_file(&folder.join("aarch64-linux/liboscillators.so"))
            .unwrap();
        expected
    });
    // With the library of this system among them the FMU is written, and that one was run.
    let (host, real) = (Platform::host().unwrap(), libraries());
    found.add("real".as_ref(), real.get(host).unwrap().to_vec()).unwrap();
    write(&component(), Version::Three, &found, &folder.join("a.fmu")).unwrap();
    assert_eq!(binaries(fs::read(folder.join("a.fmu")).unwrap()).len(), 3);
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_folder_with_something_else_is_refused_by_name() {
    let folder = folder("libraries refused");
    let refused = |path: &str, bytes: &[u8]| {
        let root = folder.join(path.split('/').next().unwrap());
        let file = folder.join(path);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(&file, bytes).unwrap();
        Libraries::from_folder(&root, "oscillators").unwrap_err().to_string()
    };
    let message = Libraries::from_folder(&folder.join("missing"), "oscillators")
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("missing: ") && message.contains("one folder for each platform: x86_64-linux,"),
        "{message}"
    );
    let message = refused("empty/README", b"");
    assert!(message.contains("empty: it has no folder of a platform"), "{message}");
    let message = refused("none/aarch64-linux/README", b"");
    assert!(
        message.contains("aarch64-linux: it holds no library. Build the library of oscillators for aarch64-linux"),
        "{message}"
    );
    let message = refused(
        "other/x86_64-windows/pendulum.dll",
        &fakes::library(Platform::X86Windows, ""),
    );
    assert!(
        message.contains("it holds pendulum.dll, but not oscillators.dll"),
        "{message}"
    );
    let message = refused(
        "swapped/x86_64-linux/oscillators.so",
        &fakes::library(Platform::ArmLinux, ""),
    );
    assert!(
        message.contains("it is a library for aarch64-linux in the folder of x86_64-linux"),
        "{message}"
    );
    let message = refused(
        "misspelt/x86-64-linux/oscillators.so",
        &fakes::library(Platform::X86Linux, ""),
    );
    assert!(
        message.contains("x86-64-linux: it holds oscillators.so, but its name is not that of a platform"),
        "{message}"
    );
    let mut two = fakes::libraries(&[Platform::X86Linux]);
    let message = two
        .add("second.so".as_ref(), fakes::library(Platform::X86Linux, "other"))
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("second.so: it is for x86_64-linux as is x86_64-linux, with other bytes"),
        "{message}"
    );
    fs::remove_dir_all(&folder).unwrap();
}
