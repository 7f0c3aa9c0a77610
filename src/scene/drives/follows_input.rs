//! The base follows the inputs `base.displacement` and `base.velocity`.

use crate::drive::FollowsInput;
use crate::scene::base_drive::{BaseDrive, TERMINAL};
use crate::scene::{Result, Row, Unit, Values};

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
