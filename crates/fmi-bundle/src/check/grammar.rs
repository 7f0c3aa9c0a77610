//! Structure of the XML files of an FMU against a grammar: which elements and attributes there are, in which order, of which type.
//!
//! The grammars are written after the schemas of the standards, which are not shipped: files such as `fmi3.txt` beside this one.

use std::collections::HashMap;

use roxmltree::{Document, Node};

use super::findings::CheckReport;

const BY_STANDARD: &str = "Write it as the schema of the standard has it.";

/// A grammar that was read from its text.
pub struct Grammar {
    elements: HashMap<&'static str, Element>,
}

#[derive(Default, Clone)]
struct Element {
    attributes: Vec<Attribute>,
    /// Names that may stand here, and how often, in their order.
    slots: Vec<(Vec<&'static str>, Often)>,
    any: bool,
}

#[derive(Clone, Copy)]
struct Attribute {
    name: &'static str,
    required: bool,
    kind: &'static str,
}

#[derive(Clone, Copy, PartialEq)]
enum Often {
    Once,
    Maybe,
    Any,
    Some,
}

impl Grammar {
    /// Reads the text, one line for an element.
    pub fn read(text: &'static str) -> Self {
        let mut elements = HashMap::new();
        let mut groups: HashMap<&str, Vec<Attribute>> = HashMap::new();
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let Some((name, rest)) = line.split_once(':') else {
                continue;
            };
            let (attributes, children) = rest.split_once('>').unwrap_or((rest, ""));
            let mut element = Element::default();
            for word in attributes.split_whitespace() {
                match word.strip_prefix('@') {
                    Some(group) => element.attributes.extend(groups.get(group).into_iter().flatten()),
                    None => element.attributes.push(attribute(word)),
                }
            }
            for word in children.split_whitespace() {
                let often = match word.as_bytes().last() {
                    Some(b'?') => Often::Maybe,
                    Some(b'*') => Often::Any,
                    Some(b'+') => Often::Some,
                    _ => Often::Once,
                };
                element.any |= word == "any";
                element
                    .slots
                    .push((word.trim_end_matches(['?', '*', '+']).split('|').collect(), often));
            }
            match name.strip_prefix('@') {
                Some(group) => _ = groups.insert(group, element.attributes),
                None => _ = elements.insert(name, element),
            }
        }
        Self { elements }
    }

    /// Checks all of `document`, which is the file `path`.
    pub fn check(&self, document: &Document<'_>, path: &str, root: &str, report: &mut CheckReport) {
        let node = document.root_element();
        if node.tag_name().name() != root {
            let what = format!("the first element is {}, allowed is {root}", node.tag_name().name());
            return report.fault(place(path, node), what, BY_STANDARD);
        }
        self.check_node(node, path, report);
    }

    fn find(&self, node: Node<'_, '_>) -> Option<&Element> {
        let name = node.tag_name().name();
        let parent = node.parent_element().map_or("", |parent| parent.tag_name().name());
        let of_parent = self.elements.get(format!("{parent}/{name}").as_str());
        of_parent.or_else(|| self.elements.get(name))
    }

    fn check_node(&self, node: Node<'_, '_>, path: &str, report: &mut CheckReport) {
        let Some(element) = self.find(node) else { return };
        check_attributes(element, node, path, report);
        if element.any {
            return;
        }
        let name = node.tag_name().name();
        let (mut slot, mut count) = (0, 0);
        for child in node.children().filter(Node::is_element) {
            let found = child.tag_name().name();
            let fits = |slot: &(Vec<&str>, Often)| slot.0.contains(&found);
            let Some(place_of) = element.slots.iter().position(fits) else {
                let allowed: Vec<String> = element.slots.iter().map(|(names, _)| names.join(", ")).collect();
                let allowed = match allowed.is_empty() {
                    true => "no element".into(),
                    false => allowed.join(", "),
                };
                report.fault(
                    place(path, child),
                    format!("{found} in {name}; allowed is {allowed}"),
                    BY_STANDARD,
                );
                continue;
            };
            if place_of < slot {
                let after = element.slots[slot].0.join(", ");
                report.fault(
                    place(path, child),
                    format!("{found} comes after {after}; in {name} it has to come before"),
                    BY_STANDARD,
                );
                continue;
            }
            count = if place_of == slot { count + 1 } else { 1 };
            slot = place_of;
            if count == 2 && matches!(element.slots[slot].1, Often::Once | Often::Maybe) {
                report.fault(
                    place(path, child),
                    format!("a second {found} in {name}; allowed is one"),
                    BY_STANDARD,
                );
            }
            self.check_node(child, path, report);
        }
        for (names, often) in &element.slots {
            let mut held = node.children().filter(|child| names.contains(&child.tag_name().name()));
            if matches!(often, Often::Once | Often::Some) && held.next().is_none() {
                report.fault(
                    place(path, node),
                    format!("{name} has no {}", names.join(" or ")),
                    BY_STANDARD,
                );
            }
        }
    }
}

