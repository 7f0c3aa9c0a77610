//! What a model is: the one trait that an author implements.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::Result;
use crate::info::ModelInfo;
use crate::listing::Listing;
use crate::row::Row;
use crate::structure::StructuralParameters;
use crate::values::Values;

/// Where a step ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// Time \[s\]; before the end of the step only if there was an event.
    pub time: f64,
    /// An event happened at that time.
    pub event: bool,
}

/// What is doubtful about a run, though nothing is refused.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// What it is about: after the first warnings of a topic no others of it are told.
    pub topic: &'static str,
    /// What is doubtful, its values, and the remedy.
    pub text: String,
}

/// A model that can be stepped, observed, saved and restored.
///
/// Contract: the parameters are frozen in [`Model::new`], but for tunable ones, which change in [`Model::tune`] alone. [`Model::advance_to`] either reaches `end_time` or leaves the state
/// as it was. Reading an output changes nothing. Equal states with equal inputs give equal bits.
pub trait Model: Sized + Send + 'static {
    /// Everything that changes with time and that an output is computed from.
    type State: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static;

    /// The model has events that an importer may want to stop at: [`Model::advance_to_event`] finds them.
    const EVENTS: bool = false;

    /// Parts of equal length into which a step is divided for an importer that offers inputs inside of it; 0 for a model that takes
    /// inputs at the beginning of a step alone. The first part is [`Model::advance_to_event`], the others [`Model::resume_to_event`].
    const INPUT_PARTS: u32 = 0;

    /// Static facts.
    fn info() -> ModelInfo;

    /// The variables for these structural parameters: parameters and inputs first, then what is computed.
    fn variables(structure: &StructuralParameters) -> Vec<Row<Self>>;

    /// Lists whose length changes with time, which programs can ask for besides the variables.
    fn listings() -> Vec<Listing<Self>> {
        Vec::new()
    }

    /// Builds the model at `start_time` \[s\] from the parameters among `values` and the inputs as they stand.
    ///
    /// # Errors
    /// A parameter that the model cannot work with, by name.
    fn new(structure: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self>;

    /// Takes over the tunable parameters among `values` at the present time. Called before a step if one of them has changed since the
    /// last step, and before [`Model::restore`] if the state was saved under others; never if no row is [`Row::tunable`].
    ///
    /// What the model keeps of the tunable parameters outside of [`Model::State`] must depend on their present values alone, not on those
    /// before; whatever else changes must be part of the state. The same values once more change nothing.
    ///
    /// # Errors
    /// Values that do not go together, by the name of a parameter. The model is then as before the call.
    fn tune(&mut self, _values: &Values) -> Result<()> {
        panic!("a model with tunable parameters says in `Model::tune` how it takes them over")
    }

    /// Advances to `end_time` \[s\] under the inputs among `values`.
    ///
    /// # Errors
    /// The step cannot be done; the state is as before the call.
    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()>;

    /// Advances to the next event, if there is one after the present time and not after `end_time` \[s\], else to
    /// `end_time`, where the state is the one after [`Model::advance_to`]. The event itself is handled: any way of going on from
    /// there gives the bits of one step to the same end. Only called where [`Model::EVENTS`] is true
    /// or [`Model::INPUT_PARTS`] is above 0.
    ///
    /// # Errors
    /// As [`Model::advance_to`].
    fn advance_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.advance_to(end_time, values)?;
        Ok(Reached {
            time: end_time,
            event: false,
        })
    }

    /// Resumes a step that [`Model::advance_to_event`] ended at an event or at the end of a part: inputs with a given rate continue at that rate, and
    /// quantities of a whole step count from its beginning. The inputs among `values` are those of the beginning, unless
    /// [`Model::INPUT_PARTS`] is above 0: then they are those of now.
    ///
    /// # Errors
    /// As [`Model::advance_to`].
    fn resume_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        self.advance_to_event(end_time, values)
    }

    /// Limits the work of one call of [`Model::advance_to`]. It holds for this value of the model and is no part of its state. A
    /// model whose calls take the same time whatever is asked of them has nothing to limit.
    fn limit_work(&mut self, _most: u64) {}

    /// What is doubtful about the parameters, or the inputs so far, but for the topics that were `told` before. Asked for after the start
    /// and after each step, so that nothing may be written for a topic that was told.
    fn warnings(&self, _told: &[&'static str]) -> Vec<Warning> {
        Vec::new()
    }

    /// A copy of the present state.
    fn state(&self) -> Self::State;

    /// Puts a copy of the present state in the place of `state`, an earlier one of this same model. Only a matter of speed: a model
    /// whose states own memory may use it again.
    fn state_over(&self, state: &mut Self::State) {
        *state = self.state();
    }

    /// Time of `state` \[s\]: the end of the last step, or the start.
    fn time_of(state: &Self::State) -> f64;

    /// Goes to a state of this same model with these same parameters; the tunable ones are those of the state.
    ///
    /// # Errors
    /// The state belongs to another model, structure or parameter set, or is damaged. The state is then as before.
    fn restore(&mut self, state: &Self::State) -> Result<()>;
}
