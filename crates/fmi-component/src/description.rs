//! What a library tells of its own model, as bytes: facts, variables, abilities. A program that writes FMUs needs the library alone then.
//!
//! The bytes are a line of text, `fmi-component VERSION description FORMAT`, and a [`Description`] in the encoding of the crate
//! postcard. The format is another number whenever a type in it changes, and a reader takes its own number only: the line is
//! what a reader of any version can read, and tells which one wrote it.

use serde::{Deserialize, Serialize};

use crate::dynamic::ModelType;
use crate::error::{Error, Result};
use crate::info::ModelInfo;
use crate::structure::StructuralParameters;
use crate::variable::Variable;

/// Number of the present format.
pub const FORMAT: u32 = 1;

const TOOL: &str = "fmi-component ";
const DESCRIPTION: &str = " description ";

/// A model with its variables for certain structural parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(bound(deserialize = "'de: 'static"))] // texts stay where the bytes are
pub struct Description {
    /// Static facts.
    pub info: ModelInfo,
    /// The value of each structural parameter, in the order of the facts.
    pub structure: Vec<u32>,
    /// Variables for these.
    pub variables: Vec<Variable>,
    /// [`ModelType::events`].
    pub events: bool,
    /// [`ModelType::input_parts`].
    pub input_parts: u32,
    /// A panic of the model stays in its instance: false if the library was built with `panic = "abort"`.
    pub contains_panics: bool,
}

impl Description {
    /// That of `model` for the structural parameters in `choices`, a line `NAME=NUMBER` each; the defaults for the others.
    ///
    /// # Errors
    /// A line of another form, a parameter that the model does not have, or out of its range.
    pub fn of(model: &ModelType, choices: &str) -> Result<Self> {
        let info = (model.info)();
        let lines = choices.lines().map(choice).collect::<Result<Vec<_>>>()?;
        let structure = StructuralParameters::choose(&info, &lines)?;
        Ok(Self {
            variables: (model.variables)(&structure),
            structure: structure.iter().map(|(_, value)| value).collect(),
            info,
            events: model.events,
            input_parts: model.input_parts,
            contains_panics: cfg!(panic = "unwind"),
        })
    }

    /// The bytes.
    ///
    /// # Errors
    /// None is expected.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        let version = env!("CARGO_PKG_VERSION");
        let line = format!("{TOOL}{version}{DESCRIPTION}{FORMAT}\n").into_bytes();
        postcard::to_extend(self, line).map_err(|error| Error::call(format!("the description: {error}"), "Report it."))
    }

    /// Reads the bytes, which stay as long as the program since texts are not copied.
    ///
    /// # Errors
    /// Bytes of another format, with the version of this crate that wrote them, or no description.
    pub fn read(bytes: &'static [u8]) -> Result<Self> {
        let damaged = |what: &str| {
            Error::call(
                format!("it gives no description of its model: {what}"),
                "Build it anew.",
            )
        };
        let end = bytes.iter().position(|byte| *byte == b'\n');
        let (line, rest) = bytes.split_at(end.ok_or_else(|| damaged("it has no first line"))?);
        let line = String::from_utf8_lossy(line);
        let parts = line.strip_prefix(TOOL).and_then(|rest| rest.split_once(DESCRIPTION));
        let (version, format) = parts.ok_or_else(|| damaged(&format!("its first line is {line:?}")))?;
        if format != FORMAT.to_string() {
            let what = format!(
                "it was built with fmi-component {version} and describes its model in format {format}; this program reads format {FORMAT}"
            );
            return Err(Error::call(what, "Take this program and fmi-component of one version."));
        }
        postcard::from_bytes(&rest[1..]).map_err(|error| damaged(&error.to_string()))
    }

    /// The structural parameters with their names.
    ///
    /// # Errors
    /// They do not fit the facts.
    pub fn structure(&self) -> Result<StructuralParameters> {
        let names = self.info.structure.iter().map(|parameter| parameter.name);
        let chosen: Vec<_> = names.zip(self.structure.iter().copied()).collect();
        StructuralParameters::choose(&self.info, &chosen)
    }
}

