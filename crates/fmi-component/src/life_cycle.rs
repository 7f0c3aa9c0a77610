//! Which call is legal in which phase: the state tables of both standards in one place.
//!
//! FMI 2.0 section 4.2.4 and FMI 3.0 sections 2.3 and 4.2. More lenient than the standards in three points, since
//! nothing can go wrong there. A refused call leaves the instance in its phase, with nothing changed, where the standards
//! let the importer only read, reset or free. FMI 2.0's `fmi2SetupExperiment` may be left out; time then starts at 0. A
//! discarded step may be tried again without restoring a state first, since the state is the one before the step anyway.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};

/// Version of the standard that an importer speaks to an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Version {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

impl Version {
    /// As the standards write it, such as `2.0`.
    pub const fn number(self) -> &'static str {
        match self {
            Self::Two => "2.0",
            Self::Three => "3.0",
        }
    }
}

/// Where an instance is in its life.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// Made, parameters may be set.
    Instantiated,
    /// Between entering and leaving initialisation.
    Initialization,
    /// FMI 3.0 event mode, for models that have events.
    Event,
    /// Ready for a step.
    Step,
    /// The simulation is over; values may be read.
    Terminated,
    /// A defect of the model showed (a panic). Only reading parameters and inputs, restoring a state, resetting and freeing are
    /// left.
    Failed,
    /// FMI 3.0 intermediate update mode: inside a step, at an event or where inputs may be renewed, while this is reported to the
    /// importer. Values may be read, and inputs set that are offered. Never
    /// saved; the last one, since saved states hold the others by their number.
    IntermediateUpdate,
}

impl Phase {
    /// Name for messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initialization mode",
            Self::Event => "event mode",
            Self::Step => "step mode",
            Self::Terminated => "terminated",
            Self::Failed => "failed",
            Self::IntermediateUpdate => "intermediate update mode",
        }
    }
}

/// What an importer may ask of an instance, apart from reading and writing single values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Call {
    /// `fmi2SetupExperiment`.
    SetupExperiment,
    /// Enter initialisation.
    EnterInitialization,
    /// Leave initialisation.
    ExitInitialization,
    /// Enter event mode.
    EnterEvent,
    /// Leave event mode for step mode.
    EnterStep,
    /// Iterate on events.
    UpdateDiscreteStates,
    /// Advance in time.
    DoStep,
    /// End the simulation.
    Terminate,
    /// Save the state.
    SaveState,
    /// Resume a step after an intermediate update.
    Resume,
    /// Anything that is more than reading.
    Change,
}

impl Call {
    #[inline]
    const fn legal(self) -> &'static [Phase] {
        match self {
            Self::SetupExperiment | Self::EnterInitialization => &[Phase::Instantiated],
            Self::ExitInitialization => &[Phase::Initialization],
            Self::EnterStep | Self::UpdateDiscreteStates => &[Phase::Event],
            Self::EnterEvent | Self::DoStep => &[Phase::Step],
            Self::Terminate => &[Phase::Step, Phase::Event],
            Self::SaveState => &[
                Phase::Instantiated,
                Phase::Initialization,
                Phase::Event,
                Phase::Step,
                Phase::Terminated,
            ],
            Self::Resume => &[Phase::IntermediateUpdate],
            Self::Change => &[
                Phase::Instantiated,
                Phase::Initialization,
                Phase::Event,
                Phase::Step,
                Phase::Terminated,
                Phase::Failed,
            ],
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::SetupExperiment => "setting up the experiment",
            Self::EnterInitialization => "entering initialization mode",
            Self::ExitInitialization => "leaving initialization mode",
            Self::EnterEvent => "entering event mode",
            Self::EnterStep => "entering step mode",
            Self::UpdateDiscreteStates => "updating discrete states",
            Self::DoStep => "a step",
            Self::Terminate => "terminating",
            Self::SaveState => "saving the state",
            Self::Resume => "resuming a step",
            Self::Change => "any call but reading values",
        }
    }

    /// Refuses this call unless it is legal in `phase`.
    ///
    /// # Errors
    /// [`Error::Call`] with the call, the phase and the phases that were expected.
    #[inline]
    pub fn check(self, phase: Phase) -> Result<()> {
        match self.legal().contains(&phase) {
            true => Ok(()),
            false => Err(self.refusal(phase)),
        }
    }

    #[cold]
    fn refusal(self, phase: Phase) -> Error {
        let expected: Vec<_> = self.legal().iter().map(|phase| phase.name()).collect();
        let remedy = match phase {
            Phase::Failed => "Reset the instance, restore a saved state or free it.".into(),
            Phase::IntermediateUpdate => {
                "Read values only, and set inputs if they are asked for; return from the callback first.".into()
            }
            _ => format!("It is legal in: {}.", expected.join(", ")),
        };
        Error::call(
            format!(
                "{} is not allowed while the instance is in the phase {}",
                self.name(),
                phase.name()
            ),
            remedy,
        )
    }
}
