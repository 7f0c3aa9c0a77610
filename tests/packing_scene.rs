//! The packing scene: conservation laws, symmetry, and bits that must not depend on how it is stepped.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::Error;
use jostle::contact::LinearDashpot;
use jostle::drive::{FollowsInput, Sine};
use jostle::engine::dem::event_located::EventStepper;
use jostle::engine::dem::verlet::{Gear5, PredictorCorrector, VelocityVerlet};
use jostle::engine::threads::ThreadPool;
use jostle::packing::{RadiusDistribution, advancing_front, mirrored};
use jostle::scene::base_drive::BaseDrive;
use jostle::scene::packing::soft::SoftMethod;
use jostle::scene::packing::{PackingOnInput, PackingOnSine, SoftPacking};
use jostle::scene::{Model, Simulation, Value};
use support::{order, simulation_of};

type Verlet = PredictorCorrector<VelocityVerlet, LinearDashpot, ThreadPool>;
type Gear = PredictorCorrector<Gear5, LinearDashpot, ThreadPool>;

/// Amplitude of the base for Gamma at 80 Hz.
fn at_gamma(gamma: f64) -> (&'static str, f64) {
    ("drive.amplitude", Sine::amplitude_of(gamma, 80.0, 9.8))
}

/// Change of momentum = gravity + impulses of the walls, and the reaction forces reported add up to the base's impulse.
fn momentum_balance<M: SoftMethod, D: BaseDrive>(name: &str) {
    let mut packing = simulation_of::<SoftPacking<M, D>>(60, &[at_gamma(8.0)]);
    let mass: f64 = packing.model().unwrap().engine().setup().masses.iter().sum();
    let (step, count) = (3.3e-4, 3000);
    let mut reported = 0.0;
    for i in 1..=count {
        packing.advance_to(f64::from(i) * step).unwrap();
        reported += packing.real("base.reaction_force").unwrap() * step;
    }
    let engine = packing.model().unwrap().engine();
    let momentum = |axis: usize| -> f64 {
        let parts = engine.observables().velocities.iter().zip(&engine.setup().masses);
        parts.map(|(rate, mass)| mass * rate[axis]).sum()
    };
    let (px, py) = (momentum(0), momentum(1));
    let walls: Vec<[f64; 2]> = (0..3).map(|wall| engine.impulse_of_wall(wall)).collect();
    let pushed = mass * 9.8 * f64::from(count) * step;
    let sideways: f64 = walls.iter().map(|impulse| impulse[0]).sum();
    let upwards: f64 = walls.iter().map(|impulse| impulse[1]).sum();
    let residual = (px - sideways).hypot(py - upwards + pushed) / pushed;
    println!("{name}: momentum residual {residual:.1e} of the impulse of gravity");
    assert!(residual < 1e-12, "{residual:e}");
    assert!((reported + walls[0][1]).abs() < 1e-12 * pushed);
}

#[test]
fn momentum_balances_to_rounding() {
    momentum_balance::<Verlet, Sine>("velocity Verlet");
    momentum_balance::<Gear, Sine>("Gear 5");
    momentum_balance::<EventStepper, Sine>("located events");
}

/// Residual of the energy balance of a shaken packing, root mean square over seeds, over the energy put in and out.
fn energy_residual<M: SoftMethod, D: BaseDrive>(time_step: f64) -> f64 {
    let residuals = (1..=6).map(|seed| {
        let changes = [at_gamma(4.0), ("time_step", time_step), ("seed", f64::from(seed))];
        let mut packing = simulation_of::<SoftPacking<M, D>>(60, &changes);
        packing.advance_to(0.15).unwrap();
        packing.real("energy.residual").unwrap() / packing.real("energy.lost").unwrap()
    });
    (residuals.map(|residual| residual * residual).sum::<f64>() / 6.0).sqrt()
}

/// Work of the base less losses is the change of energy; what is left over shrinks with the step at the order that
/// impacts allow, which is the first (see the table of `tests/verlet.rs`).
#[test]
fn energy_balances_with_the_step() {
    for (name, residual) in [
        ("velocity Verlet", energy_residual::<Verlet, Sine> as fn(f64) -> f64),
        ("Gear 5", energy_residual::<Gear, Sine>),
    ] {
        let residuals = [1.6e-5, 4e-6, 1e-6].map(residual);
        let order = order(residuals[0], residuals[2], 16.0);
        println!("{name}: energy residual over losses at 16, 4, 1 us {residuals:?}, order {order:.2}");
        assert!(order > 0.8 && residuals[2] < 2e-3, "{name}: {residuals:?}");
    }
}

