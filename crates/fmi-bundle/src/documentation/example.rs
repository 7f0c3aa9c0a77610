//! The run whose picture is on the page, and the program that does it again.

use fmi_component::{Causality, ExampleRun, Kind, Result, Value, Variable};
use quick_xml::escape::escape;

use super::curves::{Curve, draw};
use crate::component::{Component, catch_defect};
use crate::reference;
use crate::run::Run;

/// Curves of a model that names none: so many inputs and so many outputs.
const CURVES: usize = 2;

/// The part of the page: what is driven how, a picture of it, and the program.
///
/// # Errors
/// The model panics, which is a defect of it.
pub fn write(component: &Component) -> Result<String> {
    let run = component.info().sheet.example.unwrap_or_else(|| ExampleRun {
        duration: reference::duration(component),
        steps: reference::steps(component) as u32,
        curves: &[],
        about: "",
    });
    let shown = shown(component, &run);
    let Recorded { times, curves, refused } =
        catch_defect("the run for the page", || record(component, &run, &shown))??;
    let stopped = refused.map(|why| format!("<p>The run ends early: {}</p>\n", escape(why.as_str())));
    let label = format!("Curves of {} over time", component.info().name);
    Ok(format!(
        "{}<p>{}</p>\n{}{}<h3>Do it again</h3>\n<p>With <a href=\"https://github.com/CATIA-Systems/FMPy\">fmpy</a> \
         (<code>pip install fmpy</code>):</p>\n<pre>{}</pre>\n",
        nothing_moves(component),
        driven(component, &run),
        draw(&times, &curves, &label),
        stopped.unwrap_or_default(),
        escape(program(component, &run, &shown).as_str()),
    ))
}

/// What an importer sees that connects nothing.
fn nothing_moves(component: &Component) -> String {
    match component.info().sheet.without_inputs {
        "" => String::new(),
        text => format!("<p><b>Without inputs.</b> {text}</p>\n"),
    }
}

/// How the inputs of the run go.
fn driven(component: &Component, run: &ExampleRun) -> String {
    let about = match run.about {
        "" => String::new(),
        about => format!(" {about}"),
    };
    let duration = Value::Real(run.duration);
    match oscillating(component).as_slice() {
        [] => format!("What the FMU does by itself, from its start values, in {duration} s.{about}"),
        inputs => {
            let names: Vec<String> = inputs
                .iter()
                .map(|(variable, amplitude, _)| {
                    let unit = unit(variable);
                    let (name, amplitude) = (escape(variable.name.as_str()), rounded(*amplitude));
                    format!(
                        "<code>{name}</code> = <i>a</i> (1 &minus; cos &omega;<i>t</i>), <i>a</i> = {amplitude} {unit}"
                    )
                })
                .collect();
            let omega = reference::omega(component);
            format!(
                "From the start values, in {duration} s. The input is that of the reference trajectory in this FMU: {}, \
                 &omega; = {} rad/s ({} Hz), with its rates.{about}",
                names.join("; "),
                rounded(omega),
                rounded(omega / std::f64::consts::TAU)
            )
        }
    }
}

/// Inputs that oscillate with their amplitudes, each followed by its rates.
fn oscillating(component: &Component) -> Vec<(&Variable, f64, Vec<&Variable>)> {
    let (table, omega) = (component.table(), reference::omega(component));
    let variables = table.variables();
    let of_chain = |chain: Vec<usize>| {
        let first = &variables[chain[0]];
        let rates = chain[1..].iter().map(|position| &variables[*position]).collect();
        (first, (component.amplitude)(first, omega), rates)
    };
    reference::chains(table).into_iter().map(of_chain).collect()
}

fn unit(variable: &Variable) -> &'static str {
    match &variable.kind {
        Kind::Real(quantity) | Kind::Single(quantity) => quantity.unit.name,
        _ => "",
    }
}

/// Four digits, for the eye.
fn rounded(value: f64) -> Value {
    Value::Real(format!("{value:.3e}").parse().unwrap_or(value))
}

