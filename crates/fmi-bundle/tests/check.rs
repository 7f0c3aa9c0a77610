//! FMUs as they are made have no faults, and each fault that is made in one is found with its place.

#![allow(clippy::unwrap_used)]

mod support;

use std::fs;
use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fmi_bundle::{Component, Fault, Platform, Version, check, pack};
use fmi_component::{ModelType, StructuralParameters, Variable};
use support::{MODEL, component, fakes, folder, libraries};
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

type Files = Vec<(String, Vec<u8>)>;

fn unpacked(fmu: Vec<u8>) -> Files {
    let mut archive = ZipArchive::new(Cursor::new(fmu)).unwrap();
    let mut files = Files::new();
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).unwrap();
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes).unwrap();
        files.push((entry.name().unwrap().into_owned(), bytes));
    }
    files
}

fn packed(files: &Files) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (path, bytes) in files {
        archive.start_file(path.as_str(), options).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// Faults of the FMU that `change` makes of one without any.
fn faults(folder: &Path, files: &Files, change: impl FnOnce(&mut Files)) -> Vec<Fault> {
    let mut files = files.clone();
    change(&mut files);
    let path = folder.join("changed.fmu");
    fs::write(&path, packed(&files)).unwrap();
    check(&path).unwrap().faults
}

/// Replaces a text in the first line of a file that holds it and `mark`.
fn replace(files: &mut Files, path: &str, mark: &str, (old, new): (&str, &str)) {
    let (_, bytes) = files.iter_mut().find(|(name, _)| name == path).unwrap();
    let text = String::from_utf8(bytes.clone()).unwrap();
    let line = text.lines().find(|line| line.contains(mark) && line.contains(old));
    let line = line.unwrap_or_else(|| panic!("{mark} {old}"));
    *bytes = text.replacen(line, &line.replacen(old, new, 1), 1).into_bytes();
}

#[test]
fn an_fmu_as_it_is_made_has_no_faults_packed_or_not() {
    let folder = folder("check");
    let fmu = folder.join("oscillators.fmu");
    let mut component = component();
    for (version, arrays) in [(Version::Two, false), (Version::Three, false), (Version::Three, true)] {
        component.arrays = arrays;
        let bytes = pack(&component, version, &libraries()).unwrap();
        fs::write(&fmu, &bytes).unwrap();
        let report = check(&fmu).unwrap();
        assert_eq!(report.faults, [], "{version:?} {arrays}");
        assert!(report.done.len() == 4 && report.left_out.is_empty(), "{report:?}");
        let open = folder.join(format!("unpacked {version:?} {arrays}"));
        for (path, bytes) in unpacked(bytes) {
            let file: PathBuf = open.join(path);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, bytes).unwrap();
        }
        assert_eq!(check(&open).unwrap(), report);
    }
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn an_fmu_for_other_systems_is_checked_as_far_as_that_goes() {
    let folder = folder("check others");
    let fmu = folder.join("oscillators.fmu");
    let others: Vec<_> = Platform::ALL
        .into_iter()
        .filter(|platform| Some(*platform) != Platform::host())
        .collect();
    fs::write(
        &fmu,
        pack(&component(), Version::Three, &fakes::libraries(&others)).unwrap(),
    )
    .unwrap();
    let report = check(&fmu).unwrap();
    assert_eq!(report.faults, []);
    assert!(report.left_out[0].contains("no library for this system"), "{report:?}");
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn each_fault_of_a_model_description_is_found_at_its_line() {
    let folder = folder("check faults");
    let files = unpacked(pack(&component(), Version::Three, &libraries()).unwrap());
    const XML: &str = "modelDescription.xml";
    for (mark, change, what) in [
        (
            r#""#,
            (r#"start="100.0""#, r#"start="101.0""#),
            r#"start = "101.0" of spring.stiffness is not that of its library, "100.0""#,
        ),
        (
            r#""#,
            (r#"start="100.0""#, r#"start="-1.0""#),
            r#"start = -1 of spring.stiffness is not allowed: from"#,
        ),
        (
            r#""body.mass""#,
            (r#"declaredType="Mass""#, r#"declaredType="Force""#),
            r#"declaredType of body.mass is Force, in its library it is Mass"#,
        ),
        (
            r#""body.mass""#,
            (r#"declaredType="Mass""#, r#"declaredType="Furlong""#),
            r#"declaredType = "Furlong" of body.mass is not declared"#,
        ),
        (
            r#""#,
            (r#"<BaseUnit kg="1"/>"#, r#"<BaseUnit kg="2"/>"#),
            r#"unit kg is declared as"#,
        ),
        (
            r#""body.mass""#,
            (r#"max="10.0""#, r#"max="11.0""#),
            r#"max of body.mass is 11.0, in its library it is 10.0"#,
        ),
        (
            r#""#,
            (r#"name="body.mass""#, r#"name="body mass""#),
            r#"name = "body mass" of a variable is not allowed: a structured name"#,
        ),
        (
            r#""#,
            (r#"name="body.mass""#, r#"name="spring.stiffness""#),
            r#"a second variable "spring.stiffness"; the first is at modelDescription.xml:"#,
        ),
        (
            r#""#,
            (r#"name="body.mass""#, r#"name="body.weight""#),
            r#"its library has no variable "body.weight""#,
        ),
        (
            r#""#,
            (r#"modelIdentifier="oscillators""#, r#"modelIdentifier="2x""#),
            r#"modelIdentifier = "2x" is not allowed"#,
        ),
        (
            r#""#,
            (r#"<Output valueReference"#, r#"<Outputt valueReference"#),
            r#"Outputt in ModelStructure; allowed is Output,"#,
        ),
        (
            r#""#,
            (r#"<DefaultExperiment"#, r#"<DefaultExperiment tempo="1""#),
            r#"has an attribute tempo, which the standard does not know"#,
        ),
        (
            r#""#,
            (r#"stopTime="1.0""#, r#"stopTime="soon""#),
            r#"stopTime = "soon" of DefaultExperiment is not allowed: a number"#,
        ),
        (
            r#""#,
            (r#" instantiationToken="#, r#" token="#),
            r#"fmiModelDescription has no attribute instantiationToken"#,
        ),
        (
            r#""body.mass""#,
            (r#"variability="fixed""#, r#"variability="continuous""#),
            r#"whose causality is parameter, is not allowed: fixed, tunable"#,
        ),
        (
            r#""body.mass""#,
            (r#"valueReference="2""#, r#"valueReference="1""#),
            r#"body.mass has the value reference of spring.stiffness"#,
        ),
        (
            r#"<Output"#,
            (r#"valueReference="11""#, r#"valueReference="99""#),
            r#"Outputs name variable number 99, which is not there"#,
        ),
        (
            r#"<InitialUnknown"#,
            (r#"dependencies="1 2""#, r#"dependencies="1 99""#),
            r#"the dependencies of natural.angle_rate name a variable that is not there"#,
        ),
        (
            r#"<InitialUnknown"#,
            (
                r#"dependencies="1 2""#,
                r#"dependencies="1 2" dependenciesKind="fixed""#,
            ),
            r#"not as many words"#,
        ),
        (
            r#"<InitialUnknown"#,
            (r#"dependencies="1 2""#, r#"dependencies="1""#),
            r#"natural.angle_rate changes with body.mass"#,
        ),
    ] {
        let found = faults(&folder, &files, |files| replace(files, XML, mark, change));
        let at_line = |fault: &&Fault| fault.what.contains(what) && fault.place.starts_with(XML);
        assert!(found.iter().any(|fault| at_line(&fault)), "{what}: {found:#?}");
    }
    let found = faults(&folder, &files, |files| files.retain(|(path, _)| path != XML));
    assert!(
        found[0].to_string().contains("modelDescription.xml: it is missing"),
        "{found:?}"
    );
    let found = faults(&folder, &files, |files| {
        replace(files, XML, "", ("</ModelVariables>", ""))
    });
    assert!(found[0].place == XML, "{found:?}");
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn each_fault_of_the_files_is_found_by_its_path() {
    let folder = folder("check files");
    let files = unpacked(pack(&component(), Version::Three, &libraries()).unwrap());
    let host = Platform::host().unwrap();
    let binary = format!("binaries/{host}/oscillators{}", host.suffix());
    let without = |path: &'static str| move |files: &mut Files| files.retain(|(name, _)| name != path);
    let found = |change: &dyn Fn(&mut Files), place: &str, what: &str| {
        let found = faults(&folder, &files, change);
        let fits = |fault: &Fault| fault.place.starts_with(place) && fault.what.contains(what);
        assert!(found.iter().any(fits), "{place}: {what}: {found:#?}");
    };
    found(
        &without("terminalsAndIcons/icon.png"),
        "terminalsAndIcons/terminalsAndIcons.xml:",
        "terminalsAndIcons/icon.png, which is missing",
    );
    found(
        &without("extra/fmi-component/reference.csv"),
        "extra/fmi-component/reference.csv",
        "trajectory that replay",
    );
    found(
        &without("extra/fmi-component/reference.csv"),
        "extra/org.fmi-standard.fmi-ls-ref/fmi-ls-manifest.xml:",
        "extra/fmi-component/reference.csv, which",
    );
    found(
        &without("documentation/index.html"),
        "documentation/index.html",
        "it is missing",
    );
    found(
        &without("documentation/licenses/license.txt"),
        "documentation/licenses/license.txt",
        "it is missing",
    );
    let rename = |to: &'static str| {
        let binary = binary.clone();
        move |files: &mut Files| {
            let (path, _) = files.iter_mut().find(|(path, _)| *path == binary).unwrap();
            *path = to.into();
        }
    };
    found(
        &rename("binaries/x86_64-windows/oscillators.dll"),
        "binaries/x86_64-windows/oscillators.dll",
        "it is a library for",
    );
    found(
        &rename("binaries/x86_64-linux/other.so"),
        "binaries/x86_64-linux",
        "it holds other.so, but not oscillators.so",
    );
    found(
        &rename("../oscillators.so"),
        "../oscillators.so",
        "path of this file is not allowed",
    );
    let truncated = |files: &mut Files| {
        files
            .iter_mut()
            .find(|(path, _)| *path == binary)
            .unwrap()
            .1
            .truncate(4000)
    };
    found(&truncated, &binary, "");
    let terminal = |files: &mut Files| {
        let path = "terminalsAndIcons/terminalsAndIcons.xml";
        replace(
            files,
            path,
            "",
            ("variableName=\"frame.position\"", "variableName=\"frame.place\""),
        );
    };
    if files
        .iter()
        .any(|(_, bytes)| String::from_utf8_lossy(bytes).contains("variableName=\"frame.position\""))
    {
        found(
            &terminal,
            "terminalsAndIcons/terminalsAndIcons.xml:",
            "\"frame.place\" is no variable",
        );
    }
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_library_of_another_model_is_found_by_its_token() {
    let folder = folder("check foreign");
    let fmu = folder.join("oscillators.fmu");
    let other = ModelType {
        info: || fmi_component::ModelInfo {
            name: "others",
            ..(MODEL.info)()
        },
        ..MODEL
    };
    let other = Component::new(&other, &[]).unwrap();
    for version in [Version::Two, Version::Three] {
        fs::write(&fmu, pack(&other, version, &libraries()).unwrap()).unwrap();
        let faults = check(&fmu).unwrap().faults;
        assert!(
            faults.len() == 1
                && faults[0].place.starts_with("binaries/")
                && faults[0].what.contains("it is the library of oscillators"),
            "{faults:?}"
        );
    }
    fs::remove_dir_all(&folder).unwrap();
}

/// The library takes what the structure leaves out of the token, so that only perturbation finds it.
#[test]
fn a_dependency_that_is_not_declared_is_found_by_perturbation() {
    fn variables(structure: &StructuralParameters) -> Vec<Variable> {
        let mut variables = (MODEL.variables)(structure);
        for variable in variables
            .iter_mut()
            .filter(|variable| variable.name == "natural.angle_rate")
        {
            variable.dependencies = Some(Arc::from(["body.mass"]));
        }
        variables
    }
    let folder = folder("check dependencies");
    let fmu = folder.join("oscillators.fmu");
    let component = Component::new(&ModelType { variables, ..MODEL }, &[]).unwrap();
    for version in [Version::Two, Version::Three] {
        fs::write(&fmu, pack(&component, version, &libraries()).unwrap()).unwrap();
        let faults = check(&fmu).unwrap().faults;
        let what = "natural.angle_rate changes with spring.stiffness, on which it does not depend";
        let mut places = faults.iter().filter(|fault| fault.what.contains(what));
        assert!(
            places.any(|fault| fault.place.starts_with("modelDescription.xml:")),
            "{faults:?}"
        );
    }
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn what_is_no_fmu_is_refused() {
    let folder = folder("check nothing");
    let file = folder.join("no.fmu");
    assert!(check(&file).unwrap_err().to_string().contains("no.fmu: "));
    fs::write(&file, "no archive").unwrap();
    assert!(check(&file).unwrap_err().to_string().contains("Name an FMU"));
    fs::remove_dir_all(&folder).unwrap();
}
