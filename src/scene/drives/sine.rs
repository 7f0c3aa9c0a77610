//! The base moves as a sine of the parameters `drive.*`.

use std::f64::consts::TAU;

use crate::drive::Sine;
use crate::scene::base_drive::BaseDrive;
use crate::scene::{Result, Row, TIME, Unit, Values};

/// The sine that the parameters of a scene describe.
pub fn sine_of(values: &Values) -> Sine {
    Sine {
        amplitude: values.real("drive.amplitude"),
        frequency: values.real("drive.frequency"),
        phase: values.real("drive.phase"),
    }
}

impl BaseDrive for Sine {
    const NAME: &'static str = "sine";
    const STEERED: bool = false;
    const DISPLACEMENT_AT_START: &'static [&'static str] = &[TIME, "drive.amplitude", "drive.frequency", "drive.phase"];
    const VELOCITY_AT_START: &'static [&'static str] = Self::DISPLACEMENT_AT_START;
    const ACCELERATION_AT_START: &'static [&'static str] = Self::DISPLACEMENT_AT_START;
    const FREQUENCY: &'static [&'static str] = &["drive.frequency"];

    fn rows<M>() -> Vec<Row<M>> {
        vec![
            Row::parameter(
                "drive.amplitude",
                Unit::METRE,
                0.0..=1.0,
                7.757e-5,
                "Amplitude A of the base, y = A sin(2 pi f t + phase); the default is Gamma = 2 at 80 Hz",
            ),
            Row::parameter(
                "drive.frequency",
                Unit::HERTZ,
                0.0..=1e6,
                80.0,
                "Frequency f of the base",
            ),
            Row::parameter(
                "drive.phase",
                Unit::RADIAN,
                -TAU..=TAU,
                0.0,
                "Phase of the base at time zero",
            ),
        ]
    }

    fn new(_start_time: f64, values: &Values) -> Result<Self> {
        Ok(sine_of(values))
    }

    fn set_target(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn frequency(&self) -> Option<f64> {
        Some(self.frequency)
    }
}
