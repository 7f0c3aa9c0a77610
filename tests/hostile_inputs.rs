//! Hostile but legal physics, case by case: what each scene and engine answers is what the table in `docs/abuse.md` says.
//!
//! A refused step leaves the state as it was, and the next sane one goes through; an answer is finite, keeps disks above
//! the base, and its energies balance.

#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;

use jostle::Error;
use jostle::scene::catalogue::{Names, names};
use jostle::scene::{AnySimulation, Selection, Value};

const TABLE: &str = include_str!("../docs/abuse.md");
const CASES: [&str; 4] = [
    "jump of the base",
    "not a number",
    "amplitude times 1000",
    "step times 1000",
];
/// \[m\].
const AMPLITUDE: f64 = 1e-4;
/// \[N.m\].
const TORQUE: f64 = 1e-3;
const FREQUENCY: f64 = 80.0;
const STEP: f64 = 1e-3;

/// The scene, driven `factor` times as hard as usual where a parameter says how hard.
fn simulation(names: &Names, factor: f64) -> Result<AnySimulation, Error> {
    let selection = Selection {
        scene: names.scene,
        engine: Some(names.engine),
        drive: Some(names.drive),
        disks: ["packing", "ratchet"].contains(&names.scene).then_some(20),
    };
    let usual = AnySimulation::new(selection, &[])?;
    let amplitudes = ["drive.amplitude", "torque.amplitude", "support.amplitude"];
    let Some(name) = amplitudes.into_iter().find(|name| usual.position(name).is_ok()) else {
        return Ok(usual);
    };
    let on_base = usual.position("base.position").is_ok();
    let amplitude = if on_base { AMPLITUDE } else { usual.real(name)? };
    let (amplitude, frequency) = ((factor * amplitude).to_string(), FREQUENCY.to_string());
    let given = [(name, amplitude.as_str()), ("drive.frequency", frequency.as_str())];
    AnySimulation::new(selection, if on_base { &given } else { &given[..1] })
}

/// Base of y = A (1 - cos(omega t)), or a torque of B sin(omega t), given as inputs.
fn set_target(simulation: &mut AnySimulation, factor: f64) {
    let (omega, phase) = (TAU * FREQUENCY, TAU * FREQUENCY * simulation.time());
    let inputs = [
        ("base.displacement", factor * AMPLITUDE * (1.0 - phase.cos())),
        ("base.velocity", factor * AMPLITUDE * omega * phase.sin()),
        ("torque", factor * TORQUE * phase.sin()),
        ("torque.rate", factor * TORQUE * omega * phase.cos()),
    ];
    for (name, value) in inputs {
        if simulation.position(name).is_ok() {
            simulation.set(name, value).unwrap();
        }
    }
}

/// A step; if it is refused, nothing has changed.
fn step(simulation: &mut AnySimulation, duration: f64) -> Result<(), Error> {
    let before = simulation.to_bytes().unwrap();
    let outcome = simulation.advance_to(simulation.time() + duration);
    if let Err(error) = &outcome {
        assert!(matches!(error, Error::Step { .. }), "{error}");
        assert!(simulation.to_bytes().unwrap() == before, "a trace of: {error}");
    }
    outcome
}

fn walk(simulation: &mut AnySimulation, steps: u32, factor: f64) -> Result<(), Error> {
    for _ in 0..steps {
        set_target(simulation, factor);
        step(simulation, STEP)?;
    }
    Ok(())
}

/// Part of its energies that an engine may lose or find: hard disks are exact from impact to impact, soft ones of first or
/// fourth order in the time step, and the disk on two supports has its dissipation in closed form.
fn allowed_residual(names: &Names) -> f64 {
    match (names.scene, names.engine) {
        ("three_disk", _) => 1e-9,
        (_, "molecular-dynamics") => 1e-4,
        (_, "molecular-dynamics-located") => 1e-5,
        _ => 1e-9,
    }
}

/// What an answer must be.
fn check(simulation: &AnySimulation, names: &Names, what: &str) {
    for (row, value) in simulation.variables().iter().zip(simulation.all_values().unwrap()) {
        assert!(
            !matches!(value, Value::Real(real) if !real.is_finite()),
            "{what}: {} = {value:?}",
            row.name
        );
    }
    if let Ok(residual) = simulation.real("energy.residual") {
        let energies = ["energy.kinetic", "energy.potential", "energy.input", "energy.lost"];
        let scale: f64 = energies.iter().map(|name| simulation.real(name).unwrap().abs()).sum();
        assert!(
            residual.abs() <= allowed_residual(names) * scale,
            "{what}: {residual:e} beside {scale:e}"
        );
    }
    if let (Ok(y), Ok(radius)) = (simulation.real("disk.y[1]"), simulation.real("disk.radius[1]"))
        && let Ok(base) = simulation.real("base.position")
    {
        assert!(y > base + 0.4 * radius, "{what}: the disk at {y}, the base at {base}");
    }
    if names.scene == "three_disk" {
        check_supports(simulation, what);
    }
}

