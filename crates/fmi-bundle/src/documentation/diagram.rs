//! What goes into the component and what comes out: arrows with names and units on both sides of a picture of the model.

use fmi_component::{Causality, Kind, Variable, arrays};
use quick_xml::escape::escape;

use crate::component::Component;
use crate::model_description::of_each;

/// Outputs that are shown of a model that names none.
const MOST_OUTPUTS: usize = 8;

/// Ends of the arrows in a picture.
const MARKERS: &str = "<defs>\
    <marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"6\" markerHeight=\"6\" orient=\"auto-start-reverse\">\
    <path d=\"M0 0 8 4 0 8z\" fill=\"#555\"/></marker>\
    <marker id=\"tip-in\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"5\" markerHeight=\"5\" orient=\"auto-start-reverse\">\
    <path d=\"M0 0 8 4 0 8z\" fill=\"#0b5fb0\"/></marker>\
    <marker id=\"tip-out\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"5\" markerHeight=\"5\" orient=\"auto-start-reverse\">\
    <path d=\"M0 0 8 4 0 8z\" fill=\"#a8321e\"/></marker></defs>";

/// The variables of one name: one, or the elements of an array.
pub struct Group<'a> {
    /// Position of the first.
    pub first: usize,
    /// How many there are.
    pub count: usize,
    /// Name, for elements with their numbers: `body.angle[1..60]`.
    pub name: String,
    /// The first.
    pub variable: &'a Variable,
}

impl Group<'_> {
    /// Name without numbers.
    fn stem(&self) -> &str {
        arrays::name(&self.variable.name)
    }

    /// Description; of several elements that of each.
    pub fn description(&self) -> String {
        match self.count {
            1 => self.variable.description.clone(),
            _ => of_each(&self.variable.description),
        }
    }

    /// Name of the unit, `1` for pure numbers; nothing for whole numbers.
    pub fn unit(&self) -> &'static str {
        match &self.variable.kind {
            Kind::Real(quantity) => quantity.unit.name,
            _ => "",
        }
    }
}

/// The variables of this causality, elements of an array as one, as they are in the model.
pub fn groups(component: &Component, causality: Causality) -> Vec<Group<'_>> {
    let variables = component.table().variables();
    let begins = |(position, count): (usize, usize)| (count > 0).then_some((position, count));
    let spans = arrays::spans(variables).into_iter().enumerate().filter_map(begins);
    let group = |(first, count): (usize, usize)| {
        let variable = &variables[first];
        let name = match count {
            1 => variable.name.clone(),
            _ => format!("{}[1..{count}]", arrays::name(&variable.name)),
        };
        (variable.causality == causality).then_some(Group {
            first,
            count,
            name,
            variable,
        })
    };
    spans.filter_map(group).collect()
}

/// The diagram: inputs on the left, outputs on the right, a picture between them.
pub fn write(component: &Component) -> String {
    let info = component.info();
    let inputs = groups(component, Causality::Input);
    let all = groups(component, Causality::Output);
    let named: Vec<&Group> = (info.sheet.outputs.iter())
        .filter_map(|name| all.iter().find(|group| group.stem() == *name))
        .collect();
    let shown = if named.is_empty() {
        all.iter().take(MOST_OUTPUTS).collect()
    } else {
        named
    };
    let rest = all.len() - shown.len();
    let left = match inputs.as_slice() {
        [] => "<li><div><b>No inputs</b><small>what drives the model is inside; set its parameters before the start</small>\
               </div></li>"
            .into(),
        inputs => inputs.iter().map(|group| line(group, "#0b5fb0", true)).collect::<String>(),
    };
    let mut right: String = shown.iter().map(|group| line(group, "#a8321e", false)).collect();
    if rest > 0 {
        right.push_str(&format!(
            "<li><div><small>and {rest} more in the <a href=\"#outputs\">table of outputs</a></small></div></li>"
        ));
    }
    let picture = match info.sheet.picture.as_slice() {
        [] => String::new(),
        fragments => format!(
            "<svg class=\"picture\" viewBox=\"0 0 320 240\" role=\"img\" aria-label=\"{}\">{MARKERS}{}</svg>",
            escape(info.description),
            fragments.concat()
        ),
    };
    format!(
        "<div class=\"diagram\">\n<ul class=\"left\">{left}</ul>\n<div class=\"block\"><b>{}</b>{picture}</div>\n\
         <ul class=\"right\">{right}</ul>\n</div>\n",
        escape(info.name)
    )
}

/// A variable with its arrow, which is behind the name of an input and before that of an output.
fn line(group: &Group, colour: &str, input: bool) -> String {
    let unit = match group.unit() {
        "" | "1" => String::new(),
        unit => format!(" [{}]", escape(unit)),
    };
    let text = format!(
        "<div><code>{}</code>{unit}<small>{}</small></div>",
        escape(group.name.as_str()),
        escape(first_clause(&group.description()))
    );
    let arrow = format!(
        "<svg class=\"arrow\" viewBox=\"0 0 40 14\" aria-hidden=\"true\"><path d=\"M1 7H30\" stroke=\"{colour}\" \
         stroke-width=\"2.5\" fill=\"none\"/><path d=\"M28 1 39 7 28 13z\" fill=\"{colour}\"/></svg>"
    );
    match input {
        true => format!("<li>{text}{arrow}</li>"),
        false => format!("<li>{arrow}{text}</li>"),
    }
}

/// Description up to the first mark that ends a clause.
fn first_clause(description: &str) -> &str {
    let end = description.find([':', ';', '.']).unwrap_or(description.len());
    &description[..end]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_description_is_cut_where_its_first_clause_ends() {
        assert_eq!(first_clause("Force now, up; its mean is another"), "Force now, up");
        assert_eq!(first_clause("Mass"), "Mass");
    }
}
