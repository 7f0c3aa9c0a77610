//! A simulation whose model is chosen at run time: one indirect call for each step, none inside.
//!
//! The FMI boundary works on these, so that it is compiled once and not for every model.

use std::any::Any;

use crate::error::{Error, Result};
use crate::info::ModelInfo;
use crate::listing::Listed;
use crate::model::{Model, Reached, Warning};
use crate::saved_bytes;
use crate::simulation::{Saved, Simulation};
use crate::structure::StructuralParameters;
use crate::value::Value;
use crate::values::Values;
use crate::variable::Variable;

/// A model as a value: what programs need that choose one at run time.
#[derive(Debug, Clone, Copy)]
pub struct ModelType {
    /// [`Model::info`].
    pub info: fn() -> ModelInfo,
    /// [`Model::EVENTS`].
    pub events: bool,
    /// [`Model::INPUT_PARTS`].
    pub input_parts: u32,
    /// [`Model::variables`] without how they are read.
    pub variables: fn(&StructuralParameters) -> Vec<Variable>,
    /// [`Simulation::prepare`].
    pub prepare: fn(StructuralParameters) -> Box<dyn DynSimulation>,
}

impl ModelType {
    /// Whether an importer may be called inside of a step (`providesIntermediateUpdate`).
    pub const fn updates_inside_steps(&self) -> bool {
        self.events || self.input_parts > 0
    }

    /// The model `M`.
    pub const fn of<M: Model>() -> Self {
        Self {
            info: M::info,
            events: M::EVENTS,
            input_parts: M::INPUT_PARTS,
            variables: |structure| M::variables(structure).into_iter().map(|row| row.variable).collect(),
            prepare: |structure| Box::new(Simulation::<M>::prepare(structure)),
        }
    }
}

/// A saved state of a [`DynSimulation`].
pub struct DynSaved {
    started: bool,
    /// Simulation that has saved it, or read it from bytes and checked it.
    checked_by: u64,
    /// A [`Saved`].
    saved: Box<dyn Any + Send>,
}

impl DynSaved {
    fn of<State: Send + 'static>(saved: Saved<State>, checked_by: u64) -> Self {
        Self {
            started: saved.is_started(),
            checked_by,
            saved: Box::new(saved),
        }
    }

    /// Whether there was a model.
    pub fn is_started(&self) -> bool {
        self.started
    }
}

impl std::fmt::Debug for DynSaved {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("DynSaved")
    }
}

