//! FMUs of two systems become one; those that do not belong together are refused by what differs.

#![allow(unsafe_code, clippy::unwrap_used)]

#[path = "../../fmi-bundle/tests/support/mod.rs"]
mod support;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use fmi_bundle::{Component, Libraries, Platform, Version, pack};
use support::{MODEL, component, fakes, folder};

fn merged(parts: &[&Path], out: &Path) -> Result<String, String> {
    let mut program = Command::new(env!("CARGO_BIN_EXE_fmu-bundle"));
    let done = program.arg("merge").args(parts).arg("--out").arg(out).output().unwrap();
    match done.status.success() {
        true => Ok(String::from_utf8(done.stdout).unwrap()),
        false => Err(String::from_utf8(done.stderr).unwrap()),
    }
}

fn written(folder: &Path, name: &str, component: &Component, libraries: &Libraries) -> PathBuf {
    let file = folder.join(name);
    fs::write(&file, pack(component, Version::Three, libraries).unwrap()).unwrap();
    file
}

#[test]
fn fmus_of_different_systems_become_the_fmu_that_all_libraries_make() {
    let folder = folder("merge");
    let systems = [Platform::X86Linux, Platform::X86Windows, Platform::ArmDarwin];
    let mut dated = component();
    dated.date = Some("2026-11-24T06:00:00Z".into());
    let parts = systems.map(|platform| {
        let library = fakes::libraries(&[platform]);
        dated.date = Some(format!("2026-11-2{}T06:00:00Z", platform as u8));
        written(&folder, &format!("{platform}.fmu"), &dated, &library)
    });
    let out = folder.join("all.fmu");
    let parts: Vec<&Path> = parts.iter().map(PathBuf::as_path).collect();
    let said = merged(&parts, &out).unwrap();
    assert!(
        said.ends_with("all.fmu: libraries for x86_64-linux, x86_64-windows, aarch64-darwin\n"),
        "{said}"
    );
    dated.date = Some(format!("2026-11-2{}T06:00:00Z", Platform::X86Linux as u8));
    let whole = written(&folder, "whole.fmu", &dated, &fakes::libraries(&systems));
    assert_eq!(fs::read(&out).unwrap(), fs::read(&whole).unwrap());
    // One of the parts may be written over, and what is there already changes nothing.
    merged(&[&out, parts[1]], &out).unwrap();
    assert_eq!(fs::read(&out).unwrap(), fs::read(&whole).unwrap());
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn fmus_that_differ_in_more_than_date_and_libraries_are_refused_by_what_differs() {
    let folder = folder("merge refused");
    let (linux, windows) = (
        fakes::libraries(&[Platform::X86Linux]),
        fakes::libraries(&[Platform::X86Windows]),
    );
    let first = written(&folder, "first.fmu", &component(), &linux);
    let out = folder.join("out.fmu");
    let refused = |name: &str, component: &Component, libraries: &Libraries| {
        let other = written(&folder, name, component, libraries);
        let message = merged(&[&first, &other], &out).unwrap_err();
        assert!(message.contains(name) && !out.exists(), "{message}");
        message
    };
    let message = refused(
        "bodies.fmu",
        &Component::new(&MODEL, &[("bodies", 4)]).unwrap(),
        &windows,
    );
    assert!(
        message.contains("the instantiation token is") && message.contains("bodies=4"),
        "{message}"
    );
    let mut other = component();
    other.notices.files[0].1 = "Permission is not granted".into();
    let message = refused("licence.fmu", &other, &windows);
    assert!(
        message.contains("line 1 of documentation/licenses/LICENSE-MIT.txt is \"Permission is not"),
        "{message}"
    );
    let mut other = component();
    other.amplitude = |_, _| 2.0;
    let message = refused("reference.fmu", &other, &windows);
    assert!(message.contains("of extra/fmi-component/reference.csv is"), "{message}");
    let mut other = component();
    other.icon = None;
    let message = refused("icon.fmu", &other, &windows);
    assert!(
        message.contains("it lacks terminalsAndIcons/icon.png, which"),
        "{message}"
    );
    let mut others = Libraries::default();
    others
        .add("other.so".as_ref(), fakes::library(Platform::X86Linux, "other"))
        .unwrap();
    let message = refused("linux.fmu", &component(), &others);
    assert!(
        message.contains("it is for x86_64-linux as is") && message.contains("with other bytes"),
        "{message}"
    );
    let two = folder.join("two.fmu");
    fs::write(&two, pack(&component(), Version::Two, &windows).unwrap()).unwrap();
    let message = merged(&[&first, &two], &out).unwrap_err();
    assert!(
        message.contains(r#"two.fmu: the standard is "FMI 2.0", in"#),
        "{message}"
    );
    fs::write(&two, "no archive").unwrap();
    let message = merged(&[&first, &two], &out).unwrap_err();
    assert!(
        message.contains("two.fmu: ") && message.contains("Name an FMU"),
        "{message}"
    );
    let message = merged(&[&first, &folder.join("none.fmu")], &out).unwrap_err();
    assert!(message.contains("none.fmu: "), "{message}");
    let message = merged(&[&first], &out).unwrap_err();
    assert!(message.contains("FILE.fmu"), "{message}");
    fs::remove_dir_all(&folder).unwrap();
}
