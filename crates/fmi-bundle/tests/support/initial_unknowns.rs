//! `InitialUnknowns` of a model description against the model: the variables of which an initial output is said to depend
//! are to be those that change it, no fewer and no more.
//!
//! Each parameter, each input and the start time is varied from many starting points, one at a time, and what changes is
//! compared with what the XML says, read back from its value references (FMI 3.0) and indices (FMI 2.0).
//! Variables `name[1]`, `name[2]`, ... count as one: they have one list.

use std::collections::{BTreeMap, BTreeSet};

use fmi_bundle::{Component, Version, model_description};
use fmi_component::{DynSimulation, Kind, TIME, Table, Value, Values, Variable};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// A model refuses many starting points at random: this many are tried.
const TRIES: usize = 600;

/// What is tried.
pub struct Trials {
    /// Starting points that the model accepts; at least half of them are needed.
    pub points: usize,
    /// Whether a value is worth trying for a variable that is now at another.
    pub is_tried: fn(&Variable, now: Value, other: Value) -> bool,
    /// Names of reals that few variations change, since they depend on something by rounding alone.
    pub rounded: &'static [&'static str],
}

type Lists = BTreeMap<String, BTreeSet<String>>;

/// Where what a model description says and what the model does differ.
pub fn differences(component: &Component, trials: &Trials) -> Vec<String> {
    let observed = observed(component, trials);
    let variables = component.table().variables();
    // A whole number changes where a threshold is crossed, which few of the variations do. Its list has to hold what they
    // found, and nothing that changes no real output.
    let whole = |name: &str| {
        if trials.rounded.contains(&name) {
            return true;
        }
        let mut of_name = variables.iter().filter(|variable| stem(&variable.name) == name);
        of_name.any(|variable| !matches!(variable.kind, Kind::Real(_)))
    };
    let reals = observed.iter().filter(|(name, _)| !whole(name));
    let of_reals: BTreeSet<String> = reals.flat_map(|(_, list)| list.clone()).collect();
    let mut wrong = Vec::new();
    for version in [Version::Two, Version::Three] {
        let said = declared(component, version);
        assert_eq!(said.keys().collect::<Vec<_>>(), observed.keys().collect::<Vec<_>>());
        for (name, observed) in &observed {
            let missing = observed - &said[name];
            let idle = &said[name] - if whole(name) { &of_reals } else { observed };
            if !(missing.is_empty() && idle.is_empty()) {
                let identifier = &component.info().identifier;
                wrong.push(format!(
                    "{identifier}, {version:?}: {name} depends on {missing:?} too, and never on {idle:?}"
                ));
            }
        }
    }
    wrong
}

/// Name without the index at its end: `body.x` of `body.x[3]`.
fn stem(name: &str) -> &str {
    match name.strip_suffix(']').and_then(|rest| rest.rsplit_once('[')) {
        Some((stem, _)) => stem,
        None => name,
    }
}

/// Value of attribute `name` in the element that `text` begins with.
fn attribute<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let element = text.split_once('>').unwrap().0;
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    Some(rest.split_once('"').unwrap().0)
}

/// What the XML says, by name; a list that is left out is all parameters and inputs, and the time.
fn declared(component: &Component, version: Version) -> Lists {
    let text = model_description::write(component, version);
    let (variables, structure) = text.split_once("<ModelStructure>").unwrap();
    let variables = variables.split_once("<ModelVariables>").unwrap().1;
    let (opening, unknown, number) = match version {
        Version::Two => ("<ScalarVariable", "<Unknown", "index"),
        Version::Three => ("<", "<InitialUnknown", "valueReference"),
    };
    let names: BTreeMap<String, &str> = variables
        .split(opening)
        .filter(|element| attribute(&format!("{element}>"), "causality").is_some())
        .zip(1..)
        .map(|(element, index): (&str, u32)| {
            let key = match version {
                Version::Two => index.to_string(),
                Version::Three => attribute(element, "valueReference").unwrap().into(),
            };
            (key, attribute(element, "name").unwrap())
        })
        .collect();
    let structure = match version {
        Version::Two => structure.split_once("<InitialUnknowns>").unwrap().1,
        Version::Three => structure,
    };
    let settable = component
        .table()
        .settable()
        .iter()
        .map(|variable| variable.name.clone());
    let all: BTreeSet<String> = settable.chain([TIME.into()]).collect();
    let mut lists = Lists::new();
    for element in structure.split(unknown).skip(1) {
        let list = match attribute(element, "dependencies") {
            Some(keys) => keys.split_whitespace().map(|key| names[key].to_string()).collect(),
            None => all.clone(),
        };
        let name = names[attribute(element, number).unwrap()];
        let former = lists.insert(stem(name).into(), list.clone());
        assert!(
            former.is_none_or(|former| former == list),
            "{name} differs from its like"
        );
    }
    lists
}