/// The methods of [`Simulation`] without its type. See there for errors and guarantees.
#[allow(missing_docs)] // each is the method of the same name
pub trait DynSimulation: Send {
    fn info(&self) -> ModelInfo;
    fn has_events(&self) -> bool;
    fn structure(&self) -> &StructuralParameters;
    fn values(&self) -> &Values;
    fn position(&self, name: &str) -> Result<usize>;
    fn set_at(&mut self, position: usize, value: Value) -> Result<()>;
    fn set_bytes_at(&mut self, position: usize, bytes: &[u8]) -> Result<()>;
    /// Sets inputs from position `first` on, all of them reals of 64 bits, to values that were checked.
    fn set_signals(&mut self, first: usize, reals: &[f64]);
    fn value(&self, position: usize) -> Result<Value>;
    fn bytes(&self, position: usize) -> Result<&[u8]>;
    fn read_reals(&self, first: usize, out: &mut [f64]) -> Result<()>;
    fn list(&self, name: &str) -> Result<Listed>;
    fn set_start_time(&mut self, time: f64) -> Result<()>;
    fn start(&mut self, time: f64) -> Result<()>;
    fn reset(&mut self);
    fn stop(&mut self);
    fn is_started(&self) -> bool;
    fn start_time(&self) -> f64;
    fn time(&self) -> f64;
    fn advance_to(&mut self, end_time: f64) -> Result<()>;
    fn advance_to_event(&mut self, end_time: f64) -> Result<Reached>;
    fn resume_to_event(&mut self, end_time: f64) -> Result<Reached>;
    fn limit_work(&mut self, most: u64);
    fn warnings(&self, told: &[&'static str]) -> Vec<Warning>;
    fn save(&self) -> DynSaved;
    fn save_over(&self, saved: &mut DynSaved);
    fn restore(&mut self, saved: &DynSaved) -> Result<()>;
    fn restore_anew(&mut self, saved: &DynSaved) -> Result<()>;
    /// The saved state as a value that can be serialised: payload for an owner who adds more to it.
    fn saved_to_payload(&self, saved: &DynSaved) -> Result<Vec<u8>>;
    /// The saved state in a payload, checked as far as that can be done without a model.
    fn saved_from_payload(&self, payload: &[u8]) -> Result<DynSaved>;
    fn to_bytes(&self) -> Result<Vec<u8>>;
    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<()>;
    fn restore_bytes_anew(&mut self, bytes: &[u8]) -> Result<()>;
}

impl<M: Model> DynSimulation for Simulation<M> {
    fn info(&self) -> ModelInfo {
        M::info()
    }

    fn has_events(&self) -> bool {
        M::EVENTS
    }

    fn structure(&self) -> &StructuralParameters {
        self.structure()
    }

    fn values(&self) -> &Values {
        self.values()
    }

    fn position(&self, name: &str) -> Result<usize> {
        self.position(name)
    }

    fn set_at(&mut self, position: usize, value: Value) -> Result<()> {
        self.set_at(position, value)
    }

    fn set_bytes_at(&mut self, position: usize, bytes: &[u8]) -> Result<()> {
        self.set_bytes_at(position, bytes)
    }

    fn set_signals(&mut self, first: usize, reals: &[f64]) {
        self.set_signals(first, reals);
    }

    fn value(&self, position: usize) -> Result<Value> {
        self.value(position)
    }

    fn bytes(&self, position: usize) -> Result<&[u8]> {
        self.bytes(position)
    }

    fn read_reals(&self, first: usize, out: &mut [f64]) -> Result<()> {
        self.read_reals(first, out)
    }

    fn list(&self, name: &str) -> Result<Listed> {
        self.list(name)
    }

    fn set_start_time(&mut self, time: f64) -> Result<()> {
        self.set_start_time(time)
    }

    fn start(&mut self, time: f64) -> Result<()> {
        self.start(time)
    }

    fn reset(&mut self) {
        self.reset();
    }

    fn stop(&mut self) {
        self.stop();
    }

    fn is_started(&self) -> bool {
        self.is_started()
    }

    fn start_time(&self) -> f64 {
        self.start_time()
    }

    fn time(&self) -> f64 {
        self.time()
    }

    fn advance_to(&mut self, end_time: f64) -> Result<()> {
        self.advance_to(end_time)
    }

    fn advance_to_event(&mut self, end_time: f64) -> Result<Reached> {
        self.advance_to_event(end_time)
    }

    fn resume_to_event(&mut self, end_time: f64) -> Result<Reached> {
        self.resume_to_event(end_time)
    }

    fn limit_work(&mut self, most: u64) {
        self.limit_work(most);
    }

    fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        self.warnings(told)
    }

    fn save(&self) -> DynSaved {
        DynSaved::of(self.save(), self.id())
    }

    fn save_over(&self, saved: &mut DynSaved) {
        match saved.saved.downcast_mut() {
            Some(typed) => {
                self.save_over(typed);
                (saved.started, saved.checked_by) = (typed.is_started(), self.id());
            }
            None => *saved = DynSaved::of(self.save(), self.id()),
        }
    }

    fn restore(&mut self, saved: &DynSaved) -> Result<()> {
        match saved.checked_by == self.id() {
            true => self.go_to(typed(saved)?),
            false => self.restore(typed(saved)?),
        }
    }

    fn restore_anew(&mut self, saved: &DynSaved) -> Result<()> {
        self.restore_anew(typed(saved)?)
    }

    fn saved_to_payload(&self, saved: &DynSaved) -> Result<Vec<u8>> {
        saved_bytes::to_payload(typed::<M::State>(saved)?)
    }

    fn saved_from_payload(&self, payload: &[u8]) -> Result<DynSaved> {
        let saved: Saved<M::State> = saved_bytes::from_payload(payload)?;
        self.check(&saved)?;
        Ok(DynSaved::of(saved, self.id()))
    }

    fn to_bytes(&self) -> Result<Vec<u8>> {
        self.to_bytes()
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<()> {
        self.restore_bytes(bytes)
    }

    fn restore_bytes_anew(&mut self, bytes: &[u8]) -> Result<()> {
        self.restore_bytes_anew(bytes)
    }
}

fn typed<State: 'static>(saved: &DynSaved) -> Result<&Saved<State>> {
    saved
        .saved
        .downcast_ref()
        .ok_or_else(|| Error::state("it was saved by another model", "Restore it where it was saved."))
}
