//! Reference trajectory: what a model computes from its start values, as a table inside its FMU.
//!
//! CSV: `time`, the inputs as they are set at that time, the outputs as they are then; numbers read back as the same
//! bits. An input with a derivative oscillates with its rates, so that something happens: see [`Component::amplitude`]. The table is short,
//! so that what a processor's or a C library's rounding changes has not grown much by its end, although a model may amplify
//! it: see [`replay`](crate::replay()). It ends early where the model refuses a step, and is empty where it refuses its start
//! values.

use std::f64::consts::TAU;

use fmi_component::{Causality, Error, Kind, ModelInfo, Result, Table, Value, Variable};

use crate::component::{Component, catch_defect};
use crate::run::Run;

/// Longest communication step \[s\].
const LONGEST_STEP: f64 = 1.0 / 1024.0;
/// Steps: as many as keep the table at about this number of values, within a range.
const VALUES: usize = 4000;
const STEPS: std::ops::RangeInclusive<usize> = 16..=96;
/// Steps in a period of the inputs, about 85 Hz.
const PERIOD: f64 = 12.0;

/// Where it is in the FMU. Both standards leave the folder `extra` to tools.
pub fn path(info: &ModelInfo) -> String {
    format!("extra/{}/{FILE}", info.package)
}

const FILE: &str = "reference.csv";

/// Whether `path` is where an FMU, of whatever package, has its reference trajectory.
pub fn is_path(path: &str) -> bool {
    matches!(path.split('/').collect::<Vec<_>>().as_slice(), ["extra", _, FILE])
}

/// Runs the model.
///
/// # Errors
/// The table cannot be written; the model panics, which is a defect of it.
pub fn record(component: &Component) -> Result<String> {
    const WHAT: &str = "the reference trajectory";
    catch_defect(WHAT, || run(component))?.map_err(|error| within(WHAT, error))
}

fn run(component: &Component) -> Result<String> {
    let table = component.table();
    let (inputs, outputs) = (of(table, Causality::Input), of(table, Causality::Output));
    let name = |position: &usize| table.variables()[*position].name.as_str();
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: csv::Error| Error::call(format!("the reference trajectory: {error}"), "Try again.");
    let header = ["time"]
        .into_iter()
        .chain(inputs.iter().map(name))
        .chain(outputs.iter().map(name));
    writer.write_record(header).map_err(failed)?;
    let (steps, step, omega) = (steps(component), step(component), omega(component));
    let mut simulation = component.prepare()?;
    // Inputs have their first values when a model starts, as importers give them.
    set_inputs(component, &mut *simulation, omega)?;
    let mut refused = simulation.start(0.0)?;
    for _ in 0..=steps {
        if refused.is_some() {
            break;
        }
        let time = simulation.time();
        set_inputs(component, &mut *simulation, omega)?;
        let mut texts = vec![text(Value::Real(time))];
        for position in inputs.iter().chain(&outputs) {
            texts.push(text(simulation.value(*position)?));
        }
        writer.write_record(texts).map_err(failed)?;
        refused = simulation.advance_to(time + step)?;
    }
    let bytes = writer.into_inner().map_err(|error| failed(error.into_error().into()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// `error` with what was done when it came.
pub(crate) fn within(what: &str, error: Error) -> Error {
    match error {
        Error::Call { what: why, remedy } if !why.starts_with(what) => Error::call(format!("{what}: {why}"), remedy),
        other => other,
    }
}

/// Number of communication steps.
pub(crate) fn steps(component: &Component) -> usize {
    let table = component.table();
    let columns = 1 + of(table, Causality::Input).len() + of(table, Causality::Output).len();
    (VALUES / columns).clamp(*STEPS.start(), *STEPS.end())
}

/// Communication step \[s\].
fn step(component: &Component) -> f64 {
    component.info().step_size.min(LONGEST_STEP)
}

/// Duration \[s\].
pub(crate) fn duration(component: &Component) -> f64 {
    steps(component) as f64 * step(component)
}

/// Angular frequency of the inputs \[rad/s\].
pub(crate) fn omega(component: &Component) -> f64 {
    TAU / (PERIOD * step(component))
}

/// Positions of the variables of this causality that a trajectory has: numbers that every importer reads as reals, and inputs that it
/// sets so. Others stay at their start values.
pub(crate) fn of(table: &Table, causality: Causality) -> Vec<usize> {
    let variables = table.variables().iter().enumerate();
    let is_number = |variable: &Variable| match variable.kind {
        Kind::Real(_) => true,
        Kind::Integer { .. } | Kind::Enumeration { .. } => causality == Causality::Output,
        _ => false,
    };
    variables
        .filter(|(_, variable)| variable.causality == causality && is_number(variable))
        .map(|(position, _)| position)
        .collect()
}

fn text(value: Value) -> String {
    match value {
        Value::Real(real) => format!("{real:?}"),
        Value::Integer(integer) => integer.to_string(),
    }
}

/// Inputs that oscillate, each with its rate, the rate of that, and so on: those that have a rate and are none themselves.
pub(crate) fn chains(table: &Table) -> Vec<Vec<usize>> {
    let inputs = of(table, Causality::Input);
    let is_rate = |position: &usize| inputs.iter().any(|other| table.derivative(*other) == Some(*position));
    let chain = |first: usize| std::iter::successors(Some(first), |position| table.derivative(*position)).collect();
    let chains = inputs
        .iter()
        .filter(|position| !is_rate(position))
        .map(|first| chain(*first));
    chains.filter(|chain: &Vec<usize>| chain.len() > 1).collect()
}

/// Sets the inputs for the present time: a (1 - cos) where another input is the rate of this one, and its rates. Any other stays
/// at its start value.
pub(crate) fn set_inputs(component: &Component, simulation: &mut dyn Run, omega: f64) -> Result<()> {
    let table = component.table();
    let phase = omega * simulation.time();
    let (sine, cosine) = (libm::sin(phase), libm::cos(phase));
    for chain in chains(table) {
        let mut amplitude = (component.amplitude)(&table.variables()[chain[0]], omega);
        for (order, position) in chain.into_iter().enumerate() {
            let value = match order % 4 {
                _ if order == 0 => 1.0 - cosine,
                0 => -cosine,
                1 => sine,
                2 => cosine,
                _ => -sine,
            };
            simulation.set(position, amplitude * value)?;
            amplitude *= omega;
        }
    }
    Ok(())
}