/// With located events the balance closes at the order of the method.
#[test]
fn energy_balances_better_with_located_events() {
    let residuals = [8e-5, 4e-5, 2e-5, 1e-5].map(energy_residual::<EventStepper, Sine>);
    let order = order(residuals[0], residuals[3], 8.0);
    println!("located events: energy residual over losses at 80, 40, 20, 10 us {residuals:?}, order {order:.2}");
    assert!(order > 2.5 && residuals[3] < 1e-6, "{residuals:?}");
}

/// A packing and its mirror image turn oppositely, to the last bit, since the box is centred and sums run alike.
#[test]
fn mirrored_packings_turn_oppositely() {
    turn_oppositely::<Verlet, Sine>();
    turn_oppositely::<EventStepper, Sine>();
}

fn turn_oppositely<M: SoftMethod, D: BaseDrive>() {
    let simulation = simulation_of::<SoftPacking<M, D>>(60, &[at_gamma(4.0)]);
    let values = simulation.values();
    let radii = RadiusDistribution::default().sample(60, 5).unwrap();
    let disks = advancing_front(&radii, 0.4).unwrap();
    let mut packing = SoftPacking::<M, D>::of_disks(&disks, 0.0, values).unwrap();
    let mut image = SoftPacking::<M, D>::of_disks(&mirrored(&disks), 0.0, values).unwrap();
    for i in 1..=20 {
        packing.advance_to(f64::from(i) * 0.05, values).unwrap();
        image.advance_to(f64::from(i) * 0.05, values).unwrap();
        let places = packing.engine().observables().positions.iter();
        for (place, mirror) in places.zip(image.engine().observables().positions) {
            assert_eq!([place[0], place[1], place[2]], [-mirror[0], mirror[1], -mirror[2]]);
        }
    }
    let places = packing.engine().observables().positions.iter();
    let turned = places.map(|place| place[2].abs()).fold(0.0, f64::max);
    assert!(turned > 0.01, "nothing turned: {turned}");
}

/// At rest on a base at rest the base carries the weight.
#[test]
fn base_carries_the_weight() {
    let changes = [("contact.friction", 0.0), ("contact.normal_damping", 2.0)];
    let mut packing = simulation_of::<PackingOnInput>(60, &changes);
    packing.advance_to(20.0).unwrap();
    packing.advance_to(20.5).unwrap();
    let weight = 9.8 * packing.model().unwrap().engine().setup().masses.iter().sum::<f64>();
    let kinetic = packing.real("energy.kinetic").unwrap();
    assert!(kinetic < 1e-9, "{kinetic}");
    let force = packing.real("base.reaction_force").unwrap();
    assert!(
        (force + weight).abs() < 1e-3 * weight,
        "{force} N on the base, weight {weight} N"
    );
}

/// One step of 2h is two of h, to the bit, however h and the time step relate, and so is a step cut in odd pieces.
#[test]
fn split_steps_give_the_same_bits() {
    split_as_one::<Verlet, Sine>();
    split_as_one::<EventStepper, Sine>();
}

fn split_as_one<M: SoftMethod, D: BaseDrive>() {
    let ends = [
        vec![0.1],
        vec![0.05, 0.1],
        vec![1e-7, 0.012_345_6, 0.07, 0.070_000_1, 0.099_999_999, 0.1],
    ];
    let states = ends.map(|ends| {
        let mut packing = simulation_of::<SoftPacking<M, D>>(60, &[at_gamma(6.0)]);
        for end in ends {
            packing.advance_to(end).unwrap();
        }
        let packing = packing.model().unwrap();
        let now = packing.engine().observables();
        (
            packing.state().engine,
            now.positions.to_vec(),
            now.velocities.to_vec(),
            now.energy_lost,
        )
    });
    assert!(states[0] == states[1] && states[0] == states[2]);
}

/// The base follows sampled inputs; a state taken between two grid points, in the middle of the run, brings back the
/// same bits, also in another instance.
#[test]
fn rollback_gives_the_same_bits() {
    roll_back::<Verlet, FollowsInput>();
    roll_back::<EventStepper, FollowsInput>();
}

fn roll_back<M: SoftMethod, D: BaseDrive>() {
    let shake = |packing: &mut Simulation<SoftPacking<M, D>>, from: u32, to: u32| {
        let step = 1.0 / (80.0 * 24.0);
        for i in from..to {
            let phase = std::f64::consts::TAU * f64::from(i) / 24.0;
            let amplitude = Sine::amplitude_of(6.0, 80.0, 9.8);
            packing.set("base.displacement", amplitude * phase.sin()).unwrap();
            packing
                .set("base.velocity", amplitude * 502.654_824_6 * phase.cos())
                .unwrap();
            packing.advance_to(f64::from(i + 1) * step).unwrap();
        }
    };
    let mut packing = simulation_of::<SoftPacking<M, D>>(60, &[]);
    shake(&mut packing, 0, 500);
    let (saved, observed) = (packing.save(), packing.all_values());
    shake(&mut packing, 500, 900);
    let ahead = (packing.save(), packing.all_values());

    let mut other = simulation_of::<SoftPacking<M, D>>(60, &[]);
    for again in [&mut packing, &mut other] {
        again.restore(&saved).unwrap();
        assert_eq!(again.all_values(), observed);
        shake(again, 500, 900);
        assert!((again.save(), again.all_values()) == ahead);
    }
}

