//! Saved states of a simulation: bit for bit, as values or as bytes.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::Simulation;
use super::tuning::Tuned;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::saved_bytes;
use crate::times::is_simulated;
use crate::unit::Unit;
use crate::value::Value;
use crate::variable::fingerprint;

/// All that a simulation is at one time: parameters and inputs, times, and the state of the model if it has started.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Saved<State> {
    start: f64,
    time: f64,
    values: Vec<Value>,
    tuned: Tuned,
    /// Contents of texts and binary variables.
    bytes: Vec<Vec<u8>>,
    state: Option<State>,
}

impl<State> Saved<State> {
    /// Whether the simulation had started.
    pub fn is_started(&self) -> bool {
        self.state.is_some()
    }
}

impl<M: Model> Simulation<M> {
    /// Everything that a step, a set or a start can change.
    pub fn save(&self) -> Saved<M::State> {
        Saved {
            start: self.start,
            time: self.time,
            values: self.values.as_slice().to_vec(),
            tuned: match self.is_started() {
                true => self.tuned.clone(),
                false => Tuned::default(),
            },
            bytes: self.values.all_bytes().to_vec(),
            state: self.model.as_ref().map(M::state),
        }
    }

    /// As [`Simulation::save`], in the place of a state that was saved before and whose memory serves again.
    pub fn save_over(&self, saved: &mut Saved<M::State>) {
        let (Some(model), Some(state)) = (&self.model, &mut saved.state) else {
            *saved = self.save();
            return;
        };
        model.state_over(state);
        (saved.start, saved.time) = (self.start, self.time);
        saved.values.clear();
        saved.values.extend_from_slice(self.values.as_slice());
        saved.tuned.clone_from(&self.tuned);
        self.values.all_bytes().clone_into(&mut saved.bytes);
    }

    /// Goes back (or on) to a saved state and restores its parameters, those included that were set and wait for the next step.
    ///
    /// # Errors
    /// The state does not fit this model or its structure, or is damaged. The simulation is then as before.
    pub fn restore(&mut self, saved: &Saved<M::State>) -> Result<()> {
        self.check(saved)?;
        self.go_to(saved)
    }

    /// As [`Simulation::restore`], for a state that this same simulation has saved or checked.
    ///
    /// # Errors
    /// The model refuses the state. The simulation is then as before.
    pub(crate) fn go_to(&mut self, saved: &Saved<M::State>) -> Result<()> {
        let (values, tuned) = self.with_own(saved);
        let same = self.is_started() && self.start == saved.start && self.tuned.is_of_the_same_start(&tuned);
        let known = same && self.tuned.now == tuned.now;
        match (&saved.state, self.model.as_mut().filter(|_| same)) {
            (None, _) => self.model = None,
            (Some(state), Some(model)) => {
                Self::restore_tuned(model, state, &self.values, (&self.tuned, &tuned))?;
            }
            (Some(state), None) => {
                let values = self.values.with_all(&values, &saved.bytes);
                self.model = Some(self.build_tuned(saved.start, state, &values, &tuned)?);
            }
        }
        self.values.take_over(&values, &saved.bytes);
        if saved.is_started() && !known {
            self.tuned.clone_from(&tuned);
            self.judge_parameters();
        }
        self.retuned = self.is_retuned();
        (self.start, self.time) = (saved.start, saved.time);
        Ok(())
    }

    /// Values of a saved state, with those of this simulation where no state brings any along.
    fn with_own<'s>(&self, saved: &'s Saved<M::State>) -> (Cow<'s, [Value]>, Cow<'s, Tuned>) {
        let (mut values, mut tuned) = (Cow::Borrowed(&saved.values[..]), Cow::Borrowed(&saved.tuned));
        let own = self.values.table().settable().iter().zip(self.values.as_slice());
        for (position, (_, own)) in own.enumerate().filter(|(_, (variable, _))| variable.outside_states) {
            if values[position] != *own {
                values.to_mut()[position] = *own;
                tuned.to_mut().replace_at_start(position, *own);
            }
        }
        (values, tuned)
    }

    /// As [`Simulation::restore`], with the model built anew: for one that a panic may have left inconsistent.
    ///
    /// # Errors
    /// As [`Simulation::restore`].
    pub fn restore_anew(&mut self, saved: &Saved<M::State>) -> Result<()> {
        let pieces = self.model.take();
        self.restore(saved).inspect_err(|_| self.model = pieces)
    }

    /// Says whether times and values of a saved state can be those of this simulation.
    ///
    /// # Errors
    /// They cannot.
    pub fn check(&self, saved: &Saved<M::State>) -> Result<()> {
        self.values.check_all(&saved.values, &saved.bytes)?;
        saved
            .tuned
            .check(&self.values.with_all(&saved.values, &saved.bytes), saved.is_started())?;
        let Saved { start, time, state, .. } = saved;
        if !(is_simulated(*start) && is_simulated(*time) && time >= start) {
            return Err(Error::state(
                format!(
                    "it is at {} and started at {}",
                    Unit::SECOND.format(*time),
                    Unit::SECOND.format(*start)
                ),
                "Pass a state that saving gave.",
            ));
        }
        match state.as_ref().map(M::time_of).filter(|reached| reached != time) {
            None => Ok(()),
            Some(reached) => Err(Error::state(
                format!(
                    "its time is {} and its model's {}",
                    Unit::SECOND.format(*time),
                    Unit::SECOND.format(reached)
                ),
                "Pass a state that saving gave.",
            )),
        }
    }

    /// The present state as bytes without pointers, for a file or another process: see [`saved_bytes`].
    ///
    /// # Errors
    /// The state cannot be written: a defect.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        saved_bytes::write(&self.save(), &self.owner())
    }

    /// Goes to the state in bytes that a simulation of the same model, structure and version wrote.
    ///
    /// # Errors
    /// The bytes are damaged or foreign, or hold values out of range. The simulation is then as before.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<()> {
        self.restore(&saved_bytes::read(bytes, &self.owner())?)
    }

    /// As [`Simulation::restore_bytes`], with the model built anew: for one that a panic may have left inconsistent.
    ///
    /// # Errors
    /// As [`Simulation::restore_bytes`].
    pub fn restore_bytes_anew(&mut self, bytes: &[u8]) -> Result<()> {
        self.restore_anew(&saved_bytes::read(bytes, &self.owner())?)
    }

    /// For whom bytes are written.
    fn owner(&self) -> String {
        let info = M::info();
        let table = fingerprint(info.version, self.variables());
        let structure = self.structure.iter().map(|(name, value)| format!(":{name}={value}"));
        let variant = info.variant.iter().map(|(_, value)| format!(":{value}"));
        let choices: String = variant.chain(structure).collect();
        format!("simulation:{}{choices}:{table:016x}", info.name)
    }
}
