//! What is in the FMU: every function of the headers, the same bytes each time, start values of a new instance.

use std::io::{Cursor, Read};

use jostle::fmi::Version;
use jostle::fmi::bundle::{find_library, pack};
use jostle::scene::Choice;
use libloading::Library;
use zip::ZipArchive;

use crate::client::component;

/// Functions that an export table writes, from its source.
fn functions(source: &str) -> Vec<&str> {
    let lines = source.lines().filter_map(|line| line.trim().strip_prefix("fn "));
    lines.map(|line| line.split('(').next().unwrap()).collect()
}

#[test]
fn the_library_exports_all_functions_of_both_versions() {
    let library = unsafe { Library::new(find_library("fmu_probe").unwrap()) }.unwrap();
    let two = functions(include_str!("../../src/fmi/abi/export_fmi2.rs"));
    let three = functions(include_str!("../../src/fmi/abi/export_fmi3.rs"));
    assert_eq!((two.len(), three.len()), (44, 75));
    for name in two.into_iter().chain(three) {
        assert!(unsafe { library.get::<unsafe extern "C" fn()>(name) }.is_ok(), "{name}");
    }
}

#[test]
fn an_fmu_holds_what_each_standard_asks_for() {
    for (version, binary, icon) in [
        (Version::Two, "binaries/linux64/fmu_probe.so", "model.png"),
        (
            Version::Three,
            "binaries/x86_64-linux/fmu_probe.so",
            "terminalsAndIcons/icon.png",
        ),
    ] {
        let bytes = pack(&component(), version, b"library").unwrap();
        assert_eq!(
            bytes,
            pack(&component(), version, b"library").unwrap(),
            "the same bytes each time"
        );
        let mut archive = ZipArchive::new(Cursor::new(bytes)).unwrap();
        let mut content = String::new();
        archive.by_name(binary).unwrap().read_to_string(&mut content).unwrap();
        assert_eq!(content, "library");
        let mut png = Vec::new();
        archive.by_name(icon).unwrap().read_to_end(&mut png).unwrap();
        assert!(png.starts_with(b"\x89PNG"));
        for path in [
            "modelDescription.xml",
            "documentation/index.html",
            "documentation/licenses/license.txt",
        ] {
            assert!(archive.by_name(path).is_ok(), "{path}");
        }
        let mut notices = String::new();
        let path = "documentation/licenses/LICENSE-THIRD-PARTY.txt";
        archive.by_name(path).unwrap().read_to_string(&mut notices).unwrap();
        assert_eq!(notices, include_str!("../../LICENSE-THIRD-PARTY.txt"));
    }
}

#[test]
fn the_model_description_says_what_is_there() {
    let (two, three) = (
        component().model_description(Version::Two),
        component().model_description(Version::Three),
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
    for text in [&two, &three] {
        assert!(text.contains(r#"disks=3:"#));
        assert_eq!(text.matches("calculatedParameter").count(), 1);
    }
}

#[test]
fn a_missing_library_is_told_with_the_remedy() {
    let message = find_library("no_such_library").unwrap_err().to_string();
    assert!(message.contains("cargo build --release --workspace"), "{message}");
    let choice = Choice { disks: 101 };
    let message = jostle::fmi::bundle::Component::of::<fmu_probe::Probe>(choice)
        .unwrap_err()
        .to_string();
    assert!(message.contains("1 to 100"), "{message}");
}
