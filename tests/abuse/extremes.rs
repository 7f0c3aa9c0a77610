//! Extreme but legal parameters, start times, steps and inputs.

use std::sync::Arc;

use fmi_component::times::FARTHEST_TIME;
use jostle::scene::{Causality, Kind, Model, Value, Values};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::checks::{check_box, check_energy, check_outputs};
use super::pick;
use super::trial::{Observed, Trial};

/// An extreme value that the row allows.
fn extreme(generator: &mut Pcg64, kind: &Kind) -> Value {
    match kind {
        Kind::Real(quantity) => {
            let (min, max) = (quantity.min.max(-1e300), quantity.max.min(1e300));
            let start = quantity.start;
            let within = |generator: &mut Pcg64| {
                let exponent: f64 = generator.random_range(-3.0..3.0);
                start * 10_f64.powf(exponent)
            };
            let value = match generator.random_range(0..6) {
                0 => min,
                1 => max,
                2 => 0.0,
                3 => start * 1e-6,
                4 => start * 1e6,
                _ => within(generator),
            };
            Value::Real(value.clamp(min, max))
        }
        Kind::Integer { range, .. } | Kind::Long { range, .. } => Value::Integer(pick(
            generator,
            &[*range.start(), *range.end(), 42.clamp(*range.start(), *range.end())],
        )),
        Kind::Enumeration { options, .. } => Value::Integer(generator.random_range(1..=options.len() as i64)),
        other => panic!("no scene has a parameter or input of this kind: {other:?}"),
    }
}

fn describe(values: &Values, changed: &[usize]) -> String {
    let rows = values.table().variables();
    let described = changed
        .iter()
        .map(|&row| format!("{} = {:?}", rows[row].name, values.get(row)));
    described.collect::<Vec<_>>().join(", ")
}

/// Puts extreme values into some of the parameters and returns which.
fn bend(generator: &mut Pcg64, values: &mut Values) -> Vec<usize> {
    let table = Arc::clone(values.table());
    let is_parameter = |row: &usize| table.variables()[*row].causality == Causality::Parameter;
    let parameters: Vec<usize> = (0..table.variables().len()).filter(is_parameter).collect();
    let count = pick(generator, &[1, 1, 1, 2, 3, 5]);
    let mut changed = Vec::new();
    for _ in 0..count {
        let row = pick(generator, &parameters);
        let value = extreme(generator, &table.variables()[row].kind);
        values.set(row, value).expect("within the range");
        changed.push(row);
    }
    changed
}

/// A duration of some thousand time steps at most, where the scene has such: what is longer is refused at once.
fn affordable(values: &Observed, generator: &mut Pcg64, duration: f64) -> f64 {
    match values.find("chosen_time_step") {
        Some(step) if generator.random_range(0..8) > 0 => duration.min(3000.0 * step),
        _ => duration,
    }
}

fn steps_of(generator: &mut Pcg64) -> Vec<f64> {
    let mut steps = Vec::new();
    for _ in 0..generator.random_range(2..6) {
        steps.push(pick(generator, &[1e-12, 1e-9, 1e-6, 1e-3, 1e-3, 1e-2, 0.1, 0.5]));
    }
    if generator.random_range(0..8) == 0 {
        steps.push(10.0);
    }
    steps
}

/// A time where times are coarse, up to the farthest.
fn far(seed: u64) -> f64 {
    let from = [1e8, -1e9, FARTHEST_TIME - 1.0, -FARTHEST_TIME];
    from[(seed / 6 % 4) as usize]
}

/// Draws parameters from their whole ranges.
fn draw<M: Model>(generator: &mut Pcg64) -> (Trial<M>, Vec<usize>) {
    let mut trial = Trial::<M>::of_disks(pick(generator, &[1, 2, 3, 10, 60]));
    let values = &mut trial.values;
    let changed = bend(generator, values);
    let table = Arc::clone(values.table());
    if generator.random_range(0..10) == 0
        && let (Some(large), Some(width)) = (table.position("disk.radius_large"), table.position("box.width"))
        && let Some(Value::Real(large)) = values.get(large)
    {
        let _ = values.set(width, (2.0 * large).into());
    }
    (trial, changed)
}

