//! `InitialUnknowns` of every model description: the variables of which an initial output is said to depend are those that
//! change it, no fewer and no more.
//!
//! Each parameter, each input and the start time is varied from many starting points, one at a time, and what changes is
//! compared with what the XML says, read back from its value references (FMI 3.0) and indices (FMI 2.0).
//! Rows `name[1]`, `name[2]`, ... count as one: they have one list.

#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use jostle::fmi::Version;
use jostle::fmi::bundle::Component;
use jostle::scene::catalogue::{Visitor, cards, with_scene};
use jostle::scene::{Causality, Choice, Kind, Scene, TIME, Table, Value, Values, Variable, stem};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Few enough to be quick, enough for a second row of disks.
const DISKS: u32 = 20;
/// Starting points that the scene accepts; fewer where laws are tabulated anew for each.
const POINTS: usize = 16;
const POINTS_OF_TABLES: usize = 5;
/// A scene refuses many starting points at random: this many are tried.
const TRIES: usize = 600;

type Lists = BTreeMap<String, BTreeSet<String>>;

fn given(row: &Variable) -> bool {
    matches!(row.causality, Causality::Parameter | Causality::Input)
}

/// Value of attribute `name` in the element that `text` begins with.
fn attribute<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let element = text.split_once('>').unwrap().0;
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    Some(rest.split_once('"').unwrap().0)
}

