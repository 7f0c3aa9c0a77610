//! Numbers of an instance by value reference: who may read or set what, and when.

use super::Instance;
use super::access::{Access, Slot};
use crate::error::{Error, Result};
use crate::kind::Kind;
use crate::life_cycle::Phase;
use crate::standard::TIME_REFERENCE;
use crate::value::Value;
use crate::variable::{Causality, Variable};

impl Instance {
    /// Elements of the variable behind `reference`: 1 for a scalar, and for a reference that will be refused.
    #[inline]
    pub fn span(&self, reference: u32) -> usize {
        self.slot(reference).map_or(1, |slot| slot.span.max(1))
    }

    /// How many scalars there are, those in arrays included.
    pub fn scalars(&self) -> usize {
        self.slots.len()
    }

    /// Whether a variable is behind `reference`.
    pub fn knows(&self, reference: u32) -> bool {
        reference == TIME_REFERENCE || self.slot(reference).is_some_and(|slot| slot.span > 0)
    }

    /// Whether an input is behind `reference`.
    pub fn is_input(&self, reference: u32) -> bool {
        let position = (reference as usize).checked_sub(1);
        let variable = position.and_then(|position| self.table.variables().get(position));
        variable.is_some_and(|variable| variable.causality == Causality::Input)
    }

    /// Value behind `reference`; of an array the first element.
    ///
    /// # Errors
    /// Unknown reference, other type, or an output before initialisation or after a panic.
    pub fn get(&mut self, reference: u32, access: Access) -> Result<Value> {
        self.element(reference, 0, access)
    }

    /// Element `offset` of the variable behind `reference`; a scalar has element 0 alone.
    ///
    /// # Errors
    /// As [`Instance::get`].
    #[inline]
    pub fn element(&mut self, reference: u32, offset: usize, access: Access) -> Result<Value> {
        if reference == TIME_REFERENCE && matches!(access, Access::Real | Access::AnyReal) {
            return Ok(Value::Real(self.time()));
        }
        let position = self.position(reference, access)? + offset;
        self.read(position)
    }

    /// Reads variables as reals into `out`, which has as many elements as they have, by [`Access::Real`] or [`Access::AnyReal`]. Reals
    /// whose references follow one another are read in one go.
    ///
    /// # Errors
    /// As [`Instance::get`]; a whole number that does not fit 32 bits.
    pub fn get_reals(&mut self, references: &[u32], out: &mut [f64], access: Access) -> Result<()> {
        let (mut references, mut out) = (references, out);
        while let [reference, ..] = *references {
            let (mut count, mut elements) = self.run_of_reals(references);
            if count > 0 {
                let first = reference as usize - 1;
                self.check_readable(first)?;
                self.simulation.read_reals(first, &mut out[..elements])?;
            } else {
                (count, elements) = (1, self.span(reference));
                for (offset, real) in out[..elements].iter_mut().enumerate() {
                    *real = match self.element(reference, offset, access)? {
                        Value::Real(real) => real,
                        Value::Integer(integer) => i32::try_from(integer)
                            .map_err(|_| does_not_fit(reference, Value::Integer(integer)))?
                            .into(),
                    };
                }
            }
            references = &references[count..];
            out = &mut out[elements..];
        }
        Ok(())
    }

    /// Position of the first of `references`, if all are scalars that [`Slot::run`] counts, one after the other.
    #[inline]
    fn first_of_run(&self, references: &[u32]) -> Option<usize> {
        let first = *references.first()?;
        let follow = || {
            (first..)
                .zip(references)
                .all(|(expected, reference)| *reference == expected)
        };
        let slot = self.slot(first)?;
        (slot.run as usize >= references.len() && follow()).then(|| first as usize - 1)
    }

