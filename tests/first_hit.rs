//! First hits on moving bases against dense scanning, on a million random flights, grazing ones among them.

use std::f64::consts::{PI, TAU};

use jostle::drive::{Degree, Drive, FirstHit, FollowsInput, Motion, Sine};
use jostle::geometry::Flight;

/// Even numbers in [0, 1), the same on every run.
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn logarithmic(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

/// A flight and the base it meets.
struct Case<D> {
    base: D,
    start: f64,
    flight: Flight,
    normal_up: f64,
    /// Delay at which the flight grazes the base, the likeliest place to miss a hit; zero for flights of no such design.
    grazes_after: f64,
}

impl<D: FirstHit> Case<D> {
    /// Gap and its rate after a delay, by the base's own motion and nothing else.
    fn gap(&self, delay: f64) -> (f64, f64) {
        let (from, to) = (self.base.motion(self.start), self.base.motion(self.start + delay));
        let Flight { gap, velocity, pull } = self.flight;
        let moved = self.normal_up * (to.displacement - from.displacement - from.velocity * delay);
        let sped = self.normal_up * (to.velocity - from.velocity);
        (
            gap + delay * (velocity - 0.5 * pull * delay) - moved,
            velocity - pull * delay - sped,
        )
    }

    fn first_hit(&self) -> f64 {
        self.base.first_hit(self.start, &self.flight, self.normal_up)
    }

    /// No gap before the hit may be negative; at the hit it is zero and falling. Returns the hit.
    fn check(&self, scale: f64, rate_scale: f64, horizon: f64, scans: u32) -> f64 {
        let hit = self.first_hit();
        let description = || {
            format!(
                "{:?} n_y {} start {} hit {hit}",
                self.flight, self.normal_up, self.start
            )
        };
        assert!(hit >= 0.0, "{}", description());
        let until = hit.min(horizon);
        let grazing = (self.grazes_after < until).then_some(self.grazes_after);
        let scanned = (1..scans).map(|i| until * f64::from(i) / f64::from(scans));
        for delay in scanned.chain(grazing) {
            assert!(
                self.gap(delay).0 > -1e-12 * scale,
                "passed a root at {delay}: {}",
                description()
            );
        }
        if hit < f64::INFINITY && hit > 0.0 {
            let (gap, rate) = self.gap(hit);
            // Where the gap comes in at a grazing angle its root is only as sharp as its rate.
            assert!(gap.abs() < 1e-12 * scale, "gap {gap}: {}", description());
            assert!(rate < 1e-6 * rate_scale, "rate {rate}: {}", description());
        }
        hit
    }
}

/// A sinusoidal base and a flight of any kind: falling, rising, just off, chattering, along a wall of any tilt, grazing.
fn sine_case(random: &mut Uniform) -> Case<Sine> {
    let frequency = random.logarithmic(5.0, 200.0);
    let omega = TAU * frequency;
    let normal_up = match random.next() {
        p if p < 0.5 => 1.0,
        p if p < 0.9 => random.between(0.05, 1.0),
        _ => random.between(-1.0, -0.05),
    };
    let pull = 9.81 * normal_up;
    let amplitude = random.logarithmic(0.1, 10.0) * 9.81 / (omega * omega);
    let base = Sine {
        amplitude,
        frequency,
        phase: random.between(0.0, TAU),
    };
    let speed = amplitude * omega;
    let start = random.between(0.0, 10.0 / frequency);
    let mut grazes_after = 0.0;
    let (gap, velocity) = match random.next() {
        p if p < 0.3 => (
            random.logarithmic(1e-6, 30.0) * amplitude,
            random.between(-3.0, 3.0) * speed,
        ),
        p if p < 0.6 => (0.0, random.logarithmic(1e-9, 5.0) * speed),
        p if p < 0.7 => (
            random.logarithmic(1e-3, 3.0) * amplitude,
            -random.logarithmic(1e-4, 0.1) * speed,
        ),
        _ => {
            // Tangent to the base, but for a little, at a phase where the base may be grazed and a delay from now.
            let delay = random.logarithmic(0.01, 4.0) / frequency;
            let (now, then) = (base.motion(start), base.motion(start + delay));
            let departure = amplitude * random.between(-1.0, 1.0).signum() * random.logarithmic(1e-16, 1e-2);
            grazes_after = delay;
            let velocity = normal_up * (then.velocity - now.velocity) + pull * delay;
            let moved = normal_up * (then.displacement - now.displacement - now.velocity * delay);
            (moved + departure - delay * (velocity - 0.5 * pull * delay), velocity)
        }
    };
    Case {
        base,
        start,
        flight: Flight { gap, velocity, pull },
        normal_up,
        grazes_after,
    }
}

fn scan_sines(flights: u32, scans: u32, seed: u64) {
    let mut random = Uniform(seed);
    let (mut hits, mut immediate, mut never) = (0, 0, 0);
    for _ in 0..flights {
        let case = sine_case(&mut random);
        if case.flight.gap < 0.0 {
            continue;
        }
        let Sine {
            amplitude, frequency, ..
        } = case.base;
        let horizon = 10.0 / frequency;
        let speed = TAU * frequency * amplitude;
        let far = case.flight.gap + case.flight.velocity.abs() / frequency + 9.81 / frequency.powi(2);
        match case.check(amplitude + far, speed + case.flight.velocity.abs(), horizon, scans) {
            f64::INFINITY => never += 1,
            0.0 => immediate += 1,
            _ => hits += 1,
        }
    }
    println!("{hits} hits, {immediate} immediate, {never} never");
    assert!(hits > flights / 2 && never > flights / 100);
}

#[test]
fn million_flights_over_a_sine() {
    scan_sines(1_000_000, 40, 1);
}

#[test]
#[ignore = "minutes: the same, scanned densely"]
fn flights_over_a_sine_scanned_densely() {
    scan_sines(4_000_000, 2_000, 2);
}

/// A base on a quintic and a flight over it, hit or not before the quintic ends.
fn quintic_case(random: &mut Uniform) -> (Case<FollowsInput>, f64) {
    let step = random.logarithmic(1e-4, 1e-1);
    let start = random.between(0.0, 10.0);
    let speed = random.logarithmic(1e-3, 1.0);
    let mut motion = |displacement: f64| Motion {
        displacement: random.between(-1.0, 1.0) * displacement,
        velocity: random.between(-1.0, 1.0) * speed,
        acceleration: random.between(-1.0, 1.0) * speed / step,
    };
    let mut base = FollowsInput::starting(start, motion(1e-3), Degree::Automatic);
    base.set_target(start, step, motion(speed * step));
    let normal_up = if random.next() < 0.5 {
        1.0
    } else {
        random.between(-1.0, 1.0)
    };
    let pull = 9.81 * normal_up;
    let since = step * random.between(0.0, 0.5);
    let distance = speed * step;
    let mut grazes_after = 0.0;
    let (gap, velocity) = match random.next() {
        p if p < 0.4 => (
            random.logarithmic(1e-6, 3.0) * distance,
            random.between(-1.0, 1.0) * speed,
        ),
        p if p < 0.6 => (0.0, random.logarithmic(1e-9, 1.0) * speed),
        _ => {
            let delay = step * random.between(0.01, 0.5);
            let (now, then) = (base.motion(start + since), base.motion(start + since + delay));
            let departure = distance * random.between(-1.0, 1.0).signum() * random.logarithmic(1e-16, 1e-2);
            grazes_after = delay;
            let velocity = normal_up * (then.velocity - now.velocity) + pull * delay;
            let moved = normal_up * (then.displacement - now.displacement - now.velocity * delay);
            (moved + departure - delay * (velocity - 0.5 * pull * delay), velocity)
        }
    };
    let case = Case {
        base,
        start: start + since,
        flight: Flight { gap, velocity, pull },
        normal_up,
        grazes_after,
    };
    (case, step - since)
}

fn scan_quintics(flights: u32, scans: u32) {
    let mut random = Uniform(3);
    let (mut hits, mut never) = (0, 0);
    for _ in 0..flights {
        let (case, left) = quintic_case(&mut random);
        if case.flight.gap < 0.0 {
            continue;
        }
        // Positions of the base carry the rounding of times near ten seconds.
        let base = case.base.motion(case.start);
        let speed = base.velocity.abs() + case.flight.velocity.abs() + (9.81 + base.acceleration.abs()) * left;
        let scale = 1e-3 + case.flight.gap + speed * left;
        let hit = case.check(scale + 1e-2 * speed, speed, left, scans);
        assert!(hit <= left * (1.0 + 1e-12) || hit == f64::INFINITY);
        if hit < f64::INFINITY { hits += 1 } else { never += 1 }
    }
    println!("{hits} hits, {never} not on this quintic");
    assert!(hits > flights / 4 && never > flights / 20);
}

#[test]
fn million_flights_over_a_quintic() {
    scan_quintics(1_000_000, 40);
}

#[test]
#[ignore = "minutes: the same, scanned densely"]
fn flights_over_a_quintic_scanned_densely() {
    scan_quintics(1_000_000, 2_000);
}

/// The last bounces of a disk that comes to rest: each flight a millionth of the one before, down to 1e-15 of a period.
#[test]
fn chatter_keeps_its_digits() {
    let base = Sine {
        amplitude: 1e-3,
        frequency: 10.0,
        phase: 0.7,
    };
    for velocity in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        let flight = Flight {
            gap: 0.0,
            velocity,
            pull: 9.81,
        };
        let closing = 9.81 + base.motion(0.02).acceleration;
        let expected = 2.0 * velocity / closing;
        let hit = base.first_hit(0.02, &flight, 1.0);
        assert!(
            (hit / expected - 1.0).abs() < 1e-14 + 40.0 * expected,
            "{velocity}: {hit} {expected}"
        );
    }
}