/// Draws inputs for a step.
fn draw_inputs<M: Model>(generator: &mut Pcg64, trial: &mut Trial<M>) {
    let table = Arc::clone(trial.values.table());
    if table.position("base.displacement").is_some() {
        for name in ["base.displacement", "base.velocity"] {
            let kept = trial.values.real(name);
            let input = pick(
                generator,
                &[kept, kept, kept, 0.0, 1e-4, -1e-4, 1.0, -1.0, 1e10, -1e300],
            );
            trial.set(name, input);
        }
    }
    for name in ["torque", "torque.rate"] {
        if table.position(name).is_some() {
            let kept = trial.values.real(name);
            let input = pick(generator, &[kept, kept, kept, 0.0, 0.15, -1.0, 1e3, -1e300]);
            trial.set(name, input);
        }
    }
}

/// Restores a state saved as bytes in a model made anew, and repeats the step to `end`: it must give the same bits.
fn repeat<M: Model>(trial: &Trial<M>, mut other: M, bytes: &[u8], end: f64, model: &M) -> Result<(), String> {
    let state = postcard::from_bytes(bytes).map_err(|error| format!("own state: {error}"))?;
    other
        .restore(&state)
        .map_err(|error| format!("own state refused: {error}"))?;
    other
        .advance_to(end, &trial.values)
        .map_err(|error| format!("restored state refuses the step: {error}"))?;
    let same = trial.observe(&other).values == trial.observe(model).values
        && postcard::to_allocvec(&other.state()) == postcard::to_allocvec(&model.state());
    match same {
        true => Ok(()),
        false => Err("other bits after restoring".into()),
    }
}

pub fn extremes<M: Model>(seed: u64) -> Result<String, String> {
    let mut generator = Pcg64::seed_from_u64(seed);
    let (mut trial, changed) = draw::<M>(&mut generator);
    let near = pick(&mut generator, &[0.0, 0.0, 0.0, 0.1, -3.7, 1e6, -1e6]);
    let start = if seed % 6 == 5 { far(seed) } else { near };
    let (disks, described) = (trial.disks(), describe(&trial.values, &changed));
    if std::env::var_os("ABUSE_TELLS").is_some() {
        eprintln!("{seed}: from {start}, {disks} disks, {described}");
    }
    let fail = |what: String, time: f64| Err(format!("{what} at {time} from {start}, {disks} disks, {described}"));
    let mut model = match trial.model(start, &trial.values) {
        Ok(model) => model,
        Err(error) if error.to_string().len() > 40 => return Ok("refused".into()),
        Err(error) => return fail(format!("says {error}"), start),
    };
    let mut now = trial.observe(&model);
    if let Err(what) = check_outputs(&now) {
        return fail(what, start);
    }
    let initial = trial.values.clone();
    let mut time = start;
    let mut refusals = 0;
    for duration in steps_of(&mut generator) {
        draw_inputs(&mut generator, &mut trial);
        let end = time + affordable(&now, &mut generator, duration);
        if end <= time {
            continue;
        }
        if std::env::var_os("ABUSE_TELLS").is_some() {
            eprintln!("{seed}: from {time} to {end} under {:?}", trial.values.as_slice());
        }
        let base = now.find("base.position").unwrap_or(0.0);
        let bytes = postcard::to_allocvec(&model.state()).expect("serialises");
        match model.advance_to(end, &trial.values) {
            Ok(()) => {
                now = trial.observe(&model);
                let base_speed = (now.find("base.position").unwrap_or(0.0) - base).abs() / (end - time);
                let other = trial.model(start, &initial).map_err(|error| error.to_string())?;
                for checked in [
                    check_outputs(&now),
                    check_box(&now, disks, end, base_speed),
                    check_energy(&now),
                    repeat(&trial, other, &bytes, end, &model),
                ] {
                    if let Err(what) = checked {
                        return fail(format!("after {duration}: {what}"), end);
                    }
                }
                time = end;
            }
            Err(error) => {
                refusals += 1;
                if postcard::to_allocvec(&model.state()).ok() != Some(bytes) {
                    return fail(format!("the refusal '{error}' changed the state"), time);
                }
                let table = Arc::clone(trial.values.table());
                for name in ["base.displacement", "base.velocity", "torque", "torque.rate"] {
                    if table.position(name).is_some() {
                        trial.set(name, 0.0);
                    }
                }
            }
        }
    }
    Ok(if refusals == 0 {
        "ran".into()
    } else {
        "ran, with steps refused".into()
    })
}
