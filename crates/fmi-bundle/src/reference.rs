//! Reference trajectory: what a model computes from its start values, as a table inside its FMU.
//!
//! CSV: `time`, the inputs as they are set at that time, the outputs as they are then; numbers read back as the same
//! bits. An input with a derivative oscillates, so that something happens: see [`Component::amplitude`]. The table is short,
//! so that what a processor's or a C library's rounding changes has not grown much by its end, although a model may amplify
//! it: see [`replay`](crate::replay()). It ends early where the model refuses a step, and is empty where it refuses its start
//! values.

use std::f64::consts::TAU;

use fmi_component::{Causality, DynSimulation, Error, ModelInfo, Result, Table, Value};

use crate::component::{Component, catch_defect};

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
    catch_defect("the reference trajectory", || run(component))?
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
    let steps = (VALUES / (1 + inputs.len() + outputs.len())).clamp(*STEPS.start(), *STEPS.end());
    let step = component.info().step_size.min(LONGEST_STEP);
    let omega = TAU / (PERIOD * step);
    let mut simulation = (component.model().prepare)(component.structure().clone());
    let mut advanced = simulation.start(0.0);
    for _ in 0..=steps {
        if advanced.is_err() {
            break;
        }
        let time = simulation.time();
        set_inputs(component, &mut *simulation, &inputs, omega)?;
        let values = inputs
            .iter()
            .chain(&outputs)
            .map(|position| simulation.value(*position));
        let values = [Ok(Value::Real(time))].into_iter().chain(values);
        let texts = values.map(|value| value.map(text)).collect::<Result<Vec<_>>>()?;
        writer.write_record(texts).map_err(failed)?;
        advanced = simulation.advance_to(time + step);
    }
    let bytes = writer.into_inner().map_err(|error| failed(error.into_error().into()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn of(table: &Table, causality: Causality) -> Vec<usize> {
    let variables = table.variables().iter().enumerate();
    variables
        .filter(|(_, variable)| variable.causality == causality)
        .map(|(position, _)| position)
        .collect()
}

fn text(value: Value) -> String {
    match value {
        Value::Real(real) => format!("{real:?}"),
        Value::Integer(integer) => integer.to_string(),
    }
}

/// Sets the inputs for the present time: a (1 - cos) where another input is the rate of this one, and that rate. Any other
/// stays at its start value.
fn set_inputs(component: &Component, simulation: &mut dyn DynSimulation, inputs: &[usize], omega: f64) -> Result<()> {
    let table = component.table();
    let phase = omega * simulation.time();
    for input in inputs {
        let Some(rate) = table.derivative(*input) else { continue };
        let amplitude = (component.amplitude)(&table.variables()[*input], omega);
        simulation.set_at(*input, Value::Real(amplitude * (1.0 - libm::cos(phase))))?;
        if table.derivative(rate).is_none() {
            simulation.set_at(rate, Value::Real(amplitude * omega * libm::sin(phase)))?;
        }
    }
    Ok(())
}
