//! Measures of the ratchet: averages against the positions among the outputs, fields against brute force, conservation.
#![allow(clippy::unwrap_used)]

mod support;

use jostle::drive::{Drive, Sine};
use jostle::measure::{Cell, FlowFields, Transport};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine, Resolution};
use jostle::scene::{Model, Simulation, StructuralParameters};
use support::simulation_of;

const POSITIVE: [(&str, f64); 3] = [
    ("tooth.height", 3e-3),
    ("tooth.asymmetry", 0.1),
    ("drive.frequency", 25.0),
];
const MASS: f64 = 1e-5;

fn positive() -> Simulation<RatchetOnSine> {
    simulation_of(20, &POSITIVE)
}

/// Outputs now: horizontal positions of the disks \[m\] and work of the base \[J\].
fn positions_and_work(ratchet: &Simulation<RatchetOnSine>) -> (Vec<f64>, f64) {
    let position = |disk: u32| ratchet.real(&format!("disk.x[{disk}]")).unwrap();
    ((1..=20).map(position).collect(), ratchet.real("energy.input").unwrap())
}

/// The averages since a mark, from the positions and energies among the outputs at its two ends.
#[test]
fn averages_begin_anew_at_a_changed_mark() {
    let changes = [POSITIVE.as_slice(), &[("measure.start", 0.5)]].concat();
    let mut ratchet = simulation_of::<RatchetOnSine>(20, &changes);
    let (mut from, mut former_mark) = (None, 0.0);
    for (mark, until) in [(0.0, 0.5), (0.0, 2.0), (7.0, 3.0), (7.0, 5.25), (7.5, 25.25)] {
        ratchet.set("measure.mark", mark).unwrap();
        if mark != former_mark {
            from = Some((ratchet.time(), positions_and_work(&ratchet)));
            former_mark = mark;
        }
        ratchet.advance_to(until).unwrap();
        let (positions, work) = positions_and_work(&ratchet);
        let now = |name: &str| ratchet.real(name).unwrap();
        let Some((start, (positions_then, work_then))) = &from else {
            assert!(until > 0.5 || now("transport_velocity") == 0.0);
            from = Some((until, (positions, work)));
            continue;
        };
        let time = until - start;
        let own: Vec<f64> = positions
            .iter()
            .zip(positions_then)
            .map(|(position, start)| (position - start) / time)
            .collect();
        let mean = own.iter().sum::<f64>() / 20.0;
        let variance = own.iter().map(|velocity| (velocity - mean).powi(2)).sum::<f64>() / 19.0;
        let power = (work - work_then) / time;
        assert!((now("transport_velocity") - mean).abs() < 1e-13, "until {until}");
        assert!((now("transport_velocity.spread") - variance.sqrt()).abs() < 1e-13);
        assert!((now("base.mean_power") / power - 1.0).abs() < 1e-12);
        assert!((now("transport_velocity.standard_error") > 0.0) == (time >= 8.0 * Transport::FIRST_BATCH));
    }
}

/// Steps cut anywhere and states brought back give the same bits, averages and all, also with marks and on inputs.
#[test]
fn averages_are_the_same_bits_however_one_steps() {
    let run = |ratchet: &mut Simulation<RatchetOnInput>, ends: &[f64]| {
        for end in ends {
            let (time, omega) = (ratchet.time(), std::f64::consts::TAU * 25.0);
            ratchet.set("base.velocity", 0.3 * (omega * time).cos()).unwrap();
            ratchet.set("measure.mark", time.floor()).unwrap();
            ratchet.advance_to(*end).unwrap();
        }
        (ratchet.save(), ratchet.all_values())
    };
    let ends: Vec<f64> = (1..=2500).map(|index| f64::from(index) * 1e-3).collect();
    let start = || simulation_of::<RatchetOnInput>(20, &[("measure.start", 0.3)]);
    let mut ratchet = start();
    let (saved, _) = run(&mut ratchet, &ends[..1300]);
    let ahead = run(&mut ratchet, &ends[1300..]);
    assert!(ratchet.real("transport_velocity").unwrap() != 0.0);
    let mut other = start();
    for again in [&mut ratchet, &mut other] {
        again.restore(&saved).unwrap();
        assert!(run(again, &ends[1300..]) == ahead);
    }
    // On a sine, where steps may be cut.
    let [whole, cut] = [vec![9.0], vec![0.0999, 0.1, 0.3, 3.3, 3.300_000_1, 9.0]].map(|ends| {
        let mut ratchet = positive();
        ends.iter().for_each(|end| ratchet.advance_to(*end).unwrap());
        let names = [
            "transport_velocity",
            "transport_velocity.standard_error",
            "transport_velocity.spread",
        ];
        let averages = ratchet.model().unwrap().state().averages;
        (averages, names.map(|name| ratchet.real(name).unwrap()))
    });
    assert!(whole == cut && whole.1.iter().all(|number| *number != 0.0));
}