fn choice(line: &str) -> Result<(&str, u32)> {
    let parts = line.split_once('=');
    let parts = parts.and_then(|(name, number)| Some((name.trim(), number.trim().parse().ok()?)));
    parts.ok_or_else(|| {
        Error::parameter(
            "structural parameter",
            line,
            "NAME=NUMBER, a whole number",
            "Write it so.",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, Row, Unit, Values};
    use std::sync::Arc;

    struct Everything;

    impl Model for Everything {
        type State = u8;

        fn info() -> ModelInfo {
            let mut info = ModelInfo::new("everything", "1.0", "One of each");
            info.variant.push(("drive", "input"));
            info.sheet.limits.push("none");
            info.sheet.example = Some(crate::ExampleRun {
                duration: 1.0,
                steps: 3,
                curves: &["x"],
                about: "",
            });
            info.structure.push(crate::StructuralParameter {
                name: "bodies",
                description: "How many.",
                range: 1..=9,
                default: 2,
            });
            info
        }

        fn variables(structure: &StructuralParameters) -> Vec<Row<Self>> {
            let option = crate::Kind::Enumeration {
                type_name: "pattern",
                options: &[("a", "First."), ("b", "")],
                start: 2,
            };
            let text = crate::Kind::Text { start: "word".into() };
            let mut rows = vec![
                Row::new("pattern", "Which.", crate::Causality::Parameter, option, None),
                Row::new("label", "What it says.", crate::Causality::Parameter, text, None),
            ];
            rows.push(
                Row::parameter("tau", Unit::SECOND, 1.0..=f64::INFINITY, 2.0, "Time.").recommended(1.0..=3.0, "slow."),
            );
            let names: Arc<[&'static str]> = Arc::from(["tau"]);
            rows.extend((0..structure.get("bodies")).map(|body| {
                Row::output(format!("x[{}]", body + 1), Unit::METRE, 1.0, "Place.", |_: &Self| 0.0).depending_on(&names)
            }));
            rows
        }

        fn new(_: &StructuralParameters, _: f64, _: &Values) -> Result<Self> {
            Ok(Self)
        }

        fn advance_to(&mut self, _: f64, _: &Values) -> Result<()> {
            Ok(())
        }

        fn state(&self) -> u8 {
            0
        }

        fn time_of(_: &u8) -> f64 {
            0.0
        }

        fn restore(&mut self, _: &u8) -> Result<()> {
            Ok(())
        }
    }

    const MODEL: ModelType = ModelType::of::<Everything>();

    #[test]
    fn a_description_is_read_back_as_it_was() {
        let description = Description::of(&MODEL, "bodies=4").unwrap();
        assert_eq!(
            (description.variables.len(), description.structure.as_slice()),
            (7, &[4][..])
        );
        let bytes = description.to_bytes().unwrap().leak();
        let read = Description::read(bytes).unwrap();
        assert_eq!(read, description);
        assert_eq!(read.structure().unwrap().get("bodies"), 4);
    }

    /// A regression test: whoever changes these bytes counts [`FORMAT`] up, since a program of before would misread them.
    #[test]
    fn the_format_has_another_number_when_the_bytes_change() {
        let bytes = Description::of(&MODEL, "").unwrap().to_bytes().unwrap();
        let text = bytes.iter().position(|byte| *byte == b'\n').unwrap();
        let sum = bytes[text..]
            .iter()
            .fold(0_u64, |sum, byte| sum.wrapping_mul(31).wrapping_add(u64::from(*byte)));
        assert_eq!((FORMAT, bytes.len() - text, sum), (1, 458, 15_724_025_704_065_282_302));
    }

    #[test]
    fn choices_that_the_model_does_not_take_are_refused() {
        for (choices, words) in [
            ("bodies=10", "1 to 9"),
            ("bodies", "NAME=NUMBER"),
            ("balls=3", "balls is not allowed: one of the model everything: bodies"),
        ] {
            let message = Description::of(&MODEL, choices).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        }
    }

    #[test]
    fn bytes_of_another_format_are_refused_by_the_version_that_wrote_them() {
        for (bytes, words) in [
            (
                &b"fmi-component 7.1.0 description 2\n..."[..],
                "fmi-component 7.1.0 and describes its model in format 2; this program reads format 1",
            ),
            (b"fmi-component 7.1.0 description 1\n.", "no description of its model"),
            (b"something else\n", "first line is \"something else\""),
            (b"", "no first line"),
        ] {
            let message = Description::read(bytes).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        }
    }
}
