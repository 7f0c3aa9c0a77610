//! What turns the disk, as a type: its rows in the variable table and how it reads them.

mod supports;
mod torque;

use crate::drive::excitation::{Excitation, SupportMotion};
use crate::scene::{OutputWriter, Values, Variable};

/// An excitation that the scene can be bundled with.
pub trait ThreeDiskDrive: Excitation {
    /// Name on the command line and in the instantiation token.
    const NAME: &'static str;
    /// Model identifier.
    const IDENTIFIER: &'static str;
    /// One sentence.
    const DESCRIPTION: &'static str;

    /// What the places of the supports depend on at the start, as in
    /// [`Scene::initial_dependencies`](crate::scene::Scene::initial_dependencies).
    const PLACES_AT_START: &'static [&'static str] = &[];
    /// What their rates, and thus the forces of dashpots, depend on besides.
    const RATES_AT_START: &'static [&'static str] = &[];
    /// What [`ThreeDiskDrive::period`] depends on.
    const PERIOD: &'static [&'static str] = &[];

    /// What an output of its own depends on at the start.
    fn output_at_start(_name: &str) -> Vec<&'static str> {
        Vec::new()
    }

    /// Parameters and inputs that it adds to the scene.
    fn variables() -> Vec<Variable>;

    /// Outputs that it adds.
    fn outputs() -> Vec<Variable>;

    /// Shortest period \[s\] that steps of time have to resolve.
    fn period(values: &Values) -> Option<f64>;

    /// First duration \[s\] of the batches of the running mean, if some duration is better than others.
    fn batch(_values: &Values) -> Option<f64> {
        None
    }

    /// The excitation from `start_time` \[s\] on, in cells of `time_step` \[s\].
    fn new(start_time: f64, time_step: f64, values: &Values) -> Self;

    /// Takes the inputs at `time` \[s\]; says whether anything changes by them.
    fn aim(&mut self, _time: f64, _values: &Values) -> bool {
        false
    }

    /// Whether `other` can be an earlier or later state of the same excitation.
    fn continues(&self, other: &Self) -> bool;

    /// Writes what [`ThreeDiskDrive::outputs`] lists.
    /// Given are the torque and the motion of the supports now.
    fn write(outputs: &mut OutputWriter<'_>, torque: f64, supports: &[SupportMotion; 2]);
}
