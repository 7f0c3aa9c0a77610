//! A model with its parameters and inputs: what a trial tries.

use std::sync::Arc;

use jostle::scene::{Model, Read, Result, StructuralParameters, Table, Value, Values};

use super::MOST_WORK;

/// Parameters and inputs of a model that is not made yet, and how its outputs are read.
pub struct Trial<M> {
    structure: StructuralParameters,
    reads: Vec<Read<M>>,
    /// Parameters and inputs.
    pub values: Values,
}

impl<M: Model> Trial<M> {
    /// Start values, with so many disks or the most that the scene takes.
    pub fn of_disks(disks: u32) -> Self {
        let info = M::info();
        let disks = disks.min(*info.structure[0].range.end());
        let structure = StructuralParameters::choose(&info, &[("disks", disks)]).expect("in range");
        let rows = M::variables(&structure);
        let reads = rows.iter().filter_map(|row| row.read.clone()).collect();
        let table = Table::new(rows.into_iter().map(|row| row.variable).collect());
        Self {
            structure,
            reads,
            values: Values::new(Arc::new(table)),
        }
    }

    /// Number of disks.
    pub fn disks(&self) -> u32 {
        self.structure.get("disks")
    }

    /// The model at `start` \[s\] under these parameters.
    pub fn model(&self, start: f64, values: &Values) -> Result<M> {
        let mut model = M::new(&self.structure, start, values)?;
        model.limit_work(MOST_WORK);
        Ok(model)
    }

    /// Sets a parameter or an input.
    pub fn set(&mut self, name: &str, value: f64) {
        let position = self.values.table().position(name).expect("a name of this scene");
        self.values.set(position, value.into()).expect("finite");
    }

    /// All values now: parameters, inputs, and what `model` computes.
    pub fn observe(&self, model: &M) -> Observed {
        let given = self.values.as_slice().iter().copied();
        let computed = self.reads.iter().map(|read| read.value(model));
        Observed {
            table: Arc::clone(self.values.table()),
            values: given.chain(computed).collect(),
        }
    }
}

/// All values at one time.
#[derive(Clone)]
pub struct Observed {
    table: Arc<Table>,
    /// In the order of the table.
    pub values: Vec<Value>,
}

impl Observed {
    /// The real called `name`, if the scene has it.
    pub fn find(&self, name: &str) -> Option<f64> {
        match self.values[self.table.position(name)?] {
            Value::Real(real) => Some(real),
            Value::Integer(_) => None,
        }
    }

    /// The real called `name`.
    pub fn real(&self, name: &str) -> f64 {
        self.find(name).expect("a real of this scene")
    }

    /// Names and values.
    pub fn iter(&self) -> impl Iterator<Item = (&str, Value)> {
        let names = self.table.variables().iter().map(|variable| variable.name.as_str());
        names.zip(self.values.iter().copied())
    }
}
