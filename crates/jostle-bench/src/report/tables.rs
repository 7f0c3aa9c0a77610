//! The CSV files of a report.

use std::path::Path;

use anyhow::Result;

use super::Measured;
use super::case::Case;
use jostle::scene::Value;

use crate::csv_file::write_csv as write;

/// One row for each quantity of each point. A point without a number has its reason in the last column.
pub fn write_points(path: &Path, case: &Case, measured: &[Measured]) -> Result<()> {
    let header = [
        "case",
        "quantity",
        "method",
        "setting",
        "error",
        "error_bar",
        "cpu_seconds",
        "evaluations",
        "trouble",
    ];
    let rows = measured.iter().flat_map(|point| {
        case.quantities.iter().enumerate().map(move |(index, (quantity, _))| {
            let (numbers, trouble) = match &point.outcome {
                Ok((done, seconds)) => {
                    let (error, bar) = done.errors[index];
                    ([error, bar, *seconds, done.evaluations].map(short), String::new())
                }
                Err(trouble) => (<[String; 4]>::default(), trouble.clone()),
            };
            let [error, bar, seconds, evaluations] = numbers;
            let words = [case.name, quantity, point.method].map(String::from);
            let [case, quantity, method] = words;
            let setting = short(point.setting);
            [
                case,
                quantity,
                method,
                setting,
                error,
                bar,
                seconds,
                evaluations,
                trouble,
            ]
        })
    });
    write(path, std::iter::once(header.map(String::from)).chain(rows))
}

/// Five digits: more would be noise.
fn short(number: f64) -> String {
    let rounded = format!("{number:.4e}").parse().unwrap_or(number);
    Value::Real(rounded).to_string()
}

/// `cases.csv`: what the words in the points mean.
pub fn write_cases(path: &Path, cases: &[Case]) -> Result<()> {
    let header = ["case", "quantity", "error", "setting", "reference", "problem"].map(String::from);
    let rows = cases.iter().flat_map(|case| {
        case.quantities.iter().map(|(quantity, error)| {
            [
                case.name.into(),
                (*quantity).into(),
                (*error).into(),
                case.setting.into(),
                case.reference.into(),
                case.problem.clone(),
            ]
        })
    });
    write(path, std::iter::once(header).chain(rows))
}
