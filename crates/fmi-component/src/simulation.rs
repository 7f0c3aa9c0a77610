//! A model for a Rust program: parameters in, then inputs, steps and outputs by name.
//!
//! Needs: a [`Model`]. Guarantees: a refused call changes nothing; an output is computed when it is read, not before; a saved
//! state brings back the same bits. Not here: models chosen at run time ([`DynSimulation`](crate::DynSimulation)), the life
//! cycle of FMI.

mod contents;
mod lists;
mod outside;
mod refusal;
mod saving;
mod tuning;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::error::{Error, Result};
use crate::model::{Model, Reached, Warning};
use crate::row::{Read, Row};
use crate::structure::StructuralParameters;
use crate::table::Table;
use crate::times::{check_start, check_time};
use crate::unit::Unit;
use crate::value::Value;
use crate::values::Values;
use crate::variable::{Causality, Variable};
use refusal::{name_what_was_set, named};
pub use saving::Saved;
use tuning::Tuned;

/// One run of a model.
#[derive(Debug)]
pub struct Simulation<M> {
    /// Another for each simulation of the process.
    id: u64,
    structure: StructuralParameters,
    /// How each computed variable is read, in the order of the table behind its settable ones.
    reads: Arc<[Read<M>]>,
    values: Values,
    /// Start time \[s\]: of the model, or of the one to come.
    start: f64,
    /// Time reached \[s\].
    time: f64,
    /// The model; none until [`Simulation::start`].
    model: Option<M>,
    /// What [`Simulation::limit_work`] asked for.
    most_work: Option<u64>,
    /// Tunable parameters of the model.
    tuned: Tuned,
    /// A tunable parameter may have been set to another value than the model has.
    retuned: bool,
    /// Parameters of the model outside of their recommended ranges.
    outside: Vec<Warning>,
}

/// What keeps a variable from being set.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Hold {
    /// Nothing.
    Free,
    /// A tunable parameter of a model that has started, which takes it over in the next step.
    Tunable,
    /// Another parameter of a model that has started.
    Frozen,
}

impl<M: Model> Simulation<M> {
    /// The model with these structural parameters (defaults for those not named), started at time 0; `given` holds the
    /// parameters, and the inputs at the start, that differ from the start values.
    ///
    /// # Errors
    /// A structural parameter, a name or a value that the model does not take.
    pub fn new(structure: &[(&str, u32)], given: &[(&str, Value)]) -> Result<Self> {
        let mut simulation = Self::prepare(StructuralParameters::choose(&M::info(), structure)?);
        for (name, value) in given {
            simulation.set(name, *value)?;
        }
        simulation.start(0.0)?;
        Ok(simulation)
    }

    /// The model with start values, not started yet: parameters may be set until [`Simulation::start`].
    pub fn prepare(structure: StructuralParameters) -> Self {
        let rows = M::variables(&structure);
        let reads = rows.iter().filter_map(|row| row.read.clone()).collect();
        let table = Table::new(rows.into_iter().map(|Row { variable, .. }| variable).collect());
        Self {
            id: next_id(),
            structure,
            reads,
            values: Values::new(Arc::new(table)),
            start: 0.0,
            time: 0.0,
            model: None,
            most_work: None,
            tuned: Tuned::default(),
            retuned: false,
            outside: Vec::new(),
        }
    }

    /// Builds the model at `time` \[s\] from the parameters and inputs as they stand; a model that was there is dropped.
    ///
    /// # Errors
    /// A time that is not simulated, or values that the model refuses. All is then as before.
    pub fn start(&mut self, time: f64) -> Result<()> {
        check_start(time)?;
        self.model = Some(self.build(time, &self.values)?);
        (self.tuned, self.retuned) = (Tuned::of(&self.values), false);
        self.judge_parameters();
        (self.start, self.time) = (time, time);
        Ok(())
    }

    /// Says when the model is to start \[s\], so that the time is known before it does.
    ///
    /// # Errors
    /// A time that is not simulated, or the simulation has started.
    pub fn set_start_time(&mut self, time: f64) -> Result<()> {
        check_start(time)?;
        if self.is_started() {
            return Err(Error::call(
                format!("the simulation has started at {}", Unit::SECOND.format(self.start)),
                "Stop it first.",
            ));
        }
        (self.start, self.time) = (time, time);
        Ok(())
    }

    /// Forgets the model and goes back to the start time: parameters may be set again.
    pub fn stop(&mut self) {
        self.model = None;
        self.time = self.start;
    }

    /// Becomes as [`Simulation::prepare`] made it: start values, not started, time 0. A limit of work stays.
    pub fn reset(&mut self) {
        self.values = Values::new(Arc::clone(self.table()));
        self.start = 0.0;
        self.stop();
    }

    /// Whether there is a model: since [`Simulation::start`].
    pub fn is_started(&self) -> bool {
        self.model.is_some()
    }