fn attribute(word: &'static str) -> Attribute {
    let (name, kind) = match word.split_once(':') {
        Some(parts) => parts,
        None => word.find('=').map_or((word, "text"), |at| word.split_at(at)),
    };
    Attribute {
        name: name.trim_end_matches('!'),
        required: name.ends_with('!'),
        kind,
    }
}

fn check_attributes(element: &Element, node: Node<'_, '_>, path: &str, report: &mut CheckReport) {
    let name = node.tag_name().name();
    for found in node.attributes().filter(|found| found.namespace().is_none()) {
        let Some(known) = element.attributes.iter().find(|known| known.name == found.name()) else {
            report.fault(
                place(path, node),
                format!(
                    "{name} has an attribute {}, which the standard does not know",
                    found.name()
                ),
                "Remove it.",
            );
            continue;
        };
        if let Some(allowed) = refusal(known.kind, found.value()) {
            let what = format!(
                "{} = {:?} of {name} is not allowed: {allowed}",
                found.name(),
                found.value()
            );
            report.fault(place(path, node), what, "Give such a value.");
        }
    }
    for missing in element
        .attributes
        .iter()
        .filter(|known| known.required && node.attribute(known.name).is_none())
    {
        report.fault(
            place(path, node),
            format!("{name} has no attribute {}", missing.name),
            "Add it.",
        );
    }
}

/// What is allowed instead of `value`, if it is not of this kind.
fn refusal(kind: &str, value: &str) -> Option<String> {
    if let Some(item) = kind.strip_prefix('[').and_then(|kind| kind.strip_suffix(']')) {
        return value
            .split_whitespace()
            .find_map(|word| refusal(item, word))
            .map(|allowed| format!("a list of: {allowed}"));
    }
    let (fits, allowed) = match kind {
        "text" => (true, ""),
        "int" => (
            value.parse::<i64>().is_ok() || value.parse::<u64>().is_ok(),
            "a whole number",
        ),
        "uint" => (value.parse::<u64>().is_ok(), "a whole number, 0 or more"),
        "real" => (real(value).is_some(), "a number"),
        "bool" => (matches!(value, "true" | "false" | "1" | "0"), "true or false"),
        "date" => (is_date(value), "a date such as 2026-11-24T06:00:00Z"),
        "hex" => (
            value.len().is_multiple_of(2) && value.bytes().all(|byte| byte.is_ascii_hexdigit()),
            "pairs of hexadecimal digits",
        ),
        "version3" => (
            value
                .strip_prefix("3.")
                .is_some_and(|rest| rest.starts_with(|digit: char| digit.is_ascii_digit())),
            "3.0 or a later 3",
        ),
        _ => match kind.strip_prefix('=') {
            Some(fixed) => (value == fixed, fixed),
            None => (kind.split('|').any(|option| option == value), kind),
        },
    };
    (!fits).then(|| allowed.replace('|', ", "))
}

/// A number as XML writes it.
pub fn real(text: &str) -> Option<f64> {
    match text {
        "INF" => Some(f64::INFINITY),
        "-INF" => Some(f64::NEG_INFINITY),
        _ => text.parse().ok(),
    }
}

fn is_date(text: &str) -> bool {
    let pattern = "dddd-dd-ddTdd:dd:dd";
    let fits = |(sign, wanted): (char, char)| {
        if wanted == 'd' {
            sign.is_ascii_digit()
        } else {
            sign == wanted
        }
    };
    text.len() >= pattern.len() && text.chars().zip(pattern.chars()).all(fits)
}

/// The file with the line of `node`.
pub fn place(path: &str, node: Node<'_, '_>) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    format!("{path}:{line}")
}
