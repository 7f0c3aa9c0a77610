//! The base moves as a sine of the parameters `drive.*`, and the bottom row of disks is fixed to it (P Fig. 1.10).

use crate::drive::{FixedBottom, HeldDisk, Sine};
use crate::scene::base_drive::BaseDrive;
use crate::scene::{Result, Row, Values};

impl BaseDrive for FixedBottom {
    const NAME: &'static str = "sine-fixed-bottom";
    const STEERED: bool = false;
    const DISPLACEMENT_AT_START: &'static [&'static str] = Sine::DISPLACEMENT_AT_START;
    const VELOCITY_AT_START: &'static [&'static str] = Sine::VELOCITY_AT_START;
    const ACCELERATION_AT_START: &'static [&'static str] = Sine::ACCELERATION_AT_START;
    const FREQUENCY: &'static [&'static str] = Sine::FREQUENCY;

    fn rows<M>() -> Vec<Row<M>> {
        Sine::rows()
    }

    fn new(start_time: f64, values: &Values) -> Result<Self> {
        Ok(Self {
            sine: <Sine as BaseDrive>::new(start_time, values)?,
            disks: Vec::new(),
        })
    }

    fn set_target(&mut self, _time: f64, _duration: f64, _values: &Values) {}

    fn frequency(&self) -> Option<f64> {
        self.sine.frequency()
    }

    fn hold(&mut self, disks: &[HeldDisk]) {
        self.disks = disks.to_vec();
    }

    fn continues(&self, other: &Self, _time: f64) -> bool {
        self == other
    }
}