/// A state saved before the first step, or at the mark, is taken back.
#[test]
fn states_at_the_mark_are_taken_back() {
    for start in [0.0, 0.3, 1e9] {
        let mut ratchet = simulation_of::<RatchetOnSine>(20, &[("measure.start", start)]);
        for end in [0.3, 0.7] {
            let saved = ratchet.save();
            ratchet.advance_to(end).unwrap();
            let ahead = ratchet.save();
            ratchet.restore(&saved).unwrap();
            assert!(ratchet.save() == saved);
            ratchet.advance_to(end).unwrap();
            assert!(ratchet.save() == ahead);
        }
    }
}

/// A state whose averages were tampered with is refused, and nothing changes.
#[test]
fn damaged_averages_are_refused() {
    let start = positive();
    let mut ratchet = RatchetOnSine::new(start.structure(), 0.0, start.values()).unwrap();
    ratchet.advance_to(1.0, start.values()).unwrap();
    let before = ratchet.state();
    for (mark, time) in [(0.5, 1.0), (f64::NAN, 1.0), (0.0, 1e9)] {
        let mut state = before.clone();
        state.report.time = time;
        if mark != 0.0 {
            state.averages.transport = Transport::new(mark);
        }
        assert!(ratchet.restore(&state).is_err(), "mark {mark}, time {time}");
    }
    assert!(ratchet.state() == before && ratchet.restore(&before).is_ok());
}

/// The standard error of one run is the scatter of forty (whose own error is a ninth).
#[test]
fn standard_errors_are_the_scatter_of_runs() {
    let runs: Vec<[f64; 2]> = (1..=40)
        .map(|seed| {
            let changes = [
                POSITIVE.as_slice(),
                &[("seed", f64::from(seed)), ("measure.start", 1.0)],
            ]
            .concat();
            let mut ratchet = simulation_of::<RatchetOnSine>(20, &changes);
            ratchet.advance_to(31.0).unwrap();
            ["transport_velocity", "transport_velocity.standard_error"].map(|name| ratchet.real(name).unwrap())
        })
        .collect();
    let mean = runs.iter().map(|run| run[0]).sum::<f64>() / 40.0;
    let scatter = (runs.iter().map(|run| (run[0] - mean).powi(2)).sum::<f64>() / 39.0).sqrt();
    let estimated = (runs.iter().map(|run| run[1].powi(2)).sum::<f64>() / 40.0).sqrt();
    println!("{mean:.4} m/s, scatter {scatter:.5}, estimated {estimated:.5} m/s");
    assert!((0.6..1.6).contains(&(estimated / scatter)));
}

/// Fields of `seconds` after `warm_up`, their end, and the transport velocity over the same time.
fn fields(changes: &[(&str, f64)], resolution: Resolution, [warm_up, seconds]: [f64; 2]) -> (FlowFields, f64, f64) {
    let mut ratchet = simulation_of::<RatchetOnSine>(20, changes);
    ratchet.advance_to(warm_up).unwrap();
    ratchet.set("measure.mark", 1.0).unwrap();
    let mut fields = ratchet.model().unwrap().flow_fields(resolution).unwrap();
    for piece in 1..=7 {
        let end = warm_up + seconds * f64::from(piece) / 7.0;
        let step = |ratchet: &mut RatchetOnSine, values: &_| ratchet.advance_observed(end, values, &mut fields);
        ratchet.advance_by(end, step).unwrap();
    }
    let end = ratchet.model().unwrap().show_last_flights(&mut fields);
    (fields, end, ratchet.real("transport_velocity").unwrap())
}