    /// As [`Instance::get_reals`], for scalar reals one after the other, which are the most that importers ask for. False if it is
    /// for [`Instance::get_reals`].
    ///
    /// # Errors
    /// As [`Instance::get_reals`].
    #[inline]
    pub fn get_run(&mut self, references: &[u32], out: &mut [f64]) -> Result<bool> {
        let Some(first) = self.first_of_run(references) else {
            return Ok(false);
        };
        self.check_readable(first)?;
        self.simulation.read_reals(first, out)?;
        Ok(true)
    }

    /// How many of `references`, from the first on, are those of reals beside one another that are all computed or all given,
    /// and how many elements these have.
    #[inline]
    fn run_of_reals(&self, references: &[u32]) -> (usize, usize) {
        let computed = self.slot(references[0]).is_some_and(|slot| slot.computed);
        let (mut count, mut next) = (0, references[0] as usize);
        for reference in references {
            match self.slot(*reference) {
                Some(slot)
                    if *reference as usize == next && slot.real && slot.span > 0 && slot.computed == computed =>
                {
                    next += slot.span;
                }
                _ => break,
            }
            count += 1;
        }
        (count, next - references[0] as usize)
    }

    /// Rate of change of an output. Of first order, where the model names a variable that is just that (an angle has an
    /// angular velocity); of any other output it is 0, which is both standards' answer where the order is not available.
    ///
    /// # Errors
    /// Unknown reference, no real output, an order that is not offered, or before initialisation.
    pub fn output_derivative(&mut self, reference: u32, offset: usize, order: i32) -> Result<f64> {
        let position = self.position(reference, Access::Real)? + offset;
        let variable = &self.table.variables()[position];
        let highest = i32::from(self.table.has_derivatives(Causality::Output));
        if !(1..=highest).contains(&order) {
            return Err(Error::call(
                format!("the derivative of order {order} of {} is not offered", variable.name),
                format!("maxOutputDerivativeOrder = {highest}; the orders are counted from 1."),
            ));
        }
        if variable.causality != Causality::Output {
            return Err(Error::call(
                format!("{} is no output", variable.name),
                "Ask for derivatives of outputs.",
            ));
        }
        let derivative = self.table.derivative(position);
        match self.read(derivative.unwrap_or(position))? {
            Value::Real(rate) if derivative.is_some() => Ok(rate),
            _ => Ok(0.0),
        }
    }

    /// Sets the rates of change of inputs: another way to set the input that is just that, such as a velocity for a position.
    /// All, or none if one is refused. The arrays are equally long.
    ///
    /// # Errors
    /// As [`Instance::set`]; an order that is not positive; an input whose derivative of this order the model does not use.
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Result<()> {
        let derivative = |instance: &Self, index: usize| instance.input_derivative(references[index], orders[index]);
        self.set_positions(references.len(), derivative, |index| Value::Real(values[index]))
    }

    /// Position of the input that is the derivative of this order of the input behind `reference`.
    fn input_derivative(&self, reference: u32, order: i32) -> Result<usize> {
        let position = self.position(reference, Access::Real)?;
        let variable = &self.table.variables()[position];
        let target = match (variable.causality, order) {
            (Causality::Input, 1..) => (0..order).try_fold(position, |position, _| self.table.derivative(position)),
            _ => None,
        };
        target.ok_or_else(|| {
            Error::call(
                format!("the derivative of order {order} of {} has no effect", variable.name),
                "The model uses those of inputs whose derivative is an input too; orders are counted from 1.",
            )
        })
    }

    /// Stores a value for each of `references`, which are scalars, or, if one of them is refused, none.
    ///
    /// # Errors
    /// Unknown reference, other type, not to be set in this phase or at all, not finite, out of range.
    pub fn set(&mut self, references: &[u32], access: Access, value: impl Fn(usize) -> Value) -> Result<()> {
        let position =
            |instance: &Self, index: usize| instance.position_of(references[index], access, |span| span == 1);
        self.set_positions(references.len(), position, value)
    }

