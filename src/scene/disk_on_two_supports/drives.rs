//! What turns the disk, as a type: its rows and how it reads its parameters and inputs.

mod supports;
mod torque;

use crate::drive::excitation::Excitation;
use crate::scene::{Row, Values, Warning};

use super::DiskOnTwoSupportsScene;

/// An excitation that the scene can be bundled with.
pub trait DiskOnTwoSupportsDrive: Excitation {
    /// Name on the command line and in the instantiation token.
    const NAME: &'static str;
    /// One sentence.
    const DESCRIPTION: &'static str;

    /// Terminal of the inputs that turn the disk, to which its angle belongs too, if there are any.
    const TERMINAL: Option<&'static str> = None;

    /// Start value of the parameter `tilt` \[rad\].
    const TILT: f64 = 0.0;

    /// What the positions of the supports depend on at the start, as in [`Row::depending_on`].
    const POSITIONS_AT_START: &'static [&'static str] = &[];
    /// What their velocities, and thus the forces of dashpots, depend on besides.
    const VELOCITIES_AT_START: &'static [&'static str] = &[];
    /// What [`DiskOnTwoSupportsDrive::period`] depends on.
    const PERIOD: &'static [&'static str] = &[];

    /// Parameters and inputs that it adds to the scene.
    fn rows<M>() -> Vec<Row<M>>;

    /// Outputs that it adds.
    fn outputs() -> Vec<Row<DiskOnTwoSupportsScene<Self>>> {
        Vec::new()
    }

    /// Shortest period \[s\] that time steps have to resolve.
    fn period(values: &Values) -> Option<f64>;

    /// First duration \[s\] of the batches of the running mean, if some duration is better than others.
    fn batch(_values: &Values) -> Option<f64> {
        None
    }

    /// The excitation from `start_time` \[s\] on, in time steps of `time_step` \[s\].
    fn new(start_time: f64, time_step: f64, values: &Values) -> Self;

    /// Takes the inputs at `time` \[s\] for a step to `end` \[s\]; says whether they change what the drive does.
    fn set_target(&mut self, _time: f64, _end: f64, _values: &Values) -> bool {
        false
    }

    /// What is doubtful of the inputs so far.
    fn warning(&self, _told: &[&'static str]) -> Option<Warning> {
        None
    }

    /// Whether `other` can be an earlier or later state of the same excitation.
    fn continues(&self, other: &Self) -> bool;
}
