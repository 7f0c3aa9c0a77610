//! A base on inputs: it moves as they mean, in every scene that has one, and grains that should rest on it do.
#![allow(clippy::unwrap_used)]

mod support;

use std::f64::consts::TAU;

use jostle::scene::packing::event_driven::HardPackingOnInput;
use jostle::scene::packing::{LocatedPackingOnInput, PackingOnInput, PackingOnSine};
use jostle::scene::ratchet::RatchetOnInput;
use jostle::scene::wedge::{WedgeEventDrivenOnInput, WedgeMolecularDynamicsOnInput};
use jostle::scene::{Model, Simulation, Warning};
use support::simulation_of;

/// Displacement, velocity and acceleration at a time.
type Motion = fn(f64) -> [f64; 3];

const FREQUENCY: f64 = 80.0;
/// Amplitude \[m\] at Gamma = 2.
const AMPLITUDE: f64 = 7.757e-5;

fn part(amplitude: f64, frequency: f64, time: f64) -> [f64; 3] {
    let omega = TAU * frequency;
    let (sine, cosine) = (omega * time).sin_cos();
    [
        amplitude * sine,
        amplitude * omega * cosine,
        -amplitude * omega * omega * sine,
    ]
}

fn sine(time: f64) -> [f64; 3] {
    part(AMPLITUDE, FREQUENCY, time)
}

fn three_sines(time: f64) -> [f64; 3] {
    let parts = [(0.5, 1.0), (0.3, 0.62), (0.4, 0.31)].map(|(size, of)| part(size * AMPLITUDE, of * FREQUENCY, time));
    std::array::from_fn(|index| parts.iter().map(|part| part[index]).sum())
}

/// From half the frequency to all of it within 0.1 s.
fn chirp(time: f64) -> [f64; 3] {
    let rate = 0.5 * FREQUENCY / 0.1;
    let phase = TAU * (0.5 * FREQUENCY + 0.5 * rate * time) * time;
    let (omega, bend) = (TAU * (0.5 * FREQUENCY + rate * time), TAU * rate);
    let (sine, cosine) = phase.sin_cos();
    [
        AMPLITUDE * sine,
        AMPLITUDE * omega * cosine,
        AMPLITUDE * (bend * cosine - omega * omega * sine),
    ]
}

fn give<M: Model>(simulation: &mut Simulation<M>, motion: [f64; 3], values: usize) {
    let names = ["base.displacement", "base.velocity", "base.acceleration_input"];
    for (name, value) in names.into_iter().zip(motion).take(values) {
        simulation.set(name, value).unwrap();
    }
}

/// Largest errors of position and acceleration at communication points after three periods, over their amplitudes.
fn errors<M: Model>(motion: Motion, values: usize, samples: u32) -> [f64; 2] {
    let step = 1.0 / (FREQUENCY * f64::from(samples));
    let mut simulation = simulation_of::<M>(1, &[]);
    let mut worst = [0.0_f64; 2];
    for number in 0..8 * samples {
        let end = f64::from(number + 1) * step;
        give(&mut simulation, motion(f64::from(number) * step), values);
        simulation.advance_to(end).unwrap();
        if number > 3 * samples {
            let [displacement, _, acceleration] = motion(end);
            let omega = TAU * FREQUENCY;
            let found = ["base.position", "base.acceleration"].map(|name| simulation.real(name).unwrap());
            worst[0] = worst[0].max((found[0] - displacement).abs() / AMPLITUDE);
            worst[1] = worst[1].max((found[1] - acceleration).abs() / (AMPLITUDE * omega * omega));
        }
    }
    worst
}

