//! The command line as a user meets it: exit codes, messages, files.
#![allow(clippy::unwrap_used)]

mod support;

use std::process::{Command, Output};

use support::{folder, jostle, text};

#[test]
fn every_command_explains_itself_with_an_example() {
    for command in ["describe", "run"] {
        let output = jostle(&[command, "--help"]);
        assert!(output.status.success());
        assert!(text(&output.stdout).contains(&format!("Example:\n  jostle {command} packing")));
    }
}

#[test]
fn describe_lists_the_variables_of_the_chosen_drive() {
    let input = text(&jostle(&["describe", "packing"]).stdout);
    let sine = text(&jostle(&["describe", "packing", "--drive", "sine", "--disks", "7"]).stdout);
    assert!(input.contains("base.displacement") && !input.contains("drive.amplitude"));
    assert!(sine.contains("drive.amplitude") && !sine.contains("base.displacement"));
    assert!(sine.contains("disk.angle[1..7]") && input.contains("disk.angle[1..60]"));
}

#[test]
fn a_drive_that_is_not_named_is_the_first_of_the_engine() {
    let head = |arguments: &[&str]| {
        let page = text(&jostle(&[&["describe", "wedge"], arguments].concat()).stdout);
        page.split(':').next().unwrap().to_string()
    };
    assert_eq!(head(&[]), "wedge, map, drive sine, 1 disks");
    assert_eq!(
        head(&["--engine", "event-driven"]),
        "wedge, event-driven, drive input, 1 disks"
    );
    let file = folder("wedge").join("run.csv");
    let path = file.to_str().unwrap();
    let run = [
        "run",
        "wedge",
        "--engine",
        "event-driven",
        "--seconds",
        "1",
        "--output",
        path,
    ];
    assert!(jostle(&run).status.success());
    let parameters = std::fs::read_to_string(file.with_extension("parameters.csv")).unwrap();
    assert!(parameters.contains("drive,sine,"), "{parameters}");
}

