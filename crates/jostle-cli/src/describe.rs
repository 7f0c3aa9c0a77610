//! `jostle describe`: the variables of a scene as a table.

use clap::Args;
use jostle::scene::{Kind, StructuralParameters, Variable};

use crate::failure::Failure;
use crate::selection::{self, Selected, Selection};
use crate::{laboratory, standard_output, text};

/// Lists the variables of a scene, or of a component of the shaker laboratory: name, causality, unit, range, start value, meaning.
///
/// Variables of every disk share a line, disk.angle[1..60]; --all gives each its own.
#[derive(Args)]
#[command(after_help = format!("{}\nExample:\n  jostle describe packing --drive sine", selection::list()))]
pub struct Describe {
    #[command(flatten)]
    selection: Selection,
    /// What moves the base, such as input (the importer) or sine. Without it the engine's first: input where it has one.
    #[arg(long)]
    drive: Option<String>,
    /// One line for each variable of each disk.
    #[arg(long)]
    all: bool,
}

impl Describe {
    pub fn execute(self) -> Result<(), Failure> {
        let page = match laboratory::find(&self.selection.scene) {
            Some(model) => {
                laboratory::refuse_options(&self.selection, self.drive.as_deref())?;
                let info = (model.info)();
                let variables = (model.variables)(&StructuralParameters::defaults(&info));
                format!("{}: {}\n\n{}", info.name, info.description, list(&variables, self.all))
            }
            None => page(&self.selection.find(self.drive.as_deref())?, self.all),
        };
        standard_output::write(&page)
    }
}

/// Head line and table.
fn page(selected: &Selected, all: bool) -> String {
    let (info, names) = (&selected.info, selected.names);
    let variables = (selected.model.variables)(&selected.structure);
    let title = format!(
        "{}, {}, drive {}, {} disks",
        names.scene,
        names.engine,
        names.drive,
        selected.structure.get("disks")
    );
    format!("{title}: {}\n\n{}", info.description, list(&variables, all))
}

/// The table.
fn list(variables: &[Variable], all: bool) -> String {
    let mut rows = vec![
        ["name", "causality", "unit", "range", "start", "description"]
            .map(String::from)
            .to_vec(),
    ];
    let mut rest = variables;
    while let Some(first) = rest.first() {
        let run = if all { 1 } else { run_length(rest) };
        rows.push(line(first, run));
        rest = &rest[run..];
    }
    text::table(&rows)
}

/// How many rows from the first on are the elements [1], [2], ... of one name.
fn run_length(rows: &[Variable]) -> usize {
    let Some(stem) = rows[0].name.strip_suffix("[1]") else {
        return 1;
    };
    let belongs = |(index, row): &(usize, &Variable)| row.name == format!("{stem}[{}]", index + 1);
    rows.iter().enumerate().take_while(belongs).count()
}

/// The line of `row`, which stands for `run` elements if there are several.
fn line(row: &Variable, run: usize) -> Vec<String> {
    let (mut name, mut description) = (row.name.clone(), row.description.clone());
    if run > 1 {
        name = name.replace("[1]", &format!("[1..{run}]"));
        if let Some(stem) = description.strip_suffix("disk 1") {
            description = format!("{stem}each disk");
        }
    }
    if let Some(recommended) = &row.recommended {
        description = format!("{description} [recommended: {}]", recommended.text());
    }
    let start = if row.causality.is_settable() {
        row.start().to_string()
    } else {
        "-".into()
    };
    let (unit, range) = match &row.kind {
        Kind::Real(quantity) | Kind::Single(quantity) => (quantity.unit.name, real_range(quantity.min, quantity.max)),
        Kind::Integer { range, .. } | Kind::Sized { range, .. } => {
            ("integer", format!("{} to {}", range.start(), range.end()))
        }
        Kind::Enumeration { options, .. } => {
            let option = |(number, (name, _)): (i64, &(&str, &str))| format!("{number} {name}");
            let options: Vec<String> = (1..).zip(*options).map(option).collect();
            ("option", options.join(", "))
        }
        Kind::Boolean { .. } => ("boolean", "true or false".into()),
        Kind::Text { .. } => ("text", "any".into()),
        Kind::Binary { .. } => ("binary", "any".into()),
        Kind::Long { range, .. } => ("64-bit integer", format!("{} to {}", range.start(), range.end())),
    };
    vec![name, row.role().into(), unit.into(), range, start, description]
}

fn real_range(min: f64, max: f64) -> String {
    if min == f64::NEG_INFINITY && max == f64::INFINITY {
        return "any".into();
    }
    format!("{} to {}", text::number(min), text::number(max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock;

    #[test]
    fn elements_share_a_line_unless_all_are_wanted() {
        let selection = Selection {
            scene: "clock".into(),
            engine: None,
            disks: Some(3),
        };
        let clock = selection.of(clock::MODEL).unwrap();
        let short = page(&clock, false);
        let lines: Vec<&str> = short.lines().collect();
        assert_eq!(lines[0], "clock, none, drive sine, 3 disks: Hands that turn");
        assert_eq!(
            lines[3],
            "rate         parameter  rad/s           0 to 10                   1      Rate of every hand"
        );
        assert_eq!(
            lines[6],
            "sense        parameter  option          1 ahead, 2 back           1      Which way the hands turn"
        );
        assert_eq!(
            lines[7],
            "angle[1..3]  output     rad             any                       -      Angle of each disk"
        );
        assert_eq!(lines.len(), 9);
        let long = page(&clock, true);
        assert_eq!(long.lines().count(), short.lines().count() + 2);
        assert!(long.contains("angle[3]"));
    }
}
