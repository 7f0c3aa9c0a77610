//! Reference trajectory in, the files of the layered standard FMI-LS-REF out: a manifest that says what an FMU holds besides, and
//! the trajectory as an experiment that any tool can run: the inputs in a table of their own, the results in the trajectory itself.
//!
//! The manifest follows FMI-LS-REF 1.0.0-alpha.1 and is for both versions of FMI. The experiment follows the schema of
//! MA-HS-Experiments, a draft without a version, whose text still has the times on the element `Experiment`.

use std::io;

use fmi_component::{Causality, Error, Result, Table};

use crate::component::Component;
use crate::reference;
use crate::xml::{self, Attributes, Xml};

/// The folder that both versions of FMI leave to this standard.
const FOLDER: &str = "extra/org.fmi-standard.fmi-ls-ref";
const NAMESPACE: &str = "http://fmi-standard.org/fmi-ls-manifest";
const EXPERIMENT: &str = "reference.exp";
const STIMULI: &str = "stimuli.csv";

/// The files, each with its path in the FMU; `trajectory` is what [`reference::record`] gave. None where the model does not make a
/// single step from its start values, since there is then no experiment.
///
/// # Errors
/// `trajectory` is no table.
pub fn write(component: &Component, trajectory: &str) -> Result<Vec<(String, Vec<u8>)>> {
    let failed = |error: &dyn ToString| {
        let what = format!("the reference trajectory: {}", error.to_string());
        Error::call(what, "Try again.")
    };
    let mut reader = csv::Reader::from_reader(trajectory.as_bytes());
    let header = reader.headers().map_err(|error| failed(&error))?.clone();
    let records = reader.records().map(|record| record.map_err(|error| failed(&error)));
    let rows = records.collect::<Result<Vec<_>>>()?;
    let (Some(first), Some(last)) = (rows.first(), rows.last().filter(|_| rows.len() > 1)) else {
        return Ok(Vec::new());
    };
    let inputs = columns_of_inputs(component.table(), &header);
    // The time alone stimulates nothing.
    let stimulated = inputs.len() > 1;
    let times = [first, last, &rows[1]].map(|row| row.get(0).unwrap_or_default());
    let results = reference::path(component.info()).replacen("extra", "..", 1);
    let mut files = vec![
        ("fmi-ls-manifest.xml", manifest(&results).into_bytes()),
        (
            EXPERIMENT,
            experiment(component, times, stimulated, &results).into_bytes(),
        ),
    ];
    if stimulated {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in [&header].into_iter().chain(&rows) {
            let cells = inputs.iter().map(|column| row.get(*column).unwrap_or_default());
            writer.write_record(cells).map_err(|error| failed(&error))?;
        }
        let table = writer.into_inner().map_err(|error| failed(&error.into_error()))?;
        files.push((STIMULI, table));
    }
    let in_folder = |(name, content)| (format!("{FOLDER}/{name}"), content);
    Ok(files.into_iter().map(in_folder).collect())
}

/// Columns of the time and of the inputs.
fn columns_of_inputs(table: &Table, header: &csv::StringRecord) -> Vec<usize> {
    let is_input = |name: &str| {
        let position = table.position(name);
        position.is_some_and(|position| table.variables()[position].causality == Causality::Input)
    };
    let names = header.iter().enumerate();
    names
        .filter(|(column, name)| *column == 0 || is_input(name))
        .map(|(column, _)| column)
        .collect()
}

fn manifest(results: &str) -> String {
    let root = vec![
        ("xmlns:fmi-ls", NAMESPACE.into()),
        ("fmi-ls:fmi-ls-name", "org.fmi-standard.fmi-ls-ref".into()),
        ("fmi-ls:fmi-ls-version", "1.0.0-alpha.1".into()),
        (
            "fmi-ls:fmi-ls-description",
            "Layered Standard providing information on related files included in an FMU.".into(),
        ),
    ];
    let related = [
        (
            "application/x-ma-hs-experiments",
            EXPERIMENT,
            "experiment/smoke-test",
            "A short run from the start values",
        ),
        (
            "text/csv",
            results,
            "result",
            "Inputs and outputs of the run in reference.exp",
        ),
        (
            "text/html",
            "../../documentation/index.html",
            "document",
            "Variables, parameters and equations",
        ),
    ];
    xml::document(|xml| {
        xml::element(xml, "fmiReferences", &root, |xml| {
            related.iter().try_for_each(|(kind, source, role, description)| {
                let attributes: Attributes = vec![
                    ("type", (*kind).into()),
                    ("source", (*source).into()),
                    ("role", (*role).into()),
                    ("description", (*description).into()),
                ];
                xml::empty(xml, "Related", &attributes)
            })
        })
    })
}

fn experiment(component: &Component, [start, stop, second]: [&str; 3], stimulated: bool, results: &str) -> String {
    let name = component.info().name;
    let root = vec![
        ("name", format!("{name}: smoke test")),
        (
            "description",
            "What the FMU computes from its start values where it was made".into(),
        ),
    ];
    let about = vec![
        ("name", "reference".into()),
        (
            "description",
            "Each row of the stimuli is set at its time; the step to the time of the next row follows. Results are those before that step".into(),
        ),
    ];
    // The first row is at the start time, so that the second one is a step later.
    let times = vec![
        ("startTime", start.into()),
        ("stopTime", stop.into()),
        ("stepSize", step(start, second)),
    ];
    xml::document(|xml| {
        xml::element(xml, "Experiments", &root, |xml| {
            xml::element(xml, "Experiment", &about, |xml| {
                xml::empty(xml, "TransientSimulation", &times)?;
                if stimulated {
                    table(xml, "Stimuli", STIMULI)?;
                }
                table(xml, "References", results)
            })
        })
    })
}

fn step(start: &str, second: &str) -> String {
    let number = |text: &str| text.parse::<f64>().unwrap_or_default();
    xml::number(number(second) - number(start))
}

fn table(xml: &mut Xml, element: &str, file: &str) -> io::Result<()> {
    xml::empty(
        xml,
        element,
        &vec![("type", "text/csv".into()), ("source", file.into())],
    )
}
