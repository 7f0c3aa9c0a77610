//! What is in an FMU: what each standard asks for, the same bytes each time, and the message where it cannot be written.

#![allow(unsafe_code, clippy::unwrap_used)]

mod support;

use std::io::{Cursor, Read};
use std::path::Path;

use fmi_bundle::{Component, Libraries, Platform, Version, find_library, model_description, pack, write};
use fmi_component::{ModelInfo, ModelType};
use support::{MODEL, component, fakes, folder, libraries, library};
use zip::ZipArchive;

/// Functions that an export table writes, from its source.
fn functions(source: &str) -> Vec<&str> {
    let lines = source.lines().filter_map(|line| line.trim().strip_prefix("fn "));
    lines.map(|line| line.split('(').next().unwrap()).collect()
}

#[test]
fn the_library_exports_all_functions_of_both_versions() {
    // SAFETY: the library of the oscillators does nothing when it is loaded.
    let library = unsafe { libloading::Library::new(library()) }.unwrap();
    let two = functions(include_str!("../../fmi-component/src/c_api/export_fmi2.rs"));
    let three = functions(include_str!("../../fmi-component/src/c_api/export_fmi3.rs"));
    assert_eq!((two.len(), three.len()), (44, 75));
    for name in two.into_iter().chain(three) {
        // SAFETY: the function is not called.
        let found = unsafe { library.get::<unsafe extern "C" fn()>(name) };
        assert!(found.is_ok(), "{name}");
    }
}

