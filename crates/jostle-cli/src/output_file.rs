//! The name of a file that is to be written, and the format that it means.

use std::path::{Path, PathBuf};

use jostle::Error;

use crate::failure::Failure;

/// Endings of text, which CSV is. A number after a dot is no ending: `gamma0.1`.
const TEXT: [&str; 3] = ["csv", "txt", "dat"];

/// Format of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Text.
    Csv,
    /// CSV to standard output.
    StandardOutput,
    /// Parquet.
    Parquet,
    /// NetCDF.
    NetCdf,
}

/// Format of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TrajectoryFormat {
    /// Extended XYZ.
    ExtendedXyz,
    /// The text dump of LAMMPS.
    LammpsDump,
}

/// The format that the name of a table means.
///
/// # Errors
/// An ending that stands for another format.
pub fn table_format(option: &str, path: &Path) -> Result<Format, Error> {
    match plain_format(option, path) {
        Ok(format) => Ok(format),
        Err(_) if ending(path) == "nc" => Ok(Format::NetCdf),
        Err(_) => Err(refused(
            option,
            path,
            "csv",
            "one that ends in .csv, .txt, .dat or a number (CSV), .parquet (Parquet) or .nc (NetCDF), or - for CSV to \
             standard output",
        )),
    }
}

/// The format that the name of a table means which has no column of times, and so no place in NetCDF.
///
/// # Errors
/// An ending that stands for another format.
pub fn plain_format(option: &str, path: &Path) -> Result<Format, Error> {
    let ending = ending(path);
    let is_number = ending.starts_with(|first: char| first.is_ascii_digit());
    if is_standard_output(path) {
        return Ok(Format::StandardOutput);
    }
    if ending.is_empty() || is_number || TEXT.contains(&ending.as_str()) {
        return Ok(Format::Csv);
    }
    if ending == "parquet" {
        return Ok(Format::Parquet);
    }
    Err(refused(
        option,
        path,
        "csv",
        "one that ends in .csv, .txt, .dat or a number (CSV) or .parquet (Parquet), or - for CSV to standard output",
    ))
}

/// The format that the name of a trajectory means.
///
/// # Errors
/// Another ending, or none.
pub fn trajectory_format(option: &str, path: &Path) -> Result<TrajectoryFormat, Error> {
    match ending(path).as_str() {
        "xyz" | "extxyz" => Ok(TrajectoryFormat::ExtendedXyz),
        "dump" | "lammpstrj" => Ok(TrajectoryFormat::LammpsDump),
        _ => Err(refused(
            option,
            path,
            "xyz",
            "one that ends in .xyz or .extxyz (extended XYZ), .dump or .lammpstrj (LAMMPS dump)",
        )),
    }
}

/// Refuses a name that says that something else than CSV is in the file.
///
/// # Errors
/// `-`, or the ending of another format.
pub fn check_csv(option: &str, path: &Path) -> Result<(), Error> {
    match plain_format(option, path) {
        Ok(Format::Csv) => Ok(()),
        _ => Err(refused(
            option,
            path,
            "csv",
            "that of a file that ends in .csv, since it is written as CSV",
        )),
    }
}

/// Refuses a name that does not end as that of an FMU.
///
/// # Errors
/// Another ending, or none: importers go by it.
pub fn check_fmu(option: &str, path: &Path) -> Result<(), Error> {
    check_ending(option, path, &["fmu"], "by which importers know an FMU")
}

/// Refuses a name that does not end as that of an SSP archive.
///
/// # Errors
/// Another ending, or none: tools go by it.
pub fn check_ssp(option: &str, path: &Path) -> Result<(), Error> {
    check_ending(option, path, &["ssp"], "by which tools know a system")
}

/// Whether the name stands for standard output.
pub fn is_standard_output(path: &Path) -> bool {
    path == Path::new("-")
}

/// The name in a sentence.
pub fn shown(path: &Path) -> String {
    match is_standard_output(path) {
        true => "standard output".into(),
        false => path.display().to_string(),
    }
}

/// Refuses a name that two options have.
///
/// # Errors
/// Two of them are the same file.
pub fn check_distinct(files: &[(&str, &Path)]) -> Result<(), Error> {
    let whole = |path: &Path| std::path::absolute(path).ok();
    for (index, (option, path)) in files.iter().enumerate() {
        if let Some((before, _)) = files[..index].iter().find(|(_, other)| whole(other) == whole(path)) {
            let allowed = format!("another file than that of {before}");
            return Err(Error::parameter(*option, path.display(), allowed, "Name two files."));
        }
    }
    Ok(())
}

/// Refuses a file that cannot be written. One that is there keeps what it holds, and one that is not there is not left behind.
///
/// # Errors
/// It cannot be written.
pub fn check_writable(path: &Path) -> Result<(), Failure> {
    if is_standard_output(path) {
        return Ok(());
    }
    let was_there = path.exists();
    let opened = std::fs::File::options().append(true).create(true).open(path).map(drop);
    let tried = match was_there {
        true => opened,
        false => opened.and_then(|()| std::fs::remove_file(path)),
    };
    tried.map_err(|error| Failure::file(path, &error))
}