    /// Sets an input, a parameter before the start, or a tunable parameter. An input holds until it is set again; the model takes a
    /// tunable parameter over at the beginning of the next step.
    ///
    /// # Errors
    /// No such parameter or input, a parameter that is not tunable after the start, another type, or out of range.
    pub fn set(&mut self, name: &str, value: impl Into<Value>) -> Result<()> {
        self.set_at(self.position(name)?, value)
    }

    /// [`Simulation::set`] without the search: `position` as [`Simulation::position`] gave it.
    ///
    /// # Errors
    /// As [`Simulation::set`].
    pub fn set_at(&mut self, position: usize, value: impl Into<Value>) -> Result<()> {
        let hold = self.hold(position);
        if hold == Hold::Frozen {
            return Err(self.frozen(position));
        }
        self.values.set(position, value.into())?;
        self.retuned |= hold == Hold::Tunable;
        Ok(())
    }

    /// Sets inputs from position `first` on, all of them reals of 64 bits, to values that were checked.
    #[inline]
    pub(crate) fn set_signals(&mut self, first: usize, reals: &[f64]) {
        self.values.set_signals(first, reals);
    }

    /// Whether the variable at `position` is a parameter of a model that has started, and of which sort.
    #[inline]
    fn hold(&self, position: usize) -> Hold {
        match self.table().variables().get(position) {
            Some(variable) if variable.causality == Causality::Parameter && self.is_started() => match variable.tunable
            {
                true => Hold::Tunable,
                false => Hold::Frozen,
            },
            _ => Hold::Free,
        }
    }

    #[cold]
    fn frozen(&self, position: usize) -> Error {
        let name = self.variables().get(position).map_or("", |variable| &variable.name);
        Error::call(
            format!("{name} is a parameter, frozen since the start"),
            "Give it when the simulation is made.",
        )
    }

    /// Position of the variable called `name`: the same for as long as the simulation lives.
    ///
    /// # Errors
    /// The model has no such variable.
    pub fn position(&self, name: &str) -> Result<usize> {
        self.table().position(name).ok_or_else(|| {
            Error::call(
                format!("the model {} has no variable {name}", named(&M::info())),
                "Take the names from its table of variables.",
            )
        })
    }

    /// Advances to `end_time` \[s\] under the inputs as they stand, as one communication step.
    ///
    /// # Errors
    /// `end_time` is not after the present time, or the model cannot do the step. Nothing has changed then.
    pub fn advance_to(&mut self, end_time: f64) -> Result<()> {
        self.advance_by(end_time, |model, values| model.advance_to(end_time, values))
    }

    /// As [`Simulation::advance_to`], by a `step` of the model's own that does what [`Model::advance_to`] does and more, such as
    /// showing the step to an observer.
    ///
    /// # Errors
    /// As [`Simulation::advance_to`].
    pub fn advance_by(&mut self, end_time: f64, step: impl FnOnce(&mut M, &Values) -> Result<()>) -> Result<()> {
        self.step(end_time, step)?;
        self.time = end_time;
        Ok(())
    }

    /// Advances to the next event, or to `end_time` \[s\] if there is none before.
    ///
    /// # Errors
    /// As [`Simulation::advance_to`].
    pub fn advance_to_event(&mut self, end_time: f64) -> Result<Reached> {
        let reached = self.step(end_time, |model, values| model.advance_to_event(end_time, values))?;
        Ok(self.arrive(reached, end_time))
    }

    /// Resumes a step that ended at an event: see [`Model::resume_to_event`].
    ///
    /// # Errors
    /// As [`Simulation::advance_to`].
    pub fn resume_to_event(&mut self, end_time: f64) -> Result<Reached> {
        let reached = self.step(end_time, |model, values| model.resume_to_event(end_time, values))?;
        Ok(self.arrive(reached, end_time))
    }

    /// Does a `step` to `end_time`, if that is one forward in time.
    fn step<T>(&mut self, end_time: f64, step: impl FnOnce(&mut M, &Values) -> Result<T>) -> Result<T> {
        check_time("end of the step", end_time)?;
        if end_time <= self.time {
            return Err(Error::parameter(
                "end of the step",
                Unit::SECOND.format(end_time),
                format!(
                    "a time after {}, where the last step ended",
                    Unit::SECOND.format(self.time)
                ),
                "Steps go forward in time.",
            ));
        }
        match &mut self.model {
            Some(model) if !self.retuned => step(model, &self.values),
            _ => self.tune_and(step),
        }
    }

    /// Moves on to where the model says that it is. Anywhere else than at the end or at an event before is a defect of the model.
    fn arrive(&mut self, reached: Reached, end_time: f64) -> Reached {
        let legal = reached.time == end_time || reached.event && reached.time > self.time && reached.time < end_time;
        assert!(legal, "the model went to {reached:?} where {end_time} s was asked");
        self.time = reached.time;
        reached
    }