fn text(archive: &mut ZipArchive<Cursor<Vec<u8>>>, path: &str) -> String {
    let mut bytes = Vec::new();
    let mut entry = archive.by_name(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    entry.read_to_end(&mut bytes).unwrap();
    String::from_utf8_lossy(&bytes).into_owned()
}

#[test]
fn an_fmu_holds_what_each_standard_asks_for() {
    for (version, binary, icon) in [
        (Version::Two, "binaries/linux64/oscillators.so", "model.png"),
        (
            Version::Three,
            "binaries/x86_64-linux/oscillators.so",
            "terminalsAndIcons/icon.png",
        ),
    ] {
        let libraries = fakes::libraries(&[Platform::X86Linux]);
        let bytes = pack(&component(), version, &libraries).unwrap();
        assert_eq!(
            bytes,
            pack(&component(), version, &libraries).unwrap(),
            "the same bytes each time"
        );
        let mut archive = ZipArchive::new(Cursor::new(bytes)).unwrap();
        assert!(text(&mut archive, binary).starts_with("\x7fELF"));
        for icon in [icon, "terminalsAndIcons/icon.png"] {
            assert!(text(&mut archive, icon).ends_with("PNG"));
        }
        assert_eq!(text(&mut archive, "terminalsAndIcons/icon.svg"), "<svg/>");
        let terminals = text(&mut archive, "terminalsAndIcons/terminalsAndIcons.xml");
        assert!(
            terminals.contains(r#"<fmiTerminalsAndIcons fmiVersion="3.0">"#),
            "{terminals}"
        );
        let description = text(&mut archive, "modelDescription.xml");
        assert!(description.contains(r#"copyright="Copyright (c) 2026 A. &amp; B. Author" license="MIT""#));
        let page = text(&mut archive, "documentation/index.html");
        assert!(
            page.contains("bodies: 3") && page.contains("<code>mytool replay FILE.fmu</code>"),
            "{page}"
        );
        let license = text(&mut archive, "documentation/licenses/license.txt");
        assert!(
            license.contains("MIT\n\nThe texts are beside this file: LICENSE-MIT.txt"),
            "{license}"
        );
        let copied = text(&mut archive, "documentation/licenses/LICENSE-MIT.txt");
        assert_eq!(copied, "Permission is hereby granted");
        let reference = text(&mut archive, "extra/fmi-component/reference.csv");
        assert!(reference.starts_with("time,frame.position,frame.velocity,frame.reaction_force,"));
        let of_standard = |name| format!("extra/org.fmi-standard.fmi-ls-ref/{name}");
        let stimuli = text(&mut archive, &of_standard("stimuli.csv"));
        assert!(
            stimuli.starts_with("time,frame.position,frame.velocity\n0.0,"),
            "{stimuli}"
        );
        assert_eq!(stimuli.lines().count(), reference.lines().count());
        let experiment = text(&mut archive, &of_standard("reference.exp"));
        let last = reference.lines().last().unwrap().split(',').next().unwrap();
        assert!(
            experiment.contains(&format!(r#"startTime="0.0" stopTime="{last}" stepSize="#)),
            "{experiment}"
        );
    }
}

/// Every file that the manifest of FMI-LS-REF names is in the archive, and the experiment finds its tables.
#[test]
fn related_files_are_there() {
    let bytes = pack(&component(), Version::Three, &fakes::libraries(&[Platform::X86Linux])).unwrap();
    let mut archive = ZipArchive::new(Cursor::new(bytes)).unwrap();
    let folder = Path::new("extra/org.fmi-standard.fmi-ls-ref");
    let mut named = 0;
    for file in ["fmi-ls-manifest.xml", "reference.exp"] {
        let content = text(&mut archive, folder.join(file).to_str().unwrap());
        for source in content.split("source=\"").skip(1) {
            let source = source.split('"').next().unwrap();
            let mut path = folder.to_path_buf();
            for part in source.split('/') {
                match part {
                    ".." => assert!(path.pop()),
                    name => path.push(name),
                }
            }
            assert!(archive.by_name(path.to_str().unwrap()).is_ok(), "{source} of {file}");
            named += 1;
        }
    }
    assert_eq!(named, 5);
}

/// A model that panics is told of; the program that bundles it goes on.
#[test]
fn a_panic_of_the_model_is_an_error() {
    let in_a_run = ModelType {
        prepare: |_| panic!("set to panic"),
        ..MODEL
    };
    let component = Component::new(&in_a_run, &[]).unwrap();
    let message = pack(&component, Version::Three, &fakes::libraries(&[Platform::X86Linux]))
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("the reference trajectory") && message.contains("set to panic"),
        "{message}"
    );
    let in_its_rows = ModelType {
        variables: |_| panic!("set to panic"),
        ..MODEL
    };
    let message = Component::new(&in_its_rows, &[]).unwrap_err().to_string();
    assert!(
        message.contains("the variables of the model") && message.contains("set to panic"),
        "{message}"
    );
}

#[test]
fn the_model_description_says_what_is_there() {
    let (two, three) = (
        model_description::write(&component(), Version::Two),
        model_description::write(&component(), Version::Three),
    );
    assert!(three.contains("&quot;m&quot; &lt; 10."), "text is escaped");
    assert!(three.contains(r#"<DisplayUnit name="rpm" factor="9.549296585513721"/>"#));
    assert!(three.contains(r#"<Int64 name="seed""#) && three.contains(r#"max="9223372036854775807" start="42""#));
    assert!(two.contains(r#"<Integer min="0" max="2147483647" start="42"/>"#));
    assert!(three.contains(r#"canSerializeFMUState="true""#) && two.contains(r#"canSerializeFMUstate="true""#));
    let items = r#"<Item name="random" value="1" description="With velocities that the seed decides."/>"#;
    assert!(two.contains(r#"<SimpleType name="start_pattern">"#) && two.contains(items));
    assert!(three.contains(r#"<EnumerationType name="start_pattern">"#) && three.contains(items));
    assert!(two.contains(r#"<Enumeration declaredType="start_pattern" min="1" max="2" start="1"/>"#));
    assert!(three.contains(r#"<Enumeration name="start.pattern""#));
    let version = env!("CARGO_PKG_VERSION");
    for text in [&two, &three] {
        assert!(text.contains(r#"bodies=3:"#));
        assert!(text.contains(&format!(r#"generationTool="fmi-component {version}""#)));
        assert_eq!(text.matches("calculatedParameter").count(), 1);
    }
}

#[test]
fn elements_become_one_array_where_arrays_are_wanted() {
    let mut component = component();
    component.arrays = true;
    let text = model_description::write(&component, Version::Three);
    assert!(text.contains(r#"<Float64 name="body.position" valueReference="13" description="Position of each body.""#));
    assert!(text.contains(r#"<Dimension start="3"/>"#) && !text.contains("body.position["));
    let message = pack(&component, Version::Two, &fakes::libraries(&[Platform::X86Linux]))
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("version of FMI = 2.0 is not allowed: 3.0"),
        "{message}"
    );
}

#[test]
fn a_missing_library_is_reported_with_the_remedy() {
    let message = find_library("no_such_library", &[Path::new("here")])
        .unwrap_err()
        .to_string();
    assert!(message.contains("not found in here"), "{message}");
    assert!(message.contains("cargo build --release --workspace"), "{message}");
    let message = Libraries::from_file(Path::new("no_such.so")).unwrap_err().to_string();
    assert!(message.contains("cargo build --release --workspace"), "{message}");
}

#[test]
fn a_structural_parameter_out_of_range_is_refused_with_its_range() {
    let message = Component::new(&MODEL, &[("bodies", 101)]).unwrap_err().to_string();
    assert!(message.contains("1 to 100"), "{message}");
    let message = Component::new(&MODEL, &[("wheels", 1)]).unwrap_err().to_string();
    assert!(message.contains("bodies"), "{message}");
}

#[test]
fn an_fmu_that_cannot_be_written_leaves_no_file_and_says_why() {
    let folder = folder("refused");
    let refused = |out: &Path| {
        write(&component(), Version::Three, &libraries(), out)
            .unwrap_err()
            .to_string()
    };
    let message = refused(&folder.join("missing/a.fmu"));
    assert!(message.contains("missing does not exist. Create it"), "{message}");
    std::fs::create_dir(folder.join("b.fmu")).unwrap();
    let message = refused(&folder.join("b.fmu"));
    assert!(
        message.contains("it is a folder. Give the name of a file."),
        "{message}"
    );
    let left: Vec<_> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert_eq!(left, ["b.fmu"]);
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The file that is written first is a device without space.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported_as_such_and_leaves_nothing() {
    let folder = folder("full");
    std::os::unix::fs::symlink("/dev/full", folder.join("a.fmu.part")).unwrap();
    let written = write(&component(), Version::Three, &libraries(), &folder.join("a.fmu"));
    let message = written.unwrap_err().to_string();
    assert!(
        message.contains("no space left in") && message.contains("Make room"),
        "{message}"
    );
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_library_of_another_version_and_a_file_that_is_none_are_refused() {
    let folder = folder("foreign");
    let (out, text) = (folder.join("a.fmu"), folder.join("text.so"));
    let other = ModelType {
        info: || ModelInfo {
            version: "0.0.0",
            ..(MODEL.info)()
        },
        ..MODEL
    };
    let other = Component::new(&other, &[]).unwrap();
    let written = |library: &Path| write(&other, Version::Three, &Libraries::from_file(library)?, &out);
    let message = written(&library()).unwrap_err().to_string();
    assert!(message.starts_with(&library().display().to_string()), "{message}");
    assert!(
        message.contains("instantiation token") && message.contains("from the same sources"),
        "{message}"
    );
    std::fs::write(&text, "no library").unwrap();
    let message = written(&text).unwrap_err().to_string();
    assert!(
        message.contains("text.so: it is no library") && message.contains("x86_64-linux"),
        "{message}"
    );
    assert!(!out.exists());
    std::fs::remove_dir_all(&folder).unwrap();
}
