//! What advances time, and what a scene needs of it.

mod contact_now;
pub mod dem;
mod disk_motion;
pub mod disk_on_two_supports;
pub mod event_driven;
mod interruption;
pub mod threads;
pub mod wedge;
pub mod work_budget;

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use contact_now::{ContactNow, Touched};
pub use disk_motion::DiskMotion;
pub use interruption::{Question, interruptible};
pub use work_budget::{MOST_WORK_IN_A_CALL, WorkBudget};

/// What a scene needs of an engine.
///
/// Contract: the trajectory does not depend on the times to which it is advanced or at which it is observed.
pub trait Engine: Sized + Send + 'static {
    /// Everything that changes with time.
    type State: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static;
    /// Why the engine cannot go on.
    type Stop;

    /// Advances to `end_time` \[s\] and takes the work that it costs off `budget`.
    ///
    /// # Errors
    /// The engine cannot go on, or the budget is too small. Unless the engine says that nothing has changed then, its state is
    /// of no use until one is restored.
    fn advance_within(&mut self, end_time: f64, budget: &mut WorkBudget) -> Result<(), Self::Stop>;

    /// Advances to `end_time` \[s\] within the default budget.
    ///
    /// # Errors
    /// As [`Self::advance_within`].
    fn advance_to(&mut self, end_time: f64) -> Result<(), Self::Stop> {
        self.advance_within(end_time, &mut WorkBudget::default())
    }

    /// A copy of all that the future depends on.
    fn copied_state(&self) -> Self::State;

    /// The same into a state that is there, which allocates nothing where there is room: the backup of every step.
    fn copy_state_to(&self, state: &mut Self::State) {
        *state = self.copied_state();
    }

    /// Whether `state`, observed at `time` \[s\], can be one of this run.
    fn fits(&self, state: &Self::State, time: f64) -> bool;

    /// Continues from a `state` that fits, observed at `time` \[s\].
    ///
    /// # Errors
    /// The observation at `time` cannot be computed. Nothing has changed then.
    fn restore(&mut self, state: &Self::State, time: f64) -> Result<(), Self::Stop>;
}
