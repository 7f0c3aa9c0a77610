//! The name of a file that is to be written.

use std::path::{Path, PathBuf};

use jostle::Error;

/// Endings of text, which CSV is. A number after a dot is no ending: `gamma0.1`.
const TEXT: [&str; 3] = ["csv", "txt", "dat"];

/// Refuses a name that says that something else than CSV is in the file.
///
/// # Errors
/// `-`, or the ending of another format.
pub fn check_csv(option: &str, path: &Path) -> Result<(), Error> {
    let ending = ending(path);
    let is_number = ending.starts_with(|first: char| first.is_ascii_digit());
    let fits = ending.is_empty() || is_number || TEXT.contains(&ending.as_str());
    match fits && path != Path::new("-") {
        true => Ok(()),
        false => Err(refused(option, path, "csv", "since the table is written as CSV")),
    }
}

/// Refuses a name that does not end as that of an FMU.
///
/// # Errors
/// Another ending, or none: importers go by it.
pub fn check_fmu(option: &str, path: &Path) -> Result<(), Error> {
    match ending(path) == "fmu" {
        true => Ok(()),
        false => Err(refused(option, path, "fmu", "by which importers know an FMU")),
    }
}

/// Refuses a name that does not end as that of a page.
///
/// # Errors
/// Another ending, or none: browsers go by it.
pub fn check_html(option: &str, path: &Path) -> Result<(), Error> {
    match matches!(ending(path).as_str(), "html" | "htm") {
        true => Ok(()),
        false => Err(refused(option, path, "html", "by which browsers know a page")),
    }
}

/// `run.parameters.csv` beside `run.csv`. Other endings stay, so that `gamma0.1` and `gamma0.2` have a file each.
pub fn beside(path: &Path, ending: &str) -> PathBuf {
    match path.extension() {
        Some(known) if known == "csv" => path.with_extension(ending),
        _ => path.with_added_extension(ending),
    }
}

fn ending(path: &Path) -> String {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    ending.to_ascii_lowercase()
}

fn refused(option: &str, path: &Path, ending: &str, why: &str) -> Error {
    let allowed = format!("the name of a file that ends in .{ending}, {why}");
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

    #[test]
    fn names_of_other_formats_are_refused_with_one_that_fits() {
        for name in ["run.csv", "RUN.CSV", "run", "gamma0.1", "run.txt", "/dev/stdout"] {
            assert_eq!(check_csv("--output", Path::new(name)), Ok(()), "{name}");
        }
        for (name, proposed) in [
            ("a/r.h5", "--output a/r.csv"),
            ("-", "FILE.csv"),
            ("run.fmu", "run.csv"),
        ] {
            let message = check_csv("--output", Path::new(name)).unwrap_err().to_string();
            assert!(
                message.starts_with(&format!("--output = {name} is not allowed")),
                "{message}"
            );
            assert!(message.ends_with(proposed), "{message}");
        }
        assert_eq!(check_fmu("--out", Path::new("a/b.FMU")), Ok(()));
        for (name, proposed) in [("x.txt", "--out x.fmu"), ("x", "--out x.fmu"), ("-", "FILE.fmu")] {
            let message = check_fmu("--out", Path::new(name)).unwrap_err().to_string();
            assert!(message.ends_with(proposed), "{message}");
        }
    }
}
