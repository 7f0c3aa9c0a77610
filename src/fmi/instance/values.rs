//! Values of an instance by value reference: who may read or set what, when, and as which type.

use super::Instance;
use crate::error::{Error, Result};
use crate::fmi::life_cycle::Phase;
use crate::fmi::{TIME_REFERENCE, derivatives, value_reference};
use crate::scene::{Causality, Kind, Scene, Value, Variable};

/// The type by which an importer reads or writes a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// `fmi2Real`, `fmi3Float64`.
    Real,
    /// `fmi3Int32`.
    Integer,
    /// `fmi3Int64`, which serves enumerations too.
    Long,
    /// `fmi2Integer`, which serves all whole numbers.
    AnyInteger,
}

impl Access {
    /// A count or an option among the outputs may be read as a real too: there are importers that read all outputs so.
    fn fits(self, row: &Variable) -> bool {
        match row.kind {
            Kind::Real(_) => self == Self::Real,
            Kind::Integer { .. } => {
                matches!(self, Self::Integer | Self::AnyInteger)
                    || self == Self::Real && row.causality == Causality::Output
            }
            Kind::Enumeration { .. } if self == Self::Real => row.causality == Causality::Output,
            Kind::Long { .. } | Kind::Enumeration { .. } => matches!(self, Self::Long | Self::AnyInteger),
        }
    }
}

impl<S: Scene> Instance<S> {
    /// Elements of the variable behind `reference`: 1 for a scalar, and for a reference that will be refused.
    pub fn span(&self, reference: u32) -> usize {
        let position = (reference as usize).wrapping_sub(1);
        let span = self.spans.as_ref().and_then(|spans| spans.get(position));
        span.copied().unwrap_or(1).max(1)
    }

    /// Whether a variable is behind `reference`.
    pub fn knows(&self, reference: u32) -> bool {
        reference == TIME_REFERENCE || self.locate(reference).is_ok()
    }

    /// Value behind `reference`; of an array the first element.
    ///
    /// # Errors
    /// Unknown reference, other type, or an output before initialisation.
    pub fn get(&mut self, reference: u32, access: Access) -> Result<Value> {
        self.element(reference, 0, access)
    }

    /// Element `offset` of the variable behind `reference`; a scalar has element 0 alone.
    ///
    /// # Errors
    /// As [`Instance::get`].
    pub fn element(&mut self, reference: u32, offset: usize, access: Access) -> Result<Value> {
        if reference == TIME_REFERENCE && access == Access::Real {
            return Ok(Value::Real(self.clock.now));
        }
        let position = self.position(reference, access)? + offset;
        self.compute(position)?;
        Ok(self.values.as_slice()[position])
    }

    /// Rate of change of an output. Of first order, where a variable of the scene is just that (an angle has an angular
    /// velocity); of any other output it is 0, which is both standards' answer where the order is not available.
    ///
    /// # Errors
    /// Unknown reference, no real output, an order that is not offered, or before initialisation.
    pub fn output_derivative(&mut self, reference: u32, offset: usize, order: i32) -> Result<f64> {
        let position = self.position(reference, Access::Real)? + offset;
        let table = self.values.table();
        let row = &table.rows()[position];
        let highest = i32::from(derivatives::any(table, Causality::Output));
        if !(1..=highest).contains(&order) {
            return Err(Error::call(
                format!("the derivative of order {order} of {} is not offered", row.name),
                format!("maxOutputDerivativeOrder = {highest}; the orders are counted from 1."),
            ));
        }
        if row.causality != Causality::Output {
            return Err(Error::call(
                format!("{} is no output", row.name),
                "Ask for derivatives of outputs.",
            ));
        }
        let derivative = derivatives::of(table, position);
        self.compute(position)?;
        match derivative.map(|derivative| self.values.as_slice()[derivative]) {
            Some(Value::Real(rate)) => Ok(rate),
            _ => Ok(0.0),
        }
    }

