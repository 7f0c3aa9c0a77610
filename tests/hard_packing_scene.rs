//! The event-driven packing scene: balances, bits, rollback in both models of the bottom, refusals.
#![allow(clippy::unwrap_used)]

mod support;

use std::f64::consts::{PI, TAU};

use jostle::contact::LinearDashpot;
use jostle::drive::Sine;
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::{Model, Simulation};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use support::simulation_of;

const MODELS: [(&str, i64); 2] = [("random phase", 1), ("moving", 2)];

fn shaken(gamma: f64, model: i64) -> Simulation<HardPackingOnSine> {
    let amplitude = ("drive.amplitude", Sine::amplitude_of(gamma, 80.0, 9.8));
    simulation_of(60, &[amplitude, ("base.model", model as f64)])
}

/// Work of the base less losses is the change of energy to rounding, and the reported forces add up to the weight.
#[test]
fn energy_and_momentum_balance_to_rounding() {
    for (name, model) in MODELS {
        let mut packing = shaken(6.0, model);
        let (steps, step) = (4000, 1e-3);
        let mut impulse = 0.0;
        for i in 1..=steps {
            packing.advance_to(f64::from(i) * step).unwrap();
            impulse += packing.real("base.reaction_force").unwrap() * step;
        }
        let [input, residual] = ["energy.input", "energy.residual"].map(|name| packing.real(name).unwrap());
        println!(
            "{name}: energy residual {:.1e} of the work of the base",
            residual / input
        );
        assert!(input > 0.1 && residual.abs() < 1e-11 * input);
        // Walls push sideways and rub; the base carries the rest of the weight, within what friction at walls may carry.
        let weight = 9.8 * 3.57 * PI * 20.0 * (0.015_f64.powi(2) + 0.02_f64.powi(2) + 0.025_f64.powi(2));
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
        let states = [vec![0.5], vec![0.25, 0.5], vec![1e-9, 0.1, 0.100_000_1, 0.3, 0.5]].map(|ends| {
            let mut packing = shaken(5.0, model);
            ends.iter().for_each(|end| packing.advance_to(*end).unwrap());
            let angles: Vec<f64> = (1..=60)
                .map(|disk| packing.real(&format!("disk.angle[{disk}]")).unwrap())
                .collect();
            (packing.model().unwrap().state().engine, angles)
        });
        assert!(states[0] == states[1] && states[0] == states[2]);
    }
}

/// A state saved in the middle brings back the same bits, in this and in another instance; another model's is refused.
#[test]
fn rollback_gives_the_same_bits() {
    for (_, model) in MODELS {
        let mut packing = shaken(5.0, model);
        packing.advance_to(0.3).unwrap();
        let saved = packing.save();
        packing.advance_to(0.7).unwrap();
        let ahead = (packing.save(), packing.all_values());
        let mut other = shaken(5.0, model);
        for again in [&mut packing, &mut other] {
            again.restore(&saved).unwrap();
            again.advance_to(0.7).unwrap();
            assert!((again.save(), again.all_values()) == ahead);
        }
        let foreign = shaken(5.0, 3 - model).model().unwrap().state();
        let mut same = HardPackingOnSine::new(packing.structure(), 0.0, packing.values()).unwrap();
        assert!(same.restore(&foreign).is_err());
    }
}

/// A base that follows sampled inputs does what the sine does that they sample, up to the error of the extrapolation.
#[test]
fn sampled_inputs_follow_the_sine() {
    let mut on_sine = shaken(4.0, 2);
    let omega = TAU * 80.0;
    let amplitude = Sine::amplitude_of(4.0, 80.0, 9.8);
    let mut on_input =
        simulation_of::<HardPackingOnInput>(60, &[("base.velocity", amplitude * omega), ("initial.settled", 0.0)]);
    let step = 1.0 / (80.0 * 200.0);
    for i in 0..480 {
        let (start, end) = (f64::from(i) * step, f64::from(i + 1) * step);
        on_input
            .set("base.displacement", amplitude * (omega * start).sin())
            .unwrap();
        on_input
            .set("base.velocity", amplitude * omega * (omega * start).cos())
            .unwrap();
        on_input.advance_to(end).unwrap();
        on_sine.advance_to(end).unwrap();
    }
    let both = |name: &str| [on_sine.real(name).unwrap(), on_input.real(name).unwrap()];
    let [a, b] = both("base.position");
    assert!((a - b).abs() < 1e-9 * amplitude.max(1.0));
    for disk in 1..=60 {
        let name = format!("disk.y[{disk}]");
        let [a, b] = both(&name);
        assert!((a - b).abs() < 2e-3, "{name}");
    }
    let [work, same] = both("energy.input");
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
    let mut packing = simulation_of::<HardPackingOnSine>(60, &changes);
    let mut time = 0.0;
    let refusal = loop {
        let before = packing.save();
        time += 0.01;
        if let Err(refusal) = packing.advance_to(time) {
            assert!(packing.save() == before);
            break refusal.to_string();
        }
        assert!(time < 5.0, "no collapse");
    };
    assert!(
        refusal.contains("no headway") && refusal.contains("collision.contact_time"),
        "{refusal}"
    );
}

