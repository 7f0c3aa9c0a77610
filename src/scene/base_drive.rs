//! What moves the base of a scene, as a type: the rows of its parameters and inputs, and how it reads them.

use std::f64::consts::TAU;

use crate::drive::{Drive, FollowsInput, Sine};

use super::{Result, Row, TIME, Unit, Values};

/// Terminal of what is coupled at the base. It exists where inputs move the base.
pub const TERMINAL: &str = "base";

/// A motion of the base that a scene can be bundled with.
pub trait BaseDrive: Drive {
    /// Name on the command line and in the instantiation token.
    const NAME: &'static str;
    /// Whether inputs move it, so that [`BaseDrive::set_target`] changes it.
    const STEERED: bool;

    /// What the displacement at the start depends on, as in [`Row::depending_on`](crate::scene::Row::depending_on).
    const DISPLACEMENT_AT_START: &'static [&'static str];
    /// What the acceleration at the start depends on.
    const ACCELERATION_AT_START: &'static [&'static str];
    /// What [`BaseDrive::frequency`] depends on.
    const FREQUENCY: &'static [&'static str];

    /// Parameters and inputs that it adds to a scene.
    fn rows<M>() -> Vec<Row<M>>;

    /// The motion from `start_time` \[s\] on.
    ///
    /// # Errors
    /// A combination of values that is no motion.
    fn new(start_time: f64, values: &Values) -> Result<Self>;

    /// Takes the inputs at `time` \[s\] for a step of `duration` \[s\].
    fn set_target(&mut self, time: f64, duration: f64, values: &Values);

    /// Frequency \[Hz\] if it is known before the run.
    fn frequency(&self) -> Option<f64>;
}

impl BaseDrive for FollowsInput {
    const NAME: &'static str = "input";
    const STEERED: bool = true;
    const DISPLACEMENT_AT_START: &'static [&'static str] = &["base.displacement"];
    const ACCELERATION_AT_START: &'static [&'static str] = &[];
    const FREQUENCY: &'static [&'static str] = &[];

    fn rows<M>() -> Vec<Row<M>> {
        vec![
            Row::input(
                "base.displacement",
                Unit::METRE,
                1e-3,
                "Displacement of the base, up, at the present communication point",
            )
            .with_derivative("base.velocity")
            .in_terminal(TERMINAL, "displacement"),
            Row::input(
                "base.velocity",
                Unit::METRE_PER_SECOND,
                0.1,
                "Velocity of the base, up, at the present communication point",
            )
            .in_terminal(TERMINAL, "velocity"),
        ]
    }

    fn new(start_time: f64, values: &Values) -> Result<Self> {
        Ok(Self::uniform(
            start_time,
            values.real("base.displacement"),
            values.real("base.velocity"),
        ))
    }

    fn set_target(&mut self, time: f64, duration: f64, values: &Values) {
        Self::set_target(
            self,
            time,
            duration,
            values.real("base.displacement"),
            values.real("base.velocity"),
        );
    }

    fn frequency(&self) -> Option<f64> {
        None
    }
}

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
