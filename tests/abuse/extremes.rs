//! Extreme but legal parameters, start times, steps and inputs.

use std::sync::Arc;

use jostle::scene::times::FARTHEST_TIME;
use jostle::scene::{Causality, Choice, Kind, Scene, Table, Value, Values};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::checks::{check_box, check_energy, check_outputs, real};
use super::{MOST_WORK, pick};

/// A value that the row allows and nobody would choose.
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
    }
}

fn describe(values: &Values, changed: &[usize]) -> String {
    let rows = values.table().rows();
    let told = changed
        .iter()
        .map(|&row| format!("{} = {:?}", rows[row].name, values.get(row)));
    told.collect::<Vec<_>>().join(", ")
}

/// Puts extreme values into some of the parameters and returns which.
fn bend(generator: &mut Pcg64, values: &mut Values) -> Vec<usize> {
    let table = Arc::clone(values.table());
    let is_parameter = |row: &usize| table.rows()[*row].causality == Causality::Parameter;
    let parameters: Vec<usize> = (0..table.rows().len()).filter(is_parameter).collect();
    let count = pick(generator, &[1, 1, 1, 2, 3, 5]);
    let mut changed = Vec::new();
    for _ in 0..count {
        let row = pick(generator, &parameters);
        let value = extreme(generator, &table.rows()[row].kind);
        values.set(row, value).expect("within the range");
        changed.push(row);
    }
    changed
}

/// A duration of some thousand time steps at most, where the scene has such: what is longer is refused at once.
fn affordable(values: &Values, generator: &mut Pcg64, duration: f64) -> f64 {
    match real(values, "chosen_time_step") {
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

pub fn extremes<S: Scene>(seed: u64) -> Result<String, String> {
    let mut generator = Pcg64::seed_from_u64(seed);
    let card = S::card();
    let disks = pick(&mut generator, &[1, 2, 3, 10, 60]).min(*card.disks.end());
    let choice = Choice { disks };
    let mut values = Values::new(Arc::new(Table::new(S::variables(choice))));
    let changed = bend(&mut generator, &mut values);
    if generator.random_range(0..10) == 0
        && let (Some(large), Some(width)) = (real(&values, "disk.radius_large"), values.table().position("box.width"))
    {
        let _ = values.set(width, (2.0 * large).into());
    }
    let near = pick(&mut generator, &[0.0, 0.0, 0.0, 0.1, -3.7, 1e6, -1e6]);
    let start = if seed % 6 == 5 { far(seed) } else { near };
    let told = describe(&values, &changed);
    if std::env::var_os("ABUSE_TELLS").is_some() {
        eprintln!("{seed}: from {start}, {disks} disks, {told}");
    }
    let fail = |what: String, time: f64| Err(format!("{what} at {time} from {start}, {disks} disks, {told}"));
    let mut scene = match S::new(choice, start, &values) {
        Ok(scene) => scene,
        Err(error) if error.to_string().len() > 40 => return Ok("refused".into()),
        Err(error) => return fail(format!("says {error}"), start),
    };
    scene.limit_work(MOST_WORK);
    scene.write_outputs(values.writer());
    if let Err(what) = check_outputs(&values) {
        return fail(what, start);
    }
    let initial = values.clone();
    let mut time = start;
    let mut refusals = 0;
    for duration in steps_of(&mut generator) {
        if values.table().position("base.displacement").is_some() {
            for name in ["base.displacement", "base.velocity"] {
                let kept = values.real(name);
                let input = pick(
                    &mut generator,
                    &[kept, kept, kept, 0.0, 1e-4, -1e-4, 1.0, -1.0, 1e10, -1e300],
                );
                values.set_by_name(name, input.into()).expect("finite");
            }
        }
        for name in ["torque", "torque.rate"] {
            if let Some(kept) = real(&values, name) {
                let input = pick(&mut generator, &[kept, kept, kept, 0.0, 0.15, -1.0, 1e3, -1e300]);
                values.set_by_name(name, input.into()).expect("finite");
            }
        }
        let end = time + affordable(&values, &mut generator, duration);
        if end <= time {
            continue;
        }
        if std::env::var_os("ABUSE_TELLS").is_some() {
            let inputs = ["base.displacement", "base.velocity"].map(|name| real(&values, name));
            eprintln!("{seed}: from {time} to {end} under {inputs:?}");
        }
        let base = real(&values, "base.position").unwrap_or(0.0);
        let before = scene.state();
        let bytes = postcard::to_allocvec(&before).expect("serialises");
        match scene.advance_to(end, &values) {
            Ok(()) => {
                scene.write_outputs(values.writer());
                let base_speed = (real(&values, "base.position").unwrap_or(0.0) - base).abs() / (end - time);
                for checked in [
                    check_outputs(&values),
                    check_box(&values, disks, end, base_speed),
                    check_energy(&values),
                ] {
                    if let Err(what) = checked {
                        return fail(format!("after {duration}: {what}"), end);
                    }
                }
                let mut again = values.clone();
                let mut other = S::new(choice, start, &initial).map_err(|error| error.to_string())?;
                other.limit_work(MOST_WORK);
                let state = postcard::from_bytes(&bytes).map_err(|error| format!("own state: {error}"))?;
                if let Err(error) = other.restore(&state) {
                    return fail(format!("own state refused: {error}"), time);
                }
                if let Err(error) = other.advance_to(end, &values) {
                    return fail(format!("restored state refuses the step: {error}"), time);
                }
                other.write_outputs(again.writer());
                if again != values || postcard::to_allocvec(&other.state()) != postcard::to_allocvec(&scene.state()) {
                    return fail(format!("other bits after restoring, step {duration}"), end);
                }
                time = end;
            }
            Err(error) => {
                refusals += 1;
                if postcard::to_allocvec(&scene.state()).ok() != Some(bytes) {
                    return fail(format!("the refusal '{error}' changed the state"), time);
                }
                for name in ["base.displacement", "base.velocity", "torque", "torque.rate"] {
                    let _ = values.set_by_name(name, 0.0.into());
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
