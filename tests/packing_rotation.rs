//! Rotation measured inside of the packing: against the angles among its outputs, and the same bits however one steps.
#![allow(clippy::unwrap_used)]

mod support;

use jostle::drive::Sine;
use jostle::measure::Rotation;
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::packing::{
    LocatedPackingOnInput, LocatedPackingOnSine, PackingOnInput, PackingOnSine, PackingState,
};
use jostle::scene::{Model, Simulation};
use support::simulation_of;

const DISKS: u32 = 20;
/// Longer than P's second would make the tests long; no multiple of a time step.
const INTERVAL: f64 = 0.05;
const OF_ALL: [&str; 6] = [
    "rotation.mean_square",
    "rotation.persistent_mean_square",
    "rotation.correlation",
    "rotation.adjusted_deviation",
    "rotation.share_rotating",
    "rotation.fastest",
];
const OF_EACH: [&str; 3] = [
    "disk.mean_angular_velocity",
    "disk.rotation_correlation",
    "disk.adjusted_deviation",
];

/// A packing shaken at six times gravity, with its rotation measured in short intervals.
fn shaken<M: Model>(given: &[(&str, f64)]) -> Simulation<M> {
    let usual = [
        ("drive.amplitude", Sine::amplitude_of(6.0, 80.0, 9.8)),
        ("measure.interval", INTERVAL),
    ];
    simulation_of(DISKS, &[&usual[..], given].concat())
}

fn of_each<M: Model>(packing: &Simulation<M>, name: &str) -> Vec<f64> {
    let disk = |disk| packing.real(&format!("{name}[{disk}]")).unwrap();
    (1..=DISKS).map(disk).collect()
}

/// All that is computed from the samples.
fn measured<M: Model>(packing: &Simulation<M>) -> Vec<f64> {
    let all = OF_ALL.iter().map(|name| packing.real(name).unwrap());
    all.chain(OF_EACH.iter().flat_map(|name| of_each(packing, name)))
        .collect()
}

fn mean(numbers: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = numbers.len() as f64;
    numbers.sum::<f64>() / count
}

/// The same from the angular paths of the disks by the plain formulas of P 3.1.
fn by_plain_formulas(paths: &[Vec<f64>], rotating: f64) -> Vec<f64> {
    let intervals = (paths[0].len() - 1) as f64;
    let velocity = |path: &Vec<f64>| (path[path.len() - 1] - path[0]) / (intervals * INTERVAL);
    let variance = |path: &Vec<f64>| {
        let own: Vec<f64> = path.windows(2).map(|pair| (pair[1] - pair[0]) / INTERVAL).collect();
        mean(own.iter().map(|one| (one - velocity(path)).powi(2)))
    };
    let correlation = |path: &Vec<f64>| {
        let (middle, angle) = (0.5 * intervals, mean(path.iter().copied()));
        let pairs = || path.iter().enumerate().map(|(k, own)| (k as f64 - middle, own - angle));
        let product: f64 = pairs().map(|(k, own)| k * own).sum();
        let squares: [f64; 2] = [
            pairs().map(|(k, _)| k * k).sum(),
            pairs().map(|(_, own)| own * own).sum(),
        ];
        product * product / (squares[0] * squares[1])
    };
    let adjusted = |path: &Vec<f64>| {
        let deviation = variance(path).sqrt();
        deviation / (velocity(path).abs() + deviation)
    };
    let each = |of: &dyn Fn(&Vec<f64>) -> f64| -> Vec<f64> { paths.iter().map(of).collect() };
    let [velocities, correlations, deviations] = [each(&velocity), each(&correlation), each(&adjusted)];
    let walks = each(&|path| variance(path) / (intervals - 1.0));
    let square = mean(velocities.iter().map(|own| own * own));
    let all = [
        square,
        square - mean(walks.into_iter()),
        mean(correlations.iter().copied()),
        mean(deviations.iter().copied()),
        mean(correlations.iter().map(|own| f64::from(u8::from(*own > rotating)))),
        velocities.iter().fold(0.0, |fastest: f64, own| fastest.max(own.abs())),
    ];
    [&all[..], &velocities, &correlations, &deviations].concat()
}

