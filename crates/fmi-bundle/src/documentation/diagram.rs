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
            Kind::Real(quantity) | Kind::Single(quantity) => quantity.unit.name,
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
        let lengths = arrays::dimensions(&variables[first..]).unwrap_or_default();
        let ranges: Vec<String> = lengths.iter().map(|length| format!("1..{length}")).collect();
        let name = match count {
            1 => variable.name.clone(),
            _ => format!("{}[{}]", arrays::name(&variable.name), ranges.join(",")),
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
    let parameters = groups(component, Causality::Parameter);
    let set = (info.sheet.parameters.iter()).filter_map(|name| parameters.iter().find(|group| group.stem() == *name));
    let set: String = set.map(|group| line(group, Side::Parameter)).collect();
    let mut left: String = inputs.iter().map(|group| line(group, Side::Input)).collect();
    if inputs.is_empty() {
        left.push_str("<li><div><b>No inputs</b><small>what drives the model is inside</small></div></li>");
    }
    if !set.is_empty() {
        left.push_str("<li><div><small>Parameters, set before the start:</small></div></li>");
        left.push_str(&set);
    }
    let mut right: String = shown.iter().map(|group| line(group, Side::Output)).collect();
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

/// Where a variable stands.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Input,
    Parameter,
    Output,
}

/// A variable with its arrow, which is behind the name of what goes in and before that of what comes out.
fn line(group: &Group, side: Side) -> String {
    let unit = match group.unit() {
        "" | "1" => String::new(),
        unit => format!(" [{}]", escape(unit)),
    };
    let start = match side {
        Side::Parameter => format!(" = {}", group.variable.start()),
        _ => String::new(),
    };
    let text = format!(
        "<div><code>{}</code>{start}{unit}<small>{}</small></div>",
        breakable(&group.name),
        escape(first_clause(&group.description()))
    );
    let (colour, dashes) = match side {
        Side::Input => ("#0b5fb0", ""),
        Side::Parameter => ("#777", " stroke-dasharray=\"5 3\""),
        Side::Output => ("#a8321e", ""),
    };
    let arrow = format!(
        "<svg class=\"arrow\" viewBox=\"0 0 40 14\" aria-hidden=\"true\"><path d=\"M1 7H30\" stroke=\"{colour}\" \
         stroke-width=\"2.5\"{dashes} fill=\"none\"/><path d=\"M28 1 39 7 28 13z\" fill=\"{colour}\"/></svg>"
    );
    match side {
        Side::Output => format!("<li>{arrow}{text}</li>"),
        Side::Input | Side::Parameter => format!("<li>{text}{arrow}</li>"),
    }
}

/// A name that may be broken behind its points and underscores.
fn breakable(name: &str) -> String {
    let (stem, numbers) = name.split_at(name.find('[').unwrap_or(name.len()));
    let stem = escape(stem).replace('.', ".<wbr/>").replace('_', "_<wbr/>");
    format!("{stem}{}", escape(numbers))
}

/// Description up to the first mark that ends a clause; a point inside of a name does not.
fn first_clause(description: &str) -> &str {
    let mut marks = description.match_indices([':', ';', '.']);
    let ends = |place: &usize| description[place + 1..].chars().next().is_none_or(char::is_whitespace);
    let end = marks.find_map(|(place, _)| Some(place).filter(ends));
    &description[..end.unwrap_or(description.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_description_is_cut_where_its_first_clause_ends() {
        assert_eq!(first_clause("Force now, up; its mean is another"), "Force now, up");
        assert_eq!(
            first_clause("Mean since measure.start: all of it."),
            "Mean since measure.start"
        );
        assert_eq!(first_clause("Mass."), "Mass");
        assert_eq!(first_clause("Mass"), "Mass");
    }
}