    /// As [`Instance::set`] for reals, in one go if they are inputs one after the other.
    ///
    /// # Errors
    /// As [`Instance::set`].
    pub fn set_reals(&mut self, references: &[u32], access: Access, values: &[f64]) -> Result<()> {
        let fit = |slots: &[Slot]| {
            let mut pairs = slots.iter().zip(values);
            pairs.all(|(slot, value)| value.is_finite() && (slot.signal[0]..=slot.signal[1]).contains(value))
        };
        let first = self.first_of_run(references).filter(|first| {
            let slots = self.slots.get(*first..first + references.len());
            self.takes_inputs() && slots.is_some_and(fit)
        });
        let Some(first) = first else {
            return self.set(references, access, |index| Value::Real(values[index]));
        };
        self.forget_model(references.len());
        self.simulation.set_signals(first, values);
        Ok(())
    }

    /// Stores `count` values for the elements of `references`, one variable after the other, or, if one of them is refused, none.
    ///
    /// # Errors
    /// As [`Instance::set`]; another number of values.
    pub fn set_elements(
        &mut self,
        references: &[u32],
        access: Access,
        count: usize,
        value: impl Fn(usize) -> Value,
    ) -> Result<()> {
        let mut positions = Vec::new();
        for reference in references {
            let first = self.position(*reference, access)?;
            positions.extend(first..first + self.span(*reference));
        }
        if positions.len() != count {
            return Err(Error::call(
                format!(
                    "the array of values has {count} elements, expected are {}",
                    positions.len()
                ),
                "Pass one value for each scalar, and as many as its dimension says for each array.",
            ));
        }
        self.set_positions(count, |_, index| Ok(positions[index]), value)
    }

    /// Before `count` values are stored: a model of the old ones may have been built for reading outputs in initialization mode.
    pub(super) fn forget_model(&mut self, count: usize) {
        if self.phase == Phase::Initialization && count > 0 {
            self.simulation.stop();
        }
    }

    /// Stores `count` values where `position` says, or none if one is refused.
    fn set_positions(
        &mut self,
        count: usize,
        position: impl Fn(&Self, usize) -> Result<usize>,
        value: impl Fn(usize) -> Value,
    ) -> Result<()> {
        for index in 0..count {
            let variable = &self.table.variables()[position(self, index)?];
            self.check_settable(variable)?;
            variable.check(value(index))?;
        }
        self.forget_model(count);
        for index in 0..count {
            let position = position(self, index)?;
            self.simulation.set_at(position, value(index))?;
        }
        Ok(())
    }

    #[inline]
    fn read(&mut self, position: usize) -> Result<Value> {
        self.check_readable(position)?;
        self.simulation.value(position)
    }

    /// Whether there is a value at `position`. In initialization mode a model of the values as they stand is built, if need be.
    #[inline]
    pub(super) fn check_readable(&mut self, position: usize) -> Result<()> {
        if self.slots[position].computed {
            match self.phase {
                Phase::Instantiated => return Err(not_computed(&self.table.variables()[position])),
                Phase::Initialization => self.build()?,
                Phase::Failed => return Err(not_known(&self.table.variables()[position])),
                _ => {}
            }
        }
        Ok(())
    }

    pub(super) fn check_settable(&self, variable: &Variable) -> Result<()> {
        let before = matches!(self.phase, Phase::Instantiated | Phase::Initialization);
        match variable.causality {
            Causality::Parameter if before => Ok(()),
            Causality::Parameter if variable.tunable && matches!(self.phase, Phase::Event | Phase::Step) => Ok(()),
            Causality::Input if self.takes_inputs() => Ok(()),
            _ => Err(not_settable(variable, self.phase)),
        }
    }

    /// Whether inputs may be set in this phase.
    fn takes_inputs(&self) -> bool {
        match self.phase {
            Phase::Instantiated | Phase::Initialization | Phase::Event | Phase::Step => true,
            Phase::IntermediateUpdate => self.input_parts > 0,
            Phase::Terminated | Phase::Failed => false,
        }
    }

    #[inline]
    fn slot(&self, reference: u32) -> Option<&Slot> {
        self.slots.get((reference as usize).wrapping_sub(1))
    }

