//! Scenes: engines, laws, drives and measures wired together, with their parameters, ranges and variables.
//!
//! A [`Scene`] is all that the FMI boundary and the command line need to know; a Rust program takes a [`Simulation`] of
//! it, or an [`AnySimulation`] if the scene is chosen by name at run time. None of them names FMI.

mod any_simulation;
pub mod base_drive;
pub mod catalogue;
pub mod hard_disks;
pub mod packing;
pub mod ratchet;
#[cfg(feature = "toml")]
mod recipe;
mod simulation;
pub mod three_disk;
pub mod times;
mod units;
pub mod values;
pub mod variables;
pub mod wedge;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::Result;
pub use any_simulation::{AnySimulation, Selection};
#[cfg(feature = "toml")]
pub use recipe::Recipe;
pub use simulation::{Saved, Simulation};
pub use units::Unit;
pub use values::{OutputWriter, Table, Values};
pub use variables::{Causality, Kind, Quantity, Value, Variable};

/// Name of the independent variable of every component.
pub const TIME: &str = "time";

/// What the time step of one soft disk depends on besides its drive: its fastest mode, and the choice of the user.
const STEP_OF_ONE_DISK: &[&str] = &[
    "disk.mass",
    "contact.normal_stiffness",
    "contact.stiffness_ratio",
    "contact.normal_damping",
    "contact.friction",
    "time_step",
];

/// Name without the index at its end: `disk.x` of `disk.x[3]`.
pub fn stem(name: &str) -> &str {
    match name.strip_suffix(']').and_then(|rest| rest.rsplit_once('[')) {
        Some((stem, _)) => stem,
        None => name,
    }
}

/// What is decided when a component is bundled and can be decided no later, since it changes the list of variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, serde::Deserialize)]
pub struct Choice {
    /// Number of disks.
    pub disks: u32,
}

/// Static facts of a scene, for the model description, the documentation page and the command line.
#[derive(Debug, Clone, PartialEq)]
pub struct Card {
    /// Scene, such as `packing`.
    pub scene: &'static str,
    /// Model identifier, file name and C identifier at once, such as `jostle_packing`.
    pub identifier: &'static str,
    /// Engine, such as `molecular-dynamics`.
    pub engine: &'static str,
    /// Drive, such as `input` or `sine`.
    pub drive: &'static str,
    /// One sentence.
    pub description: &'static str,
    /// HTML fragment with the equations and their sources, for the documentation page.
    pub equations: &'static str,
    /// Allowed disk counts.
    pub disks: std::ops::RangeInclusive<u32>,
    /// Disk count when none is chosen.
    pub default_disks: u32,
    /// Default experiment: stop time \[s\].
    pub stop_time: f64,
    /// Default experiment: communication step \[s\].
    pub step_size: f64,
}

/// Where a step ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// Time \[s\]; before the end of the step only if there was an event.
    pub time: f64,
    /// An event happened at that time.
    pub event: bool,
}

/// A scene of disks that can be stepped, looked at, saved and restored.
///
/// Contract: the parameters are frozen in [`Scene::new`]. [`Scene::advance_to`] either reaches `end_time` or leaves the
/// state as it was. Looking never disturbs: [`Scene::write_outputs`] takes `&self`. Equal states with equal inputs give
/// equal bits.
pub trait Scene: Sized + Send + 'static {
    /// Everything that changes with time, the report of the last step included.
    type State: Clone + PartialEq + Serialize + DeserializeOwned + Send;

    /// Has events that an importer may want to stop at: [`Scene::advance_to_event`] finds them.
    const EVENTS: bool = false;

    /// Static facts.
    fn card() -> Card;

    /// The rows for this choice: parameters, then inputs, then calculated parameters and outputs.
    fn variables(choice: Choice) -> Vec<Variable>;

    /// What the computed row called `name` depends on while the scene is initialised: names of parameters and inputs, and
    /// [`TIME`] where the start time matters; names that are no rows do not count. `None` says that it may be all of them.
    /// One list for all rows `name[1]`, `name[2]`, ... and for any number of disks. Held by `tests/initial_unknowns.rs`.
    fn initial_dependencies(_name: &str) -> Option<Vec<&'static str>> {
        None
    }

    /// Builds the scene at `start_time` \[s\] from the parameters among `values` and the inputs as they stand.
    ///
    /// # Errors
    /// A parameter that the scene cannot work with, by name.
    fn new(choice: Choice, start_time: f64, values: &Values) -> Result<Self>;

    /// Advances to `end_time` \[s\] under the inputs among `values`.
    ///
    /// # Errors
    /// The step cannot be done; the state is as before the call.
    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()>;

    /// Advances to the next event, if there is one after the present time and not after `end_time` \[s\], else to
    /// `end_time`, where it is just as after [`Scene::advance_to`]. The event itself is done: going on from there in any
    /// way gives the bits of one step to the same end. Only called where [`Scene::EVENTS`] says so.
    ///
    /// # Errors
    /// As [`Scene::advance_to`].
    fn advance_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.advance_to(end_time, values)?;
        Ok(Reached {
            time: end_time,
            event: false,
        })
    }

    /// Goes on with a step that [`Scene::advance_to_event`] left at an event: inputs that have a course go on along it, and
    /// what is told of a step is told from its beginning. The inputs among `values` are those of the beginning.
    ///
    /// # Errors
    /// As [`Scene::advance_to`].
    fn go_on_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.advance_to_event(end_time, values)
    }

    /// Lets one call of [`Scene::advance_to`] do no more than so much, instead of [`crate::engine::MOST_WORK_IN_A_CALL`].
    /// It holds for this value of the scene, and is no part of its state. A scene whose calls take the same time whatever
    /// is asked of them has nothing to limit.
    fn limit_work(&mut self, _most: u64) {}

    /// Writes every calculated parameter and output, in the order of the rows.
    fn write_outputs(&self, outputs: OutputWriter<'_>);

    /// A copy of the present state.
    fn state(&self) -> Self::State;

    /// Time that `state` has reached \[s\]: the end of the last call, or the start.
    fn time_of(state: &Self::State) -> f64;

    /// Goes back (or on) to a state of this same scene with these same parameters.
    ///
    /// # Errors
    /// The state belongs to another scene, disk count or parameter set, or is damaged. The state is then as before.
    fn restore(&mut self, state: &Self::State) -> Result<()>;
}
