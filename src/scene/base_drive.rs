//! What drives the base of a scene, as a type: its rows in the variable table and how it reads them.

use std::f64::consts::TAU;

use crate::drive::{Drive, FollowsInput, Sine};
use crate::error::Result;

use crate::scene::{TIME, Unit, Values, Variable};

/// A motion of the base that a scene can be bundled with.
pub trait BaseDrive: Drive {
    /// Name on the command line and in the instantiation token.
    const NAME: &'static str;
    /// Whether inputs steer it, so that [`BaseDrive::aim`] changes it.
    const STEERED: bool;

    /// What the displacement at the start depends on, as in [`Scene::initial_dependencies`](crate::scene::Scene).
    const DISPLACEMENT_AT_START: &'static [&'static str];
    /// What the acceleration at the start depends on.
    const ACCELERATION_AT_START: &'static [&'static str];
    /// What [`BaseDrive::frequency`] depends on.
    const FREQUENCY: &'static [&'static str];

    /// Parameters and inputs that it adds to a scene.
    fn variables() -> Vec<Variable>;

    /// The motion from `start_time` \[s\] on.
    ///
    /// # Errors
    /// A combination of values that is no motion.
    fn new(start_time: f64, values: &Values) -> Result<Self>;

    /// Takes the inputs at `time` \[s\] for a step of `duration` \[s\].
    fn aim(&mut self, time: f64, duration: f64, values: &Values);

    /// Frequency \[Hz\] if it is known before the run.
    fn frequency(&self) -> Option<f64>;
}

impl BaseDrive for FollowsInput {
    const NAME: &'static str = "input";
    const STEERED: bool = true;
    const DISPLACEMENT_AT_START: &'static [&'static str] = &["base.displacement"];
    const ACCELERATION_AT_START: &'static [&'static str] = &[];
    const FREQUENCY: &'static [&'static str] = &[];

    fn variables() -> Vec<Variable> {
        vec![
            Variable::input(
                "base.displacement",
                Unit::Metre,
                1e-3,
                "Displacement of the base, up, at the present communication point",
            ),
            Variable::input(
                "base.velocity",
                Unit::MetrePerSecond,
                0.1,
                "Velocity of the base, up, at the present communication point",
            ),
        ]
    }

    fn new(start_time: f64, values: &Values) -> Result<Self> {
        Ok(Self::uniform(
            start_time,
            values.real("base.displacement"),
            values.real("base.velocity"),
        ))
    }

    fn aim(&mut self, time: f64, duration: f64, values: &Values) {
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

/// The sine that the parameters of a scene tell.
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

    fn variables() -> Vec<Variable> {
        vec![
            Variable::parameter(
                "drive.amplitude",
                Unit::Metre,
                0.0..=1.0,
                7.757e-5,
                "Amplitude A of the base, y = A sin(2 pi f t + phase); the default is Gamma = 2 at 80 Hz",
            ),
            Variable::parameter(
                "drive.frequency",
                Unit::Hertz,
                0.0..=1e6,
                80.0,
                "Frequency f of the base",
            ),
            Variable::parameter(
                "drive.phase",
                Unit::Radian,
                -TAU..=TAU,
                0.0,
                "Phase of the base at time zero",
            ),
        ]
    }

    fn new(_start_time: f64, values: &Values) -> Result<Self> {
        Ok(sine_of(values))
    }

    fn aim(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn frequency(&self) -> Option<f64> {
        Some(self.frequency)
    }
}