/// Computed values of the model when it starts; none if it refuses.
fn outputs(simulation: &mut dyn DynSimulation, start_time: f64, given: &[Value]) -> Option<Vec<Value>> {
    simulation.stop();
    for (position, value) in given.iter().enumerate() {
        simulation.set_at(position, *value).unwrap();
    }
    simulation.start(start_time).ok()?;
    let all = simulation.values().table().variables().len();
    Some(
        (given.len()..all)
            .map(|position| simulation.value(position).unwrap())
            .collect(),
    )
}

/// Other values that a variable may have.
fn variations(variable: &Variable, now: Value, trials: &Trials) -> Vec<Value> {
    let all: Vec<Value> = match (&variable.kind, now) {
        (Kind::Real(quantity), Value::Real(now)) => {
            let scaled = [1.0 + 1e-6, 0.97, 1.3, 3.0, 0.2].map(|factor| factor * now);
            let shifted = [0.37, -0.41, 3e-3, 2e-5, 1e-7, 1e3].map(|part| now + part * quantity.nominal);
            let ends = [quantity.min, quantity.max];
            scaled.into_iter().chain(shifted).chain(ends).map(Value::Real).collect()
        }
        (Kind::Enumeration { options, .. }, _) => (1..=options.len() as i64).map(Value::Integer).collect(),
        (_, Value::Integer(now)) => [0, 1, 2, 3, 4, 5, now + 1, now + 2].map(Value::Integer).to_vec(),
        _ => unreachable!("a real holds a real"),
    };
    let allowed = all.into_iter().filter(|value| variable.check(*value).is_ok());
    allowed
        .filter(|value| (trials.is_tried)(variable, now, *value))
        .collect()
}

/// A starting point away from the start values, which are often zeros that hide what matters.
fn point(table: &Table, random: &mut Pcg64) -> Vec<Value> {
    let mut even = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let mut values = Vec::new();
    for variable in table.settable() {
        let (chosen, factor) = (even(), even());
        let value = match (&variable.kind, variable.start()) {
            // Of all sizes: time steps too long are refused, and small lengths are distinguished from zero.
            (Kind::Real(quantity), Value::Real(0.0)) if chosen < 0.6 => {
                Value::Real(quantity.nominal * 10_f64.powf(2.0 - 6.0 * factor))
            }
            (Kind::Real(_), Value::Real(start)) if chosen < 0.6 => Value::Real((0.7 + 0.6 * factor) * start),
            (Kind::Enumeration { options, .. }, _) if chosen < 0.6 => {
                Value::Integer(1 + (factor * options.len() as f64) as i64)
            }
            (Kind::Long { range, .. }, _) if chosen < 0.6 && *range.end() < 10 => {
                Value::Integer(range.start() + (factor * (1 + range.end() - range.start()) as f64) as i64)
            }
            (_, start) => start,
        };
        values.push(match variable.check(value) {
            Ok(()) => value,
            Err(_) => variable.start(),
        });
    }
    values
}

/// What changes, by name.
fn observed(component: &Component, trials: &Trials) -> Lists {
    let table = component.table();
    let computed = &table.variables()[table.settable().len()..];
    let mut lists: Lists = computed
        .iter()
        .map(|variable| (stem(&variable.name).into(), BTreeSet::new()))
        .collect();
    let mut note = |before: &[Value], after: Option<Vec<Value>>, cause: &str| {
        let Some(after) = after else { return };
        for (variable, (one, other)) in computed.iter().zip(before.iter().zip(&after)) {
            if one != other {
                lists.get_mut(stem(&variable.name)).unwrap().insert(cause.into());
            }
        }
    };
    let mut random = Pcg64::seed_from_u64(7);
    let mut simulation = (component.model().unwrap().prepare)(component.structure().clone());
    let mut run = |time: f64, values: &[Value]| outputs(&mut *simulation, time, values);
    let mut accepted = 0;
    for number in 0..TRIES {
        let (start_time, values) = match number {
            0 => (0.0, Values::new(table.clone()).as_slice().to_vec()),
            _ => (0.2971, point(table, &mut random)),
        };
        let Some(before) = run(start_time, &values) else {
            continue;
        };
        accepted += 1;
        for other in [0.0123, 1.7, -0.9] {
            note(&before, run(other, &values), TIME);
        }
        for (position, variable) in table.settable().iter().enumerate() {
            for value in variations(variable, values[position], trials) {
                let mut varied = values.clone();
                varied[position] = value;
                note(&before, run(start_time, &varied), &variable.name);
            }
        }
        if accepted == trials.points {
            break;
        }
    }
    let identifier = &component.info().identifier;
    assert!(
        accepted >= trials.points / 2,
        "{identifier} accepts {accepted} starting points only"
    );
    lists
}
