//! Contacts that last, against the closed form of the driven, damped oscillator: a disk on a shaken plane, and a disk
//! between the two walls of a shaken wedge, to which `supports` adds the engine of a disk on two supports.
//!
//! On a plane at height b(t): `m y'' = -k_n (y - b) - gamma_n (y' - b') - m g`. In a wedge with walls at slopes
//! +-alpha and without tilt the disk moves up and down by symmetry; both normal and both tangential springs act:
//! `k = 2 (k_n cos^2 alpha + k_t sin^2 alpha)`, damping `2 gamma_n cos^2 alpha`. None has an event, so all show the
//! order of the integrator itself.

use std::f64::consts::{PI, TAU};

use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Sine;
use jostle::engine::dem::{ContactLaws, SoftDiskSetup};
use jostle::geometry::{Disk, Wall};
use jostle::scene::soft_disks::refused_step;

use super::case::{Case, Done, Point, Stopwatch, ladder};
use super::engines::{SoftEngine, each_engine};
use super::impact::contact_period;

pub const RADIUS: f64 = 0.02;
pub const STIFFNESS: f64 = 1e4;
pub const STIFFNESS_RATIO: f64 = 0.77;
pub const GRAVITY: f64 = 9.8;
pub const DAMPING: f64 = 3.0;
/// Periods of the free oscillation that are followed.
const PERIODS: f64 = 8.0;
const REPEATS: usize = 16;
/// Slope of the walls of the wedge: an aperture of 120 degrees.
pub const SLOPE: f64 = PI / 6.0;
pub const FREQUENCY: f64 = 40.0;
pub const AMPLITUDE: f64 = 2e-5;

pub const QUANTITIES: &[(&str, &str)] = &[("height", "error of the height over the amplitude of the base")];

/// A plane and a wedge.
pub fn cases() -> Vec<Case> {
    let end = "after eight periods of its contact";
    let plane = case(
        "on_plane",
        format!("A disk rests on a plane shaken at {FREQUENCY} Hz, A = {AMPLITUDE:e} m, {end}."),
        || Oscillator::on(&[0.0]),
    );
    let wedge = case(
        "in_wedge",
        format!("A disk rests in a wedge of 120 degrees shaken at {FREQUENCY} Hz, A = {AMPLITUDE:e} m, {end}."),
        || Oscillator::on(&[-SLOPE, SLOPE]),
    );
    vec![plane, wedge]
}

fn case(name: &'static str, problem: String, oscillator: fn() -> Oscillator) -> Case {
    let mut points = Vec::new();
    for steps in ladder(22.0, 2.0, 7) {
        each_engine!(points, point(oscillator(), steps));
    }
    Case {
        name,
        problem,
        setting: "time steps a period of the contact",
        reference: "closed form of the driven damped oscillator",
        quantities: QUANTITIES,
        points,
    }
}

/// A disk that stays in contact with all its walls, as a linear oscillator in the vertical.
#[derive(Debug, Clone)]
pub struct Oscillator {
    walls: Vec<Wall>,
    pub mass: f64,
    /// Of all contacts together \[N/m\].
    stiffness: f64,
    /// Of the normals alone, which carry the weight before the tangential springs are stretched \[N/m\].
    normal_stiffness: f64,
    /// Of all contacts together \[kg/s\].
    damping: f64,
}

impl Oscillator {
    pub fn on(slopes: &[f64]) -> Self {
        let sum = |part: fn(f64) -> f64| slopes.iter().map(|&slope| part(slope).powi(2)).sum::<f64>();
        let normal_stiffness = STIFFNESS * sum(f64::cos);
        Self {
            walls: slopes.iter().map(|&slope| Wall::vibrating_slope(slope)).collect(),
            mass: 3.57 * PI * RADIUS * RADIUS,
            stiffness: normal_stiffness + STIFFNESS_RATIO * STIFFNESS * sum(f64::sin),
            normal_stiffness,
            damping: DAMPING * sum(f64::cos),
        }
    }

    /// Period of its oscillation \[s\].
    pub fn period(&self) -> f64 {
        contact_period(self.mass, self.stiffness)
    }

    /// End of the time that is followed \[s\].
    pub fn end(&self) -> f64 {
        PERIODS * self.period()
    }

    /// How far the weight presses the disk in while the tangential springs are not stretched \[m\].
    fn sag(&self) -> f64 {
        self.mass * GRAVITY / self.normal_stiffness
    }

    /// Height of the centre while it touches all walls and presses none, base at rest \[m\].
    fn touching(&self) -> f64 {
        RADIUS / self.walls[0].normal[1]
    }

    fn engine<E: SoftEngine>(&self, step: f64) -> E {
        let laws = ContactLaws {
            normal: LinearDashpot {
                stiffness: STIFFNESS,
                damping: DAMPING,
            },
            tangential: TangentialSpring {
                stiffness: STIFFNESS_RATIO * STIFFNESS,
                friction: 10.0,
            },
        };
        let setup = SoftDiskSetup {
            laws,
            walls: self.walls.clone(),
            masses: vec![self.mass],
            gravity: GRAVITY,
            time_step: step,
            start_time: 0.0,
        };
        let disk = Disk {
            x: 0.0,
            y: self.touching() - self.sag(),
            radius: RADIUS,
        };
        let drive = Sine {
            amplitude: AMPLITUDE,
            frequency: FREQUENCY,
            phase: 0.0,
        };
        E::start(setup, &[disk], drive, &[[0.0; 3]])
    }

    /// Departure \[m\] from the height at the start, which is one of rest, at `time` \[s\].
    pub fn departure(&self, time: f64) -> f64 {
        let (square, rate) = (self.stiffness / self.mass, 0.5 * self.damping / self.mass);
        let (natural, damped) = (square.sqrt(), (square - rate * rate).sqrt());
        let omega = TAU * FREQUENCY;
        // The steady response is the imaginary part of C exp(i omega t), C the transmissibility times A.
        let (re, im) = (natural * natural - omega * omega, 2.0 * rate * omega);
        let modulus = re * re + im * im;
        let real = (natural * natural * re + im * im) / modulus;
        let imaginary = (im * re - natural * natural * im) / modulus;
        let steady = |t: f64| AMPLITUDE * (real * (omega * t).sin() + imaginary * (omega * t).cos());
        let steady_rate = |t: f64| AMPLITUDE * omega * (real * (omega * t).cos() - imaginary * (omega * t).sin());
        let (height, velocity) = (-steady(0.0), -steady_rate(0.0));
        let (sine, cosine) = (damped * time).sin_cos();
        steady(time) + (-rate * time).exp() * (height * cosine + (velocity + rate * height) / damped * sine)
    }
}

fn point<E: SoftEngine>(oscillator: Oscillator, steps: f64) -> Point {
    Point::new(E::METHOD, steps, move |watch: &mut Stopwatch| {
        let fresh = oscillator.engine::<E>(oscillator.period() / steps);
        let mut engines = vec![fresh; REPEATS];
        let end = oscillator.end();
        watch
            .measure(REPEATS as u32, || {
                engines.iter_mut().try_for_each(|engine| engine.advance_to(end))
            })
            .map_err(|breakdown| refused_step(E::METHOD, breakdown))?;
        let height = engines[0].places(1)[0][1] - (oscillator.touching() - oscillator.sag());
        let error = (height - oscillator.departure(end)).abs() / AMPLITUDE;
        Ok(Done::exact([error], E::PASSES * engines[0].steps() as f64))
    })
}