    /// Limits the work of one step, in the unit of the model, instead of its own limit.
    pub fn limit_work(&mut self, most: u64) {
        self.most_work = Some(most);
        if let Some(model) = &mut self.model {
            model.limit_work(most);
        }
    }

    /// Distinguishes it from all other simulations of the process.
    pub(crate) fn id(&self) -> u64 {
        self.id
    }

    /// Time reached \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Start time \[s\].
    pub fn start_time(&self) -> f64 {
        self.start
    }

    /// The real variable called `name`, as of now.
    ///
    /// # Errors
    /// The model has no such variable, or it is a whole number.
    pub fn real(&self, name: &str) -> Result<f64> {
        match self.value(self.position(name)?)? {
            Value::Real(real) => Ok(real),
            Value::Integer(_) => Err(whole_number(name)),
        }
    }

    /// The whole number called `name`, as of now.
    ///
    /// # Errors
    /// The model has no such variable, or it is a real.
    pub fn integer(&self, name: &str) -> Result<i64> {
        match self.value(self.position(name)?)? {
            Value::Integer(integer) => Ok(integer),
            Value::Real(_) => Err(Error::call(format!("{name} is a real number"), "Read it as a real.")),
        }
    }

    /// Value of the variable at `position`, as of now: computed here and now if the model computes it.
    ///
    /// # Errors
    /// No variable there, or a computed one before the start.
    pub fn value(&self, position: usize) -> Result<Value> {
        let settable = self.values.as_slice();
        if let Some(value) = settable.get(position) {
            return Ok(*value);
        }
        match (&self.model, self.reads.get(position - settable.len())) {
            (Some(model), Some(read)) => Ok(read.value(model)),
            _ => Err(self.no_value(position)),
        }
    }

    /// Fills `out` with the values of the reals from `first` on, as [`Simulation::value`] gives them: all at once, for arrays.
    ///
    /// # Errors
    /// As [`Simulation::value`]; a whole number among them.
    pub fn read_reals(&self, first: usize, out: &mut [f64]) -> Result<()> {
        let settable = self.values.as_slice();
        let (mut position, mut rest) = (first, out);
        while !rest.is_empty() {
            let filled = match (settable.get(position), &self.model) {
                (Some(Value::Real(real)), _) => {
                    rest[0] = *real;
                    1
                }
                (None, Some(model)) => {
                    let read = self.reads.get(position - settable.len());
                    read.map_or(0, |read| read.fill(model, rest))
                }
                _ => 0,
            };
            if filled == 0 {
                return Err(self.no_real(position));
            }
            position += filled;
            rest = &mut rest[filled..];
        }
        Ok(())
    }

    #[cold]
    fn no_real(&self, position: usize) -> Error {
        match self.value(position) {
            Ok(_) => whole_number(&self.variables()[position].name),
            Err(error) => error,
        }
    }

    #[cold]
    fn no_value(&self, position: usize) -> Error {
        match self.variables().get(position) {
            Some(variable) => not_started(&format!("read {}", variable.name)),
            None => self.table().no_variable(position),
        }
    }

    /// What is doubtful about the run so far, but for the topics that were `told` before; nothing before the start. Parameters
    /// outside of their recommended ranges come first, those of the start under one topic.
    pub fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        let Some(model) = &self.model else { return Vec::new() };
        let untold = |warning: &&Warning| !told.contains(&warning.topic);
        let mut warnings: Vec<_> = self.outside.iter().filter(untold).cloned().collect();
        warnings.extend(model.warnings(told));
        warnings
    }

    /// All values as of now, in the order of the variables.
    ///
    /// # Errors
    /// Before the start.
    pub fn all_values(&self) -> Result<Vec<Value>> {
        (0..self.table().variables().len())
            .map(|position| self.value(position))
            .collect()
    }

    /// The variables.
    pub fn variables(&self) -> &[Variable] {
        self.table().variables()
    }

    /// The variables with their index by name.
    pub fn table(&self) -> &Arc<Table> {
        self.values.table()
    }

    /// Parameters and inputs.
    pub fn values(&self) -> &Values {
        &self.values
    }

    /// Structural parameters.
    pub fn structure(&self) -> &StructuralParameters {
        &self.structure
    }

    /// The model, for what is no variable.
    ///
    /// # Errors
    /// Before the start.
    pub fn model(&self) -> Result<&M> {
        self.model.as_ref().ok_or_else(|| not_started("observe the model"))
    }

    fn build(&self, start: f64, values: &Values) -> Result<M> {
        let model = M::new(&self.structure, start, values);
        let mut model = model.map_err(|error| name_what_was_set(error, values))?;
        if let Some(most) = self.most_work {
            model.limit_work(most);
        }
        Ok(model)
    }
}

fn next_id() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

fn whole_number(name: &str) -> Error {
    Error::call(format!("{name} is a whole number"), "Read it as an integer.")
}

fn not_started(what: &str) -> Error {
    Error::call(
        format!("cannot {what}: the simulation has not started"),
        "Start it first.",
    )
}