/// Steps to the sample times and reads the angles there.
fn outputs_are_those_of_the_angles<M: Model>(given: &[(&str, f64)]) {
    let (start, rotating, samples) = (0.12, 0.9, 13);
    let own = [("measure.start", start), ("measure.rotating_correlation", rotating)];
    let mut packing = shaken::<M>(&[given, &own].concat());
    packing.advance_to(0.11).unwrap();
    let mut paths = vec![Vec::new(); DISKS as usize];
    for sample in 0..samples {
        assert_eq!(measured(&packing).iter().all(|number| *number == 0.0), sample < 2);
        packing.advance_to(start + f64::from(sample) * INTERVAL).unwrap();
        for (path, angle) in paths.iter_mut().zip(of_each(&packing, "disk.angle")) {
            path.push(angle);
        }
    }
    // What comes after the last sample does not count.
    packing.advance_to(start + 12.9 * INTERVAL).unwrap();
    let (found, expected) = (measured(&packing), by_plain_formulas(&paths, rotating));
    for (found, expected) in found.iter().zip(&expected) {
        assert!(
            (found - expected).abs() < 1e-12 * expected.abs().max(1.0),
            "{found} {expected}"
        );
    }
    assert!(found[0] > 0.0 && found[4] > 0.0 && found[4] < 1.0, "{:?}", &found[..6]);
}

#[test]
fn outputs_are_those_of_the_angles_at_the_sample_times() {
    outputs_are_those_of_the_angles::<PackingOnSine>(&[]);
    outputs_are_those_of_the_angles::<LocatedPackingOnSine>(&[]);
    outputs_are_those_of_the_angles::<HardPackingOnSine>(&[("base.model", 2.0)]);
    outputs_are_those_of_the_angles::<HardPackingOnSine>(&[("base.model", 1.0)]);
}

/// Saved bytes and everything that is measured, after steps that end at `ends` \[s\].
fn after<M: Model>(packing: &mut Simulation<M>, ends: &[f64]) -> (Vec<u8>, Vec<f64>) {
    ends.iter().for_each(|end| packing.advance_to(*end).unwrap());
    let bytes = packing.to_bytes().unwrap();
    (bytes, measured(packing))
}

/// Steps cut anywhere, and a state that another instance takes over between two samples, give the same bits.
fn bits_are_the_same_however_one_steps<M: Model>(given: &[(&str, f64)]) {
    let given = [given, &[("measure.start", 0.0123)]].concat();
    let measured_after = |ends: &[f64]| after(&mut shaken::<M>(&given), ends).1;
    let whole = measured_after(&[0.5]);
    assert!(whole.iter().all(|number| number.is_finite()) && whole[0] > 0.0);
    let many: Vec<f64> = (1..=1000).map(|step| f64::from(step) * 5e-4).collect();
    let odd = [0.0123, 0.2, 0.0123 + 4.0 * INTERVAL, 0.3, 0.300_000_01, 0.499_999, 0.5];
    assert!(measured_after(&many) == whole && measured_after(&odd) == whole);

    let mut packing = shaken::<M>(&given);
    for middle in [0.0, 0.0123, 0.31] {
        if middle > 0.0 {
            packing.advance_to(middle).unwrap();
        }
        let saved = packing.to_bytes().unwrap();
        let ahead = after(&mut packing, &[0.5]);
        assert!(ahead.1 == whole);
        let mut other = shaken::<M>(&given);
        for again in [&mut packing, &mut other] {
            again.restore_bytes(&saved).unwrap();
            assert!(after(again, &[0.5]) == ahead);
            again.restore_bytes(&saved).unwrap();
        }
    }
}

#[test]
fn bits_of_soft_disks_are_the_same_however_one_steps() {
    bits_are_the_same_however_one_steps::<PackingOnSine>(&[]);
    bits_are_the_same_however_one_steps::<LocatedPackingOnSine>(&[]);
}

#[test]
fn bits_of_hard_disks_are_the_same_however_one_steps() {
    bits_are_the_same_however_one_steps::<HardPackingOnSine>(&[("base.model", 2.0)]);
    bits_are_the_same_however_one_steps::<HardPackingOnSine>(&[("base.model", 1.0)]);
}

/// The engine's state after a run that takes samples often is the one after a run that takes none.
fn measuring_changes_nothing<M: Model<State = PackingState<S>>, S: PartialEq>(given: &[(&str, f64)]) {
    let run = |own: &[(&str, f64)]| {
        let mut packing = shaken::<M>(&[given, own].concat());
        for step in 1..=20 {
            packing.advance_to(0.02 * f64::from(step)).unwrap();
        }
        let PackingState {
            engine,
            report,
            rotation,
            ..
        } = packing.model().unwrap().state();
        (engine, report, rotation.mean_square())
    };
    let (often, never) = (run(&[("measure.interval", 1.7e-3)]), run(&[("measure.start", 1e9)]));
    assert!(often.0 == never.0 && often.1 == never.1);
    assert!(often.2 > 0.0 && never.2 == 0.0);
}

