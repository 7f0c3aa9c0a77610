//! A model as a component: life cycle, communication points, values by reference and saved states. Knows no C types.
//!
//! Needs: a simulation of the model, which it owns. Guarantees: a refused call changes nothing; reset equals a new instance;
//! a state saved in any phase brings back the same bits. Not here: pointers, panics and log messages (`c_api`), legal phases
//! (`life_cycle`), the state itself ([`Simulation`](crate::Simulation)).

mod access;
mod contents;
mod saving;
mod stepping;
mod values;

use std::sync::Arc;

use crate::dynamic::{DynSimulation, ModelType};
use crate::error::{Error, Result};
use crate::kind::Kind;
use crate::life_cycle::{Call, Phase};
use crate::model::Warning;
use crate::standard::TOLERANCE;
use crate::table::Table;
use crate::times::check_start;
use crate::token;
use crate::unit::Unit;
use crate::value::Value;
use crate::variable::Causality;
pub use access::Access;
use access::Slot;
pub use saving::Snapshot;
pub use stepping::Part;
use stepping::UnderWay;
pub use values::does_not_fit;

/// What the importer said that it can do when it made the instance (FMI 3.0; in FMI 2.0 nothing of this).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Importer {
    /// `eventModeUsed`: it handles events in event mode, and initialisation ends there.
    pub event_mode: bool,
    /// `earlyReturnAllowed`: a step may end before its end.
    pub early_return: bool,
}

impl Importer {
    /// Whether steps end at events, for the importer to handle them in event mode.
    pub const fn stops_at_events(self) -> bool {
        self.event_mode && self.early_return
    }
}

/// One component.
pub struct Instance {
    token: String,
    table: Arc<Table>,
    /// What each get and set looks up of the variable at each position.
    slots: Vec<Slot>,
    importer: Importer,
    phase: Phase,
    /// End of the simulation \[s\], if the importer gave one.
    stop: Option<f64>,
    /// Values, time and, when it is needed, the model.
    simulation: Box<dyn DynSimulation>,
    /// Parts of a step after which the importer offers inputs; 0 if it does not.
    input_parts: u32,
    /// A step that goes from event to event, while one is reported to the importer.
    under_way: Option<UnderWay>,
}

impl std::fmt::Debug for Instance {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "Instance of {} in {:?}", self.token, self.phase)
    }
}

impl Instance {
    /// A new component of `model` for `token`.
    ///
    /// # Errors
    /// The token is not of this model, or the importer wants event mode of a model that has no events.
    pub fn new(model: &ModelType, token: &str, importer: Importer) -> Result<Self> {
        let contents = token::read(model, token)?;
        if importer.event_mode && !model.events {
            return Err(Error::call(
                "event mode is not offered (hasEventMode = false)",
                "Pass eventModeUsed = false.",
            ));
        }
        let simulation = (model.prepare)(contents.structure);
        let table = Arc::clone(simulation.values().table());
        Ok(Self {
            token: token.into(),
            slots: Slot::of(table.variables(), contents.arrays),
            table,
            importer,
            phase: Phase::Instantiated,
            stop: None,
            simulation,
            input_parts: 0,
            under_way: None,
        })
    }

    /// Where it is in its life.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Present communication point \[s\].
    pub fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// Parameters and inputs.
    pub fn values(&self) -> &[Value] {
        self.simulation.values().as_slice()
    }

    /// Contents of the texts and binary variables among them.
    pub fn all_bytes(&self) -> &[Vec<u8>] {
        self.simulation.values().all_bytes()
    }