/// What the XML says, by name; a list that is left out is all that is given, and the time.
fn declared(component: &Component, version: Version) -> Lists {
    let text = component.model_description(version);
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
    let all = component
        .rows
        .iter()
        .filter(|row| given(row))
        .map(|row| row.name.clone());
    let all: BTreeSet<String> = all.chain([TIME.into()]).collect();
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

/// Computed values of a new scene, by name; none if it refuses.
fn outputs<S: Scene>(table: &Arc<Table>, choice: Choice, start_time: f64, given: &Values) -> Option<Vec<Value>> {
    let mut values = Values::new(Arc::clone(table));
    values.put_back(given.as_slice()).unwrap();
    let scene = S::new(choice, start_time, &values).ok()?;
    scene.write_outputs(values.writer());
    Some(values.as_slice().to_vec())
}

/// Other values that a row may have.
fn variations(row: &Variable, now: Value) -> Vec<Value> {
    let all: Vec<Value> = match (&row.kind, now) {
        (Kind::Real(quantity), Value::Real(now)) => {
            let scaled = [1.0 + 1e-6, 0.97, 1.3, 3.0, 0.2].map(|factor| factor * now);
            let shifted = [0.37, -0.41, 3e-3, 2e-5, 1e-7, 1e3].map(|part| now + part * quantity.nominal);
            let ends = [quantity.min, quantity.max];
            scaled.into_iter().chain(shifted).chain(ends).map(Value::Real).collect()
        }
        (Kind::Enumeration { options, .. }, _) => (1..=options.len() as i64).map(Value::Integer).collect(),
        (_, Value::Integer(now)) => [1, 2, 3, 4, 5, now + 1, now + 2].map(Value::Integer).to_vec(),
        _ => unreachable!("a real holds a real"),
    };
    // A table of impacts takes as long as the skin oscillates in one: a much stiffer one shows nothing new.
    let quick = |value: &Value| match (row.name.as_str(), now, value) {
        ("contact.stiffness_ratio", Value::Real(now), Value::Real(value)) => *value <= 3.0 * now,
        _ => true,
    };
    let allowed = all.into_iter().filter(|value| row.check(*value).is_ok());
    allowed.filter(quick).collect()
}

/// A starting point away from the start values, which are often zeros that hide what matters.
fn point(table: &Arc<Table>, random: &mut Pcg64) -> Values {
    let mut even = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let mut values = Values::new(Arc::clone(table));
    for (position, row) in table.rows().iter().enumerate().filter(|(_, row)| given(row)) {
        let (chosen, factor) = (even(), even());
        let value = match (&row.kind, row.start()) {
            // Of all sizes: time steps too long are refused, and heights far below the overlap at rest are told apart.
            (Kind::Real(quantity), Value::Real(0.0)) if chosen < 0.6 => {
                Value::Real(quantity.nominal * 10_f64.powf(2.0 - 6.0 * factor))
            }
            (Kind::Real(_), Value::Real(start)) if chosen < 0.6 => Value::Real((0.7 + 0.6 * factor) * start),
            (Kind::Enumeration { options, .. }, _) if chosen < 0.6 => {
                Value::Integer(1 + (factor * options.len() as f64) as i64)
            }
            (_, start) => start,
        };
        if row.check(value).is_ok() {
            values.set(position, value).unwrap();
        }
    }
    values
}

/// What changes, by name.
fn observed<S: Scene>(choice: Choice) -> Lists {
    let table = Arc::new(Table::new(S::variables(choice)));
    let mut lists = Lists::new();
    for row in table.rows().iter().filter(|row| !given(row)) {
        lists.entry(stem(&row.name).into()).or_default();
    }
    let mut note = |before: &[Value], after: Option<Vec<Value>>, cause: &str| {
        let Some(after) = after else { return };
        for (row, (one, other)) in table.rows().iter().zip(before.iter().zip(&after)) {
            if !given(row) && one != other {
                lists.get_mut(stem(&row.name)).unwrap().insert(cause.into());
            }
        }
    };
    let mut random = Pcg64::seed_from_u64(7);
    let card = S::card();
    let tabulated = card.engine == "event-driven" && card.scene == "packing";
    let points = if tabulated { POINTS_OF_TABLES } else { POINTS };
    let mut accepted = 0;
    for number in 0..TRIES {
        let values = if number == 0 {
            Values::new(Arc::clone(&table))
        } else {
            point(&table, &mut random)
        };
        let start_time = if number == 0 { 0.0 } else { 0.2971 };
        let Some(before) = outputs::<S>(&table, choice, start_time, &values) else {
            continue;
        };
        accepted += 1;
        for other in [0.0123, 1.7] {
            note(&before, outputs::<S>(&table, choice, other, &values), TIME);
        }
        for (position, row) in table.rows().iter().enumerate().filter(|(_, row)| given(row)) {
            for value in variations(row, values.as_slice()[position]) {
                let mut varied = values.clone();
                varied.set(position, value).unwrap();
                note(&before, outputs::<S>(&table, choice, start_time, &varied), &row.name);
            }
        }
        if accepted == points {
            break;
        }
    }
    assert!(
        accepted >= points / 2,
        "{} accepts {accepted} starting points only",
        card.identifier
    );
    lists
}

struct Compared;

impl Visitor for Compared {
    type Output = Vec<String>;

    /// Where what is said and what is seen differ.
    fn visit<S: Scene>(self) -> Vec<String> {
        let card = S::card();
        let choice = Choice {
            disks: DISKS.min(*card.disks.end()),
        };
        let component = Component::of::<S>(choice).unwrap();
        let seen = observed::<S>(choice);
        // A whole number changes where a threshold is crossed, which few of the variations do. Its list has to hold what they
        // found, and nothing that changes no real output.
        let whole = |name: &str| {
            let mut rows = component.rows.iter().filter(|row| stem(&row.name) == name);
            rows.any(|row| !matches!(row.kind, Kind::Real(_)))
        };
        let reals = seen.iter().filter(|(name, _)| !whole(name));
        let of_reals: BTreeSet<String> = reals.flat_map(|(_, list)| list.clone()).collect();
        let mut wrong = Vec::new();
        for version in [Version::Two, Version::Three] {
            let said = declared(&component, version);
            assert_eq!(said.keys().collect::<Vec<_>>(), seen.keys().collect::<Vec<_>>());
            for (name, seen) in &seen {
                let missing = seen - &said[name];
                let idle = &said[name] - if whole(name) { &of_reals } else { seen };
                if !(missing.is_empty() && idle.is_empty()) {
                    let identifier = card.identifier;
                    wrong.push(format!(
                        "{identifier}, {version:?}: {name} depends on {missing:?} too, and never on {idle:?}"
                    ));
                }
            }
        }
        wrong
    }
}

fn compare(scene: &str) {
    let of_scene = cards().into_iter().filter(|card| card.scene == scene);
    let wrong: Vec<String> = of_scene
        .flat_map(|card| with_scene(card.scene, Some(card.engine), Some(card.drive), Compared).unwrap())
        .collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn packing() {
    compare("packing");
}

#[test]
fn wedge() {
    compare("wedge");
}

#[test]
fn ratchet() {
    compare("ratchet");
}

#[test]
fn three_disk() {
    compare("three_disk");
}
