//! Every scene under extreme but legal parameters, steps and inputs, and fed with damaged states: it may refuse, but it
//! neither panics nor hangs, what it shows is finite, and a refusal leaves it as it was.
//!
//! Trials are drawn from seeds, so that a failure names what repeats it. `ABUSE_TRIALS` asks for more of them,
//! `ABUSE_FIRST` for others, `ABUSE_TELLS` for what each does.

use std::collections::BTreeMap;
use std::panic::catch_unwind;
use std::sync::Arc;

use jostle::drive::{FollowsInput, Sine};
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::packing::{LocatedPackingOnInput, LocatedPackingOnSine, PackingOnInput, PackingOnSine};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine};
use jostle::scene::three_disk::{
    ThreeDiskOnHarmonicTorque, ThreeDiskOnInput, ThreeDiskOnRandomSupports, ThreeDiskOnSine,
};
use jostle::scene::wedge::{WedgeEventDriven, WedgeMap, WedgeMolecularDynamics};
use jostle::scene::{Causality, Choice, Kind, Scene, Table, Value, Values};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Work that a step of a trial may do (`jostle::engine::Work`). What absurd parameters ask beyond it is refused.
const MOST_WORK: u64 = 200_000;

fn number(variable: &str, usual: u64) -> u64 {
    let asked = std::env::var(variable).ok();
    asked.and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// Runs the trials and gathers what went wrong. None can hang: what a step may do is bounded.
fn run_all(name: &str, usual: u64, trial: fn(u64) -> Result<String, String>) {
    let (first, count) = (number("ABUSE_FIRST", 0), number("ABUSE_TRIALS", usual));
    let (mut wrong, mut seen) = (Vec::new(), BTreeMap::new());
    for seed in first..first + count {
        match catch_unwind(|| trial(seed)) {
            Ok(Ok(outcome)) => *seen.entry(outcome).or_insert(0) += 1,
            Ok(Err(what)) => wrong.push(format!("{name} {seed}: {what}")),
            Err(panic) => {
                let text = panic.downcast_ref::<String>().cloned();
                let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| text.to_string()));
                wrong.push(format!("{name} {seed}: panics {text:?}"));
            }
        }
    }
    eprintln!("{name}: {seen:?}");
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
}

fn pick<T: Copy>(generator: &mut Pcg64, from: &[T]) -> T {
    from[generator.random_range(0..from.len())]
}

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

fn real(values: &Values, name: &str) -> Option<f64> {
    values.table().position(name).map(|_| values.real(name))
}

/// A duration of some thousand time steps at most, where the scene has such: what is longer is refused at once.
fn affordable(values: &Values, generator: &mut Pcg64, duration: f64) -> f64 {
    match real(values, "chosen_time_step") {
        Some(step) if generator.random_range(0..8) > 0 => duration.min(3000.0 * step),
        _ => duration,
    }
}

fn check_outputs(values: &Values) -> Result<(), String> {
    for (row, value) in values.table().rows().iter().zip(values.as_slice()) {
        if let Value::Real(real) = value
            && !real.is_finite()
        {
            return Err(format!("{} = {real}", row.name));
        }
    }
    Ok(())
}

/// How far disk and base may move \[m\] in the time that tells two numbers at `time` \[s\] apart: 1e-10 s after a million.
/// The speeds are the largest that the energy, the lightest disk and the drive allow.
fn place_at_resolution(values: &Values, time: f64) -> f64 {
    let radii = ["disk.radius_small", "disk.radius_medium", "disk.radius_large"];
    let smallest = radii
        .iter()
        .filter_map(|name| real(values, name))
        .fold(f64::INFINITY, f64::min);
    let density = real(values, "disk.surface_density").unwrap_or(f64::INFINITY);
    let lightest = density * std::f64::consts::PI * smallest * smallest;
    let disk = (2.0 * values.real("energy.kinetic") / lightest).sqrt();
    let drive = ["drive.amplitude", "drive.frequency"].map(|name| real(values, name).unwrap_or(0.0));
    let base = std::f64::consts::TAU * drive[0] * drive[1] + real(values, "base.velocity").unwrap_or(0.0).abs();
    f64::EPSILON * time.abs() * (disk + base)
}

/// Hard disks stay in the box, soft ones leave it by half a radius at most.
fn check_box(values: &Values, disks: u32, time: f64) -> Result<(), String> {
    let Some(width) = real(values, "box.width") else {
        return Ok(());
    };
    let soft = real(values, "chosen_time_step").is_some();
    let base = values.real("base.position");
    let blur = place_at_resolution(values, time);
    for disk in 1..=disks {
        let number = |name: &str| values.real(&format!("{name}[{disk}]"));
        let (x, y, radius) = (number("disk.x"), number("disk.y"), number("disk.radius"));
        let slack = if soft {
            0.5 * radius
        } else {
            1e-9 * radius + 1e-12 * (width + y.abs() + base.abs()) + blur
        };
        if x.abs() + radius > 0.5 * width + slack || y < base + radius - slack {
            return Err(format!(
                "disk {disk} of radius {radius} is at {x}, {y} with the base at {base}"
            ));
        }
    }
    Ok(())
}

