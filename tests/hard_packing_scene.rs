//! The event-driven packing scene: balances, bits, rollback in both models of the bottom, refusals.
#![allow(clippy::unwrap_used)]

mod support;

use jostle::drive::Sine;
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::{Choice, Scene, Value, Values};
use support::{outputs_of, values_of};

const SIXTY: Choice = Choice { disks: 60 };
const MODELS: [(&str, i64); 2] = [("random phase", 1), ("moving", 2)];

fn values(gamma: f64, model: i64) -> Values {
    let amplitude = ("drive.amplitude", Sine::amplitude_of(gamma, 80.0, 9.8));
    let mut values = values_of::<HardPackingOnSine>(SIXTY, &[amplitude]);
    values.set_by_name("base.model", Value::Integer(model)).unwrap();
    values
}

/// Work of the base less losses is the change of energy to rounding, and the reported forces add up to the weight.
#[test]
fn energy_and_momentum_balance_to_rounding() {
    for (name, model) in MODELS {
        let values = values(6.0, model);
        let mut packing = HardPackingOnSine::new(SIXTY, 0.0, &values).unwrap();
        let (steps, step) = (4000, 1e-3);
        let mut impulse = 0.0;
        for i in 1..=steps {
            packing.advance_to(f64::from(i) * step, &values).unwrap();
            impulse += outputs_of(&packing, &values).real("base.reaction_force") * step;
        }
        let outputs = outputs_of(&packing, &values);
        let (input, residual) = (outputs.real("energy.input"), outputs.real("energy.residual"));
        println!(
            "{name}: energy residual {:.1e} of the work of the base",
            residual / input
        );
        assert!(input > 0.1 && residual.abs() < 1e-11 * input);
        // Walls push sideways and rub; the base carries the rest of the weight, within what friction at walls may carry.
        let weight =
            9.8 * 3.57 * std::f64::consts::PI * 20.0 * (0.015_f64.powi(2) + 0.02_f64.powi(2) + 0.025_f64.powi(2));
        let mean = impulse / 4.0;
        assert!(
            (mean + weight).abs() < 0.1 * weight,
            "{name}: {mean} N on the base, weight {weight} N"
        );
    }
}

/// One step of 2h is two of h and odd pieces, to the bit, in both models.
#[test]
fn split_steps_give_the_same_bits() {
    for (_, model) in MODELS {
        let values = values(5.0, model);
        let states = [vec![0.5], vec![0.25, 0.5], vec![1e-9, 0.1, 0.100_000_1, 0.3, 0.5]].map(|ends| {
            let mut packing = HardPackingOnSine::new(SIXTY, 0.0, &values).unwrap();
            ends.iter().for_each(|end| packing.advance_to(*end, &values).unwrap());
            let outputs = outputs_of(&packing, &values);
            let angles: Vec<f64> = (1..=60)
                .map(|disk| outputs.real(&format!("disk.angle[{disk}]")))
                .collect();
            (packing.state().engine, angles)
        });
        assert!(states[0] == states[1] && states[0] == states[2]);
    }
}

/// A state saved in the middle brings back the same bits, in this and in another instance; another model's is refused.
#[test]
fn rollback_gives_the_same_bits() {
    for (_, model) in MODELS {
        let values = values(5.0, model);
        let mut packing = HardPackingOnSine::new(SIXTY, 0.0, &values).unwrap();
        packing.advance_to(0.3, &values).unwrap();
        let saved = packing.state();
        packing.advance_to(0.7, &values).unwrap();
        let ahead = (packing.state(), outputs_of(&packing, &values));
        let mut other = HardPackingOnSine::new(SIXTY, 0.0, &values).unwrap();
        for again in [&mut packing, &mut other] {
            again.restore(&saved).unwrap();
            again.advance_to(0.7, &values).unwrap();
            assert!((again.state(), outputs_of(again, &values)) == ahead);
        }
        let foreign = HardPackingOnSine::new(SIXTY, 0.0, &self::values(5.0, 3 - model))
            .unwrap()
            .state();
        assert!(packing.restore(&foreign).is_err());
    }
}

/// A base that follows sampled inputs does what the sine does that they sample, up to the error of the cubic.
#[test]
fn sampled_inputs_follow_the_sine() {
    let reference = values(4.0, 2);
    let mut on_sine = HardPackingOnSine::new(SIXTY, 0.0, &reference).unwrap();
    let omega = std::f64::consts::TAU * 80.0;
    let amplitude = Sine::amplitude_of(4.0, 80.0, 9.8);
    let mut inputs = values_of::<HardPackingOnInput>(SIXTY, &[("base.velocity", amplitude * omega)]);
    let mut on_input = HardPackingOnInput::new(SIXTY, 0.0, &inputs).unwrap();
    let step = 1.0 / (80.0 * 200.0);
    for i in 0..480 {
        // The inputs that land the base where the sine will be.
        let end = f64::from(i + 1) * step;
        let velocity = amplitude * omega * (omega * end).cos();
        let displacement = amplitude * (omega * end).sin() - step * velocity;
        inputs
            .set_by_name("base.displacement", Value::Real(displacement))
            .unwrap();
        inputs.set_by_name("base.velocity", Value::Real(velocity)).unwrap();
        on_input.advance_to(end, &inputs).unwrap();
        on_sine.advance_to(end, &reference).unwrap();
    }
    let (a, b) = (outputs_of(&on_sine, &reference), outputs_of(&on_input, &inputs));
    assert!((a.real("base.position") - b.real("base.position")).abs() < 1e-9 * amplitude.max(1.0));
    for disk in 1..=60 {
        let name = format!("disk.y[{disk}]");
        assert!((a.real(&name) - b.real(&name)).abs() < 2e-3, "{name}");
    }
    let (work, same) = (a.real("energy.input"), b.real("energy.input"));
    assert!((work - same).abs() < 0.2 * work, "{work} J and {same} J");
}

/// A packing that collapses is refused with place and remedy, and the state is the one before.
#[test]
fn collapse_is_refused_and_keeps_the_state() {
    let changes = [
        ("contact.normal_damping", 8.0),
        ("collision.contact_time", 0.0),
        ("drive.amplitude", 0.0),
    ];
    let values = values_of::<HardPackingOnSine>(SIXTY, &changes);
    let mut packing = HardPackingOnSine::new(SIXTY, 0.0, &values).unwrap();
    let mut time = 0.0;
    let refusal = loop {
        let before = packing.state();
        time += 0.01;
        if let Err(refusal) = packing.advance_to(time, &values) {
            assert!(packing.state() == before);
            break refusal.to_string();
        }
        assert!(time < 5.0, "no collapse");
    };
    assert!(
        refusal.contains("no headway") && refusal.contains("collision.contact_time"),
        "{refusal}"
    );
}
