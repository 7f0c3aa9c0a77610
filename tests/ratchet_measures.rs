//! Measures of the ratchet: averages against the places that the outputs tell, fields against brute force, conservation.
#![allow(clippy::unwrap_used)]

mod support;

use jostle::drive::{Drive, Sine};
use jostle::measure::{Cell, FlowFields, Transport};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine, Resolution};
use jostle::scene::{Choice, Scene, Value, Values};
use support::{outputs_of, values_of};

const CHOICE: Choice = Choice { disks: 20 };
const POSITIVE: [(&str, f64); 3] = [
    ("tooth.height", 3e-3),
    ("tooth.asymmetry", 0.1),
    ("drive.frequency", 25.0),
];
const MASS: f64 = 1e-5;

fn places(outputs: &Values) -> Vec<f64> {
    (1..=20).map(|disk| outputs.real(&format!("disk.x[{disk}]"))).collect()
}

/// The averages since a mark, from the places and energies that the outputs tell at its two ends.
#[test]
fn averages_begin_anew_at_a_changed_mark() {
    let mut values = values_of::<RatchetOnSine>(CHOICE, &POSITIVE);
    values.set_by_name("measure.start", Value::Real(0.5)).unwrap();
    let mut ratchet = RatchetOnSine::new(CHOICE, 0.0, &values).unwrap();
    let mut from = None;
    for (mark, until) in [(0.0, 0.5), (0.0, 2.0), (7.0, 3.0), (7.0, 5.25), (7.5, 25.25)] {
        let changed = mark != values.real("measure.mark");
        values.set_by_name("measure.mark", Value::Real(mark)).unwrap();
        let before = outputs_of(&ratchet, &values);
        if changed {
            from = Some((ratchet.state().report.time, before));
        }
        ratchet.advance_to(until, &values).unwrap();
        let now = outputs_of(&ratchet, &values);
        let Some((start, at_start)) = &from else {
            assert!(until > 0.5 || now.real("transport_velocity") == 0.0);
            from = Some((until, now));
            continue;
        };
        let time = until - start;
        let own: Vec<f64> = places(&now)
            .iter()
            .zip(places(at_start))
            .map(|(place, start)| (place - start) / time)
            .collect();
        let mean = own.iter().sum::<f64>() / 20.0;
        let variance = own.iter().map(|velocity| (velocity - mean).powi(2)).sum::<f64>() / 19.0;
        let power = (now.real("energy.input") - at_start.real("energy.input")) / time;
        assert!((now.real("transport_velocity") - mean).abs() < 1e-13, "until {until}");
        assert!((now.real("transport_velocity.spread") - variance.sqrt()).abs() < 1e-13);
        assert!((now.real("base.mean_power") / power - 1.0).abs() < 1e-12);
        assert!((now.real("transport_velocity.standard_error") > 0.0) == (time >= 8.0 * Transport::FIRST_BATCH));
    }
}

/// Steps cut anywhere and states brought back give the same bits, averages and all, also with marks and on inputs.
#[test]
fn averages_are_the_same_bits_however_one_steps() {
    let mut values = values_of::<RatchetOnInput>(CHOICE, &[("measure.start", 0.3)]);
    let mut run = |ratchet: &mut RatchetOnInput, ends: &[f64]| {
        for end in ends {
            let (time, omega) = (ratchet.state().report.time, std::f64::consts::TAU * 25.0);
            values
                .set_by_name("base.velocity", Value::Real(0.3 * (omega * time).cos()))
                .unwrap();
            values.set_by_name("measure.mark", Value::Real(time.floor())).unwrap();
            ratchet.advance_to(*end, &values).unwrap();
        }
        (ratchet.state(), outputs_of(ratchet, &values))
    };
    let ends: Vec<f64> = (1..=2500).map(|index| f64::from(index) * 1e-3).collect();
    let new = || {
        RatchetOnInput::new(
            CHOICE,
            0.0,
            &values_of::<RatchetOnInput>(CHOICE, &[("measure.start", 0.3)]),
        )
        .unwrap()
    };
    let mut ratchet = new();
    let (saved, _) = run(&mut ratchet, &ends[..1300]);
    let ahead = run(&mut ratchet, &ends[1300..]);
    let mut other = new();
    for again in [&mut ratchet, &mut other] {
        again.restore(&saved).unwrap();
        assert!(run(again, &ends[1300..]) == ahead);
    }
    assert!(ahead.1.real("transport_velocity") != 0.0);
    // On a sine, where steps may be cut.
    let values = values_of::<RatchetOnSine>(CHOICE, &POSITIVE);
    let [whole, cut] = [vec![9.0], vec![0.0999, 0.1, 0.3, 3.3, 3.300_000_1, 9.0]].map(|ends| {
        let mut ratchet = RatchetOnSine::new(CHOICE, 0.0, &values).unwrap();
        ends.iter().for_each(|end| ratchet.advance_to(*end, &values).unwrap());
        let outputs = outputs_of(&ratchet, &values);
        let names = [
            "transport_velocity",
            "transport_velocity.standard_error",
            "transport_velocity.spread",
        ];
        (ratchet.state().averages, names.map(|name| outputs.real(name)))
    });
    assert!(whole == cut && whole.1.iter().all(|number| *number != 0.0));
}