/// Ten threads with one packing each give what one alone gives.
#[test]
fn threads_give_the_same_bits() {
    let run = || {
        let mut packing = simulation_of::<PackingOnSine>(60, &[at_gamma(4.0)]);
        packing.advance_to(0.2).unwrap();
        packing.save()
    };
    let alone = run();
    let threads: Vec<_> = (0..10).map(|_| std::thread::spawn(run)).collect();
    for thread in threads {
        assert_eq!(thread.join().unwrap(), alone);
    }
}

/// A base that jumps by a metre is refused; the state stays, and the same step with tame inputs is then done.
#[test]
fn a_refused_step_keeps_the_state() {
    refuse_a_step::<Verlet, FollowsInput>();
    refuse_a_step::<EventStepper, FollowsInput>();
}

fn refuse_a_step<M: SoftMethod, D: BaseDrive>() {
    let mut packing = simulation_of::<SoftPacking<M, D>>(60, &[]);
    packing.advance_to(0.01).unwrap();
    let before = (packing.model().unwrap().state(), outputs(&packing));
    packing.set("base.displacement", 1.0).unwrap();
    let refusal = packing.advance_to(0.011).unwrap_err();
    assert!(matches!(refusal, Error::Step { model: "packing", .. }), "{refusal}");
    assert!((packing.model().unwrap().state(), outputs(&packing)) == before);
    packing.set("base.displacement", 0.0).unwrap();
    packing.advance_to(0.011).unwrap();
}

/// All that the packing computes.
fn outputs<M: SoftMethod, D: BaseDrive>(packing: &Simulation<SoftPacking<M, D>>) -> Vec<Value> {
    let inputs = packing.values().as_slice().len();
    packing.all_values().unwrap().split_off(inputs)
}

#[test]
fn parameters_that_cannot_work_are_refused_by_name() {
    let refused = |changes: &[(&str, f64)]| {
        let given: Vec<(&str, Value)> = changes.iter().map(|(name, value)| (*name, (*value).into())).collect();
        Simulation::<PackingOnSine>::new(&[("disks", 60)], &given)
            .err()
            .map(|error| error.to_string())
            .unwrap_or_default()
    };
    let message = refused(&[("time_step", 1e-3)]);
    assert!(
        message.contains("time_step = 1e-3 s") && message.contains("at most"),
        "{message}"
    );
    assert!(refused(&[("box.width", 0.04)]).contains("disk.radius_large"));
    // The largest step that the message names is accepted.
    let packing = simulation_of::<PackingOnSine>(60, &[]);
    let largest = packing.real("largest_time_step").unwrap();
    assert_eq!(refused(&[("time_step", largest)]), "");
}

/// The packing starts on the base wherever the base starts, and a lifted base lifts it.
#[test]
fn packing_starts_on_the_base() {
    let packing = simulation_of::<PackingOnInput>(60, &[("base.displacement", 0.25), ("initial.settled", 0.0)]);
    let engine = packing.model().unwrap().engine();
    let lowest = engine
        .observables()
        .positions
        .iter()
        .zip(engine.radii())
        .map(|(place, radius)| place[1] - radius)
        .fold(f64::INFINITY, f64::min);
    assert!((lowest - 0.25).abs() < 1e-12);
}

/// Small disks a thousand times smaller than the others: deep in a run the located engine met a contact that changed at the very
/// end of a step, and divided by the time that was left. Both engines now refuse the same overlap, at the same time.
#[test]
fn both_soft_engines_refuse_the_same_overlap_at_radius_ratio_1000() {
    let radii = [
        ("disk.radius_small", 2e-5),
        ("disk.radius_medium", 0.02),
        ("disk.radius_large", 0.02),
    ];
    fn refusal<M: SoftMethod>(radii: &[(&str, f64)]) -> (f64, String) {
        let mut packing = simulation_of::<SoftPacking<M, Sine>>(60, radii);
        let sample = 1e-6;
        for count in 1..400 {
            let time = f64::from(count) * sample;
            if let Err(error) = packing.advance_to(time) {
                return (time, error.to_string());
            }
        }
        panic!("no overlap was refused");
    }
    let (located, verlet) = (refusal::<EventStepper>(&radii), refusal::<Verlet>(&radii));
    for (_, message) in [&located, &verlet] {
        assert!(message.contains("an overlap of 1.0000"), "{message}");
    }
    assert!((located.0 - verlet.0).abs() < 1.5e-6, "{located:?} {verlet:?}");
}
