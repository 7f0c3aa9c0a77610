//! Motions of the supports: random and sinusoidal.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::ThreeDiskDrive;
use crate::drive::excitation::{NoiseSign, RandomSupports, SineSupports, SupportMotion, Vibration};
use crate::scene::base_drive::sine_of;
use crate::scene::{OutputWriter, TIME, Unit, Values, Variable};

const SIGNS: &[(&str, &str)] = &[
    ("as_drawn", "The noise as drawn"),
    ("reversed", "Every displacement and angle of the supports reversed"),
    (
        "mirrored",
        "As seen in a mirror: supports exchanged, x and angle reversed",
    ),
];

impl ThreeDiskDrive for RandomSupports {
    const NAME: &'static str = "random-supports";
    const IDENTIFIER: &'static str = "jostle_three_disk_random_supports";
    const DESCRIPTION: &'static str = "Disk on two supports that vibrate randomly";
    const PLACES_AT_START: &'static [&'static str] = &["seed", "support.noise", "support.amplitude"];
    const RATES_AT_START: &'static [&'static str] = &["contact.normal_damping", "support.angular_frequency"];
    const PERIOD: &'static [&'static str] = &["support.angular_frequency", "support.damping_ratio"];

    fn output_at_start(name: &str) -> Vec<&'static str> {
        let member = name.strip_prefix("support[").and_then(|rest| rest.split_once("]."));
        let further: &[&str] = match member {
            Some((_, "x" | "y")) => &[],
            Some((_, "x_velocity" | "y_velocity")) => &["support.angular_frequency"],
            Some((_, "angle")) => &["disk.radius"],
            Some((_, "angular_velocity")) => &["disk.radius", "support.angular_frequency"],
            _ => return Vec::new(),
        };
        [Self::PLACES_AT_START, further].concat()
    }

    fn variables() -> Vec<Variable> {
        vec![
            Variable::long_parameter("seed", 0..=i64::MAX, 1, "Seed of the noise that forces the supports"),
            Variable::enumeration_parameter(
                "support.noise",
                "support_noise",
                SIGNS,
                1,
                "Which of the equally likely runs of one seed; means over such pairs scatter less",
            ),
            Variable::parameter(
                "support.amplitude",
                Unit::Metre,
                0.0..=1.0,
                5e-5,
                "Root mean square displacement A_b of each support in x and in y; R times that of its angle",
            ),
            Variable::parameter(
                "support.angular_frequency",
                Unit::RadianPerSecond,
                1e-6..=1e6,
                20.0 * std::f64::consts::PI,
                "Natural angular frequency omega_b of the supports",
            ),
            Variable::parameter(
                "support.damping_ratio",
                Unit::One,
                1e-6..=100.0,
                0.5,
                "Damping ratio c of the supports",
            ),
        ]
    }

    fn outputs() -> Vec<Variable> {
        let mut rows = Vec::new();
        for (index, which) in [(1, "left"), (2, "right")] {
            let row = |name: &str, unit, nominal, what: &str| {
                Variable::output(
                    format!("support[{index}].{name}"),
                    unit,
                    nominal,
                    format!("{what} of the {which} support"),
                )
            };
            rows.extend([
                row("x", Unit::Metre, 1e-4, "Displacement to the right"),
                row("y", Unit::Metre, 1e-4, "Displacement up"),
                row("angle", Unit::Radian, 1e-4, "Angle, counter-clockwise,"),
                row("x_velocity", Unit::MetrePerSecond, 1e-2, "Velocity to the right"),
                row("y_velocity", Unit::MetrePerSecond, 1e-2, "Velocity up"),
                row(
                    "angular_velocity",
                    Unit::RadianPerSecond,
                    1e-2,
                    "Angular velocity, counter-clockwise,",
                ),
            ]);
        }
        rows
    }

    fn period(values: &Values) -> Option<f64> {
        // Strong damping is faster than the oscillator.
        let ratio = values.real("support.damping_ratio");
        Some(TAU / (values.real("support.angular_frequency") * (2.0 * ratio).max(1.0)))
    }

    fn new(_start_time: f64, time_step: f64, values: &Values) -> Self {
        let amplitude = values.real("support.amplitude");
        let vibration = Vibration {
            amplitude,
            angle: amplitude / values.real("disk.radius"),
            angular_frequency: values.real("support.angular_frequency"),
            damping_ratio: values.real("support.damping_ratio"),
            seed: values.integer("seed") as u64,
            sign: match values.integer("support.noise") {
                1 => NoiseSign::AsDrawn,
                2 => NoiseSign::Reversed,
                _ => NoiseSign::Mirrored,
            },
        };
        Self::new(&vibration, time_step)
    }

    fn continues(&self, other: &Self) -> bool {
        Self::continues(self, other)
    }

    fn write(outputs: &mut OutputWriter<'_>, _torque: f64, supports: &[SupportMotion; 2]) {
        for (index, support) in (1..).zip(supports) {
            let ([x, y, angle], [vx, vy, turning]) = (support.place, support.rates);
            for (name, value) in [
                ("x", x),
                ("y", y),
                ("angle", angle),
                ("x_velocity", vx),
                ("y_velocity", vy),
                ("angular_velocity", turning),
            ] {
                outputs.real(&format!("support[{index}].{name}"), value);
            }
        }
    }
}