/// Any sizes and signs give a time, and soon.
#[test]
fn delays_of_extreme_flights_are_never_negative_or_nan() {
    let sizes = [0.0, 1e-30, 1e-17, 1e-3, 1.0, 1e6].map(|size| [size, -size]).concat();
    let mut input = FollowsInput::uniform(0.0, 0.0, 0.0);
    let motion = Motion {
        displacement: 1e-5,
        velocity: 0.02,
        acceleration: -3.0,
    };
    input.set_target(0.0, 1e-3, motion);
    for amplitude in [1e-30, 1e-9, 1e-3, 1.0] {
        let sine = Sine {
            amplitude,
            frequency: 50.0,
            phase: 0.3,
        };
        for gap in &sizes {
            for velocity in &sizes {
                for pull in &sizes {
                    for normal_up in &sizes {
                        let flight = Flight {
                            gap: *gap,
                            velocity: *velocity,
                            pull: *pull,
                        };
                        assert!(sine.first_hit(1e-4, &flight, *normal_up) >= 0.0);
                        assert!(input.first_hit(1e-4, &flight, *normal_up) >= 0.0);
                    }
                }
            }
        }
    }
}

/// At a touch without relative velocity the base's acceleration decides: below -g it leaves the disk behind.
#[test]
fn a_disk_at_rest_on_the_base_lifts_off() {
    let base = Sine {
        amplitude: 2.0 * 9.81 / (TAU * 20.0_f64).powi(2),
        frequency: 20.0,
        phase: 0.0,
    };
    let at = |phase: f64, gap: f64| {
        let flight = Flight {
            gap,
            velocity: 0.0,
            pull: 9.81,
        };
        base.first_hit(phase / (TAU * 20.0), &flight, 1.0)
    };
    assert_eq!(at(0.0, 0.0), 0.0);
    assert_eq!(at(-0.5 * PI, 0.0), 0.0);
    assert!(at(0.5 * PI, 0.0) > 0.01 && at(0.5 * PI, 0.0) < 0.1);
    // At the very instant of lift-off, G'' = 0, the third derivative decides; with rounding either way.
    let lift_off = at(PI / 6.0, 0.0);
    assert!(!(1e-7..=0.01).contains(&lift_off));
    // Overlap by rounding is contact.
    assert_eq!(at(0.0, -1e-18), 0.0);
    assert_eq!(at(0.5 * PI, -1e-18), at(0.5 * PI, 0.0));
}

/// A wall that does not move along its normal, and a base that does not move at all, are walls at rest.
#[test]
fn walls_at_rest_are_the_limit() {
    let flight = Flight {
        gap: 5.0,
        velocity: 0.0,
        pull: 10.0,
    };
    let base = Sine {
        amplitude: 1e-3,
        frequency: 10.0,
        phase: 0.0,
    };
    assert_eq!(Sine { amplitude: 0.0, ..base }.first_hit(3.0, &flight, 1.0), 1.0);
    assert_eq!(base.first_hit(3.0, &flight, 0.0), 1.0);
    let rest = FollowsInput::uniform(3.0, 0.1, 0.0);
    assert!((rest.first_hit(3.0, &Flight { pull: 40.0, ..flight }, 1.0) - 0.5).abs() < 1e-15);
    assert_eq!(rest.first_hit(3.0, &Flight { pull: 9.9, ..flight }, 1.0), f64::INFINITY);
}