fn check_energy(values: &Values) -> Result<(), String> {
    let Some(residual) = real(values, "energy.residual") else {
        return Ok(());
    };
    if real(values, "chosen_time_step").is_some() {
        return Ok(());
    }
    let names = ["energy.kinetic", "energy.potential", "energy.input", "energy.lost"];
    let scale: f64 = names.iter().map(|name| values.real(name).abs()).sum();
    if residual.abs() > 1e-6 * scale {
        return Err(format!("energy.residual = {residual:e} beside {scale:e}"));
    }
    Ok(())
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

fn extremes<S: Scene>(seed: u64) -> Result<String, String> {
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
    let start = pick(&mut generator, &[0.0, 0.0, 0.0, 0.1, -3.7, 1e6, -1e6]);
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
        let before = scene.state();
        let bytes = postcard::to_allocvec(&before).expect("serialises");
        match scene.advance_to(end, &values) {
            Ok(()) => {
                scene.write_outputs(values.writer());
                for checked in [
                    check_outputs(&values),
                    check_box(&values, disks, end),
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

/// Damages some bytes.
fn damage(generator: &mut Pcg64, bytes: &mut Vec<u8>) {
    for _ in 0..pick(generator, &[1, 1, 2, 4]) {
        let at = generator.random_range(0..bytes.len());
        match generator.random_range(0..6) {
            0 => bytes.truncate(at.max(1)),
            1 | 2 => bytes[at] ^= 1 << generator.random_range(0..8),
            3 => bytes[at] = generator.next_u64() as u8,
            4 => bytes[at..].iter_mut().take(9).for_each(|byte| *byte = 0xff),
            _ => {
                let number = pick(generator, &[f64::NAN, 1e300, -1e300, f64::INFINITY, 0.0, -1.0]);
                for (byte, new) in bytes[at..].iter_mut().zip(number.to_le_bytes()) {
                    *byte = new;
                }
            }
        }
    }
}

fn damaged<S: Scene>(seed: u64) -> Result<String, String> {
    let mut generator = Pcg64::seed_from_u64(seed);
    let disks = pick(&mut generator, &[1, 5]).min(*S::card().disks.end());
    let choice = Choice { disks };
    let mut values = Values::new(Arc::new(Table::new(S::variables(choice))));
    if let Some(row) = values.table().position("base.model") {
        values
            .set(row, Value::Integer(generator.random_range(1..=2)))
            .expect("an option");
    }
    let mut scene = S::new(choice, 0.0, &values).map_err(|error| error.to_string())?;
    scene.limit_work(MOST_WORK);
    scene.advance_to(0.02, &values).map_err(|error| error.to_string())?;
    let mut bytes = postcard::to_allocvec(&scene.state()).expect("serialises");
    let before = bytes.clone();
    damage(&mut generator, &mut bytes);
    let Ok(state) = postcard::from_bytes::<S::State>(&bytes) else {
        return Ok("no state".into());
    };
    if scene.restore(&state).is_err() {
        if postcard::to_allocvec(&scene.state()).expect("serialises") != before {
            return Err("a refused state changed the scene".into());
        }
        return Ok("refused".into());
    }
    scene.write_outputs(values.writer());
    check_outputs(&values).map_err(|what| format!("after restoring: {what}"))?;
    let mut refused = 0;
    for step in 1..=100 {
        let end = 0.02 + 1e-3 * f64::from(step);
        if scene.advance_to(end, &values).is_err() {
            refused += 1;
            continue;
        }
        scene.write_outputs(values.writer());
        check_outputs(&values).map_err(|what| format!("at {end}: {what}"))?;
    }
    Ok(if refused == 0 {
        "ran".into()
    } else {
        "ran, with steps refused".into()
    })
}

macro_rules! scenes {
    ($($name:ident: $scene:ty, $extremes:expr, $damaged:expr;)*) => {
        mod extreme_parameters {
            use super::*;
            $(#[test]
            fn $name() {
                run_all(stringify!($name), $extremes, extremes::<$scene>);
            })*
        }

        mod damaged_states {
            use super::*;
            $(#[test]
            fn $name() {
                run_all(stringify!($name), $damaged, damaged::<$scene>);
            })*
        }
    };
}

/// Trials that found something once: more impacts on the ceiling than in all, disks thrown to infinity, the resolution of
/// time.
#[test]
fn what_was_mended_stays_so() {
    for outcome in [
        damaged::<RatchetOnInput>(209),
        damaged::<WedgeMolecularDynamics<FollowsInput>>(171),
        damaged::<WedgeMolecularDynamics<FollowsInput>>(231),
        extremes::<HardPackingOnSine>(314),
    ] {
        assert!(outcome.is_ok(), "{outcome:?}");
    }
}

scenes! {
    packing_on_sine: PackingOnSine, 12, 60;
    packing_on_input: PackingOnInput, 8, 40;
    located_packing_on_sine: LocatedPackingOnSine, 12, 60;
    located_packing_on_input: LocatedPackingOnInput, 8, 40;
    hard_packing_on_sine: HardPackingOnSine, 12, 60;
    hard_packing_on_input: HardPackingOnInput, 8, 40;
    wedge_map: WedgeMap, 20, 60;
    wedge_event_driven_on_sine: WedgeEventDriven<Sine>, 20, 60;
    wedge_event_driven_on_input: WedgeEventDriven<FollowsInput>, 20, 60;
    wedge_molecular_dynamics_on_sine: WedgeMolecularDynamics<Sine>, 12, 60;
    wedge_molecular_dynamics_on_input: WedgeMolecularDynamics<FollowsInput>, 12, 60;
    ratchet_on_sine: RatchetOnSine, 12, 60;
    ratchet_on_input: RatchetOnInput, 12, 60;
    three_disk_on_input: ThreeDiskOnInput, 12, 40;
    three_disk_on_harmonic_torque: ThreeDiskOnHarmonicTorque, 12, 40;
    three_disk_on_random_supports: ThreeDiskOnRandomSupports, 12, 40;
    three_disk_on_sine: ThreeDiskOnSine, 12, 40;
}
