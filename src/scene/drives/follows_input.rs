//! The base follows the inputs `base.displacement`, `base.velocity` and `base.acceleration_input`.

use super::extrapolated;
use crate::drive::{FollowsInput, Motion};
use crate::scene::base_drive::{BaseDrive, TERMINAL};
use crate::scene::{Result, Row, Unit, Values, Warning};

const DISPLACEMENT: &str = "base.displacement";
const VELOCITY: &str = "base.velocity";
const ACCELERATION: &str = "base.acceleration_input";
const DEGREE: &str = "base.extrapolation_degree";

fn inputs(values: &Values) -> Motion {
    Motion {
        displacement: values.real(DISPLACEMENT),
        velocity: values.real(VELOCITY),
        acceleration: values.real(ACCELERATION),
    }
}

impl BaseDrive for FollowsInput {
    const NAME: &'static str = "input";
    const STEERED: bool = true;
    const DISPLACEMENT_AT_START: &'static [&'static str] = &[DISPLACEMENT];
    const VELOCITY_AT_START: &'static [&'static str] = &[VELOCITY];
    const ACCELERATION_AT_START: &'static [&'static str] = &[ACCELERATION];
    const FREQUENCY: &'static [&'static str] = &[];

    fn rows<M>() -> Vec<Row<M>> {
        vec![
            extrapolated::degree_parameter(DEGREE, "the inputs of the base"),
            Row::input(
                DISPLACEMENT,
                Unit::METRE,
                1e-3,
                "Displacement of the base, up, at the present communication point",
            )
            .with_derivative(VELOCITY)
            .in_terminal(TERMINAL, "displacement"),
            Row::input(
                VELOCITY,
                Unit::METRE_PER_SECOND,
                0.1,
                "Velocity of the base, up, at the present communication point: the rate of base.displacement. Optional: while \
                 it has been 0 throughout, the velocity is that of the displacements so far",
            )
            .with_derivative(ACCELERATION)
            .in_terminal(TERMINAL, "velocity"),
            Row::input(
                ACCELERATION,
                Unit::METRE_PER_SECOND_SQUARED,
                10.0,
                "Acceleration of the base, up, at the present communication point: the rate of base.velocity. Optional: while \
                 it has been 0 throughout, the acceleration is that of the inputs so far",
            )
            .in_terminal(TERMINAL, "acceleration_input"),
        ]
    }

    fn new(start_time: f64, values: &Values) -> Result<Self> {
        Ok(Self::starting(
            start_time,
            inputs(values),
            extrapolated::degree(DEGREE, values),
        ))
    }

    fn set_target(&mut self, time: f64, duration: f64, values: &Values) {
        Self::set_target(self, time, duration, inputs(values));
    }

    fn frequency(&self) -> Option<f64> {
        None
    }

    fn warning(&self, told: &[&'static str]) -> Option<Warning> {
        extrapolated::warning(self.history(), [DISPLACEMENT, VELOCITY, ACCELERATION], told)
    }
}
