//! `ModelVariables`: one element per variable, or per array of variables.

use std::io;

use fmi_component::{Causality, Kind, TIME, TIME_REFERENCE, Variable, Version, value_reference};

use super::Layout;
use super::types::{RealType, typed};
use crate::xml::{self, Attributes, Xml, number};

/// All variables, the time first.
pub fn write(xml: &mut Xml, layout: &Layout<'_>) -> io::Result<()> {
    let about_time = vec![
        ("name", TIME.into()),
        ("valueReference", TIME_REFERENCE.to_string()),
        ("description", "Simulated time.".into()),
        ("causality", "independent".into()),
        ("variability", "continuous".into()),
    ];
    let unit = typed(RealType::TIME, layout.version);
    element(xml, layout.version, about_time, ("Real", "Float64"), unit, Inner::None)?;
    layout
        .positions()
        .try_for_each(|position| write_variable(xml, layout, position))
}

fn write_variable(xml: &mut Xml, layout: &Layout<'_>, position: usize) -> io::Result<()> {
    let variable = layout.variable(position);
    let array = layout.component.is_array(position);
    let description = match array {
        true => of_each(&variable.description),
        false => variable.description.clone(),
    };
    let mut about = vec![
        ("name", layout.component.name_at(position).into()),
        ("valueReference", value_reference(position).to_string()),
        ("description", description),
        ("causality", causality(variable.causality).into()),
        (
            "variability",
            layout.component.table().variability(position).word().into(),
        ),
    ];
    let inside = layout.component.input_parts() > 0 && variable.causality == Causality::Input;
    if inside && layout.version == Version::Three {
        about.push(("intermediateUpdate", "true".into()));
    }
    about.extend(initial(variable.causality).map(|initial| ("initial", initial.into())));
    let kinds = match variable.kind {
        Kind::Real(_) => ("Real", "Float64"),
        Kind::Integer { .. } => ("Integer", "Int32"),
        Kind::Long { .. } => ("Integer", "Int64"),
        Kind::Enumeration { .. } => ("Enumeration", "Enumeration"),
        Kind::Boolean { .. } => ("Boolean", "Boolean"),
        Kind::Single(_) => ("Real", "Float32"),
        Kind::Sized { size, .. } => ("Integer", size.name()),
        Kind::Text { .. } => ("String", "String"),
        Kind::Binary { .. } => ("", "Binary"), // FMI 2.0 leaves it out
    };
    let mut list = details(variable, layout.version);
    if array && let Some((_, start)) = list.iter_mut().find(|(key, _)| *key == "start") {
        let elements = (position..position + layout.spans[position]).map(|element| layout.variable(element));
        let starts: Vec<String> = elements.map(|element| number(element.start().to_f64())).collect();
        *start = starts.join(" ");
    }
    if let Some(integral) = layout.integrals[position] {
        let target = match layout.version {
            Version::Two => layout.index(integral),
            Version::Three => value_reference(integral).to_string(),
        };
        list.push(("derivative", target));
    }
    let inner = match variable.kind.start_bytes().filter(|_| variable.causality.is_settable()) {
        _ if array => Inner::Dimensions(layout.component.dimensions(position)),
        Some(bytes) => Inner::Start(start_text(variable, bytes)),
        None => Inner::None,
    };
    element(xml, layout.version, about, kinds, list, inner)
}

/// What FMI 3.0 writes inside of the element of a variable.
enum Inner {
    None,
    /// Lengths of an array.
    Dimensions(Vec<usize>),
    /// Start value of a text or, in hexadecimal digits, of a binary variable.
    Start(String),
}

fn start_text(variable: &Variable, bytes: &[u8]) -> String {
    match variable.kind {
        Kind::Binary { .. } => bytes.iter().map(|byte| format!("{byte:02x}")).collect(),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    }
}

