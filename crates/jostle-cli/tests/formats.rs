//! Samples in every format, and to standard output: the same numbers.
#![allow(clippy::unwrap_used)]

mod support;

use std::path::{Path, PathBuf};

use netcdf3::FileReader;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::RowAccessor;
use support::{folder, jostle, text};

const RUN: [&str; 9] = [
    "run",
    "ratchet",
    "--disks",
    "4",
    "--seconds",
    "0.25",
    "--no-progress",
    "--set",
    "seed=3",
];

fn run_into(output: &Path, more: &[&str]) -> String {
    let ran = jostle(&[&RUN[..], &["--output", output.to_str().unwrap()], more].concat());
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    text(&ran.stdout)
}

/// Names and rows of CSV.
fn table(page: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_reader(page.as_bytes());
    let names = reader.headers().unwrap().iter().map(String::from).collect();
    let row = |row: csv::StringRecord| row.iter().map(|cell| cell.parse().unwrap()).collect();
    (names, reader.records().map(|found| row(found.unwrap())).collect())
}

fn csv_of_the_run(folder: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let path = folder.join("run.csv");
    run_into(&path, &[]);
    table(&std::fs::read_to_string(path).unwrap())
}

#[test]
fn standard_output_takes_the_samples_and_the_summary_goes_to_standard_error() {
    let folder = folder("standard");
    let parameters = folder.join("p.csv");
    let words = ["--output", "-", "--parameters", parameters.to_str().unwrap()];
    let ran = jostle(&[&RUN[..], &words].concat());
    assert_eq!(ran.status.code(), Some(0));
    assert_eq!(table(&text(&ran.stdout)), csv_of_the_run(&folder));
    assert!(text(&ran.stderr).contains("26 rows in standard output, parameters in "));
    assert!(std::fs::read_to_string(parameters).unwrap().contains("seed,3,1\n"));
    assert!(!folder.join("-").exists() && !Path::new("-").exists());
}

#[test]
fn parquet_has_the_numbers_of_csv_with_units_and_parameters() {
    let folder = folder("parquet");
    let path = folder.join("alone.parquet");
    let said = run_into(&path, &[]);
    assert!(
        said.contains("26 rows in ") && !said.contains("parameters in"),
        "{said}"
    );
    assert!(!folder.join("alone.parameters.csv").exists());
    let (names, rows) = csv_of_the_run(&folder);
    let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
    let file = reader.metadata().file_metadata();
    let columns: Vec<String> = file
        .schema_descr()
        .columns()
        .iter()
        .map(|column| column.name().into())
        .collect();
    assert_eq!(columns, names);
    let found: Vec<Vec<f64>> = reader
        .get_row_iter(None)
        .unwrap()
        .map(|row| {
            let row = row.unwrap();
            (0..names.len()).map(|index| row.get_double(index).unwrap()).collect()
        })
        .collect();
    assert_eq!(found, rows);
    let pairs = file.key_value_metadata().unwrap();
    let value = |key: &str| {
        pairs
            .iter()
            .find(|pair| pair.key == key)
            .and_then(|pair| pair.value.as_deref())
    };
    assert_eq!(value("scene"), Some("ratchet"));
    assert_eq!(value("seed"), Some("3"));
    assert_eq!(value("disk.mass_rule"), Some("equal_mass"));
    assert_eq!(value("units/drive.amplitude"), Some("m"));
    assert_eq!(value("units/disk.x[3]"), Some("m"));
    assert!(value("long_name/disk.x[3]").unwrap().ends_with("of disk 3"));
}

#[test]
fn netcdf_has_the_numbers_of_csv_by_time_and_disk() {
    let folder = folder("netcdf");
    let path = folder.join("run.nc");
    run_into(&path, &[]);
    let (names, rows) = csv_of_the_run(&folder);
    let column = |name: &str| names.iter().position(|known| known == name).unwrap();
    let mut reader = FileReader::open(&path).unwrap();
    assert_eq!(reader.data_set().num_records(), Some(rows.len()));
    assert_eq!(reader.data_set().get_global_attr_as_string("scene").unwrap(), "ratchet");
    let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    assert_eq!(reader.read_var_f64("time").unwrap(), times);
    let heights: Vec<f64> = rows
        .iter()
        .flat_map(|row| (1..=4).map(|disk| row[column(&format!("disk.y[{disk}]"))]))
        .collect();
    assert_eq!(reader.read_var_f64("disk.y").unwrap(), heights);
    assert_eq!(reader.read_var_i32("disk").unwrap(), [1, 2, 3, 4]);
}