/// `run.state` beside `run.csv`. Numbers after a dot stay, so that `gamma0.1` and `gamma0.2` have a file each.
pub fn beside(path: &Path, ending_of_new: &str) -> PathBuf {
    let old = ending(path);
    let is_known = ["csv", "parquet", "nc"].contains(&old.as_str());
    if is_known {
        path.with_extension(ending_of_new)
    } else {
        path.with_added_extension(ending_of_new)
    }
}

/// Refuses a name that does not end as that of a page.
///
/// # Errors
/// Another ending, or none: browsers go by it.
pub fn check_html(option: &str, path: &Path) -> Result<(), Error> {
    check_ending(option, path, &["html", "htm"], "by which browsers know a page")
}

/// Refuses a name with none of these endings; the first is proposed.
fn check_ending(option: &str, path: &Path, endings: &[&str], why: &str) -> Result<(), Error> {
    if endings.contains(&ending(path).as_str()) {
        return Ok(());
    }
    let proposed = endings[0];
    let what = format!("that of a file that ends in .{proposed}, {why}");
    Err(refused(option, path, proposed, &what))
}

fn ending(path: &Path) -> String {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    ending.to_ascii_lowercase()
}

fn refused(option: &str, path: &Path, ending: &str, what: &str) -> Error {
    let allowed = format!("the name of a file, {what}");
    let proposed = match path.file_stem() {
        Some(stem) if stem != "-" => path.with_file_name(stem).with_added_extension(ending),
        _ => format!("FILE.{ending}").into(),
    };
    Error::parameter(
        option,
        path.display(),
        allowed,
        format!("Write, say, {option} {}", proposed.display()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn format_of(name: &str) -> Result<Format, Error> {
        table_format("--output", Path::new(name))
    }

    #[test]
    fn the_ending_means_the_format() {
        for name in [
            "run.csv",
            "RUN.CSV",
            "run",
            "gamma0.1",
            "run.txt",
            "run.dat",
            "/dev/stdout",
        ] {
            assert_eq!(format_of(name), Ok(Format::Csv), "{name}");
        }
        assert_eq!(format_of("a.b/run.Parquet"), Ok(Format::Parquet));
        assert_eq!(format_of("run.nc"), Ok(Format::NetCdf));
        assert_eq!(format_of("-"), Ok(Format::StandardOutput));
        let trajectory = |name: &str| trajectory_format("--trajectory", Path::new(name));
        assert_eq!(trajectory("a.xyz"), Ok(TrajectoryFormat::ExtendedXyz));
        assert_eq!(trajectory("a.extxyz"), Ok(TrajectoryFormat::ExtendedXyz));
        assert_eq!(trajectory("a.dump"), Ok(TrajectoryFormat::LammpsDump));
        assert_eq!(trajectory("a.lammpstrj"), Ok(TrajectoryFormat::LammpsDump));
    }

    #[test]
    fn names_of_other_formats_are_refused_with_one_that_fits() {
        for (name, proposed) in [
            ("a/r.h5", "--output a/r.csv"),
            ("run.fmu", "run.csv"),
            ("x.npy", "x.csv"),
        ] {
            let message = format_of(name).unwrap_err().to_string();
            assert!(
                message.starts_with(&format!("--output = {name} is not allowed")),
                "{message}"
            );
            assert!(
                message.contains(".parquet (Parquet) or .nc (NetCDF), or - for"),
                "{message}"
            );
            assert!(message.ends_with(proposed), "{message}");
        }
        let message = plain_format("--output", Path::new("f.nc")).unwrap_err().to_string();
        assert!(!message.contains("NetCDF"), "{message}");
        for name in ["t.csv", "t", "-"] {
            let message = trajectory_format("--trajectory", Path::new(name))
                .unwrap_err()
                .to_string();
            assert!(
                message.contains("ends in .xyz") && message.contains(".lammpstrj"),
                "{message}"
            );
        }
        for name in ["-", "p.parquet", "p.json"] {
            assert!(check_csv("--parameters", Path::new(name)).is_err(), "{name}");
        }
        assert_eq!(check_fmu("--out", Path::new("a/b.FMU")), Ok(()));
        for (name, proposed) in [("x.txt", "--out x.fmu"), ("x", "--out x.fmu"), ("-", "FILE.fmu")] {
            let message = check_fmu("--out", Path::new(name)).unwrap_err().to_string();
            assert!(message.ends_with(proposed), "{message}");
        }
    }

    #[test]
    fn files_beside_keep_numbers_after_a_dot() {
        for (name, expected) in [
            ("a/run.csv", "a/run.state"),
            ("run.nc", "run.state"),
            ("gamma0.1", "gamma0.1.state"),
            ("run.txt", "run.txt.state"),
        ] {
            assert_eq!(beside(Path::new(name), "state"), Path::new(expected));
        }
    }

    #[test]
    fn one_file_for_two_options_is_refused() {
        let files = [
            ("--output", Path::new("a.csv")),
            ("--parameters", Path::new("b.csv")),
            ("--state", Path::new("./a.csv")),
        ];
        assert_eq!(check_distinct(&files[..2]), Ok(()));
        let message = check_distinct(&files).unwrap_err().to_string();
        assert!(
            message.starts_with("--state = ./a.csv") && message.contains("that of --output"),
            "{message}"
        );
    }
}