/// One disk that bounces on the floor alone, on a base of random phase, and what restitution its contact has.
fn bouncing(restitution: f64, changes: &[(&str, f64)]) -> Simulation<HardPackingOnSine> {
    let mass = 3.57 * PI * 0.015_f64.powi(2);
    let damping = LinearDashpot::damping_ratio_for(restitution) * 2.0 * (1e4 * mass).sqrt();
    let alone = [
        ("base.model", 1.0),
        ("contact.normal_damping", damping),
        ("collision.contact_time", 0.0),
        ("drive.amplitude", Sine::amplitude_of(4.0, 80.0, 9.8)),
        ("drive.frequency", 80.0),
    ];
    simulation_of(1, &[&alone, changes].concat())
}

/// The same bounces with lines thrown at random instants, each followed down to where it first meets the sine.
fn share_of_lines_rejected(restitution: f64, impacts: u32) -> f64 {
    let mut random = Pcg64::seed_from_u64(3);
    let (mut speed, mut draws) = (1.0, 0_u32);
    for _ in 0..impacts {
        loop {
            draws += 1;
            let mut phase = TAU * (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            let mut height = 1.0;
            while height > phase.sin() {
                let step = 1e-3 / f64::max(speed, 1.0);
                (phase, height) = (phase + step, height - speed * step);
            }
            let after = restitution * speed + (1.0 + restitution) * phase.cos();
            if after > 0.0 {
                speed = after;
                break;
            }
        }
    }
    1.0 - f64::from(impacts) / f64::from(draws)
}

/// Each impact keeps one draw; how many are rejected is what the process has by a plain simulation of it. A base that moves
/// draws nothing.
#[test]
fn rejected_draws_are_those_of_lines_thrown_at_random() {
    for restitution in [0.2, 0.5] {
        let mut disk = bouncing(restitution, &[]);
        disk.advance_to(1000.0).unwrap();
        let [draws, rejected, impacts] =
            ["base.draws", "base.rejected_draws", "collisions"].map(|name| disk.real(name).unwrap());
        let expected = share_of_lines_rejected(restitution, 40_000);
        println!("e_n {restitution}: {rejected} of {draws} draws rejected, share {expected:.4} by lines");
        assert!(draws - rejected == impacts && impacts > 30_000.0);
        let scatter = (expected / draws + expected / 40_000.0).sqrt();
        assert!((rejected / draws - expected).abs() < 4.0 * scatter);
    }
    let mut moving = shaken(4.0, 2);
    moving.advance_to(0.1).unwrap();
    assert_eq!(moving.real("base.draws").unwrap(), 0.0);
}

/// On a sawtooth each impact turns |v| into `e_n |v| + (1 + e_n) A omega`: the parabolas that follow each other are known.
#[test]
fn a_disk_on_a_sawtooth_bounces_as_the_closed_form_says() {
    let (restitution, gravity) = (0.6, 9.8);
    let lift = (1.0 + restitution) * Sine::amplitude_of(4.0, 80.0, gravity) * TAU * 80.0;
    let mut disk = bouncing(restitution, &[("base.profile", 2.0), ("initial.settled", 0.0)]);
    // It starts a little above the floor, and meets it first when it has fallen that far.
    let gap = disk.real("disk.y[1]").unwrap() - 0.015;
    let fall = (2.0 * gap / gravity).sqrt();
    let (mut speed, mut time) = (restitution * gravity * fall + lift, fall);
    for impacts in 1..40 {
        let flight = 2.0 * speed / gravity;
        for part in [0.25, 0.9] {
            let since = part * flight;
            disk.advance_to(time + since).unwrap();
            let height = 0.015 + since * (speed - 0.5 * gravity * since);
            let off = disk.real("disk.y[1]").unwrap() - height;
            assert!(off.abs() < 1e-10, "impact {impacts}: {off:e} m off");
            assert_eq!(disk.real("collisions").unwrap(), f64::from(impacts));
        }
        (speed, time) = (restitution * speed + lift, time + flight);
    }
    // The energy balance counts what this base gives.
    let [input, residual] = ["energy.input", "energy.residual"].map(|name| disk.real(name).unwrap());
    assert!(residual.abs() < 1e-11 * input);
    assert_eq!(disk.real("base.draws").unwrap(), 0.0);
    let given = [("base.profile", 2_i64.into())];
    let refusal = Simulation::<HardPackingOnSine>::new(&[("disks", 1)], &given)
        .unwrap_err()
        .to_string();
    assert!(
        refusal.starts_with("base.profile = sawtooth") && refusal.contains("base.model"),
        "{refusal}"
    );
}