/// Positions of the variables that are drawn.
fn shown(component: &Component, run: &ExampleRun) -> Vec<usize> {
    let table = component.table();
    if !run.curves.is_empty() {
        return run.curves.iter().filter_map(|name| table.position(name)).collect();
    }
    let real = |position: &usize| matches!(table.variables()[*position].kind, Kind::Real(_));
    let of = |causality| reference::of(table, causality).into_iter().filter(real).take(CURVES);
    of(Causality::Input).chain(of(Causality::Output)).collect()
}

struct Recorded {
    times: Vec<f64>,
    curves: Vec<Curve>,
    /// Why the run ended early, if it did.
    refused: Option<String>,
}

fn record(component: &Component, run: &ExampleRun, shown: &[usize]) -> Result<Recorded> {
    let table = component.table();
    let omega = reference::omega(component);
    let curve = |position: &usize| {
        let variable = &table.variables()[*position];
        Curve {
            name: variable.name.clone(),
            unit: unit(variable),
            input: variable.causality == Causality::Input,
            values: Vec::new(),
        }
    };
    let mut recorded = Recorded {
        times: Vec::new(),
        curves: shown.iter().map(curve).collect(),
        refused: None,
    };
    let mut simulation = component.prepare()?;
    reference::set_inputs(component, &mut *simulation, omega)?; // as the program of the page does
    let mut refused = simulation.start(0.0)?;
    for count in 1..=run.steps + 1 {
        if refused.is_some() {
            recorded.refused = refused;
            break;
        }
        reference::set_inputs(component, &mut *simulation, omega)?;
        sample(&mut *simulation, shown, &mut recorded)?;
        // Never a running sum: the program of the page has the same times.
        refused = simulation.advance_to(run.duration * (f64::from(count) / f64::from(run.steps)))?;
    }
    Ok(recorded)
}

fn sample(simulation: &mut dyn Run, shown: &[usize], recorded: &mut Recorded) -> Result<()> {
    recorded.times.push(simulation.time());
    for (position, curve) in shown.iter().zip(&mut recorded.curves) {
        curve.values.push(match simulation.value(*position)? {
            Value::Real(real) => real,
            Value::Integer(integer) => integer as f64,
        });
    }
    Ok(())
}

/// The program that does the run by fmpy.
fn program(component: &Component, run: &ExampleRun, shown: &[usize]) -> String {
    let variables = component.table().variables();
    let outputs: Vec<String> = shown
        .iter()
        .filter(|position| variables[**position].causality == Causality::Output)
        .map(|position| format!("{:?}", variables[*position].name))
        .collect();
    let (step, stop) = (run.duration / f64::from(run.steps), run.duration);
    let mut text = String::from("import numpy as np\nfrom fmpy import simulate_fmu\n\n");
    text.push_str(&format!("step, stop = {step:?}, {stop:?}\n"));
    let oscillating = oscillating(component);
    let mut argument = String::new();
    if !oscillating.is_empty() {
        let omega = reference::omega(component);
        text.push_str(&format!(
            "t, omega = np.arange({}) * step, {omega:?}\n",
            u64::from(run.steps) + 1
        ));
        let mut columns = vec![("time".to_string(), "t".to_string())];
        for (variable, amplitude, rates) in oscillating {
            columns.push((
                variable.name.clone(),
                format!("{amplitude:?} * (1 - np.cos(omega * t))"),
            ));
            let formulas = ["omega * np.sin(omega * t)", "omega**2 * np.cos(omega * t)"];
            for (rate, formula) in rates.iter().zip(formulas) {
                columns.push((rate.name.clone(), format!("{amplitude:?} * {formula}")));
            }
        }
        text.push_str("columns = {\n");
        for (name, formula) in &columns {
            text.push_str(&format!("    {name:?}: {formula},\n"));
        }
        text.push_str(
            "}\nsignals = np.array(list(zip(*columns.values())), dtype=[(name, float) for name in columns])\n",
        );
        argument = ", input=signals".into();
    }
    text.push_str(&format!(
        "result = simulate_fmu(\"FILE.fmu\", stop_time=stop, step_size=step, output_interval=step{argument},\n    output=[{}])\nprint(result[-1])\n",
        outputs.join(", ")
    ));
    text
}