/// A state saved before the first step, or at the mark, is taken back.
#[test]
fn states_at_the_mark_are_taken_back() {
    for start in [0.0, 0.3, 1e9] {
        let values = values_of::<RatchetOnSine>(CHOICE, &[("measure.start", start)]);
        let mut ratchet = RatchetOnSine::new(CHOICE, 0.0, &values).unwrap();
        for end in [0.3, 0.7] {
            let saved = ratchet.state();
            ratchet.advance_to(end, &values).unwrap();
            let ahead = ratchet.state();
            ratchet.restore(&saved).unwrap();
            assert!(ratchet.state() == saved);
            ratchet.advance_to(end, &values).unwrap();
            assert!(ratchet.state() == ahead);
        }
    }
}

/// A state whose averages were tampered with is refused, and nothing changes.
#[test]
fn damaged_averages_are_refused() {
    let values = values_of::<RatchetOnSine>(CHOICE, &POSITIVE);
    let mut ratchet = RatchetOnSine::new(CHOICE, 0.0, &values).unwrap();
    ratchet.advance_to(1.0, &values).unwrap();
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

/// The error that one run tells is the scatter of forty (whose own error is a ninth).
#[test]
fn standard_errors_are_the_scatter_of_runs() {
    let runs: Vec<[f64; 2]> = (1..=40)
        .map(|seed| {
            let changes = [
                POSITIVE.as_slice(),
                &[("seed", f64::from(seed)), ("measure.start", 1.0)],
            ]
            .concat();
            let values = values_of::<RatchetOnSine>(CHOICE, &changes);
            let mut ratchet = RatchetOnSine::new(CHOICE, 0.0, &values).unwrap();
            ratchet.advance_to(31.0, &values).unwrap();
            let outputs = outputs_of(&ratchet, &values);
            ["transport_velocity", "transport_velocity.standard_error"].map(|name| outputs.real(name))
        })
        .collect();
    let mean = runs.iter().map(|run| run[0]).sum::<f64>() / 40.0;
    let scatter = (runs.iter().map(|run| (run[0] - mean).powi(2)).sum::<f64>() / 39.0).sqrt();
    let estimated = (runs.iter().map(|run| run[1].powi(2)).sum::<f64>() / 40.0).sqrt();
    println!("{mean:.4} m/s, scatter {scatter:.5}, estimated {estimated:.5} m/s");
    assert!((0.6..1.6).contains(&(estimated / scatter)));
}

/// Fields of `seconds` after `warm_up`, their end, and the transport velocity over the same time.
fn fields(
    choice: Choice,
    changes: &[(&str, f64)],
    resolution: Resolution,
    [warm_up, seconds]: [f64; 2],
) -> (FlowFields, f64, f64) {
    let mut values = values_of::<RatchetOnSine>(choice, changes);
    let mut ratchet = RatchetOnSine::new(choice, 0.0, &values).unwrap();
    ratchet.advance_to(warm_up, &values).unwrap();
    values.set_by_name("measure.mark", Value::Real(1.0)).unwrap();
    let mut fields = ratchet.flow_fields(resolution).unwrap();
    for piece in 1..=7 {
        let end = warm_up + seconds * f64::from(piece) / 7.0;
        ratchet.advance_observed(end, &values, &mut fields).unwrap();
    }
    let end = ratchet.show_last_flights(&mut fields);
    (fields, end, outputs_of(&ratchet, &values).real("transport_velocity"))
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
        let (fields, end, transport) = fields(CHOICE, &changes, resolution, [25.037, 50.019]);
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

/// The same run, sampled 100,000 times a second: boxes differ by what samples every 10 us miss at their edges.
#[test]
fn fields_are_what_brute_force_sampling_tends_to() {
    let (warm_up, seconds, interval) = (0.5, 4.0, 1e-5);
    let (fields, end, _) = fields(CHOICE, &POSITIVE, Resolution::default(), [warm_up, seconds]);
    let exact: Vec<Cell> = fields.cells(end).collect();
    let rows = exact.len() / 36;
    let mut sampled = vec![[0.0; 3]; exact.len()];
    let values = values_of::<RatchetOnSine>(CHOICE, &POSITIVE);
    let mut ratchet = RatchetOnSine::new(CHOICE, 0.0, &values).unwrap();
    let lowest = (exact[0].y / 1e-3).floor();
    for sample in 0..400_000_u32 {
        let time = warm_up + (f64::from(sample) + 0.5) * interval;
        ratchet.advance_to(time, &values).unwrap();
        let window = (6.0 * 25.0 * time).floor().rem_euclid(6.0) as usize;
        for disk in 0..20 {
            let motion = ratchet.engine().sample_at(time, disk);
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
    let values = values_of::<RatchetOnSine>(CHOICE, &POSITIVE);
    let new = || RatchetOnSine::new(CHOICE, 0.0, &values).unwrap();
    let (mut observed, mut alone) = (new(), new());
    let mut fields = observed.flow_fields(Resolution::default()).unwrap();
    observed.advance_observed(40.0, &values, &mut fields).unwrap();
    alone.advance_to(40.0, &values).unwrap();
    assert!(observed.state() == alone.state());
}

/// The drive in local time is the drive, at the start of every epoch and with odd phases.
#[test]
fn local_time_is_time() {
    let values = values_of::<RatchetOnSine>(CHOICE, &[("drive.phase", -0.7)]);
    let mut ratchet = RatchetOnSine::new(CHOICE, 0.1, &values).unwrap();
    let sine = Sine {
        amplitude: 2e-3,
        frequency: 25.0,
        phase: -0.7,
    };
    for time in [0.1, 20.0, 40.0, 70.0, 100.0] {
        ratchet.advance_to(time, &values).unwrap();
        let state = ratchet.engine().state();
        let local = state.boundary.local_motion(time - state.epoch);
        let off = local.displacement - sine.motion(time).displacement;
        assert!(off.abs() < 1e-14, "{off:e} m at {time} s");
    }
}
