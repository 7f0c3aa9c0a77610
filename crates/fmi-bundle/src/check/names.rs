//! Names in a model description: legal, of their own, and those of other things that they refer to.
//!
//! Source: FMI 2.0 sections 2.2.7 to 2.2.9, FMI 3.0 sections 2.4.5 to 2.4.8.

use std::collections::HashMap;

use fmi_component::Version;

use super::description::{Described, DescribedVariable, PATH, Unknown};
use super::findings::CheckReport;
use super::grammar::real;
use crate::legal::is_identifier;

/// Checks identifier, variables and model structure.
pub fn check(described: &Described, report: &mut CheckReport) {
    let identifier = &described.identifier;
    if !is_identifier(identifier) {
        let what = format!("modelIdentifier = {identifier:?} is not allowed: a C identifier of CoSimulation");
        report.fault(
            PATH,
            what,
            "Name the model by letters, digits and underscores, no digit first.",
        );
    }
    let mut names: HashMap<&str, &str> = HashMap::new();
    let mut references: HashMap<u32, &str> = HashMap::new();
    for variable in &described.variables {
        check_name(described, variable, report);
        if let Some(first) = names.insert(variable.name(), &variable.place) {
            report.fault(
                &variable.place,
                format!("a second variable {:?}; the first is at {first}", variable.name()),
                "Rename one.",
            );
        }
        let former = variable
            .reference()
            .and_then(|reference| references.insert(reference, variable.name()));
        if let Some(former) = former.filter(|_| described.version == Version::Three) {
            let what = format!("{} has the value reference of {former}", variable.name());
            report.fault(&variable.place, what, "Give each variable one of its own.");
        }
        check_facts(described, variable, report);
        check_range(variable, report);
    }
    check_structure(described, report);
}

fn check_name(described: &Described, variable: &DescribedVariable, report: &mut CheckReport) {
    let name = variable.name();
    let allowed = match described.structured {
        _ if name.is_empty() => "a text that is not empty",
        _ if name.contains(char::is_control) => "a text without control characters",
        true if !is_structured(name) => {
            "a structured name such as spring.stiffness, body.x[3] or der(x), since variableNamingConvention is structured"
        }
        _ => return,
    };
    report.fault(
        &variable.place,
        format!("name = {name:?} of a variable is not allowed: {allowed}"),
        "Rename the variable.",
    );
}

/// The grammar of structured names.
fn is_structured(name: &str) -> bool {
    if let Some(inner) = name.strip_prefix("der(").and_then(|rest| rest.strip_suffix(')')) {
        let (inner, order) = inner.rsplit_once(',').unwrap_or((inner, "1"));
        return order.parse::<u32>().is_ok() && is_structured(inner);
    }
    let mut rest = name;
    loop {
        let begins = |sign: char| sign.is_alphabetic() && sign.is_ascii() || sign == '_';
        rest = match rest.strip_prefix('\'') {
            Some(quoted) => match quoted.split_once('\'') {
                Some((inside, after)) if !inside.is_empty() => after,
                _ => return false,
            },
            None if rest.starts_with(begins) => {
                rest.trim_start_matches(|sign: char| sign.is_ascii_alphanumeric() || sign == '_')
            }
            None => return false,
        };
        if let Some(indices) = rest.strip_prefix('[') {
            let Some((inside, after)) = indices.split_once(']') else {
                return false;
            };
            if !inside.split(',').all(|index| index.parse::<u32>().is_ok()) {
                return false;
            }
            rest = after;
        }
        match rest.strip_prefix('.') {
            Some(next) => rest = next,
            None => return rest.is_empty(),
        }
    }
}

/// Causality, variability, initial and start fit, and what it names is there.
fn check_facts(described: &Described, variable: &DescribedVariable, report: &mut CheckReport) {
    let (name, causality, variability) = (variable.name(), variable.causality(), variable.variability());
    let allowed: &[&str] = match causality {
        "parameter" | "calculatedParameter" | "structuralParameter" => &["fixed", "tunable"],
        "input" => &["discrete", "continuous"],
        "independent" => &["continuous"],
        "output" => &["constant", "discrete", "continuous"],
        _ => &["constant", "fixed", "tunable", "discrete", "continuous"],
    };
    let mut fault = |what: String, remedy: &str| report.fault(&variable.place, what, remedy);
    if !allowed.contains(&variability) {
        fault(
            format!(
                "variability = {variability} of {name}, whose causality is {causality}, is not allowed: {}",
                allowed.join(", ")
            ),
            "Choose one.",
        );
    }
    if variability == "continuous" && !variable.is_real() {
        fault(
            format!(
                "{name} is continuous and of type {}; allowed is a real",
                variable.element
            ),
            "Make it discrete.",
        );
    }
    let needs_start = causality == "input" || matches!(variable.initial(), Some("exact" | "approx"));
    let may_start = causality != "independent" && variable.initial() != Some("calculated");
    match &variable.start {
        None if needs_start && !matches!(variable.element.as_str(), "Clock") => {
            fault(
                format!("{name} has no start value, which its causality {causality} needs"),
                "Add it.",
            );
        }
        Some(start) if !may_start => fault(
            format!("{name} has a start value, {start}, although it is computed"),
            "Remove it.",
        ),
        _ => {}
    }
    for (key, known) in [("unit", &described.units), ("declaredType", &described.types)] {
        if let Some(value) = variable
            .get(key)
            .filter(|value| !known.iter().any(|known| known.name == *value))
        {
            fault(
                format!(
                    "{key} = {value:?} of {name} is not declared; declared are {}",
                    known
                        .iter()
                        .map(|known| known.name.as_str())
                        .collect::<Vec<_>>()
                        .join(", ")
                ),
                "Declare it.",
            );
        }
    }
    if let Some(derivative) = variable.get("derivative") {
        let found = match described.version {
            Version::Two => derivative
                .parse::<usize>()
                .ok()
                .and_then(|index| described.variables.get(index.checked_sub(1)?)),
            Version::Three => described
                .variables
                .iter()
                .find(|other| other.get("valueReference") == Some(derivative)),
        };
        if found.is_none_or(|other| !other.is_real()) {
            fault(
                format!("{name} is said to be the derivative of {derivative}, which is no real variable"),
                "Name one.",
            );
        }
    }
}

