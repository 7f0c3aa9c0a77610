//! Tunable parameters of a simulation: what was set between steps reaches the model at the beginning of the next step.

use serde::{Deserialize, Serialize};

use super::{Simulation, outside};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::value::Value;
use crate::values::Values;

/// What a model was built from, and what it knows of the tunable parameters; empty before the start.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tuned {
    /// All parameters and inputs that the model was built from.
    at_start: Vec<Value>,
    /// Contents of the texts and binary variables among them.
    bytes_at_start: Vec<Vec<u8>>,
    /// Tunable parameters that it has now, in the order of [`Table::tunable`](crate::Table::tunable). One that was set since the last
    /// step has another value among the [`Values`].
    pub(super) now: Vec<Value>,
}

// A derived one would make all of it anew in `clone_from`.
impl Clone for Tuned {
    fn clone(&self) -> Self {
        Self {
            at_start: self.at_start.clone(),
            bytes_at_start: self.bytes_at_start.clone(),
            now: self.now.clone(),
        }
    }

    fn clone_from(&mut self, other: &Self) {
        self.at_start.clone_from(&other.at_start);
        self.bytes_at_start.clone_from(&other.bytes_at_start);
        self.now.clone_from(&other.now);
    }
}

impl Tuned {
    /// Those of a model that was built from `values`.
    pub fn of(values: &Values) -> Self {
        Self {
            at_start: values.as_slice().to_vec(),
            bytes_at_start: values.all_bytes().to_vec(),
            now: values.tunable(),
        }
    }

    /// With another value in the place of one that the model was built from, if it has started.
    pub fn replace_at_start(&mut self, position: usize, value: Value) {
        if let Some(at_start) = self.at_start.get_mut(position) {
            *at_start = value;
        }
    }

    /// Whether a model that was built from one is one that was built from the other.
    pub fn is_of_the_same_start(&self, other: &Self) -> bool {
        self.at_start == other.at_start && self.bytes_at_start == other.bytes_at_start
    }

    /// Says whether these can be those of a model that has started, if it has, and has parameters and inputs `values` now.
    ///
    /// # Errors
    /// Another number of values, of another type, out of range, or other fixed parameters.
    pub fn check(&self, values: &Values, started: bool) -> Result<()> {
        let damaged = |what: &str| Err(Error::state(what, "Pass a state that saving gave."));
        if !started {
            return match *self == Self::default() {
                true => Ok(()),
                false => damaged("it holds values of a model that has not started"),
            };
        }
        values.check_all(&self.at_start, &self.bytes_at_start)?;
        if !values.same_fixed_parameters(&self.at_start, &self.bytes_at_start) {
            return damaged("it started with other parameters");
        }
        let table = values.table();
        if self.now.len() != table.tunable().len() {
            return damaged("it holds another number of tunable parameters");
        }
        let mut pairs = table.tunable().iter().zip(&self.now);
        pairs.try_for_each(|(position, value)| table.variables()[*position].check(*value))
    }
}

impl<M: Model> Simulation<M> {
    /// Does `step` after the model has taken over the tunable parameters as they stand.
    ///
    /// # Errors
    /// Those of the step or of [`Model::tune`]. The model is then as before.
    #[cold]
    pub(super) fn tune_and<T>(&mut self, step: impl FnOnce(&mut M, &Values) -> Result<T>) -> Result<T> {
        let Some(model) = &mut self.model else {
            return Err(super::not_started("advance"));
        };
        let wanted = self.values.tunable();
        if wanted == self.tuned.now {
            self.retuned = false;
            return step(model, &self.values);
        }
        let before = model.state();
        model
            .tune(&self.values)
            .map_err(|error| super::name_what_was_set(error, &self.values))?;
        let done = step(model, &self.values);
        if done.is_err() {
            go_back(model, &self.values.with_tunable(&self.tuned.now), &before);
            return done;
        }
        self.tuned.now = wanted;
        self.retuned = false;
        self.judge_parameters();
        done
    }

    /// Brings the model of this simulation to a `state` that was saved with the tunable parameters of `tuned`.
    ///
    /// # Errors
    /// The state does not fit. The model is then as before.
    pub(super) fn restore_tuned(
        model: &mut M,
        state: &M::State,
        values: &Values,
        (own, tuned): (&Tuned, &Tuned),
    ) -> Result<()> {
        if own.now == tuned.now {
            return model.restore(state);
        }
        let before = model.state();
        model.tune(&values.with_tunable(&tuned.now))?;
        model
            .restore(state)
            .inspect_err(|_| go_back(model, &values.with_tunable(&own.now), &before))
    }

    /// A model of `values` in a `state` that was saved with the tunable parameters of `tuned`.
    ///
    /// # Errors
    /// The values or the state do not fit.
    pub(super) fn build_tuned(&self, start: f64, state: &M::State, values: &Values, tuned: &Tuned) -> Result<M> {
        let at_start = values.with_all(&tuned.at_start, &tuned.bytes_at_start);
        let mut model = self.build(start, &at_start)?;
        let as_built = Tuned::of(&at_start);
        Self::restore_tuned(&mut model, state, values, (&as_built, tuned))?;
        Ok(model)
    }

    /// Notes which parameters of the model are outside of their recommended ranges.
    pub(super) fn judge_parameters(&mut self) {
        let at_start = self.values.with_all(&self.tuned.at_start, &self.tuned.bytes_at_start);
        self.outside = outside::warnings(&at_start);
        if self.tuned.now != at_start.tunable() {
            let now = self.values.with_tunable(&self.tuned.now);
            self.outside.extend(outside::since(&at_start, &now));
        }
    }

    /// Whether a tunable parameter was set to another value than the model has.
    pub(super) fn is_retuned(&self) -> bool {
        let tunable = self.values.table().tunable().iter();
        self.is_started()
            && !tunable
                .map(|position| &self.values.as_slice()[*position])
                .eq(&self.tuned.now)
    }
}

/// Undoes a change of tunable parameters: `values` and `state` are those before it.
fn go_back<M: Model>(model: &mut M, values: &Values, state: &M::State) {
    let undone = model.tune(values).and_then(|()| model.restore(state));
    if let Err(error) = undone {
        panic!("the model does not go back to the tunable parameters that it had: {error}");
    }
}
