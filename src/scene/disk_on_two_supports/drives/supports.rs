//! Motions of the supports: random and sinusoidal.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::DiskOnTwoSupportsDrive;
use crate::drive::excitation::{NoiseSign, RandomSupports, SineSupports, Vibration};
use crate::elementary::sin_cos;
use crate::scene::disk_on_two_supports::DiskOnTwoSupportsScene;
use crate::scene::disks_on_base::names;
use crate::scene::drives::sine::sine_of;
use crate::scene::{Derived, Row, TIME, Unit, Values};

/// Displacement of the supports over that of the contacts under the weight.
const SHAKING: Derived = Derived {
    name: "displacement of the supports over the overlap under the weight",
    unit: Unit::ONE,
    value: |real| real("support.amplitude") * real("contact.normal_stiffness") / (real("disk.mass") * real("gravity")),
};

const SIGNS: &[(&str, &str)] = &[
    ("as_drawn", "The noise as generated"),
    ("reversed", "Every displacement and angle of the supports reversed"),
    ("mirrored", "The mirror image: supports exchanged, x and angle reversed"),
];

impl DiskOnTwoSupportsDrive for RandomSupports {
    const NAME: &'static str = "random-supports";
    const DESCRIPTION: &'static str = "Disk on two supports that vibrate randomly";
    const POSITIONS_AT_START: &'static [&'static str] = &["seed", "support.noise", "support.amplitude"];
    const VELOCITIES_AT_START: &'static [&'static str] = &["contact.normal_damping", "support.angular_frequency"];
    const PERIOD: &'static [&'static str] = &["support.angular_frequency", "support.damping_ratio"];

    fn rows<M>() -> Vec<Row<M>> {
        vec![
            Row::long_parameter("seed", 0..=i64::MAX, 1, "Seed of the noise that forces the supports"),
            Row::enumeration_parameter(
                "support.noise",
                "support_noise",
                SIGNS,
                1,
                "Which of the equally likely runs of one seed; means over such pairs scatter less",
            ),
            Row::parameter(
                "support.amplitude",
                Unit::METRE,
                0.0..=1.0,
                5e-5,
                "Root mean square displacement A_b of each support in x and in y; R times that of its angle",
            )
            .recommended_by(
                SHAKING,
                0.0..=1.0,
                "the supports move by more than the disk sinks in and lose contact all the time; the theory is that of lasting contacts.",
            ),
            Row::parameter(
                "support.angular_frequency",
                Unit::RADIAN_PER_SECOND,
                1e-6..=1e6,
                20.0 * PI,
                "Natural angular frequency omega_b of the supports",
            ),
            Row::parameter(
                "support.damping_ratio",
                Unit::ONE,
                1e-6..=100.0,
                0.5,
                "Damping ratio c of the supports",
            ),
        ]
    }

    fn outputs() -> Vec<Row<DiskOnTwoSupportsScene<Self>>> {
        let mut rows = support_rows::<0>("left");
        rows.extend(support_rows::<1>("right"));
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
}

/// Position and velocity of support `INDEX`, which is the `which` one.
fn support_rows<const INDEX: usize>(which: &str) -> Vec<Row<DiskOnTwoSupportsScene<RandomSupports>>> {
    type Read = fn(&DiskOnTwoSupportsScene<RandomSupports>) -> f64;
    let row = |name: &str, (unit, nominal): (Unit, f64), what: &str, further: &[&'static str], read: Read| {
        let at_start = names(&[RandomSupports::POSITIONS_AT_START, further]);
        let (name, what) = (
            format!("support[{}].{name}", INDEX + 1),
            format!("{what} of the {which} support"),
        );
        Row::output(name, unit, nominal, what, read).depending_on(&at_start)
    };
    let (length, angle) = ((Unit::METRE, 1e-4), (Unit::RADIAN, 1e-4));
    let (speed, rate) = ((Unit::METRE_PER_SECOND, 1e-2), (Unit::RADIAN_PER_SECOND, 1e-2));
    let frequency = "support.angular_frequency";
    vec![
        row("x", length, "Displacement to the right", &[], |scene| {
            scene.support(INDEX).place[0]
        }),
        row("y", length, "Displacement up", &[], |scene| {
            scene.support(INDEX).place[1]
        }),
        row("angle", angle, "Angle, counter-clockwise,", &["disk.radius"], |scene| {
            scene.support(INDEX).place[2]
        }),
        row("x_velocity", speed, "Velocity to the right", &[frequency], |scene| {
            scene.support(INDEX).rates[0]
        }),
        row("y_velocity", speed, "Velocity up", &[frequency], |scene| {
            scene.support(INDEX).rates[1]
        }),
        row(
            "angular_velocity",
            rate,
            "Angular velocity, counter-clockwise,",
            &["disk.radius", frequency],
            |scene| scene.support(INDEX).rates[2],
        ),
    ]
}