#[test]
fn measuring_changes_no_bit_of_the_trajectory() {
    measuring_changes_nothing::<PackingOnSine, _>(&[]);
    measuring_changes_nothing::<LocatedPackingOnSine, _>(&[]);
    measuring_changes_nothing::<HardPackingOnSine, _>(&[("base.model", 2.0)]);
    measuring_changes_nothing::<HardPackingOnSine, _>(&[("base.model", 1.0)]);
}

/// Disks that float without friction never turn.
fn at_rest<M: Model>() {
    let mut packing = simulation_of::<M>(
        DISKS,
        &[
            ("gravity", 0.0),
            ("contact.friction", 0.0),
            ("measure.interval", INTERVAL),
        ],
    );
    packing.advance_to(0.2).unwrap();
    let all = OF_ALL.map(|name| packing.real(name).unwrap());
    assert_eq!(all, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    assert!(of_each(&packing, OF_EACH[2]).iter().all(|deviation| *deviation == 1.0));
}

#[test]
fn disks_that_never_turn_are_all_noise_and_do_not_rotate() {
    at_rest::<PackingOnInput>();
    at_rest::<LocatedPackingOnInput>();
    at_rest::<HardPackingOnInput>();
}

/// A step that is refused after it took samples leaves no trace of them, nor of where the disks were then.
fn refused_steps_leave_no_samples<M: Model>(given: &[(&str, f64)]) {
    let changes = [("measure.interval", 1e-4)];
    let mut packing = simulation_of::<M>(DISKS, &[&changes[..], given].concat());
    packing.advance_to(0.010_05).unwrap();
    let before = (packing.to_bytes().unwrap(), packing.all_values().unwrap());
    packing.set("base.displacement", 1e4).unwrap();
    packing.advance_to(0.110_05).unwrap_err();
    packing.set("base.displacement", 0.0).unwrap();
    assert!((packing.to_bytes().unwrap(), packing.all_values().unwrap()) == before);
    packing.advance_to(0.011).unwrap();
}

#[test]
fn refused_steps_of_soft_disks_leave_no_samples() {
    refused_steps_leave_no_samples::<PackingOnInput>(&[]);
    refused_steps_leave_no_samples::<LocatedPackingOnInput>(&[]);
}

/// A step with more samples than a call may do is refused before it begins, or when the work is done.
#[test]
fn too_many_samples_in_a_step_are_refused() {
    fn refusal<M: Model>() -> String {
        let often = [("measure.interval", 1e-6), ("work.limit", 1e6)];
        let mut packing = simulation_of::<M>(DISKS, &[&often[..], &[("gravity", 0.0)]].concat());
        packing.advance_to(0.001).unwrap();
        let before = (packing.to_bytes().unwrap(), packing.all_values().unwrap());
        let refusal = packing.advance_to(10.0).unwrap_err().to_string();
        assert!((packing.to_bytes().unwrap(), packing.all_values().unwrap()) == before);
        packing.advance_to(0.01).unwrap();
        refusal
    }
    for text in [refusal::<PackingOnInput>(), refusal::<HardPackingOnInput>()] {
        assert!(text.contains("work.limit"), "{text}");
    }
}

/// A state whose record is of another mark, interval or number of disks, or of another time, is refused, and nothing changes.
fn foreign_records_are_refused<M: Model<State = PackingState<S>>, S: Clone + PartialEq>() {
    let mut packing = shaken::<M>(&[]);
    packing.advance_to(0.17).unwrap();
    let sound = packing.model().unwrap().state();
    let mut own = M::new(packing.structure(), 0.0, packing.values()).unwrap();
    own.restore(&sound).unwrap();
    let disks = DISKS as usize;
    for rotation in [
        Rotation::new(disks, 0.0, INTERVAL),
        Rotation::new(disks, 0.2, INTERVAL),
        Rotation::new(disks, 0.0, 1.0),
        Rotation::new(disks + 1, 0.0, INTERVAL),
    ] {
        let foreign = PackingState {
            rotation,
            ..sound.clone()
        };
        assert!(own.restore(&foreign).is_err());
    }
    assert!(own.state() == sound);
}

#[test]
fn records_of_other_runs_are_refused() {
    foreign_records_are_refused::<PackingOnSine, _>();
    foreign_records_are_refused::<LocatedPackingOnSine, _>();
    foreign_records_are_refused::<HardPackingOnSine, _>();
}