    /// Position of the variable behind `reference`, if it can be accessed so.
    #[inline]
    pub(super) fn position(&self, reference: u32, access: Access) -> Result<usize> {
        self.position_of(reference, access, |span| span > 0)
    }

    /// As [`Instance::position`], of a variable with such a number of elements.
    #[inline]
    fn position_of(&self, reference: u32, access: Access, fits: impl Fn(usize) -> bool) -> Result<usize> {
        match self.slot(reference) {
            Some(slot) if fits(slot.span) && slot.accesses >> access as u8 & 1 == 1 => Ok(reference as usize - 1),
            slot => Err(self.no_access(reference, access, slot)),
        }
    }

    #[cold]
    fn no_access(&self, reference: u32, access: Access, slot: Option<&Slot>) -> Error {
        let what = match slot {
            None if reference == TIME_REFERENCE => {
                "value reference 0 is the time, a real that only steps change".into()
            }
            None => format!(
                "value reference {reference} is unknown, there are 0 to {}",
                self.slots.len()
            ),
            Some(Slot { span: 0, .. }) => format!("value reference {reference} is inside of an array"),
            Some(Slot { span, accesses, .. }) if *span > 1 && accesses >> access as u8 & 1 == 1 => {
                return Error::call(
                    format!("value reference {reference} is an array of {span} elements, and one value is given"),
                    "Pass as many values as the dimensions say.",
                );
            }
            Some(_) => return of_another_type(&self.table.variables()[reference as usize - 1], reference),
        };
        Error::call(what, "Take the value references from modelDescription.xml.")
    }
}

/// Refuses a value read as a type that is too small for it.
#[cold]
pub fn does_not_fit(reference: u32, value: Value) -> Error {
    Error::call(
        format!("value reference {reference} holds {value}, which does not fit this type"),
        "Read it through FMI 3.0.",
    )
}

#[cold]
fn not_computed(variable: &Variable) -> Error {
    Error::call(
        format!("{} is not computed yet", variable.name),
        "Enter initialization mode first.",
    )
}

#[cold]
fn not_known(variable: &Variable) -> Error {
    Error::call(
        format!("{} is not known: the instance has failed", variable.name),
        "Reset the instance, restore a saved state or free it.",
    )
}

#[cold]
fn not_settable(variable: &Variable, phase: Phase) -> Error {
    let remedy = match variable.causality {
        Causality::Parameter if variable.tunable => {
            "Tunable parameters may be set between steps until the simulation is terminated."
        }
        Causality::Parameter => "Parameters are frozen when initialization ends: reset, then set it.",
        Causality::Input => "Inputs may be set until the simulation is terminated.",
        Causality::Output | Causality::CalculatedParameter => "The model computes it: read it only.",
    };
    Error::call(
        format!("{} cannot be set in the phase {}", variable.name, phase.name()),
        remedy,
    )
}

#[cold]
fn of_another_type(variable: &Variable, reference: u32) -> Error {
    let kind = match variable.kind {
        Kind::Real(_) => "real (Real, Float64)",
        Kind::Integer { .. } => "32-bit integer (Integer, Int32)",
        Kind::Long { .. } => "64-bit integer (Integer, Int64)",
        Kind::Enumeration { .. } => "enumeration (Integer, Int64)",
        Kind::Boolean { .. } => "boolean (Boolean)",
        Kind::Single(_) => "32-bit real (Real, Float32)",
        Kind::Sized { size, .. } => {
            return refused_type(variable, reference, &format!("integer (Integer, {})", size.name()));
        }
        Kind::Text { .. } => "text (String)",
        Kind::Binary { .. } => "binary (Binary)",
    };
    refused_type(variable, reference, kind)
}

fn refused_type(variable: &Variable, reference: u32, kind: &str) -> Error {
    Error::call(
        format!("{} (value reference {reference}) is of type {kind}", variable.name),
        "Call the function of this type.",
    )
}
