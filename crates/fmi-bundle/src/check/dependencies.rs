//! What outputs are said to depend on, against what changes them in the library.
//!
//! Each parameter, each input and the start time is varied from two starting points, one at a time, and each computed variable that changes
//! has to name it. During initialisation that is `InitialUnknowns`, after a step, under another input, `Outputs`. What is listed and changes
//! nothing is no fault: it may matter elsewhere.

use std::collections::BTreeSet;

use fmi_component::{Causality, Kind, Result, TIME, TIME_REFERENCE, Value, Variable, value_reference};

use super::description::{Described, Unknown};
use super::findings::CheckReport;
use crate::component::Component;
use crate::importer::Instance;

const LIST_IT: &str = "List it, or leave the attribute dependencies out, which stands for all.";

/// A list of dependencies in the model structure.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum List {
    /// During initialisation.
    InitialUnknowns,
    /// After a step.
    Outputs,
}

/// What a trial looks at.
struct Trial<'a> {
    component: &'a Component,
    instance: Instance,
    /// Where the variable of the FMU begins that holds the scalar at each position.
    begins: Vec<usize>,
}

/// Compares; a line on what was tried.
///
/// # Errors
/// The library makes no instance.
pub fn check(described: &Described, component: &Component, report: &mut CheckReport) -> Result<String> {
    let mut begin = 0;
    let begins = component.spans().into_iter().enumerate().map(|(position, span)| {
        begin = if span > 0 { position } else { begin };
        begin
    });
    let mut trial = Trial {
        component,
        begins: begins.collect(),
        instance: component.instance(false)?,
    };
    let settable = component.table().settable().len();
    let mut told = BTreeSet::new();
    let (mut points, mut tried) = (0, 0);
    for point in [trial.start_values(), trial.moved()] {
        let Some(before) = trial.initial(0.0, &point)? else {
            continue;
        };
        points += 1;
        for time in [0.0123, 1.7] {
            if let Some(after) = trial.initial(time, &point)? {
                let changed = trial.changed(&before, &after);
                trial.note(
                    List::InitialUnknowns,
                    described,
                    (TIME_REFERENCE, TIME),
                    &changed,
                    &mut told,
                    report,
                );
            }
        }
        for position in 0..settable {
            for value in variations(&component.table().variables()[position], point[position]) {
                let mut varied = point.clone();
                varied[position] = value;
                let Some(after) = trial.initial(0.0, &varied)? else {
                    continue;
                };
                tried += 1;
                let changed = trial.changed(&before, &after);
                let cause = trial.cause(position);
                trial.note(List::InitialUnknowns, described, cause, &changed, &mut told, report);
            }
        }
        tried += trial.after_a_step(described, &point, &mut told, report)?;
    }
    Ok(format!(
        "dependencies: {tried} changes of a parameter or an input, from {points} starting points"
    ))
}