/// Errors of the polynomials of degree five, worked out by hand for a sine; sums of sines and chirps are no faster.
#[test]
fn the_base_moves_as_its_inputs_mean() {
    let table = [
        (8, [[1.9e-2, 0.39], [4.9e-3, 0.11]]),
        (16, [[3.1e-4, 2.6e-2], [8.0e-5, 7.2e-3]]),
        (25, [[2.2e-5, 4.4e-3], [5.5e-6, 1.2e-3]]),
        (100, [[5.3e-9, 1.7e-5], [1.4e-9, 4.8e-6]]),
    ];
    let motions: [(&str, Motion); 3] = [("sine", sine), ("three sines", three_sines), ("chirp", chirp)];
    for (name, motion) in motions {
        for (samples, allowed) in table {
            for (values, allowed) in (2..).zip(allowed) {
                let found = errors::<PackingOnInput>(motion, values, samples);
                println!(
                    "{name}, {samples} samples a period, {values} inputs: position {:.1e}, acceleration {:.1e}",
                    found[0], found[1]
                );
                for (found, allowed) in found.into_iter().zip(allowed) {
                    assert!(
                        found <= 1.1 * allowed,
                        "{name}, {samples}, {values}: {found:e} {allowed:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn all_scenes_have_the_same_base() {
    let expected = errors::<PackingOnInput>(sine, 2, 25);
    for found in [
        errors::<LocatedPackingOnInput>(sine, 2, 25),
        errors::<HardPackingOnInput>(sine, 2, 25),
        errors::<RatchetOnInput>(sine, 2, 25),
        errors::<WedgeEventDrivenOnInput>(sine, 2, 25),
        errors::<WedgeMolecularDynamicsOnInput>(sine, 2, 25),
    ] {
        assert!(found == expected, "{found:?} {expected:?}");
    }
}

/// Velocity and acceleration that the importer never sets are taken from the displacements.
#[test]
fn displacements_alone_move_the_base() {
    let [position, acceleration] = errors::<PackingOnInput>(sine, 1, 25);
    assert!(position < 1e-2 && acceleration < 0.2, "{position:e} {acceleration:e}");
}

#[test]
fn inputs_that_contradict_are_warned_of() {
    let warned = |factors: [f64; 3]| {
        let mut simulation = simulation_of::<PackingOnInput>(1, &[]);
        for number in 0..40 {
            let motion = sine(f64::from(number) * 1e-3);
            give(
                &mut simulation,
                std::array::from_fn(|index| factors[index] * motion[index]),
                3,
            );
            simulation.advance_to(f64::from(number + 1) * 1e-3).unwrap();
        }
        let of_the_base = |warning: &Warning| warning.topic.starts_with("base.");
        simulation
            .warnings(&[])
            .into_iter()
            .filter(of_the_base)
            .collect::<Vec<_>>()
    };
    assert!(warned([1.0, 1.0, 1.0]).is_empty());
    assert!(warned([1.0, 0.0, 0.0]).is_empty());
    let warnings = warned([1.0, -1.0, -1.0]);
    assert_eq!(warnings.len(), 1);
    let text = &warnings[0].text;
    assert!(
        text.starts_with("base.velocity is not the rate of base.displacement: at t = 3.9e-2 s it is "),
        "{text}"
    );
}

/// Kinetic energy \[J\] and largest move of a disk \[radii\] of a packing on a base at rest.
fn collapse<M: Model>(settled: f64) -> [f64; 2] {
    let mut packing = simulation_of::<M>(60, &[("initial.settled", settled)]);
    let places = |packing: &Simulation<M>| -> Vec<f64> {
        let names = (1..=60).flat_map(|disk| ["x", "y"].map(|axis| format!("disk.{axis}[{disk}]")));
        names.map(|name| packing.real(&name).unwrap()).collect()
    };
    let before = places(&packing);
    let mut most = 0.0_f64;
    for step in 1..=40 {
        packing.advance_to(f64::from(step) * 0.01).unwrap();
        most = most.max(packing.real("energy.kinetic").unwrap());
    }
    let moves = before
        .iter()
        .zip(places(&packing))
        .map(|(before, after)| (after - before).abs() / 0.02);
    [most, moves.fold(0.0, f64::max)]
}

/// Falling by a radius would give the packing 0.05 J.
#[test]
fn a_settled_packing_stays_where_it_is() {
    for [energy, moved] in [collapse::<PackingOnInput>(1.0), collapse::<LocatedPackingOnInput>(1.0)] {
        assert!(energy < 1e-10 && moved < 1e-4, "{energy:e} J, {moved:e} R");
    }
    let [energy, moved] = collapse::<PackingOnInput>(0.0);
    assert!(energy > 1e-5 && moved > 0.01, "{energy:e} J, {moved:e} R");
}

#[test]
fn the_force_now_carries_the_weight_at_rest() {
    fn check<M: Model>() {
        let mut packing = simulation_of::<M>(60, &[("contact.friction", 0.0)]);
        packing.advance_to(0.01).unwrap();
        let radii = (1..=60).map(|disk| packing.real(&format!("disk.radius[{disk}]")).unwrap());
        let weight: f64 = 9.8 * 3.57 * std::f64::consts::PI * radii.map(|radius| radius * radius).sum::<f64>();
        for name in ["base.reaction_force_now", "base.reaction_force"] {
            let force = packing.real(name).unwrap();
            assert!(
                (force + weight).abs() < 1e-3 * weight,
                "{name} = {force} N, weight {weight} N"
            );
        }
        let impulse = packing.real("base.impulse").unwrap();
        assert!((impulse + 0.01 * weight).abs() < 1e-3 * 0.01 * weight, "{impulse}");
    }
    check::<PackingOnInput>();
    check::<LocatedPackingOnInput>();
}

/// Share of communication points within a second at which nothing presses on the base of settled disks, at Gamma = 0.8.
fn open_share<M: Model>(on_inputs: bool) -> f64 {
    let size = 0.8 / 2.0;
    let step = 1.0 / (FREQUENCY * 25.0);
    let motion = |time: f64| sine(time).map(|value| size * value);
    let mut packing = simulation_of::<M>(
        20,
        &[
            ("initial.settled", 1.0),
            // At the usual stiffness the packing resonates near the frequency of the drive.
            ("contact.normal_stiffness", 1e6),
            ("contact.normal_damping", 2.0),
            match on_inputs {
                true => ("base.velocity", motion(0.0)[1]),
                false => ("drive.amplitude", size * AMPLITUDE),
            },
        ],
    );
    let count = (1.0 / step).round() as u32;
    let mut open = 0;
    for number in 0..count {
        if on_inputs {
            give(&mut packing, motion(f64::from(number) * step), 2);
        }
        packing.advance_to(f64::from(number + 1) * step).unwrap();
        let force = packing.real("base.reaction_force_now").unwrap();
        open += u32::from(force >= 0.0);
    }
    f64::from(open) / f64::from(count)
}

#[test]
fn grains_below_gravity_stay_on_the_base() {
    let open_on_sine = open_share::<PackingOnSine>(false);
    let open_on_inputs = open_share::<PackingOnInput>(true);
    assert!(
        open_on_sine == 0.0 && open_on_inputs < 1e-3,
        "{open_on_sine} {open_on_inputs}"
    );
}

/// Hard disks settle with gaps that are a few thousandths of their radii, below where the front put them.
#[test]
fn hard_disks_settle_without_overlaps() {
    let height = |settled: f64| {
        let packing = simulation_of::<HardPackingOnInput>(60, &[("initial.settled", settled)]);
        assert_eq!(packing.warnings(&[]), []);
        let [x, y, radius] = ["x", "y", "radius"].map(|what| -> Vec<f64> {
            let names = (1..=60).map(|disk| format!("disk.{what}[{disk}]"));
            names.map(|name| packing.real(&name).unwrap()).collect()
        });
        for i in 0..60 {
            assert!(y[i] > radius[i] && x[i].abs() < 0.2 - radius[i]);
            for j in 0..i {
                assert!((x[i] - x[j]).hypot(y[i] - y[j]) > radius[i] + radius[j], "{i} {j}");
            }
        }
        y.iter().sum::<f64>()
    };
    assert!(height(1.0) < height(0.0));
}

/// A state saved in the midst of a motion holds the history of the inputs: the bits are the same after it.
#[test]
fn the_history_of_the_inputs_is_part_of_the_state() {
    fn check<M: Model>(disks: u32) {
        let step = 1.0 / (FREQUENCY * 16.0);
        let run = |simulation: &mut Simulation<M>, numbers: std::ops::Range<u32>| {
            for number in numbers {
                give(simulation, sine(f64::from(number) * step), 2);
                simulation.advance_to(f64::from(number + 1) * step).unwrap();
            }
        };
        let mut simulation = simulation_of::<M>(disks, &[]);
        run(&mut simulation, 0..40);
        let saved = simulation.save();
        let mut other = simulation_of::<M>(disks, &[]);
        other.restore(&saved).unwrap();
        // A step elsewhere is forgotten.
        give(&mut simulation, [3e-5, 0.0, 0.0], 2);
        simulation.advance_to(40.3 * step).unwrap();
        simulation.restore(&saved).unwrap();
        for simulation in [&mut simulation, &mut other] {
            run(simulation, 40..80);
        }
        assert!(simulation.all_values().unwrap() == other.all_values().unwrap());
        assert!(simulation.save() == other.save());
    }
    check::<PackingOnInput>(3);
    check::<LocatedPackingOnInput>(3);
    check::<HardPackingOnInput>(3);
    check::<RatchetOnInput>(3);
    check::<WedgeEventDrivenOnInput>(1);
}

/// Two steps of half the length end where one ends, up to the error of the extrapolation.
#[test]
fn split_steps_agree_to_the_error_of_the_extrapolation() {
    let step = 1.0 / (FREQUENCY * 25.0);
    let mut whole = simulation_of::<PackingOnInput>(1, &[]);
    let mut split = simulation_of::<PackingOnInput>(1, &[]);
    for number in 0..200 {
        for part in 0..2 {
            let start = (f64::from(number) + 0.5 * f64::from(part)) * step;
            if part == 0 {
                give(&mut whole, sine(start), 2);
                whole.advance_to(f64::from(number + 1) * step).unwrap();
            }
            give(&mut split, sine(start), 2);
            split.advance_to(start + 0.5 * step).unwrap();
        }
        let [one, other] = [&whole, &split].map(|simulation| simulation.real("base.position").unwrap());
        assert!(
            number < 10 || (one - other).abs() < 5e-5 * AMPLITUDE,
            "step {number}: {one} {other}"
        );
    }
}

/// An importer that offers inputs inside of a step is asked for them at three places; the base then follows as in steps of a quarter,
/// and the force is the mean over the whole step.
#[test]
fn inputs_inside_of_a_step_are_taken() {
    use fmi_component::instance::{Access, Part};
    use fmi_component::{Importer, Instance, ModelType, Value, value_reference};

    let model = ModelType::of::<PackingOnInput>();
    let component = fmi_bundle::Component::new(&model, &[("disks", 3)]).unwrap();
    let table = component.table().clone();
    let reference = |name: &str| value_reference(table.position(name).unwrap());
    let names = ["base.displacement", "base.velocity"].map(reference);
    let token = component.token();
    let mut inside = Instance::new(&model, &token, Importer::default()).unwrap();
    let mut quarters = Instance::new(&model, &token, Importer::default()).unwrap();
    for instance in [&mut inside, &mut quarters] {
        instance.set_up(0.0, None).unwrap();
        instance.enter_initialization().unwrap();
        instance.exit_initialization().unwrap();
    }
    inside.offer_inputs(model.input_parts);
    let give = |instance: &mut Instance, time: f64| {
        let motion = sine(time);
        instance
            .set(&names, Access::Real, |index| Value::Real(motion[index]))
            .unwrap();
    };
    let step = 1.0 / 512.0;
    for number in 0..40 {
        let start = f64::from(number) * step;
        let mut mean = 0.0;
        for part in 0..4 {
            let time = start + 0.25 * f64::from(part) * step;
            give(&mut quarters, time);
            quarters.do_step(time, 0.25 * step).unwrap();
            let Value::Real(force) = quarters.get(reference("base.reaction_force"), Access::Real).unwrap() else {
                panic!("a real");
            };
            mean += 0.25 * force;
        }
        give(&mut inside, start);
        let mut part = inside.begin_step(start, step).unwrap();
        while let Part::Event(time) = part {
            give(&mut inside, time);
            part = inside.resume_step(None).unwrap();
        }
        for name in ["base.position", "base.acceleration", "disk.y[1]", "energy.input"] {
            let [one, other] = [&mut inside, &mut quarters].map(|of| of.get(reference(name), Access::Real).unwrap());
            assert!(one == other, "{name} after step {number}: {one:?} {other:?}");
        }
        let Value::Real(force) = inside.get(reference("base.reaction_force"), Access::Real).unwrap() else {
            panic!("a real");
        };
        assert!(
            (force - mean).abs() <= 1e-9 * mean.abs().max(1e-3),
            "step {number}: {force} {mean}"
        );
    }
}

/// Inputs that are no number are refused and those before hold: the base does not leave its motion by more than where a linear
/// prediction would lead from there.
#[test]
fn inputs_that_are_no_number_for_one_step_do_little_harm() {
    let samples = 25;
    let step = 1.0 / (FREQUENCY * f64::from(samples));
    // Errors after a step without new inputs of x + 2 h v, x and v being those of the step before, and of x if v is not given.
    let angle = 2.0 * TAU / f64::from(samples);
    for (values, linear) in (1..).zip([
        angle * AMPLITUDE,
        0.5 * angle * angle * AMPLITUDE,
        0.5 * angle * angle * AMPLITUDE,
    ]) {
        for bad in 60..60 + samples {
            let mut simulation = simulation_of::<PackingOnInput>(1, &[]);
            for number in 0..90 {
                if number == bad {
                    let refused = ["base.displacement", "base.velocity", "base.acceleration_input"];
                    for name in &refused[..values] {
                        assert!(simulation.set(name, f64::NAN).is_err());
                    }
                } else {
                    give(&mut simulation, sine(f64::from(number) * step), values);
                }
                simulation.advance_to(f64::from(number + 1) * step).unwrap();
                let error = simulation.real("base.position").unwrap() - sine(f64::from(number + 1) * step)[0];
                assert!(
                    number < 40 || error.abs() < linear,
                    "{values} inputs, step {number}, bad {bad}: {error:e}"
                );
            }
        }
    }
}

#[test]
fn contacts_too_soft_to_settle_are_told_in_words() {
    let mut simulation = Simulation::<PackingOnInput>::prepare(
        jostle::scene::StructuralParameters::choose(&PackingOnInput::info(), &[("disks", 60)]).unwrap(),
    );
    simulation.set("contact.normal_stiffness", 1.0).unwrap();
    let message = simulation.start(0.0).unwrap_err().to_string();
    assert!(
        message.contains("which settles with an overlap of ") && message.contains("Raise contact.normal_stiffness"),
        "{message}"
    );
}