impl DiskOnTwoSupportsDrive for SineSupports {
    const NAME: &'static str = "sine";
    const DESCRIPTION: &'static str = "Disk on two supports that vibrate sinusoidally";
    /// Without tilt and phase difference all is symmetric, and the disk does not turn.
    const TILT: f64 = 0.1;
    const POSITIONS_AT_START: &'static [&'static str] = &[
        TIME,
        "drive.amplitude",
        "drive.frequency",
        "drive.phase",
        "drive.phase_difference",
        "drive.direction",
    ];
    const VELOCITIES_AT_START: &'static [&'static str] = &["contact.normal_damping"];
    const PERIOD: &'static [&'static str] = &["drive.frequency"];

    fn rows<M>() -> Vec<Row<M>> {
        vec![
            Row::parameter(
                "drive.amplitude",
                Unit::METRE,
                0.0..=1.0,
                4e-3,
                "Amplitude A of the supports, A sin(2 pi f t + phase) along drive.direction; the default is Gamma = 1.6 at 10 Hz",
            ),
            Row::parameter(
                "drive.frequency",
                Unit::HERTZ,
                0.0..=1e6,
                10.0,
                "Frequency f of the supports",
            ),
            Row::parameter(
                "drive.phase",
                Unit::RADIAN,
                -TAU..=TAU,
                0.0,
                "Phase of the left support at time zero",
            ),
            Row::parameter(
                "drive.phase_difference",
                Unit::RADIAN,
                -TAU..=TAU,
                0.0,
                "Phase by which the right support is ahead; at 0 both move as one base",
            ),
            Row::parameter(
                "drive.direction",
                Unit::RADIAN,
                -TAU..=TAU,
                FRAC_PI_2,
                "Direction in which the supports move, counter-clockwise from the right; the default is up",
            ),
        ]
    }

    fn outputs() -> Vec<Row<DiskOnTwoSupportsScene<Self>>> {
        let of_left_support = names(&[&[
            TIME,
            "drive.amplitude",
            "drive.frequency",
            "drive.phase",
            "drive.direction",
        ]]);
        let rows = [
            Row::output(
                "base.position",
                Unit::METRE,
                1e-4,
                "Displacement of the left support up",
                |scene: &DiskOnTwoSupportsScene<Self>| scene.support(0).place[1],
            ),
            Row::output(
                "base.acceleration",
                Unit::METRE_PER_SECOND_SQUARED,
                1.0,
                "Acceleration of the left support up",
                |scene| scene.support(0).accelerations[1],
            ),
        ];
        rows.map(|row| row.depending_on(&of_left_support)).into()
    }

    fn period(values: &Values) -> Option<f64> {
        let frequency = values.real("drive.frequency");
        (frequency > 0.0).then(|| 1.0 / frequency)
    }

    fn new(_start_time: f64, _time_step: f64, values: &Values) -> Self {
        let (sine, cosine) = sin_cos(values.real("drive.direction"));
        Self {
            sine: sine_of(values),
            phase_difference: values.real("drive.phase_difference"),
            direction: [cosine, sine],
        }
    }

    fn continues(&self, other: &Self) -> bool {
        self == other
    }
}