impl<'a> Trial<'a> {
    fn variable(&self, position: usize) -> &'a Variable {
        &self.component.table().variables()[position]
    }

    fn settable(&self) -> usize {
        self.component.table().settable().len()
    }

    fn start_values(&self) -> Vec<Value> {
        self.component.table().settable().iter().map(Variable::start).collect()
    }

    /// Away from the start values, which are often zeros that hide what matters: by parts that are no two alike.
    fn moved(&self) -> Vec<Value> {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let moved = |(position, variable): (usize, &Variable)| {
            let part = (position as f64 + 1.0) * GOLDEN % 1.0;
            let value = match (variable.start(), &variable.kind) {
                (Value::Real(0.0), Kind::Real(quantity) | Kind::Single(quantity)) => {
                    Value::Real(quantity.nominal * 0.1 * part)
                }
                (Value::Real(start), _) => Value::Real(start * (0.9 + 0.2 * part)),
                (whole, _) => whole,
            };
            if variable.check(value).is_ok() {
                value
            } else {
                variable.start()
            }
        };
        self.component
            .table()
            .settable()
            .iter()
            .enumerate()
            .map(moved)
            .collect()
    }

    /// Computed values once the model has started; none if it refuses.
    fn initial(&mut self, time: f64, given: &[Value]) -> Result<Option<Vec<Value>>> {
        if self.instance.reset().is_err() {
            self.instance = self.component.instance(false)?; // one that has failed
        }
        match self.started(time, given) {
            Ok(()) => Ok(self.computed().ok()),
            Err(_) => Ok(None),
        }
    }

    fn started(&mut self, time: f64, given: &[Value]) -> Result<()> {
        for (position, value) in given.iter().enumerate() {
            self.set(position, *value)?;
        }
        self.instance.enter_initialization(time)?;
        self.instance.exit_initialization()
    }

    fn set(&mut self, position: usize, value: Value) -> Result<()> {
        let kind = &self.variable(position).kind;
        match kind {
            Kind::Text { .. } | Kind::Binary { .. } => Ok(()),
            kind => self.instance.set_value(kind, value_reference(position), value),
        }
    }

    /// Values of the computed numbers; texts and bytes count as one that never changes.
    fn computed(&mut self) -> Result<Vec<Value>> {
        let computed = &self.component.table().variables()[self.settable()..];
        let first = value_reference(self.settable());
        let mut values = Vec::new();
        for (reference, variable) in (first..).zip(computed) {
            values.push(match &variable.kind {
                Kind::Text { .. } | Kind::Binary { .. } => Value::Integer(0),
                kind => self.instance.values(kind, reference, 1)?[0],
            });
        }
        Ok(values)
    }

    /// Positions of what differs.
    fn changed(&self, before: &[Value], after: &[Value]) -> Vec<usize> {
        let bits = |value: &Value| match value {
            Value::Real(real) => real.to_bits(),
            Value::Integer(integer) => *integer as u64,
        };
        let pairs = before.iter().zip(after).enumerate();
        let differing = pairs.filter(|(_, (one, other))| bits(one) != bits(other));
        differing.map(|(index, _)| self.settable() + index).collect()
    }

    /// Reference and name of the FMU's variable that holds the scalar at `position`.
    fn cause(&self, position: usize) -> (u32, &'a str) {
        let begin = self.begins[position];
        (value_reference(begin), self.component.name_at(begin))
    }

    /// Faults for all of `changed` whose list lacks the cause.
    fn note(
        &self,
        list: List,
        described: &Described,
        (reference, cause): (u32, &str),
        changed: &[usize],
        told: &mut BTreeSet<(u32, u32, List)>,
        report: &mut CheckReport,
    ) {
        let (unknowns, when) = match list {
            List::InitialUnknowns => (&described.initial, "InitialUnknowns say, when the model starts"),
            List::Outputs => (&described.outputs, "Outputs say, at a communication point"),
        };
        for position in changed {
            let own = value_reference(self.begins[*position]);
            let of = |unknown: &&Unknown| {
                unknown
                    .variable
                    .and_then(|index| described.variables[index].reference())
                    == Some(own)
            };
            let Some(unknown) = unknowns.iter().find(of) else {
                continue;
            };
            let Some(dependencies) = &unknown.dependencies else {
                continue;
            };
            let references = dependencies
                .iter()
                .flatten()
                .filter_map(|index| described.variables[*index].reference());
            if references.into_iter().any(|known| known == reference) || !told.insert((own, reference, list)) {
                continue;
            }
            let name = self.component.name_at(self.begins[*position]);
            report.fault(
                &unknown.place,
                format!("{name} changes with {cause}, on which it does not depend as {when}"),
                LIST_IT,
            );
        }
    }

    /// Varies the inputs after a step; how many changes were tried.
    fn after_a_step(
        &mut self,
        described: &Described,
        point: &[Value],
        told: &mut BTreeSet<(u32, u32, List)>,
        report: &mut CheckReport,
    ) -> Result<usize> {
        let step = self.component.info().step_size;
        if self.initial(0.0, point)?.is_none() || self.instance.step(0.0, step, step).is_err() {
            return Ok(0);
        }
        let Ok(before) = self.computed() else { return Ok(0) };
        let mut tried = 0;
        let settable = self.component.table().settable().iter().enumerate();
        let inputs = settable.filter(|(_, variable)| variable.causality == Causality::Input);
        for (position, variable) in inputs {
            for value in variations(variable, point[position]) {
                if self.set(position, value).is_ok()
                    && let Ok(after) = self.computed()
                {
                    tried += 1;
                    let changed = self.changed(&before, &after);
                    self.note(List::Outputs, described, self.cause(position), &changed, told, report);
                }
            }
            let _ = self.set(position, point[position]);
        }
        Ok(tried)
    }
}

/// Other values that a variable may have.
fn variations(variable: &Variable, now: Value) -> Vec<Value> {
    let all: Vec<Value> = match (&variable.kind, now) {
        (Kind::Real(quantity) | Kind::Single(quantity), Value::Real(now)) => {
            let scaled = [1.3, 0.97, 1.0 + 1e-6].map(|factor| factor * now);
            let shifted = [0.37, -0.41, 1e-3].map(|part| now + part * quantity.nominal);
            scaled.into_iter().chain(shifted).map(Value::Real).collect()
        }
        (Kind::Enumeration { options, .. }, _) => (1..=options.len() as i64).map(Value::Integer).collect(),
        (_, Value::Integer(now)) => [0, 1, now.saturating_add(1), now.saturating_sub(1)]
            .map(Value::Integer)
            .to_vec(),
        (_, Value::Real(_)) => Vec::new(),
    };
    all.into_iter()
        .filter(|value| *value != now && variable.check(*value).is_ok())
        .collect()
}
