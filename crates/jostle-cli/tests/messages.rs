//! What the command line says of wrong arguments and full disks: the name, its value, what is allowed, the remedy.
#![allow(clippy::unwrap_used)]

mod support;

use std::process::Command;

use support::{folder, jostle, text};

/// Exit code and standard error.
fn refused(arguments: &[&str]) -> (Option<i32>, String) {
    let output = jostle(arguments);
    (output.status.code(), text(&output.stderr))
}

#[test]
fn a_wrong_name_is_answered_with_the_nearest_one() {
    let run = ["run", "packing", "--seconds", "1e-9", "--output", "/dev/null"];
    let cases: [(&[&str], &str); 6] = [
        (&["describe", "pakcing"], "Did you mean packing?"),
        (&["describe", "three-disk"], "Did you mean three_disk?"),
        (
            &["describe", "wedge", "--engine", "event_driven"],
            "Did you mean event-driven?",
        ),
        (
            &["fmu", "packing", "--drive", "sin", "--out", "a.fmu"],
            "Did you mean sine?",
        ),
        (
            &["run", "--set", "contact.frictoin=0.2"],
            "Did you mean contact.friction?",
        ),
        (&["run", "--set", "frequency=20"], "Did you mean drive.frequency?"),
    ];
    for (arguments, question) in cases {
        let arguments = match arguments[0] {
            "run" => [&run, &arguments[1..]].concat(),
            _ => arguments.to_vec(),
        };
        let (code, message) = refused(&arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {message}");
        assert!(message.contains(question), "{arguments:?}: {message}");
    }
    let (_, message) = refused(&["describe", "sandpile"]);
    assert!(!message.contains("Did you mean"), "{message}");
}

#[test]
fn help_lists_scenes_engines_and_drives() {
    for arguments in [
        &["--help"][..],
        &["describe", "--help"],
        &["run", "--help"],
        &["fmu", "--help"],
    ] {
        let help = text(&jostle(arguments).stdout);
        for line in [
            "  packing     molecular-dynamics          input, sine, sine-fixed-bottom, random-bottom\n",
            "              event-driven                input, sine\n",
            "  three_disk  molecular-dynamics          input, harmonic-torque, random-supports, sine\n",
        ] {
            assert!(help.contains(line), "{arguments:?}: {help}");
        }
    }
}

#[test]
fn a_file_of_another_format_is_refused_before_anything_is_done() {
    let folder = folder("endings");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_string();
    let run = |output: &str| refused(&["run", "packing", "--seconds", "0.001", "--output", output]);
    let cases = [
        (
            run(&path("r.h5")),
            "ends in .csv, .txt, .dat or a number (CSV), .parquet (Parquet) or .nc (NetCDF), or -",
        ),
        (run(&path("r.mat")), "r.csv"),
        (
            refused(&["theory", "three_disk", "limits", "--output", &path("t.nc")]),
            "ends in .csv",
        ),
        (
            refused(&[
                "run",
                "packing",
                "--seconds",
                "1",
                "--output",
                &path("r.csv"),
                "--trajectory",
                &path("t.vtk"),
            ]),
            "--trajectory = ",
        ),
        (
            refused(&[
                "run",
                "packing",
                "--seconds",
                "1",
                "--output",
                &path("r.csv"),
                "--parameters",
                &path("r.csv"),
            ]),
            "another file than that of --output",
        ),
        (refused(&["fmu", "packing", "--out", &path("x.txt")]), "ends in .fmu"),
        (refused(&["fmu", "packing", "--out", "-"]), "--out FILE.fmu"),
        (
            refused(&["fields", "ratchet", "--seconds", "1", "--output", &path("f.json")]),
            "ends in .csv",
        ),
        (
            refused(&[
                "fields",
                "ratchet",
                "--seconds",
                "1",
                "--output",
                &path("f.csv"),
                "--profile",
                &path("p.npy"),
            ]),
            "--profile = ",
        ),
    ];
    for ((code, message), what) in cases {
        assert_eq!(code, Some(2), "{message}");
        assert!(message.contains(what), "{message}");
    }
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
}

#[test]
fn numbers_of_disks_are_refused_with_the_range_of_the_scene() {
    for (disks, said) in [
        ("-5", "--disks = -5 is not allowed: from 1 to "),
        ("0", "--disks = 0 is not allowed: from 1 to "),
        ("99999999999", "--disks = 99999999999 is not allowed: from 1 to "),
        ("1.5", "give a whole number"),
    ] {
        let (code, message) = refused(&["describe", "packing", "--disks", disks]);
        assert_eq!(code, Some(2), "{message}");
        assert!(message.contains(said), "{message}");
    }
}

#[test]
fn what_is_not_possible_is_told_in_the_words_of_the_options() {
    let cases: [(&[&str], &str); 4] = [
        (
            &["fields", "packing", "--seconds", "1"],
            "scene = packing is not allowed: ratchet, the only one",
        ),
        (
            &["fields", "ratchet", "--engine", "map", "--seconds", "1"],
            "engine = map is not allowed: event-driven, the only one",
        ),
        (
            &["fmu", "packing", "--fmi", "2", "--arrays", "--out", "never.fmu"],
            "--fmi = 2 is not allowed: 3 with --arrays",
        ),
        (
            &["run", "packing", "--seconds", "1", "--set", "seed=1", "--set", "seed=2"],
            "seed = 1 is set before. Leave one of the two out.",
        ),
    ];
    for (arguments, said) in cases {
        let (code, message) = refused(arguments);
        assert_eq!(code, Some(2), "{message}");
        assert!(message.contains(said), "{arguments:?}: {message}");
    }
    let (_, message) = refused(&["fields", "packing", "--seconds", "1"]);
    assert!(!message.contains("engine"), "{message}");
}

#[test]
fn a_folder_without_the_libraries_of_other_systems_is_refused_by_name() {
    let folder = folder("libraries");
    let other = folder.join("other/x86_64-windows");
    std::fs::create_dir_all(&other).unwrap();
    std::fs::write(other.join("jostle_wedge_map.dll"), "").unwrap();
    std::fs::create_dir_all(folder.join("empty")).unwrap();
    for (name, said) in [
        (
            "missing",
            "Name a folder that holds one folder for each platform: x86_64-linux, ",
        ),
        (
            "empty",
            "empty: it has no folder of a platform. Allowed names are x86_64-linux, ",
        ),
        (
            "other",
            "x86_64-windows: it holds jostle_wedge_map.dll, but not jostle_packing.dll. Build the library of",
        ),
    ] {
        let (folder, out) = (folder.join(name), folder.join("never.fmu"));
        let [folder, out] = [&folder, &out].map(|path| path.to_str().unwrap());
        let (code, message) = refused(&["fmu", "packing", "--libraries", folder, "--out", out]);
        assert_eq!(code, Some(1), "{message}");
        assert!(message.contains(folder) && message.contains(said), "{message}");
    }
    assert!(!folder.join("never.fmu").exists());
}

/// A file may have two blocks here: the last row that fits is told, and the one that is cut is not counted.
#[cfg(target_os = "linux")]
#[test]
fn a_run_on_a_full_disk_says_which_rows_are_whole() {
    let file = folder("full").join("run.csv");
    let script = format!(
        "trap '' XFSZ; ulimit -f 8; exec '{}' run three_disk --seconds 1 --sample 1e-3 --output '{}'",
        env!("CARGO_BIN_EXE_jostle"),
        file.display()
    );
    let output = Command::new("sh").args(["-c", &script]).output().unwrap();
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(
        message.contains("no space left in") && message.contains("Make room"),
        "{message}"
    );
    let written = std::fs::read_to_string(&file).unwrap();
    let whole = written.matches('\n').count() - 1;
    assert!(
        whole > 1 && message.contains(&format!("{whole} whole rows up to t = ")),
        "{whole}: {message}"
    );
}
