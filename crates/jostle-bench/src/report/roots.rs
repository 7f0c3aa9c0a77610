//! When a disk in flight meets the sine base: our march, which has no tolerance to choose, beside F's scan with bisection,
//! which has one.
//!
//! The error of a root is the gap there over the speed of approach. A method that passes the first root of a flight has
//! no place in the diagram and is reported instead.

use jostle::drive::{Drive, FirstHit, Sine};
use jostle::geometry::Flight;

use super::case::{Case, Done, Point, Stopwatch, Trouble, ladder, root_mean_square};

const FLIGHTS: u32 = 2000;
const PULL: f64 = 9.8;
const SCAN: f64 = 64.0;
const QUANTITIES: &[(&str, &str)] = &[("time", "rms error of the time of the first root over a period")];

/// Flights of many heights, speeds and phases.
pub fn cases() -> Vec<Case> {
    let mut points = vec![Point::new("march to the root", 0.0, |watch: &mut Stopwatch| {
        solved(watch, march)
    })];
    points.extend(ladder(1e-3, 1e-2, 6).map(|tolerance| {
        Point::new("scan and bisection", tolerance, move |watch: &mut Stopwatch| {
            solved(watch, |drive, time, flight| scan(drive, time, flight, tolerance))
        })
    }));
    vec![Case {
        name: "first_hit",
        problem: format!("{FLIGHTS} flights above a base of 80 Hz, Gamma 2: when does each meet it first?"),
        setting: "tolerance of the time over a period; 0: to rounding",
        reference: "the gap at the root over the speed of approach",
        quantities: QUANTITIES,
        points,
    }]
}

fn drive() -> Sine {
    Sine {
        amplitude: Sine::amplitude_of(2.0, 80.0, PULL),
        frequency: 80.0,
        phase: 0.0,
    }
}

/// Time and flight number `index`, relative to the base: low-discrepancy, so that every run has the same ones.
fn flight(index: u32) -> (f64, Flight) {
    let golden = |multiple: f64| (f64::from(index) * multiple).fract();
    let drive = drive();
    let time = golden(0.618_033_988_749_894_9) / drive.frequency;
    let base = drive.motion(time);
    let height = 4.0 * drive.amplitude * golden(0.754_877_666_246_692_7) + 1e-9;
    let velocity = 0.1 * (golden(0.569_840_290_998_053_2) - 0.3);
    let flight = Flight {
        gap: height,
        velocity: velocity - base.velocity,
        pull: PULL,
    };
    (time, flight)
}

/// Gap and its rate at `delay`.
fn gap(drive: &Sine, time: f64, flight: &Flight, delay: f64) -> (f64, f64) {
    let (start, now) = (drive.motion(time), drive.motion(time + delay));
    let fall = flight.gap + (flight.velocity + start.velocity) * delay - 0.5 * flight.pull * delay * delay;
    let rate = flight.velocity + start.velocity - flight.pull * delay - now.velocity;
    (fall - (now.displacement - start.displacement), rate)
}

fn march(drive: &Sine, time: f64, flight: &Flight) -> f64 {
    drive.first_hit(time, flight, 1.0)
}

/// F B.3: steps of a 64th of a period until the gap is negative, then bisection.
fn scan(drive: &Sine, time: f64, flight: &Flight, tolerance: f64) -> f64 {
    let (period, mut low) = (1.0 / drive.frequency, 0.0);
    let step = period / SCAN;
    while gap(drive, time, flight, low + step).0 > 0.0 {
        low += step;
    }
    let mut high = low + step;
    while high - low > tolerance * period {
        let middle = 0.5 * (low + high);
        if gap(drive, time, flight, middle).0 > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

fn solved(watch: &mut Stopwatch, solve: impl Fn(&Sine, f64, &Flight) -> f64) -> Result<Done, Trouble> {
    let drive = drive();
    let flights: Vec<(f64, Flight)> = (1..=FLIGHTS).map(flight).collect();
    let delays: Vec<f64> = watch.measure(FLIGHTS, || {
        flights
            .iter()
            .map(|(time, flight)| solve(&drive, *time, flight))
            .collect()
    });
    let (mut errors, mut missed) = (Vec::new(), 0);
    for ((time, flight), delay) in flights.iter().zip(delays) {
        // A gap below zero, clearly before the root that was found, is a root that was passed.
        let clearly = delay - 0.5 / SCAN / drive.frequency;
        let mut earlier = (1..4096).map(|part| clearly * f64::from(part) / 4096.0);
        if clearly > 0.0 && earlier.any(|before| gap(&drive, *time, flight, before).0 < -1e-15) {
            missed += 1;
            continue;
        }
        let (value, rate) = gap(&drive, *time, flight, delay);
        errors.push((value / rate.abs().max(1e-6)).abs() * drive.frequency);
    }
    if missed > 0 {
        return Err(format!("passed the first root of {missed} of {FLIGHTS} flights").into());
    }
    Ok(Done::exact([root_mean_square(&errors)], f64::from(FLIGHTS)))
}