    /// Token that it was made with.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// What is doubtful about the run so far, but for the topics that were `told` before.
    pub fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        self.simulation.warnings(told)
    }

    /// Whether the model has events.
    pub fn has_events(&self) -> bool {
        self.simulation.has_events()
    }

    /// [`Instance::set_up`] with the importer's relative tolerance, if it has one. It goes to the parameter `tolerance` of
    /// models that have one and were given no other; a coarser one than the model knows is kept at the model's coarsest.
    ///
    /// # Errors
    /// Those of [`Instance::set_up`]; a tolerance that is not positive or finer than the model can keep.
    pub fn set_up_within(&mut self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Result<()> {
        let parameter = tolerance.and_then(|tolerance| self.parameter_for(tolerance));
        if let Some((position, value)) = parameter {
            self.table.variables()[position].check(value)?;
        }
        self.set_up(start, stop)?;
        match parameter {
            Some((position, value)) => self.simulation.set_at(position, value),
            None => Ok(()),
        }
    }

    /// Position and value that a tolerance gives to the parameter `tolerance`, if it is still at its start value.
    fn parameter_for(&self, tolerance: f64) -> Option<(usize, Value)> {
        let position = self.table.position(TOLERANCE)?;
        let variable = &self.table.variables()[position];
        let untouched = self.simulation.values().get(position) == Some(variable.start());
        let Kind::Real(quantity) = &variable.kind else {
            return None;
        };
        let coarser = tolerance.is_finite() && tolerance > quantity.max;
        let kept = if coarser { quantity.max } else { tolerance };
        (untouched && variable.causality == Causality::Parameter).then_some((position, Value::Real(kept)))
    }

    /// Sets start and, if known, stop time \[s\].
    ///
    /// # Errors
    /// Wrong phase; a start too far from zero to be simulated; times that are not finite or not in order.
    pub fn set_up(&mut self, start: f64, stop: Option<f64>) -> Result<()> {
        Call::SetupExperiment.check(self.phase)?;
        check_start(start)?;
        if let Some(stop) = stop.filter(|stop| !stop.is_finite() || *stop < start) {
            return Err(Error::parameter(
                "stop time",
                Unit::SECOND.format(stop),
                format!("finite and not before the start time {}", Unit::SECOND.format(start)),
                "Give such a time or leave it undefined.",
            ));
        }
        self.simulation.set_start_time(start)?;
        self.stop = stop;
        Ok(())
    }

    /// Begins initialisation.
    ///
    /// # Errors
    /// Wrong phase.
    pub fn enter_initialization(&mut self) -> Result<()> {
        Call::EnterInitialization.check(self.phase)?;
        self.phase = Phase::Initialization;
        Ok(())
    }

    /// Ends initialisation: freezes the parameters that are not tunable and builds the model.
    ///
    /// # Errors
    /// Wrong phase, or the model refuses the parameters. They may then be set anew.
    pub fn exit_initialization(&mut self) -> Result<()> {
        Call::ExitInitialization.check(self.phase)?;
        self.build()?;
        self.phase = if self.importer.event_mode {
            Phase::Event
        } else {
            Phase::Step
        };
        Ok(())
    }

    /// Enters event mode (FMI 3.0).
    ///
    /// # Errors
    /// Wrong phase, or event mode was not asked for when the instance was made.
    pub fn enter_event_mode(&mut self) -> Result<()> {
        Call::EnterEvent.check(self.phase)?;
        if !self.importer.event_mode {
            let remedy = match self.has_events() {
                true => "Instantiate with eventModeUsed = true.",
                false => "Do without: this model has no events.",
            };
            return Err(Error::call(
                "event mode was not asked for when the instance was made",
                remedy,
            ));
        }
        self.phase = Phase::Event;
        Ok(())
    }

    /// Iterates on events: the model has handled an event when the step ends, so that one round is enough.
    ///
    /// # Errors
    /// Wrong phase.
    pub fn update_discrete_states(&mut self) -> Result<()> {
        Call::UpdateDiscreteStates.check(self.phase)
    }

    /// Leaves event mode.
    ///
    /// # Errors
    /// Wrong phase.
    pub fn enter_step_mode(&mut self) -> Result<()> {
        Call::EnterStep.check(self.phase)?;
        self.phase = Phase::Step;
        Ok(())
    }

    /// Ends the simulation.
    ///
    /// # Errors
    /// Wrong phase.
    pub fn terminate(&mut self) -> Result<()> {
        Call::Terminate.check(self.phase)?;
        self.phase = Phase::Terminated;
        Ok(())
    }

    /// Becomes as a new instance, whatever happened before; a step under way is forgotten.
    pub fn reset(&mut self) {
        self.under_way = None;
        self.simulation.reset();
        self.stop = None;
        self.phase = Phase::Instantiated;
    }

    /// Marks the instance after a panic: what the model holds may not be trusted.
    pub fn fail(&mut self) {
        self.phase = Phase::Failed;
    }

    /// Makes sure that there is a model of the values as they stand.
    fn build(&mut self) -> Result<()> {
        match self.simulation.is_started() {
            true => Ok(()),
            false => self.simulation.start(self.simulation.start_time()),
        }
    }
}