/// The supports push, rub no more than Coulomb allows, and are not passed through.
fn check_supports(simulation: &AnySimulation, what: &str) {
    let radius = simulation.real("disk.radius").unwrap();
    let friction = simulation.real("contact.friction").unwrap();
    for contact in 1..=2 {
        let real = |name: &str| simulation.real(&format!("contact[{contact}].{name}")).unwrap();
        let (overlap, normal, tangential) = (real("overlap"), real("normal_force"), real("tangential_force"));
        assert!(overlap < 0.5 * radius, "{what}: an overlap of {overlap} m");
        assert!(
            normal >= 0.0 && tangential.abs() <= friction * normal * (1.0 + 1e-9),
            "{what}: {normal} N and {tangential} N"
        );
    }
}

/// One hostile step, or more of a hostile motion, after 0.1 s of a usual one.
fn answer(names: &Names, case: &str) -> &'static str {
    let what = format!("{} {} {}, {case}", names.scene, names.engine, names.drive);
    let times_1000 = names.drive != "input" && case == "amplitude times 1000";
    let mut simulation = match simulation(names, if times_1000 { 1000.0 } else { 1.0 }) {
        Ok(simulation) => simulation,
        Err(error) => {
            assert!(error.to_string().contains(".amplitude"), "{what}: {error}");
            return "refused at the start";
        }
    };
    if !times_1000 {
        walk(&mut simulation, 100, 1.0).unwrap_or_else(|error| panic!("{what}: {error}"));
    }
    set_target(&mut simulation, 1.0);
    let (sane, time) = (simulation.to_bytes().unwrap(), simulation.time());
    let outcome = match case {
        "jump of the base" => {
            let on_base = simulation.set("base.displacement", 0.05).is_ok();
            assert!(on_base || simulation.set("torque", 1000.0 * TORQUE).is_ok(), "{what}");
            step(&mut simulation, STEP)
        }
        "not a number" => {
            for name in ["base.velocity", "torque"] {
                assert!(simulation.set(name, f64::NAN).is_err(), "{what}");
            }
            assert_eq!(simulation.to_bytes().unwrap(), sane, "{what}");
            walk(&mut simulation, 10, 1.0).unwrap();
            check(&simulation, names, &what);
            return "input refused";
        }
        "amplitude times 1000" => walk(&mut simulation, 100, 1000.0),
        _ => step(&mut simulation, 1000.0 * STEP),
    };
    if outcome.is_ok() {
        check(&simulation, names, &what);
        return "answered";
    }
    // The caller may retry with a sane motion, if it may change the motion at all.
    if simulation.time() == time && !times_1000 {
        walk(&mut simulation, 1, 1.0).unwrap_or_else(|error| panic!("{what}, retried: {error}"));
    }
    "step refused"
}

/// What asks for too much is refused at the same place on every machine, and shorter steps do it.
#[test]
fn the_work_of_a_step_is_bounded() {
    for names in names() {
        let mut limited = simulation(&names, 1.0).unwrap();
        let mut free = simulation(&names, 1.0).unwrap();
        limited.limit_work(20);
        let before = limited.to_bytes().unwrap();
        let refusal = limited.advance_to(1.0).unwrap_err().to_string();
        assert!(
            refusal.contains("more than one call may do. Take shorter communication steps."),
            "{names:?}: {refusal}"
        );
        assert!(
            limited.to_bytes().unwrap() == before,
            "{names:?}: the refusal left a trace"
        );
        limited.limit_work(1_000_000);
        limited.advance_to(0.02).unwrap();
        free.advance_to(0.02).unwrap();
        assert!(limited.to_bytes().unwrap() == free.to_bytes().unwrap(), "{names:?}");
    }
}

#[test]
fn every_case_is_answered_as_documented() {
    let mut rows = Vec::new();
    for names in names() {
        let mut cells = vec![format!("{}, {}, {}", names.scene, names.engine, names.drive)];
        for case in CASES {
            let has_case = names.drive == "input" || case.contains("times");
            cells.push(if has_case {
                answer(&names, case).into()
            } else {
                "-".into()
            });
        }
        rows.push(format!("| {} |", cells.join(" | ")));
    }
    let missing: Vec<_> = rows.iter().filter(|row| !TABLE.contains(row.as_str())).collect();
    assert!(
        missing.is_empty(),
        "docs/abuse.md says otherwise; found:\n{}",
        rows.join("\n")
    );
}
