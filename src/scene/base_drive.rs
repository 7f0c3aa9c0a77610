//! What moves the base of a scene, as a type: the rows of its parameters and inputs, and how it reads them. The types that
//! there are stand in [`drives`](super::drives), one a file.

use crate::drive::{Drive, HeldDisk};

use super::{Result, Row, Values, Warning};

/// Terminal of what is coupled at the base. It exists where inputs move the base.
pub const TERMINAL: &str = "base";

/// A motion of the base that a scene can be bundled with.
pub trait BaseDrive: Drive {
    /// Name on the command line and in the instantiation token.
    const NAME: &'static str;
    /// Whether inputs move it, so that [`BaseDrive::set_target`] changes it.
    const STEERED: bool;

    /// Parts of a step after which an importer may renew inputs, if it offers them inside of steps: [`Model::INPUT_PARTS`].
    ///
    /// [`Model::INPUT_PARTS`]: crate::scene::Model::INPUT_PARTS
    const INPUT_PARTS: u32 = if Self::STEERED { 4 } else { 0 };

    /// What the displacement at the start depends on, as in [`Row::depending_on`](crate::scene::Row::depending_on).
    const DISPLACEMENT_AT_START: &'static [&'static str];
    /// What the velocity at the start depends on.
    const VELOCITY_AT_START: &'static [&'static str];
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

    /// Takes the disks that stand on the floor, if it moves disks.
    fn hold(&mut self, _disks: &[HeldDisk]) {}

    /// Whether `other` can be the drive of a state of this run at `time` \[s\]: states come from outside.
    fn continues(&self, _other: &Self, _time: f64) -> bool {
        true
    }

    /// What is doubtful of the inputs so far.
    fn warning(&self, _told: &[&'static str]) -> Option<Warning> {
        None
    }
}
