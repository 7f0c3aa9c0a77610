//! First hits on a base that follows inputs, beside those on a cubic: `cargo bench --bench first_hit`.
//!
//! The same random flights over bases that move alike; in turn, medians of nine, CPU time of this process. The cubic is what the
//! base followed in earlier builds; its roots are those of quadratics between which it is monotone.

use std::hint::black_box;

use cpu_time::ProcessTime;
use jostle::drive::{Degree, Drive, FirstHit, FollowsInput, Motion};
use jostle::geometry::Flight;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

const FLIGHTS: usize = 200_000;
const RUNS: usize = 9;

/// Displacement as a polynomial of degree three of the time since `start` over `duration`.
struct Cubic {
    start: f64,
    duration: f64,
    coefficients: [f64; 4],
}

impl Cubic {
    fn between(start: f64, from: Motion, duration: f64, to: Motion) -> Self {
        let (v0, v1) = (duration * from.velocity, duration * to.velocity);
        let rise = to.displacement - from.displacement;
        let coefficients = [from.displacement, v0, 3.0 * rise - 2.0 * v0 - v1, v0 + v1 - 2.0 * rise];
        Self {
            start,
            duration,
            coefficients,
        }
    }

    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64 {
        let [_, _, c2, c3] = self.coefficients;
        let u = (time - self.start) / self.duration;
        let acceleration = (2.0 * c2 + 6.0 * u * c3) / self.duration.powi(2);
        let gap = [
            flight.gap.max(0.0),
            flight.velocity,
            -0.5 * (flight.pull + normal_up * acceleration),
            -normal_up * c3 / self.duration.powi(3),
        ];
        first_fall(gap, self.start + self.duration - time)
    }
}

/// First t in [0, `end`] at which the cubic falls through zero, or infinity.
fn first_fall([d, w, b, e]: [f64; 4], end: f64) -> f64 {
    let value = |t: f64| d + t * (w + t * (b + t * e));
    let [early, late] = two_roots(3.0 * e, 2.0 * b, w);
    let (mut low, mut low_value) = (0.0, d);
    for high in [early, late, end] {
        if high > low && high <= end {
            let high_value = value(high);
            if high_value < 0.0 && low_value >= 0.0 {
                return falling_root(low, high, |t| (value(t), w + t * (2.0 * b + t * 3.0 * e)));
            }
            (low, low_value) = (high, high_value);
        }
    }
    f64::INFINITY
}

fn two_roots(a: f64, b: f64, c: f64) -> [f64; 2] {
    let sum = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b));
    let (first, second) = (sum / a, c / sum);
    if first < second {
        [first, second]
    } else {
        [second, first]
    }
}

/// Newton's method that cannot leave a bracket, as the library has it.
fn falling_root(mut low: f64, mut high: f64, function: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut at = 0.5 * (low + high);
    let mut last_step = high - low;
    for _ in 0..200 {
        let (value, slope) = function(at);
        if value >= 0.0 {
            low = at;
        } else {
            high = at;
        }
        let newton = at - value / slope;
        let step = (newton - at).abs();
        let inside = newton > low && newton < high;
        if inside && step * step * step <= 0.25 * f64::EPSILON * newton.abs() * last_step * last_step {
            return newton;
        }
        let next = if inside && step < 0.5 * last_step {
            newton
        } else {
            0.5 * (low + high)
        };
        last_step = (next - at).abs();
        if next <= low || next >= high || last_step <= f64::EPSILON * 0.5 * next.abs() {
            return next;
        }
        at = next;
    }
    at
}

/// Even numbers in [low, high).
fn between(random: &mut Pcg64, low: f64, high: f64) -> f64 {
    let even = (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    low + (high - low) * even
}

/// Communication steps of a millisecond of a sine of 80 Hz at Gamma = 2, and flights of hard disks over them.
fn cases() -> Vec<(FollowsInput, Cubic, f64, Flight)> {
    let mut random = Pcg64::seed_from_u64(7);
    let (amplitude, omega, step) = (7.757e-5, std::f64::consts::TAU * 80.0, 1e-3);
    let sine = |time: f64| Motion {
        displacement: amplitude * (omega * time).sin(),
        velocity: amplitude * omega * (omega * time).cos(),
        acceleration: -amplitude * omega * omega * (omega * time).sin(),
    };
    (0..FLIGHTS)
        .map(|_| {
            let start = between(&mut random, 0.0, 1.0);
            let mut base = FollowsInput::starting(start, sine(start), Degree::Automatic);
            base.set_target(start, step, sine(start));
            let cubic = Cubic::between(start, base.motion(start), step, base.motion(start + step));
            let time = start + between(&mut random, 0.0, 0.9) * step;
            let flight = Flight {
                gap: between(&mut random, 1e-7, 5e-5),
                velocity: between(&mut random, -0.08, 0.04),
                pull: 9.81,
            };
            (base, cubic, time, flight)
        })
        .collect()
}

fn seconds(work: impl FnOnce() -> f64) -> f64 {
    let begun = ProcessTime::now();
    black_box(work());
    begun.elapsed().as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    let cases = cases();
    let capped = |hit: f64| hit.min(1.0);
    let mut taken = [Vec::new(), Vec::new()];
    let hits = cases
        .iter()
        .filter(|(base, _, time, flight)| base.first_hit(*time, flight, 1.0) < 1.0)
        .count();
    for _ in 0..RUNS {
        taken[0].push(seconds(|| {
            cases
                .iter()
                .map(|(_, cubic, time, flight)| capped(cubic.first_hit(*time, flight, 1.0)))
                .sum()
        }));
        taken[1].push(seconds(|| {
            cases
                .iter()
                .map(|(base, _, time, flight)| capped(base.first_hit(*time, flight, 1.0)))
                .sum()
        }));
    }
    let [cubic, quintic] = taken.map(|taken| 1e9 * median(taken) / FLIGHTS as f64);
    println!("{FLIGHTS} flights, {hits} hits before the end of the path");
    println!("cubic   {cubic:7.1} ns a flight");
    println!(
        "quintic {quintic:7.1} ns a flight, {:.2} times the cubic",
        quintic / cubic
    );
}