/// In each window all mass is in some box, and all momentum together is that of the transport. Over an epoch of the
/// engine's clock, at odd phases.
#[test]
fn fields_hold_all_mass_and_the_whole_transport() {
    let changes = [POSITIVE.as_slice(), &[("drive.phase", 1.3)]].concat();
    let whole = Resolution {
        whole_cell: true,
        phases: 5,
        ..Resolution::default()
    };
    for resolution in [Resolution::default(), whole] {
        let (fields, end, transport) = fields(&changes, resolution, [25.037, 50.019]);
        let durations = fields.durations(end);
        let (mut mass, mut momentum) = (vec![0.0; durations.len()], 0.0);
        for cell in fields.cells(end) {
            mass[cell.phase as usize] += cell.mass;
            momentum += cell.momentum[0] * durations[cell.phase as usize] / 50.019;
        }
        for mass in mass {
            assert!((mass / (20.0 * MASS) - 1.0).abs() < 1e-11, "{mass}");
        }
        let of_layers: f64 = fields.layers(end).map(|layer| layer.mass * layer.velocity).sum();
        let expected = 20.0 * MASS * transport;
        println!("momentum {momentum:e}, by layers {of_layers:e}, transport {expected:e} kg.m/s");
        assert!((momentum / expected - 1.0).abs() < 1e-10 && (of_layers / expected - 1.0).abs() < 1e-10);
    }
}

/// The same run, sampled 100,000 times a second: boxes differ by what a sample every 10 us misses at their edges.
#[test]
fn fields_are_what_brute_force_sampling_tends_to() {
    let (warm_up, seconds, interval) = (0.5, 4.0, 1e-5);
    let (fields, end, _) = fields(&POSITIVE, Resolution::default(), [warm_up, seconds]);
    let exact: Vec<Cell> = fields.cells(end).collect();
    let rows = exact.len() / 36;
    let mut sampled = vec![[0.0; 3]; exact.len()];
    let mut ratchet = positive();
    let lowest = (exact[0].y / 1e-3).floor();
    for sample in 0..400_000_u32 {
        let time = warm_up + (f64::from(sample) + 0.5) * interval;
        ratchet.advance_to(time).unwrap();
        let window = (6.0 * 25.0 * time).floor().rem_euclid(6.0) as usize;
        for disk in 0..20 {
            let motion = ratchet.model().unwrap().engine().sample_at(time, disk);
            let column = (motion.position.x / 1e-3).floor().rem_euclid(6.0) as usize;
            let row = ((motion.position.y / 1e-3).floor() - lowest) as usize;
            let weight = MASS * interval / (seconds / 6.0);
            let sum = &mut sampled[(window * rows + row) * 6 + column];
            for (index, amount) in [1.0, motion.velocity.x, motion.velocity.y].into_iter().enumerate() {
                sum[index] += weight * amount;
            }
        }
    }
    let mut off = [0.0; 3];
    for (cell, sampled) in exact.iter().zip(&sampled) {
        let numbers = [cell.mass, cell.momentum[0], cell.momentum[1]];
        (0..3).for_each(|index| off[index] += (numbers[index] - sampled[index]).abs());
    }
    let total = 6.0 * 20.0 * MASS;
    println!(
        "mass off by {:.1e} of all, momentum by {:.1e} and {:.1e} of all at 1 m/s",
        off[0] / total,
        off[1] / total,
        off[2] / total
    );
    assert!(off[0] < 1e-3 * total && off[1] < 1e-3 * total * 0.3 && off[2] < 1e-3 * total);
}

/// An observer changes nothing, not a bit.
#[test]
fn an_observed_run_is_the_same_run() {
    let (mut observed, mut alone) = (positive(), positive());
    let mut fields = observed.model().unwrap().flow_fields(Resolution::default()).unwrap();
    let step = |ratchet: &mut RatchetOnSine, values: &_| ratchet.advance_observed(40.0, values, &mut fields);
    observed.advance_by(40.0, step).unwrap();
    alone.advance_to(40.0).unwrap();
    assert!(observed.save() == alone.save());
}

/// The drive in local time is the drive, at the start of every epoch and with odd phases.
#[test]
fn local_time_is_time() {
    let structure = StructuralParameters::defaults(&RatchetOnSine::info());
    let mut ratchet = Simulation::<RatchetOnSine>::prepare(structure);
    ratchet.set("drive.phase", -0.7).unwrap();
    ratchet.start(0.1).unwrap();
    let sine = Sine {
        amplitude: 2e-3,
        frequency: 25.0,
        phase: -0.7,
    };
    for time in [0.1, 20.0, 40.0, 70.0, 100.0] {
        if time > 0.1 {
            ratchet.advance_to(time).unwrap();
        }
        let state = ratchet.model().unwrap().engine().state();
        let local = state.boundary.local_motion(time - state.epoch);
        let off = local.displacement - sine.motion(time).displacement;
        assert!(off.abs() < 1e-14, "{off:e} m at {time} s");
    }
}