/// FMI 2.0 splits what FMI 3.0 writes in one element.
fn element(
    xml: &mut Xml,
    version: Version,
    mut about: Attributes,
    kinds: (&str, &str),
    mut details: Attributes,
    inner: Inner,
) -> io::Result<()> {
    match version {
        Version::Two => {
            if let Inner::Start(text) = inner {
                details.push(("start", text));
            }
            xml::element(xml, "ScalarVariable", &about, |xml| xml::empty(xml, kinds.0, &details))
        }
        Version::Three => {
            about.extend(details);
            let (element, contents) = match inner {
                Inner::None => return xml::empty(xml, kinds.1, &about),
                Inner::Dimensions(lengths) => {
                    let lengths = lengths.into_iter().map(|length| ("start", length.to_string()));
                    ("Dimension", lengths.collect())
                }
                Inner::Start(text) => ("Start", vec![("value", text)]),
            };
            xml::element(xml, kinds.1, &about, |xml| {
                let mut contents = contents.into_iter();
                contents.try_for_each(|content| xml::empty(xml, element, &vec![content]))
            })
        }
    }
}

/// Description of an array from that of its first element: `Mass of body 1.` becomes `Mass of each body.`
pub(crate) fn of_each(first: &str) -> String {
    let stands_alone = |end: &usize| !first[*end..].starts_with(|next: char| next.is_alphanumeric());
    let mut ends = first.match_indices(" 1").map(|(start, one)| start + one.len());
    let Some(end) = ends.find(stands_alone) else {
        return first.into();
    };
    let before = &first[..end - " 1".len()];
    let noun = before.rfind(' ').map_or(0, |space| space + 1);
    format!("{}each {}{}", &before[..noun], &before[noun..], &first[end..])
}

fn causality(causality: Causality) -> &'static str {
    match causality {
        Causality::Parameter => "parameter",
        Causality::CalculatedParameter => "calculatedParameter",
        Causality::Input => "input",
        Causality::Output => "output",
    }
}

/// Inputs must not state it: theirs is always exact.
fn initial(causality: Causality) -> Option<&'static str> {
    match causality {
        Causality::Parameter => Some("exact"),
        Causality::CalculatedParameter | Causality::Output => Some("calculated"),
        Causality::Input => None,
    }
}

fn details(variable: &Variable, version: Version) -> Attributes {
    let mut list = Attributes::new();
    let settable = variable.causality.is_settable();
    match &variable.kind {
        Kind::Real(quantity) | Kind::Single(quantity) => {
            list.extend(typed(RealType::of(variable, quantity), version));
            let ends = [("min", quantity.min), ("max", quantity.max)];
            list.extend(
                ends.into_iter()
                    .filter(|(_, end)| end.is_finite())
                    .map(|(name, end)| (name, number(end))),
            );
            if version == Version::Two {
                list.push(("nominal", number(quantity.nominal)));
            }
            list.extend(settable.then(|| ("start", number(quantity.start))));
        }
        Kind::Integer { range, start } | Kind::Long { range, start } | Kind::Sized { range, start, .. } => {
            let narrow = |end: i64| match version {
                Version::Two => end.clamp(i64::from(i32::MIN), i64::from(i32::MAX)),
                Version::Three => end,
            };
            list.push(("min", narrow(*range.start()).to_string()));
            list.push(("max", narrow(*range.end()).to_string()));
            list.extend(settable.then(|| ("start", narrow(*start).to_string())));
        }
        Kind::Enumeration {
            type_name,
            options,
            start,
        } => {
            list.push(("declaredType", (*type_name).into()));
            list.push(("min", "1".into()));
            list.push(("max", options.len().to_string()));
            list.extend(settable.then(|| ("start", start.to_string())));
        }
        Kind::Boolean { start } => list.extend(settable.then(|| ("start", start.to_string()))),
        // Their start value is an element in FMI 3.0.
        Kind::Text { .. } => {}
        Kind::Binary { mime_type, .. } => list.push(("mimeType", mime_type.clone().into_owned())),
    }
    list
}

#[cfg(test)]
mod tests {
    use super::of_each;

    #[test]
    fn an_array_is_described_as_its_elements_without_their_number() {
        for (first, array) in [
            ("Mass of body 1.", "Mass of each body."),
            ("Body 1, seen from above", "each Body, seen from above"),
            ("Body 12 of 1", "Body 12 each of"),
            ("Height", "Height"),
        ] {
            assert_eq!(of_each(first), array);
        }
    }
}