impl ThreeDiskDrive for SineSupports {
    const NAME: &'static str = "sine";
    const IDENTIFIER: &'static str = "jostle_three_disk_sine";
    const DESCRIPTION: &'static str = "Disk on two supports that vibrate sinusoidally";
    const PLACES_AT_START: &'static [&'static str] = &[
        TIME,
        "drive.amplitude",
        "drive.frequency",
        "drive.phase",
        "drive.phase_difference",
        "drive.direction",
    ];
    const RATES_AT_START: &'static [&'static str] = &["contact.normal_damping"];
    const PERIOD: &'static [&'static str] = &["drive.frequency"];

    fn output_at_start(name: &str) -> Vec<&'static str> {
        let of_left = |known: &&&str| **known != "drive.phase_difference";
        match name {
            "base.position" | "base.acceleration" => Self::PLACES_AT_START.iter().filter(of_left).copied().collect(),
            _ => Vec::new(),
        }
    }

    fn variables() -> Vec<Variable> {
        vec![
            Variable::parameter(
                "drive.amplitude",
                Unit::Metre,
                0.0..=1.0,
                1e-4,
                "Amplitude A of the supports, A sin(2 pi f t + phase) along drive.direction",
            ),
            Variable::parameter(
                "drive.frequency",
                Unit::Hertz,
                0.0..=1e6,
                10.0,
                "Frequency f of the supports",
            ),
            Variable::parameter(
                "drive.phase",
                Unit::Radian,
                -TAU..=TAU,
                0.0,
                "Phase of the left support at time zero",
            ),
            Variable::parameter(
                "drive.phase_difference",
                Unit::Radian,
                -TAU..=TAU,
                0.0,
                "Phase by which the right support is ahead; at 0 both move as one base",
            ),
            Variable::parameter(
                "drive.direction",
                Unit::Radian,
                -TAU..=TAU,
                FRAC_PI_2,
                "Direction in which the supports move, counter-clockwise from the right; the default is up",
            ),
        ]
    }

    fn outputs() -> Vec<Variable> {
        vec![
            Variable::output(
                "base.position",
                Unit::Metre,
                1e-4,
                "Displacement of the left support up",
            ),
            Variable::output(
                "base.acceleration",
                Unit::MetrePerSecondSquared,
                1.0,
                "Acceleration of the left support up",
            ),
        ]
    }

    fn period(values: &Values) -> Option<f64> {
        let frequency = values.real("drive.frequency");
        (frequency > 0.0).then(|| 1.0 / frequency)
    }

    fn new(_start_time: f64, _time_step: f64, values: &Values) -> Self {
        let (sine, cosine) = values.real("drive.direction").sin_cos();
        Self {
            sine: sine_of(values),
            phase_difference: values.real("drive.phase_difference"),
            direction: [cosine, sine],
        }
    }

    fn continues(&self, other: &Self) -> bool {
        self == other
    }

    fn write(outputs: &mut OutputWriter<'_>, _torque: f64, supports: &[SupportMotion; 2]) {
        outputs.real("base.position", supports[0].place[1]);
        outputs.real("base.acceleration", supports[0].accelerations[1]);
    }
}