fn check_range(variable: &DescribedVariable, report: &mut CheckReport) {
    let number = |key: &str| variable.get(key).and_then(real);
    let (min, max) = (number("min"), number("max"));
    let name = variable.name();
    if let (Some(min), Some(max)) = (min, max)
        && min > max
    {
        report.fault(
            &variable.place,
            format!("min = {min} of {name} is above max = {max}"),
            "Give the smaller one first.",
        );
    }
    let is_number = !matches!(variable.element.as_str(), "String" | "Binary" | "Boolean");
    for start in variable
        .start
        .iter()
        .filter(|_| is_number)
        .flat_map(|text| text.split_whitespace())
        .filter_map(real)
    {
        if min.is_some_and(|min| start < min) || max.is_some_and(|max| start > max) {
            let end = |end: Option<f64>| end.map_or("any".into(), |end| end.to_string());
            let what = format!(
                "start = {start} of {name} is not allowed: from {} to {}",
                end(min),
                end(max)
            );
            report.fault(&variable.place, what, "Give a value in the range.");
        }
    }
}

fn check_structure(described: &Described, report: &mut CheckReport) {
    let variables = &described.variables;
    let is_output = |variable: &DescribedVariable| variable.causality() == "output";
    let is_initial = |variable: &DescribedVariable| {
        matches!(variable.causality(), "output" | "calculatedParameter")
            && matches!(variable.initial(), Some("calculated" | "approx"))
    };
    check_list("Outputs", &described.outputs, variables, is_output, report);
    check_list("InitialUnknowns", &described.initial, variables, is_initial, report);
}

/// Each variable that is `wanted` is in the list once, and what the list names is there.
fn check_list(
    list: &str,
    unknowns: &[Unknown],
    variables: &[DescribedVariable],
    wanted: impl Fn(&DescribedVariable) -> bool,
    report: &mut CheckReport,
) {
    for unknown in unknowns {
        let Some(position) = unknown.variable else {
            report.fault(
                &unknown.place,
                format!("{list} name variable number {}, which is not there", unknown.called),
                "Name a variable.",
            );
            continue;
        };
        let name = variables[position].name();
        if list == "Outputs" && !wanted(&variables[position]) {
            report.fault(
                &unknown.place,
                format!(
                    "Outputs name {name}, whose causality is {}",
                    variables[position].causality()
                ),
                "Name an output.",
            );
        }
        if unknown.dependencies.iter().flatten().any(Option::is_none) {
            report.fault(
                &unknown.place,
                format!("the dependencies of {name} name a variable that is not there"),
                "Name a variable.",
            );
        }
        if !unknown.kinds_fit {
            report.fault(
                &unknown.place,
                format!("dependenciesKind of {name} has not as many words as dependencies"),
                "Give one for each.",
            );
        }
    }
    for (position, variable) in variables.iter().enumerate().filter(|(_, variable)| wanted(variable)) {
        match unknowns
            .iter()
            .filter(|unknown| unknown.variable == Some(position))
            .count()
        {
            1 => {}
            count => report.fault(
                &variable.place,
                format!("{} is {count} times in {list}; allowed is once", variable.name()),
                "List it once.",
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::is_structured;

    #[test]
    fn structured_names_are_told_from_others() {
        for name in [
            "x",
            "body.x[3]",
            "a_1.b[1,2].c",
            "der(x)",
            "der(body.x[1],2)",
            "'any thing'.y",
        ] {
            assert!(is_structured(name), "{name}");
        }
        for name in [
            "", "1x", "a b", "a.", "x[", "x[a]", "x[1]y", "a..b", "''", "der(x,y)", "grüße",
        ] {
            assert!(!is_structured(name), "{name}");
        }
    }
}
