//! Runs that are stopped by a signal or by a full disk: what the message says is in the file is there, and the run can go on.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

mod support;

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use netcdf3::FileReader;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::RowAccessor;
use support::{folder, jostle, text};

/// Far longer than a test.
const LONG: [&str; 8] = [
    "run",
    "wedge",
    "--engine",
    "event-driven",
    "--seconds",
    "1e5",
    "--sample",
    "0.01",
];

fn start(words: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_jostle"));
    command.args(words).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// Waits until the file has so many bytes, and no longer than a test may take.
fn wait_for(path: &Path, bytes: u64) {
    let began = Instant::now();
    while std::fs::metadata(path).map_or(0, |found| found.len()) < bytes {
        assert!(
            began.elapsed() < Duration::from_secs(60),
            "{} does not grow",
            path.display()
        );
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn stop(child: Child, signal: &str) -> Output {
    let kill = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status()
        .unwrap();
    assert!(kill.success());
    child.wait_with_output().unwrap()
}

/// Times of the rows.
fn times(path: &Path) -> Vec<f64> {
    match path.extension().unwrap().to_str().unwrap() {
        "csv" => {
            let mut reader = csv::Reader::from_path(path).unwrap();
            reader.records().map(|row| row.unwrap()[0].parse().unwrap()).collect()
        }
        "nc" => FileReader::open(path).unwrap().read_var_f64("time").unwrap(),
        _ => {
            let reader = SerializedFileReader::new(std::fs::File::open(path).unwrap()).unwrap();
            let rows = reader.get_row_iter(None).unwrap();
            rows.map(|row| row.unwrap().get_double(0).unwrap()).collect()
        }
    }
}

/// What the message says is in the file is in it.
fn check_kept(path: &Path, message: &str) {
    let times = times(path);
    let (rows, until) = (times.len(), times.last().unwrap());
    let said = format!("{rows} whole rows up to t = {until} s are in {}", path.display());
    assert!(message.contains(&said), "not {said}: {message}");
}

#[test]
fn a_stopped_run_leaves_a_file_that_can_be_read_and_a_state() {
    for (name, signal, code) in [
        ("a.csv", "-INT", 130),
        ("a.parquet", "-TERM", 143),
        ("a.nc", "-INT", 130),
    ] {
        let folder = folder("stopped");
        let (path, trajectory) = (folder.join(name), folder.join(name).with_extension("xyz"));
        for old in [&path, &trajectory] {
            let _ = std::fs::remove_file(old); // of an earlier run of this test
        }
        let files = [
            "--output",
            path.to_str().unwrap(),
            "--trajectory",
            trajectory.to_str().unwrap(),
        ];
        let child = start(&[&LONG[..], &files].concat());
        wait_for(&trajectory, 100_000);
        let output = stop(child, signal);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{message}");
        check_kept(&path, &message);
        let frames = std::fs::read_to_string(&trajectory).unwrap().matches("Lattice").count();
        assert_eq!(frames, times(&path).len());
        assert!(message.contains(&format!("{frames} whole frames are in ")), "{message}");
        assert!(
            message.contains("with --resume") && folder.join("a.state").exists(),
            "{message}"
        );
    }
}

/// Nothing can be done then: what counts is that each record was complete before.
#[test]
fn netcdf_of_a_killed_run_can_be_read() {
    let path = folder("killed").join("a.nc");
    let _ = std::fs::remove_file(&path); // of an earlier run of this test
    let mut child = start(&[&LONG[..], &["--output", path.to_str().unwrap()]].concat());
    wait_for(&path, 100_000);
    child.kill().unwrap();
    child.wait().unwrap();
    let times = times(&path);
    assert!(times.len() > 100);
    assert!(times.iter().enumerate().all(|(row, time)| *time == row as f64 * 0.01));
}

/// A run that is stopped and goes on has the rows, to the last digit, of one that was never stopped.
#[test]
fn a_resumed_run_goes_on_with_the_same_bits() {
    let folder = folder("resumed");
    let path = |name: &str| -> String { folder.join(name).to_str().unwrap().into() };
    let short = ["run", "packing", "--disks", "6", "--sample", "0.01", "--no-progress"];
    let run = |more: &[&str]| {
        let output = jostle(&[&short[..], more].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
    };
    let seeded = ["--set", "seed=3", "--set", "measure.interval=0.02"];
    run(&[&["--seconds", "0.3", "--output", &path("whole.csv")], &seeded[..]].concat());
    run(&[
        &[
            "--seconds",
            "0.14",
            "--output",
            &path("a.csv"),
            "--state",
            &path("a.state"),
        ],
        &seeded[..],
    ]
    .concat());
    run(&[
        "--seconds",
        "0.3",
        "--output",
        &path("b.csv"),
        "--resume",
        &path("a.state"),
    ]);
    let read = |name: &str| std::fs::read_to_string(path(name)).unwrap();
    let (first, second) = (read("a.csv"), read("b.csv"));
    let joined = first.clone() + second.split_once('\n').unwrap().1;
    assert_eq!(joined, read("whole.csv"));
    assert!(read("b.parameters.csv").contains("seed,3,1\n"));
}

#[test]
fn what_cannot_be_resumed_is_refused() {
    let folder = folder("unresumed");
    let path = |name: &str| -> String { folder.join(name).to_str().unwrap().into() };
    let (state, first) = (path("a.state"), path("a.csv"));
    let short = [
        "run",
        "wedge",
        "--engine",
        "event-driven",
        "--seconds",
        "0.1",
        "--output",
    ];
    let saved = jostle(&[&short[..], &[&first, "--state", &state]].concat());
    assert!(saved.status.success(), "{}", text(&saved.stderr));
    std::fs::write(path("broken.state"), "no state").unwrap();
    let (broken, nowhere, other) = (path("broken.state"), path("nowhere.state"), path("b.csv"));
    let frames = path("a.xyz");
    std::fs::write(&frames, "of the saved run").unwrap();
    let cases: [(&[&str], &str); 7] = [
        (
            &["--seconds", "0.1", "--output", &other, "--resume", &state],
            "--seconds = 0.1 is not allowed: above 0.1 s",
        ),
        (
            &["--seconds", "1", "--output", &first, "--resume", &state],
            "whose rows it would replace",
        ),
        (
            &[
                "--seconds",
                "1",
                "--output",
                &other,
                "--resume",
                &state,
                "--trajectory",
                &frames,
            ],
            "may hold the frames of the saved run",
        ),
        (
            &["--seconds", "1", "--output", &other, "--resume", &nowhere],
            "--resume = ",
        ),
        (
            &["--seconds", "1", "--output", &other, "--resume", &broken],
            "--resume = ",
        ),
        (
            &[
                "--seconds",
                "1",
                "--output",
                &other,
                "--resume",
                &state,
                "--drive",
                "input",
            ],
            "drive input",
        ),
        (
            &[
                "--seconds",
                "1",
                "--output",
                &other,
                "--resume",
                &state,
                "--set",
                "gravity=9",
            ],
            "--set",
        ),
    ];
    for (words, said) in cases {
        let output = jostle(&[&["run", "wedge", "--engine", "event-driven"], words].concat());
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {message}");
        assert!(message.contains(said), "{words:?}: {message}");
    }
    assert!(!Path::new(&other).exists());
}

fn limited(blocks: u32, folder: &Path, name: &str, more: &[&str]) -> (PathBuf, String) {
    let path = folder.join(name);
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let words = [
        "run",
        "three_disk",
        "--seconds",
        "20",
        "--sample",
        "1e-3",
        "--output",
        path.to_str().unwrap(),
    ];
    let output = Command::new("sh")
        .args(["-c", &script, env!("CARGO_BIN_EXE_jostle")])
        .args(words)
        .args(more)
        .output()
        .unwrap();
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(
        message.contains("no space left in") && message.contains("Make room"),
        "{message}"
    );
    (path, message)
}

/// The limit stands for a full disk. Parquet needs room for its footer, which it has reserved.
#[test]
fn on_a_full_disk_every_format_keeps_what_it_says() {
    let folder = folder("full-formats");
    for name in ["full.csv", "full.nc", "full.parquet"] {
        let (path, message) = limited(6_000, &folder, name, &[]);
        check_kept(&path, &message);
    }
    let (path, message) = limited(8, &folder, "small.parquet", &[]);
    assert!(message.contains("no space left in"), "{message}");
    assert!(std::fs::metadata(path).map_or(0, |found| found.len()) <= 8 * 512);
}

#[test]
fn a_trajectory_on_a_full_disk_ends_with_a_whole_frame() {
    let folder = folder("full-trajectory");
    let trajectory = folder.join("t.dump");
    let (_, message) = limited(4_000, &folder, "-", &["--trajectory", trajectory.to_str().unwrap()]);
    let page = std::fs::read_to_string(trajectory).unwrap();
    let frames = page.matches("ITEM: TIMESTEP").count();
    assert!(page.ends_with('\n') && frames > 10, "{frames}");
    assert!(message.contains(&format!("{frames} whole frames are in ")), "{message}");
    let last = page.lines().last().unwrap();
    assert_eq!(last.split(' ').count(), 10, "{last}");
}

/// A device that is always full: nothing is kept, and that is said.
#[cfg(target_os = "linux")]
#[test]
fn a_full_device_keeps_no_row() {
    let output = jostle(&["run", "three_disk", "--seconds", "0.01", "--output", "/dev/full"]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("no space left in /dev"), "{message}");
}

#[test]
fn a_folder_that_takes_no_files_is_named() {
    for name in ["no/such/folder/run.parquet", "no/such/folder/run.nc"] {
        let output = jostle(&["run", "three_disk", "--seconds", "0.01", "--output", name]);
        assert_eq!(output.status.code(), Some(1));
        assert!(text(&output.stderr).contains("the folder no/such/folder does not exist"));
    }
    let own = folder("nowhere").join("run.csv");
    let words = [
        "run",
        "three_disk",
        "--seconds",
        "0.01",
        "--output",
        own.to_str().unwrap(),
    ];
    for option in ["--trajectory", "--state", "--parameters"] {
        let name = if option == "--trajectory" {
            "no/such/t.xyz"
        } else {
            "no/such/t.csv"
        };
        let output = jostle(&[&words[..], &[option, name]].concat());
        assert_eq!(output.status.code(), Some(1));
        assert!(
            text(&output.stderr).contains("the folder no/such does not exist"),
            "{option}"
        );
        assert!(!own.exists());
    }
}

/// A closed pipe means that the reader has read enough.
#[test]
fn a_reader_that_has_read_enough_ends_the_run_without_a_word() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut command = Command::new(env!("CARGO_BIN_EXE_jostle"));
    let output = command
        .args(LONG)
        .args(["--output", "-", "--no-progress"])
        .stdout(writer)
        .stderr(Stdio::piped())
        .output()
        .unwrap();
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
}