    /// Sets the rates of change of inputs: another way to set the input that is just that (`base.velocity` for
    /// `base.displacement`). All, or none if one is refused. The arrays are equally long.
    ///
    /// # Errors
    /// As [`Instance::set`]; an order other than 1; an input whose derivative the scene does not use.
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Result<()> {
        let mut targets = Vec::with_capacity(references.len());
        for (reference, order) in references.iter().zip(orders) {
            let position = self.position(*reference, Access::Real)?;
            let table = self.values.table();
            let row = &table.rows()[position];
            let input = row.causality == Causality::Input && *order == 1;
            let Some(target) = derivatives::of(table, position).filter(|_| input) else {
                return Err(Error::call(
                    format!("the derivative of order {order} of {} has no effect", row.name),
                    "The scene uses that of order 1 of an input displacement, where it has one.",
                ));
            };
            targets.push(value_reference(target));
        }
        self.set(&targets, Access::Real, |index| Value::Real(values[index]))
    }

    /// Makes sure that the value at `position` is that of the present state.
    fn compute(&mut self, position: usize) -> Result<()> {
        let row = &self.values.table().rows()[position];
        if !computed(row) {
            return Ok(());
        }
        match self.phase {
            Phase::Instantiated => Err(Error::call(
                format!("{} is not computed yet", row.name),
                "Enter initialization mode first.",
            )),
            Phase::Initialization => self.build(),
            _ => Ok(()),
        }
    }

    /// Stores all values or, if one of them is refused, none.
    ///
    /// # Errors
    /// Unknown reference, other type, not to be set in this phase or at all, not finite, out of range.
    pub fn set(&mut self, references: &[u32], access: Access, value: impl Fn(usize) -> Value) -> Result<()> {
        for (index, reference) in references.iter().enumerate() {
            let position = self.position(*reference, access)?;
            let row = &self.values.table().rows()[position];
            self.check_settable(row)?;
            row.check(value(index))?;
        }
        for (index, reference) in references.iter().enumerate() {
            let position = self.position(*reference, access)?;
            self.values.set(position, value(index))?;
        }
        self.stale |= self.phase == Phase::Initialization && !references.is_empty();
        Ok(())
    }

    fn check_settable(&self, row: &Variable) -> Result<()> {
        let before = matches!(self.phase, Phase::Instantiated | Phase::Initialization);
        let running = matches!(self.phase, Phase::Event | Phase::Step);
        let remedy = match row.causality {
            Causality::Parameter if before => return Ok(()),
            Causality::Input if before || running => return Ok(()),
            Causality::Parameter => "Parameters are frozen when initialization ends: reset, then set it.",
            Causality::Input => "Inputs may be set until the simulation is terminated.",
            Causality::Output | Causality::CalculatedParameter => "The scene computes it: read it only.",
        };
        Err(Error::call(
            format!("{} cannot be set in the phase {}", row.name, self.phase.name()),
            remedy,
        ))
    }

    /// Position of the row behind `reference`, whatever its type.
    fn locate(&self, reference: u32) -> Result<usize> {
        let rows = self.values.table().rows();
        let position = (reference as usize).wrapping_sub(1);
        if position >= rows.len() {
            let what = match reference {
                TIME_REFERENCE => "value reference 0 is the time, a real that only steps change".into(),
                _ => format!("value reference {reference} is unknown, there are 0 to {}", rows.len()),
            };
            return Err(Error::call(
                what,
                "Take the value references from modelDescription.xml.",
            ));
        }
        if self.spans.as_ref().is_some_and(|spans| spans[position] == 0) {
            return Err(Error::call(
                format!("value reference {reference} is inside of an array"),
                "Take the value references from modelDescription.xml.",
            ));
        }
        Ok(position)
    }

    fn position(&self, reference: u32, access: Access) -> Result<usize> {
        let position = self.locate(reference)?;
        let row = &self.values.table().rows()[position];
        if access.fits(row) {
            return Ok(position);
        }
        let kind = match row.kind {
            Kind::Real(_) => "real (Real, Float64)",
            Kind::Integer { .. } => "32-bit integer (Integer, Int32)",
            Kind::Long { .. } => "64-bit integer (Integer, Int64)",
            Kind::Enumeration { .. } => "enumeration (Integer, Int64)",
        };
        Err(Error::call(
            format!("{} (value reference {reference}) is of type {kind}", row.name),
            "Call the function of this type.",
        ))
    }
}

fn computed(row: &Variable) -> bool {
    matches!(row.causality, Causality::Output | Causality::CalculatedParameter)
}
