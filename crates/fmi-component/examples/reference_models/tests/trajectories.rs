//! What the models compute, against the published results of the Reference FMUs and against closed forms.
#![allow(clippy::unwrap_used)]

use fmi_component::{DynSimulation, Kind, ModelType, Simulation, StructuralParameters, Value};
use reference_models::{ALL, BouncingBall, VanDerPol};

type Of<C> = fmi_component::ComponentModel<C>;

/// Of the published results, which have the digits of the shortest text of a double. The methods are the same, so that no more than the
/// rounding of another order of operations is allowed: far below the 10 % of a signal's range that the FMI cross-check allowed.
const TOLERANCE: f64 = 1e-9;

fn simulation(model: &ModelType) -> Box<dyn DynSimulation> {
    let structure = StructuralParameters::defaults(&(model.info)());
    let mut simulation = (model.prepare)(structure);
    simulation.start(0.0).unwrap();
    simulation
}

fn published(identifier: &str) -> (Vec<String>, Vec<csv::StringRecord>) {
    let path = format!("{}/tests/data/{identifier}_out.csv", env!("CARGO_MANIFEST_DIR"));
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names = reader.headers().unwrap().iter().map(String::from).collect();
    (names, reader.records().map(Result::unwrap).collect())
}

fn check_value(simulation: &dyn DynSimulation, name: &str, text: &str, time: f64) {
    let position = simulation.position(name).unwrap();
    let variable = &simulation.values().table().variables()[position];
    let place = format!("{name} at t = {time} s");
    match (&variable.kind, simulation.value(position).unwrap()) {
        (Kind::Text { .. }, _) => assert_eq!(simulation.bytes(position).unwrap(), text.as_bytes(), "{place}"),
        (Kind::Binary { .. }, _) => {
            let digits: String = simulation
                .bytes(position)
                .unwrap()
                .iter()
                .map(|byte| format!("{byte:02x}"))
                .collect();
            assert_eq!(digits, text, "{place}");
        }
        (Kind::Boolean { .. }, value) => assert_eq!(variable.text(value), text, "{place}"),
        (_, Value::Integer(integer)) => assert_eq!(integer.to_string(), text, "{place}"),
        (_, Value::Real(real)) => {
            let expected: f64 = text.parse().unwrap();
            let allowed = TOLERANCE * expected.abs().max(1.0);
            assert!(
                (real - expected).abs() <= allowed,
                "{place}: {real}, published is {expected}"
            );
        }
    }
}

#[test]
fn trajectories_are_those_that_the_reference_fmus_publish() {
    for (_, model) in &ALL {
        let (names, rows) = published(&(model.info)().identifier);
        let mut simulation = simulation(model);
        assert!(rows.len() > 1);
        for row in &rows {
            let time: f64 = row[0].parse().unwrap();
            if time > 0.0 {
                simulation.advance_to(time).unwrap();
            }
            for (name, cell) in names.iter().zip(row).skip(1) {
                let elements: Vec<&str> = cell.split(' ').collect();
                // "Set me!" has a space, a vector has numbers between them.
                if simulation.position(name).is_ok() {
                    check_value(&*simulation, name, cell, time);
                    continue;
                }
                for (number, element) in (1..).zip(elements) {
                    check_value(&*simulation, &format!("{name}[{number}]"), element, time);
                }
            }
        }
    }
}

/// Exact flight: impacts at t_1 (1 + 2 (e + e² + ...)), t_1 = sqrt(2 h / g). In steps of the method each flight is late by two at most, hits
/// by as much faster, and that lengthens the next flight.
#[test]
fn impacts_of_the_ball_are_those_of_the_exact_flight_to_first_order() {
    let mut ball = Simulation::<Of<BouncingBall>>::new(&[], &[]).unwrap();
    let (restitution, first) = (0.7, (2.0_f64 / 9.81).sqrt());
    let (mut exact, mut flight) = (first, 2.0 * restitution * first);
    let (mut late, mut faster) = (2.0, 2.0);
    for number in 1..=6 {
        let reached = ball.advance_to_event(3.0).unwrap();
        assert!(reached.event, "impact {number}");
        let steps = (reached.time - exact) / 1e-3;
        assert!(
            (0.0..late).contains(&steps),
            "impact {number} is late by {steps} steps, not {late} at most"
        );
        (exact, flight) = (exact + flight, flight * restitution);
        late += 2.0 + 2.0 * restitution * faster;
        faster = 2.0 + restitution * faster;
    }
}

/// Explicit Euler is of first order: its error against the closed form is h/2 times an integral of the second derivative.
#[test]
fn linear_models_agree_with_their_closed_forms_to_first_order() {
    let mut dahlquist = simulation(&ALL[1].1);
    let x = dahlquist.position("x").unwrap();
    for step in 1..=100 {
        let time = 0.1 * f64::from(step);
        dahlquist.advance_to(time).unwrap();
        let error = (dahlquist.value(x).unwrap().to_f64() - (-time).exp()).abs();
        assert!(error <= 0.5 * 0.1 * time * (-time).exp() * 1.1, "t = {time} s: {error}");
    }
    let mut linear = simulation(&ALL[5].1);
    for step in 1..=10 {
        let time = f64::from(step);
        linear.advance_to(time).unwrap();
        for (number, u) in [(1, 1.0), (2, 2.0), (3, 3.0)] {
            let position = linear.position(&format!("y[{number}]")).unwrap();
            let exact = u * (2.0 * time.exp() - 1.0) - u * time.exp() + u;
            let found = linear.value(position).unwrap().to_f64();
            assert!(
                (found / exact - 1.0).abs() < 0.5e-3 * time,
                "y[{number}] at {time} s: {found}, exact {exact}"
            );
        }
    }
}

/// Runge-Kutta of fourth order with steps of 0.1 ms is exact here to 1e-10.
#[test]
fn the_oscillator_agrees_with_a_tight_integration_to_first_order() {
    let rate = |[x, v]: [f64; 2]| [v, (1.0 - x * x) * v - x];
    let add = |[x, v]: [f64; 2], h: f64, [dx, dv]: [f64; 2]| [x + h * dx, v + h * dv];
    let mut oscillator = Simulation::<Of<VanDerPol>>::new(&[], &[]).unwrap();
    let mut exact = [2.0, 0.0];
    let h = 1e-4;
    for step in 1..=500 {
        for _ in 0..100 {
            let k1 = rate(exact);
            let k2 = rate(add(exact, h / 2.0, k1));
            let k3 = rate(add(exact, h / 2.0, k2));
            let k4 = rate(add(exact, h, k3));
            exact = [0, 1].map(|i| exact[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        }
        oscillator.advance_to(0.01 * f64::from(step)).unwrap();
        let error = (oscillator.real("x0").unwrap() - exact[0]).abs();
        assert!(error < 0.05, "step {step}: off by {error}");
    }
}
