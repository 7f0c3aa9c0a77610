//! The samples of a run as a table: the time and every output; and all that made them.

use std::path::Path;

use jostle::scene::{Causality, DynSimulation, Kind, Unit, Value, Variable};

use crate::failure::Failure;
use crate::output_file::Format;
use crate::selection::Selected;
use crate::table::{self, Column, Coordinate, CsvTable, Fact, FactValue, Table};

/// A table that takes samples.
pub struct Samples {
    table: Box<dyn Table>,
    /// Positions of the outputs in the scene's table.
    outputs: Vec<usize>,
    row: Vec<Value>,
}

impl Samples {
    /// A table without rows; a file that was there is replaced.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(
        format: Format,
        path: &Path,
        simulation: &dyn DynSimulation,
        facts: &[Fact],
    ) -> Result<Self, Failure> {
        let variables = simulation.values().table().variables();
        let is_output = |position: &usize| variables[*position].causality == Causality::Output;
        let outputs: Vec<usize> = (0..variables.len()).filter(is_output).collect();
        let time = Column::real("time", Unit::SECOND, "Simulated time");
        let own = outputs.iter().map(|&position| Column::of(&variables[position]));
        let columns: Vec<Column> = std::iter::once(time).chain(own).collect();
        let fixed = coordinates(simulation)?;
        let table = table::create(format, path, &columns, facts, &fixed)?;
        Ok(Self {
            table,
            row: Vec::with_capacity(columns.len()),
            outputs,
        })
    }

    /// Adds the sample of now.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&mut self, time: f64, simulation: &dyn DynSimulation) -> Result<(), Failure> {
        self.row.clear();
        self.row.push(Value::Real(time));
        for &position in &self.outputs {
            self.row.push(simulation.value(position)?);
        }
        self.table.write(&self.row)
    }

    /// Completes the table.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish(&mut self) -> Result<(), Failure> {
        self.table.finish()
    }

    /// Rows that a reader finds.
    pub fn whole_rows(&self) -> u64 {
        self.table.whole_rows()
    }
}

/// Arrays that are computed from the parameters, such as `disk.radius`.
fn coordinates(simulation: &dyn DynSimulation) -> Result<Vec<Coordinate>, Failure> {
    let mut found: Vec<Coordinate> = Vec::new();
    let base = |name: &str| name.split('[').next().unwrap_or_default().to_string();
    for (position, variable) in simulation.values().table().variables().iter().enumerate() {
        if variable.causality != Causality::CalculatedParameter || !variable.name.contains('[') {
            continue;
        }
        let Value::Real(value) = simulation.value(position)? else {
            continue;
        };
        match found.last_mut() {
            Some(last) if base(&last.column.name) == base(&variable.name) => last.values.push(value),
            _ => found.push(Coordinate {
                column: Column::of(variable),
                values: vec![value],
            }),
        }
    }
    Ok(found)
}

/// All that made the samples: names, then every variable that is no output.
///
/// # Errors
/// A value cannot be read.
pub fn facts(selected: &Selected, simulation: &dyn DynSimulation) -> Result<Vec<Fact>, Failure> {
    let names = selected.names;
    let word = |name: &str, text: &str| Fact {
        name: name.into(),
        value: FactValue::Text(text.into()),
        unit: "",
    };
    let disks = Value::Integer(selected.structure.get("disks").into());
    let mut facts = vec![
        word("scene", names.scene),
        word("engine", names.engine),
        word("drive", names.drive),
        Fact {
            name: "disks".into(),
            value: FactValue::Number(disks),
            unit: "",
        },
        word("jostle_version", env!("CARGO_PKG_VERSION")),
    ];
    for (position, variable) in simulation.values().table().variables().iter().enumerate() {
        if variable.causality != Causality::Output {
            facts.push(Fact {
                name: variable.name.clone(),
                value: fact_value(variable, simulation.value(position)?),
                unit: Column::of(variable).unit,
            });
        }
    }
    Ok(facts)
}

fn fact_value(variable: &Variable, value: Value) -> FactValue {
    let (Kind::Enumeration { options, .. }, Value::Integer(number)) = (&variable.kind, value) else {
        return FactValue::Number(value);
    };
    let option = usize::try_from(number - 1).ok().and_then(|index| options.get(index));
    option.map_or(FactValue::Number(value), |(name, _)| FactValue::Option(number, name))
}

/// Writes the facts with the times of the run into a CSV file: name, value, unit; of an option its number.
///
/// # Errors
/// It cannot be written.
pub fn write_parameters(path: &Path, facts: &[Fact], times: [(&'static str, f64); 2]) -> Result<(), Failure> {
    let mut file = CsvTable::with_header(path, ["name", "value", "unit"].into_iter())?;
    for fact in facts {
        let name = if fact.name == "jostle_version" {
            "version"
        } else {
            &fact.name
        };
        let value = match fact.value {
            FactValue::Option(number, _) => number.to_string(),
            _ => fact.value.text(),
        };
        file.record([name, &value, fact.unit])?;
        if name == "version" {
            for (name, seconds) in times {
                file.record([name, &Value::Real(seconds).to_string(), "s"])?;
            }
        }
    }
    Ok(())
}
