//! Reference trajectory: what a scene computes from its start values, as a table inside its FMU.
//!
//! CSV: `time`, the inputs as they are set at that time, the outputs as they are then; numbers read back as the same
//! bits. Inputs that are a motion shake the base at twice gravity. The table is short, so that what a processor's or a C
//! library's rounding changes has not grown much by its end, although collisions amplify it: see [`super::replay`]. It ends
//! early where the scene refuses a step, and is empty where it refuses its start values.

use std::f64::consts::TAU;

use crate::error::{Error, Result};
use crate::scene::{Causality, Choice, Kind, Scene, Simulation, Table, Unit, Value};

use super::derivatives;

/// Where it is in the FMU. Both standards leave the folder `extra` to tools.
pub const PATH: &str = "extra/jostle/reference.csv";

/// Longest communication step \[s\].
const LONGEST_STEP: f64 = 1.0 / 1024.0;
/// Steps: as many as keep the table at about this number of values, within a range.
const VALUES: usize = 4000;
const STEPS: std::ops::RangeInclusive<usize> = 16..=96;
/// Steps in a period of the inputs, about 85 Hz.
const PERIOD: f64 = 12.0;
/// Largest acceleration of the base \[m/s2\]: grains leave it, which hard disks need.
const ACCELERATION: f64 = 20.0;

/// Runs the scene.
///
/// # Errors
/// The table cannot be written.
pub fn record<S: Scene>(choice: Choice) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: csv::Error| Error::call(format!("the reference trajectory: {error}"), "Try again.");
    let table = Table::new(S::variables(choice));
    let (inputs, outputs) = (of(&table, Causality::Input), of(&table, Causality::Output));
    let names = |list: &[usize]| -> Vec<String> {
        let names = list.iter().map(|position| table.rows()[*position].name.clone());
        names.collect()
    };
    let input_names = names(&inputs);
    let header = [vec!["time".into()], input_names.clone(), names(&outputs)].concat();
    writer.write_record(header).map_err(failed)?;
    let steps = (VALUES / (1 + inputs.len() + outputs.len())).clamp(*STEPS.start(), *STEPS.end());
    let step = S::card().step_size.min(LONGEST_STEP);
    let (mut rows, mut refused) = (0, false);
    let mut simulation = Simulation::<S>::new(choice.disks, &[]).ok();
    while let Some(simulation) = simulation.as_mut().filter(|_| !refused && rows <= steps) {
        let time = simulation.time();
        let moved = motion(&table, &inputs, TAU / (PERIOD * step), time);
        for (name, value) in input_names.iter().zip(&moved) {
            simulation.set(name, *value)?;
        }
        let values = simulation.values().as_slice();
        let shown = outputs.iter().map(|position| match values[*position] {
            Value::Real(real) => format!("{real:?}"),
            Value::Integer(integer) => integer.to_string(),
        });
        let given = [time].into_iter().chain(moved).map(|value| format!("{value:?}"));
        writer.write_record(given.chain(shown)).map_err(failed)?;
        refused = simulation.advance_to(time + step).is_err();
        rows += 1;
    }
    let bytes = writer.into_inner().map_err(|error| failed(error.into_error().into()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn of(table: &Table, causality: Causality) -> Vec<usize> {
    let rows = table.rows().iter().enumerate();
    rows.filter(|(_, row)| row.causality == causality)
        .map(|(position, _)| position)
        .collect()
}

/// Values of the inputs at `time` \[s\]: a (1 - cos) where the next input is the rate of this one, and that rate; any other
/// stays at its start value.
fn motion(table: &Table, inputs: &[usize], omega: f64, time: f64) -> Vec<f64> {
    let swing = |position: usize| match &table.rows()[position].kind {
        Kind::Real(quantity) if quantity.unit == Unit::Metre => ACCELERATION / omega.powi(2),
        Kind::Real(quantity) => quantity.nominal,
        _ => 1.0,
    };
    let phase = omega * time;
    let value = |position: &usize| {
        let integral = inputs
            .iter()
            .find(|input| derivatives::of(table, **input) == Some(*position));
        match (derivatives::of(table, *position), integral) {
            (Some(_), _) => swing(*position) * (1.0 - phase.cos()),
            (None, Some(integral)) => swing(*integral) * omega * phase.sin(),
            (None, None) => match table.rows()[*position].start() {
                Value::Real(start) => start,
                Value::Integer(start) => start as f64,
            },
        }
    };
    inputs.iter().map(value).collect()
}