#[test]
fn run_writes_the_samples_and_what_made_them() {
    let file = folder("run").join("short.csv");
    let path = file.to_str().unwrap();
    let few = ["--disks", "6", "--set", "box.width=0.12", "--set", "seed=3"];
    let output = jostle(&[&["run", "packing", "--seconds", "0.05", "--output", path], &few[..]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let mut reader = csv::Reader::from_path(&file).unwrap();
    let header = reader.headers().unwrap().clone();
    assert_eq!(
        (
            &header[0],
            header.iter().filter(|name| name.starts_with("disk.angle[")).count()
        ),
        ("time", 6)
    );
    let times: Vec<f64> = reader.records().map(|row| row.unwrap()[0].parse().unwrap()).collect();
    assert_eq!(times, [0.0, 0.01, 0.02, 0.03, 0.04, 0.05]);
    let parameters = std::fs::read_to_string(file.with_extension("parameters.csv")).unwrap();
    assert!(
        parameters.contains("box.width,0.12,m\n") && parameters.contains("seed,3,1\n"),
        "{parameters}"
    );
}

#[test]
fn wrong_arguments_end_with_code_2_and_a_remedy() {
    let file = folder("wrong").join("never.csv");
    let path = file.to_str().unwrap();
    let cases: [(&[&str], &str); 7] = [
        (&["run", "sandpile", "--seconds", "1"], "one of: packing"),
        (&["run", "packing", "--seconds", "0"], "above 0"),
        (&["run", "packing", "--seconds", "1", "--disks", "0"], "--disks = 0"),
        (
            &["run", "packing", "--seconds", "1", "--set", "box.width=-1"],
            "box.width = -1",
        ),
        (
            &["run", "packing", "--seconds", "1", "--set", "box.width=0.01"],
            "box.width",
        ),
        (
            &["run", "packing", "--seconds", "1", "--set", "time_step=0.5"],
            "time_step",
        ),
        (&["describe", "packing", "--drive", "wind"], "one of: input, sine"),
    ];
    for (arguments, message) in cases {
        let output = if arguments[0] == "run" {
            [arguments, &["--output", path]].concat()
        } else {
            arguments.to_vec()
        };
        let output = jostle(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            text(&output.stderr).contains(message),
            "{arguments:?}: {}",
            text(&output.stderr)
        );
    }
    assert!(!file.exists());
}

#[test]
fn a_refused_step_ends_with_code_1_and_keeps_the_rows() {
    let file = folder("refused").join("kept.csv");
    let path = file.to_str().unwrap();
    // One metre at 20 Hz: the base tears through the disks.
    let wild = [
        "--set",
        "drive.amplitude=1",
        "--set",
        "drive.frequency=20",
        "--sample",
        "1e-4",
    ];
    let output = jostle(&[&["run", "packing", "--seconds", "1", "--output", path], &wild[..]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let rows = std::fs::read_to_string(&file).unwrap().lines().count() - 1;
    assert!(
        rows >= 1 && text(&output.stderr).contains(&format!("{rows} whole rows up to t = ")),
        "{}",
        text(&output.stderr)
    );
}

#[test]
fn a_file_that_cannot_be_written_ends_with_code_1() {
    let output = jostle(&[
        "run",
        "packing",
        "--seconds",
        "0.01",
        "--output",
        "no/such/folder/run.csv",
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        text(&output.stderr).contains("the folder no/such/folder does not exist. Create it, or choose another."),
        "{}",
        text(&output.stderr)
    );
}

#[test]
fn theory_prints_csv_and_refuses_what_it_has_not() {
    let output = jostle(&["theory", "three_disk", "limits", "--set", "tilt=0,0.2"]);
    let page = text(&output.stdout);
    let lines: Vec<&str> = page.lines().collect();
    assert_eq!(output.status.code(), Some(0));
    assert!(lines.len() == 3 && lines[0].starts_with("tilt,A_S1,A_S2,A_0"));
    let column = |index: usize| lines[1].split(',').nth(index).unwrap().parse::<f64>().unwrap();
    assert_eq!(column(1), column(2)); // without tilt both limits are A_0
    for arguments in [["theory", "packing", "limits"], ["theory", "three_disk", "limits"]] {
        let output = jostle(&[&arguments[..], &["--set", "tilt=0.7"]].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(output.stdout.is_empty());
    }
}

const SHORT: [&str; 8] = [
    "run",
    "packing",
    "--disks",
    "3",
    "--seconds",
    "0.001",
    "--sample",
    "0.001",
];

fn short_run(output: &std::path::Path, friction: &str) -> Output {
    let friction = format!("contact.friction={friction}");
    let own = ["--output", output.to_str().unwrap(), "--set", &friction];
    jostle(&[&SHORT[..], &own].concat())
}

#[test]
fn what_is_doubtful_is_said_and_is_no_failure() {
    let path = folder("doubtful").join("run.csv");
    let equal = ["small", "large"].map(|which| format!("disk.radius_{which}=0.02"));
    let own = [
        "--output",
        path.to_str().unwrap(),
        "--set",
        &equal[0],
        "--set",
        &equal[1],
    ];
    let output = jostle(&[&SHORT[..], &own].concat());
    assert_eq!(output.status.code(), Some(0));
    let said = text(&output.stderr);
    assert!(said.contains("jostle: warning: the seed decides nothing"), "{said}");
}

#[test]
fn outputs_whose_names_differ_after_a_dot_have_parameters_of_their_own() {
    let folder = folder("dots");
    for friction in ["0.1", "0.2"] {
        let output = short_run(&folder.join(format!("friction{friction}")), friction);
        assert!(output.status.success(), "{}", text(&output.stderr));
    }
    for friction in ["0.1", "0.2"] {
        let path = folder.join(format!("friction{friction}.parameters.csv"));
        let parameters = std::fs::read_to_string(path).unwrap();
        assert!(parameters.contains(&format!("contact.friction,{friction},1\n")));
    }
}

#[test]
fn a_run_that_cannot_write_its_samples_leaves_no_parameters() {
    let folder = folder("taken");
    let taken = folder.join("run.csv");
    std::fs::create_dir_all(&taken).unwrap();
    assert_eq!(short_run(&taken, "0.1").status.code(), Some(1));
    assert!(!folder.join("run.parameters.csv").exists());
}

#[test]
fn fields_refuses_its_files_before_it_computes() {
    let folder = folder("fields");
    let file = folder.join("fields.csv");
    let _ = std::fs::remove_file(&file); // of an earlier run of this test
    let (path, nowhere) = (file.to_str().unwrap(), "no/such/folder/profile.csv");
    // So long a run would not end within the time of a test.
    let long = ["fields", "ratchet", "--seconds", "1e6", "--output", path, "--profile"];
    let roundabout = folder.join(".").join("fields.csv");
    for (profile, code, message) in [
        (path, 2, "Name two files"),
        (roundabout.to_str().unwrap(), 2, "Name two files"),
        (nowhere, 1, "no/such/folder does not exist"),
    ] {
        let output = jostle(&[&long[..], &[profile]].concat());
        assert_eq!(output.status.code(), Some(code), "{}", text(&output.stderr));
        assert!(text(&output.stderr).contains(message), "{}", text(&output.stderr));
        assert!(!file.exists(), "a refused command left {path}");
    }
}

/// A closed pipe means that the reader has read enough; a full device is a failure.
#[cfg(target_os = "linux")]
#[test]
fn a_standard_output_that_takes_nothing_more_is_told_apart() {
    use std::process::Stdio;
    let run = |output: Stdio| {
        Command::new(env!("CARGO_BIN_EXE_jostle"))
            .args(["theory", "three_disk", "limits", "--set", "tilt=0"])
            .stdout(output)
            .stderr(Stdio::null())
            .status()
            .unwrap()
    };
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    assert_eq!(run(writer.into()).code(), Some(0));
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    assert_eq!(run(full.into()).code(), Some(1));
}
