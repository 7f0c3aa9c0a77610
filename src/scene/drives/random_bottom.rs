//! The base is at rest, and the disks of the bottom row vibrate randomly, each in a circle about its place (P 1.3).

use std::f64::consts::TAU;

use crate::drive::{HeldDisk, RandomBottom, RandomVibration};
use crate::scene::base_drive::BaseDrive;
use crate::scene::{Result, Row, Unit, Values};

const ANGULAR_FREQUENCY: &str = "bottom.angular_frequency";
const DAMPING_RATIO: &str = "bottom.damping_ratio";

impl BaseDrive for RandomBottom {
    const NAME: &'static str = "random-bottom";
    const STEERED: bool = false;
    /// Base and bottom row start at rest.
    const DISPLACEMENT_AT_START: &'static [&'static str] = &[];
    const VELOCITY_AT_START: &'static [&'static str] = &[];
    const ACCELERATION_AT_START: &'static [&'static str] = &[];
    const FREQUENCY: &'static [&'static str] = &[ANGULAR_FREQUENCY, DAMPING_RATIO];

    fn rows<M>() -> Vec<Row<M>> {
        vec![
            Row::parameter(
                "bottom.radius",
                Unit::METRE,
                0.0..=1.0,
                1e-4,
                "Radius epsilon of the circle about its place that the centre of each disk of the bottom row stays in",
            ),
            Row::parameter(
                ANGULAR_FREQUENCY,
                Unit::RADIAN_PER_SECOND,
                1e-6..=1e6,
                80.0 * TAU,
                "Natural angular frequency of the oscillators, forced by white noise, that displace the bottom row",
            ),
            Row::parameter(
                DAMPING_RATIO,
                Unit::ONE,
                1e-6..=100.0,
                0.5,
                "Damping ratio of these oscillators",
            ),
            Row::long_parameter("bottom.seed", 0..=i64::MAX, 1, "Seed of the noise that forces them"),
        ]
    }

    fn new(start_time: f64, values: &Values) -> Result<Self> {
        let vibration = RandomVibration {
            radius: values.real("bottom.radius"),
            angular_frequency: values.real(ANGULAR_FREQUENCY),
            damping_ratio: values.real(DAMPING_RATIO),
            seed: values.integer("bottom.seed") as u64,
        };
        Ok(Self::new(vibration, start_time))
    }

    fn set_target(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn frequency(&self) -> Option<f64> {
        Some(1.0 / self.vibration().period())
    }

    fn hold(&mut self, disks: &[HeldDisk]) {
        Self::hold(self, disks);
    }

    fn continues(&self, other: &Self, time: f64) -> bool {
        Self::continues(self, other, time)
    }
}