#[test]
fn fields_go_to_parquet_and_to_standard_output() {
    let folder = folder("fields-formats");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_string();
    let words = [
        "fields",
        "ratchet",
        "--disks",
        "4",
        "--seconds",
        "0.1",
        "--no-progress",
        "--boxes",
        "2",
        "--phases",
        "2",
    ];
    let (fields, profile) = (path("f.parquet"), path("p.parquet"));
    let ran = jostle(&[&words[..], &["--output", &fields, "--profile", &profile]].concat());
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    let printed = jostle(&[&words[..], &["--output", "-"]].concat());
    assert!(text(&printed.stderr).contains("fields in standard output"));
    let (names, rows) = table(&text(&printed.stdout));
    assert_eq!(names, ["phase", "x", "y", "mass", "momentum_x", "momentum_y"]);
    let reader = SerializedFileReader::new(std::fs::File::open(fields).unwrap()).unwrap();
    let found = reader.get_row_iter(None).unwrap().map(|row| {
        let row = row.unwrap();
        let numbers = (1..6).map(|index| row.get_double(index).unwrap());
        std::iter::once(row.get_long(0).unwrap() as f64)
            .chain(numbers)
            .collect::<Vec<f64>>()
    });
    assert_eq!(found.collect::<Vec<_>>(), rows);
    assert!(SerializedFileReader::new(std::fs::File::open(profile).unwrap()).is_ok());
}

#[test]
fn theory_goes_to_a_file() {
    let path = folder("theory").join("limits.csv");
    let words = ["theory", "three_disk", "limits", "--set", "tilt=0,0.2"];
    let printed = text(&jostle(&words).stdout);
    let wrote = jostle(&[&words[..], &["--output", path.to_str().unwrap()]].concat());
    assert!(wrote.status.success() && wrote.stdout.is_empty());
    assert_eq!(std::fs::read_to_string(path).unwrap(), printed);
}

/// Frames of extended XYZ and of a dump, read as their definitions say: places and angular velocities of each disk.
#[test]
fn trajectories_have_the_places_of_the_samples() {
    let folder = folder("trajectories");
    let (names, rows) = csv_of_the_run(&folder);
    let column = |name: &str, disk: usize| {
        names
            .iter()
            .position(|known| *known == format!("{name}[{disk}]"))
            .unwrap()
    };
    let wanted: Vec<[f64; 3]> = rows
        .iter()
        .flat_map(|row| {
            (1..=4)
                .map(move |disk| ["disk.x", "disk.y", "disk.angular_velocity"].map(|name| (name, disk)))
                .map(move |names| names.map(|(name, disk)| row[column(name, disk)]))
        })
        .collect();
    let lines = |name: &str, starts: &dyn Fn(&str) -> bool| -> Vec<Vec<String>> {
        let path: PathBuf = folder.join(name);
        run_into(&folder.join("again.csv"), &["--trajectory", path.to_str().unwrap()]);
        let page = std::fs::read_to_string(path).unwrap();
        let rows = page.lines().filter(|line| starts(line));
        rows.map(|line| line.split(' ').map(String::from).collect()).collect()
    };
    let chosen = |rows: Vec<Vec<String>>, places: [usize; 3]| -> Vec<[f64; 3]> {
        rows.iter()
            .map(|row| places.map(|place| row[place].parse().unwrap()))
            .collect()
    };
    assert_eq!(
        chosen(lines("t.xyz", &|line| line.starts_with("X ")), [1, 2, 12]),
        wanted
    );
    let is_atom = |line: &str| line.split(' ').count() == 13 && !line.starts_with("ITEM");
    assert_eq!(chosen(lines("t.dump", &is_atom), [3, 4, 11]), wanted);
}
