//! A scene as a component: life cycle, communication points, values and saved states. Knows no C types.
//!
//! Needs: a [`Scene`]. Guarantees: a refused call changes nothing; reset equals a new instance; a state saved in any
//! phase brings back the same bits. Not here: pointers, panics and log messages (`abi`), legal phases (`life_cycle`).

mod saving;
mod stepping;
mod values;

use std::sync::Arc;

use super::life_cycle::{Call, Phase};
use super::snapshot::Clock;
use super::{TOLERANCE, arrays, token};
use crate::error::{Error, Result};
use crate::scene::times::check_time;
use crate::scene::{Causality, Choice, Kind, Scene, Table, Value, Values};
pub use stepping::Part;
use stepping::UnderWay;
pub use values::Access;

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
pub struct Instance<S: Scene> {
    token: String,
    /// Elements of the variable at each position, if there are arrays.
    spans: Option<Arc<[usize]>>,
    choice: Choice,
    importer: Importer,
    phase: Phase,
    clock: Clock,
    values: Values,
    scene: Option<S>,
    /// A value was set after `scene` was built, so that `scene` has to be built anew. Only before initialisation ends.
    stale: bool,
    /// A step that goes from event to event, while the importer is told of one.
    under_way: Option<UnderWay<S::State>>,
}

impl<S: Scene> Instance<S> {
    /// A new component for `token`.
    ///
    /// # Errors
    /// The token is not of this scene, or the importer wants event mode of a scene that has no events.
    pub fn new(token: &str, importer: Importer) -> Result<Self> {
        let contents = token::read::<S>(token)?;
        if importer.event_mode && !S::EVENTS {
            return Err(Error::call(
                "event mode is not offered (hasEventMode = false)",
                "Pass eventModeUsed = false.",
            ));
        }
        let spans = contents.arrays.then(|| arrays::spans(&contents.rows).into());
        let table = Arc::new(Table::new(contents.rows));
        Ok(Self::start(token.into(), contents.choice, importer, table, spans))
    }

    fn start(
        token: String,
        choice: Choice,
        importer: Importer,
        table: Arc<Table>,
        spans: Option<Arc<[usize]>>,
    ) -> Self {
        Self {
            token,
            spans,
            choice,
            importer,
            phase: Phase::Instantiated,
            clock: Clock {
                start: 0.0,
                now: 0.0,
                stop: None,
            },
            values: Values::new(table),
            scene: None,
            stale: false,
            under_way: None,
        }
    }

    /// Where it is in its life.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Present communication point \[s\].
    pub fn time(&self) -> f64 {
        self.clock.now
    }

    /// Token that it was made with.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// [`Instance::set_up`] with the importer's relative tolerance, if it has one. It goes to the parameter `tolerance` of
    /// scenes that have one and were given no other; a coarser one than the scene knows is kept at the scene's coarsest.
    ///
    /// # Errors
    /// Those of [`Instance::set_up`]; a tolerance that is not positive or finer than the scene can keep.
    pub fn set_up_within(&mut self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Result<()> {
        let parameter = tolerance.and_then(|tolerance| self.parameter_for(tolerance));
        if let Some((position, value)) = parameter {
            self.values.table().rows()[position].check(value)?;
        }
        self.set_up(start, stop)?;
        match parameter {
            Some((position, value)) => self.values.set(position, value),
            None => Ok(()),
        }
    }

    /// Position and value that a tolerance gives to the parameter `tolerance`, if it is still at its start value.
    fn parameter_for(&self, tolerance: f64) -> Option<(usize, Value)> {
        let position = self.values.table().position(TOLERANCE)?;
        let row = &self.values.table().rows()[position];
        let untouched = row.causality == Causality::Parameter && self.values.get(position) == Some(row.start());
        let Kind::Real(quantity) = &row.kind else {
            return None;
        };
        let coarser = tolerance.is_finite() && tolerance > quantity.max;
        let kept = if coarser { quantity.max } else { tolerance };
        untouched.then_some((position, Value::Real(kept)))
    }

    /// Sets start and, if known, stop time \[s\].
    ///
    /// # Errors
    /// Wrong phase; a start too far from zero to be simulated; times that are not finite or not in order.
    pub fn set_up(&mut self, start: f64, stop: Option<f64>) -> Result<()> {
        Call::SetupExperiment.check(self.phase)?;
        check_time("start time", start)?;
        if let Some(stop) = stop.filter(|stop| !stop.is_finite() || *stop < start) {
            return Err(Error::parameter(
                "stop time",
                stop,
                format!("finite and not before the start time {start} s"),
                "Give such a time or leave it undefined.",
            ));
        }
        self.clock = Clock {
            start,
            now: start,
            stop,
        };
        Ok(())
    }

    /// Begins initialisation.
    ///
    /// # Errors
    /// Wrong phase.
    pub fn enter_initialization(&mut self) -> Result<()> {
        Call::EnterInitialization.check(self.phase)?;
        self.phase = Phase::Initialization;
        self.stale = true;
        Ok(())
    }

    /// Ends initialisation: freezes the parameters and computes the outputs.
    ///
    /// # Errors
    /// Wrong phase, or the scene refuses the parameters. They may then be set anew.
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
            let remedy = match S::EVENTS {
                true => "Instantiate with eventModeUsed = true.",
                false => "Do without: this scene has no events.",
            };
            return Err(Error::call(
                "event mode was not asked for when the instance was made",
                remedy,
            ));
        }
        self.phase = Phase::Event;
        Ok(())
    }

    /// Iterates on events: the scene has done with an event when the step ends, so that one round is enough.
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
        let (table, spans) = (Arc::clone(self.values.table()), self.spans.take());
        *self = Self::start(
            std::mem::take(&mut self.token),
            self.choice,
            self.importer,
            table,
            spans,
        );
    }

    /// Marks the instance after a panic: nothing that the scene holds may be trusted.
    pub fn fail(&mut self) {
        self.phase = Phase::Failed;
        self.stale = true;
    }

    fn build(&mut self) -> Result<()> {
        if self.scene.is_none() || self.stale {
            let scene = S::new(self.choice, self.clock.start, &self.values)?;
            scene.write_outputs(self.values.writer());
            self.scene = Some(scene);
            self.stale = false;
        }
        Ok(())
    }
}
