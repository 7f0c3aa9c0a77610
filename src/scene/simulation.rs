//! A scene for a Rust program: parameters in, then inputs, steps and outputs by name.
//!
//! Needs: a [`Scene`]. Guarantees: the checks and the bits of the same scene in an FMU. Not here: scenes whose type is
//! found by name ([`super::AnySimulation`]), and importers that speak FMI (`fmi`).

mod saving;

use std::sync::Arc;

use crate::engine::MOST_WORK_IN_A_CALL;
use crate::error::{Error, Result};

use super::times::check_time;
use super::{Causality, Choice, Scene, Table, Value, Values};
pub use saving::Saved;

/// Time at which every simulation starts \[s\].
const START: f64 = 0.0;

/// One run of a scene, from time 0 on.
///
/// ```
/// use jostle::scene::Simulation;
/// use jostle::scene::packing::PackingOnSine;
///
/// let parameters = [("drive.amplitude", 1e-4.into()), ("seed", 7.into())];
/// let mut packing = Simulation::<PackingOnSine>::new(20, &parameters)?;
/// packing.advance_to(0.25)?;
/// println!("disk 1 has turned by {} rad", packing.real("disk.angle[1]")?);
/// # assert!(packing.real("disk.angle[1]")? != 0.0);
/// # jostle::Result::Ok(())
/// ```
#[derive(Debug)]
pub struct Simulation<S> {
    choice: Choice,
    scene: S,
    values: Values,
    time: f64,
    /// What [`Simulation::limit_work`] asked for.
    most_work: u64,
}

impl<S: Scene> Simulation<S> {
    /// The scene with this many disks; `given` holds the parameters, and the inputs at the start, that differ from the
    /// start values.
    ///
    /// # Errors
    /// A disk count, a name or a value that the scene does not take.
    pub fn new(disks: u32, given: &[(&str, Value)]) -> Result<Self> {
        let mut values = Self::start_values(disks)?;
        for (name, value) in given {
            give::<S>(&mut values, name, *value, &[Causality::Parameter, Causality::Input])?;
        }
        Self::start(disks, values)
    }

    pub(super) fn start_values(disks: u32) -> Result<Values> {
        let card = S::card();
        if card.disks.contains(&disks) {
            return Ok(Values::new(Arc::new(Table::new(S::variables(Choice { disks })))));
        }
        Err(Error::parameter(
            "number of disks",
            disks,
            format!("{} to {}", card.disks.start(), card.disks.end()),
            "Give a number in this range.",
        ))
    }

    pub(super) fn start(disks: u32, mut values: Values) -> Result<Self> {
        let choice = Choice { disks };
        let scene = S::new(choice, START, &values)?;
        scene.write_outputs(values.writer());
        Ok(Self {
            choice,
            scene,
            values,
            time: START,
            most_work: MOST_WORK_IN_A_CALL,
        })
    }

    /// Sets an input; it holds until it is set again.
    ///
    /// # Errors
    /// No input of this name, or not a finite number.
    pub fn set(&mut self, name: &str, value: impl Into<Value>) -> Result<()> {
        give::<S>(&mut self.values, name, value.into(), &[Causality::Input])
    }

    /// Sets the input at `position`, as [`Simulation::position`] gave it: [`Simulation::set`] without the search.
    ///
    /// # Errors
    /// No input there, or not a finite number.
    pub fn set_at(&mut self, position: usize, value: impl Into<Value>) -> Result<()> {
        match self.values.table().rows().get(position) {
            Some(row) if row.causality == Causality::Input => self.values.set(position, value.into()),
            Some(row) => Err(not_settable(&row.name, row.causality)),
            None => self.values.set(position, value.into()),
        }
    }

    /// Position of the variable called `name`: the same for as long as the simulation lives.
    ///
    /// # Errors
    /// The scene has no such variable.
    pub fn position(&self, name: &str) -> Result<usize> {
        self.values.table().position(name).ok_or_else(|| Self::unknown(name))
    }

    /// Goes on to `end_time` \[s\] under the inputs as they stand, as one communication step.
    ///
    /// # Errors
    /// `end_time` is not after the present time, or the scene cannot do the step. Nothing has changed then.
    pub fn advance_to(&mut self, end_time: f64) -> Result<()> {
        check_time("end of the step", end_time)?;
        if end_time <= self.time {
            return Err(Error::parameter(
                "end of the step",
                format!("{end_time} s"),
                format!("a time after {} s, where the last step ended", self.time),
                "Steps go forward in time.",
            ));
        }
        self.scene.advance_to(end_time, &self.values)?;
        self.scene.write_outputs(self.values.writer());
        self.time = end_time;
        Ok(())
    }

    /// Lets one step do no more than so much, instead of what takes half an hour at most: see
    /// [`WorkBudget`](crate::engine::WorkBudget).
    pub fn limit_work(&mut self, most: u64) {
        self.most_work = most;
        self.scene.limit_work(most);
    }

    /// Time reached \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The real variable called `name`, as of now.
    ///
    /// # Errors
    /// The scene has no such variable.
    pub fn real(&self, name: &str) -> Result<f64> {
        match self.value(name)? {
            Value::Real(real) => Ok(real),
            Value::Integer(_) => Err(Error::call(
                format!("{name} is a whole number"),
                "Read it as an integer.",
            )),
        }
    }

    /// The whole number called `name`, as of now.
    ///
    /// # Errors
    /// The scene has no such variable.
    pub fn integer(&self, name: &str) -> Result<i64> {
        match self.value(name)? {
            Value::Integer(integer) => Ok(integer),
            Value::Real(_) => Err(Error::call(format!("{name} is a real number"), "Read it as a real.")),
        }
    }

    /// The scene, to look at what is no variable.
    pub fn scene(&self) -> &S {
        &self.scene
    }

    /// All values, with the table of the variables.
    pub fn values(&self) -> &Values {
        &self.values
    }

    pub(super) fn unknown(name: &str) -> Error {
        let card = S::card();
        Error::call(
            format!(
                "the scene {} driven by {} has no variable {name}",
                card.scene, card.drive
            ),
            format!("List them: jostle describe {} --drive {}.", card.scene, card.drive),
        )
    }

    fn value(&self, name: &str) -> Result<Value> {
        let position = self.position(name)?;
        Ok(self.values.as_slice()[position])
    }
}

fn give<S: Scene>(values: &mut Values, name: &str, value: Value, settable: &[Causality]) -> Result<()> {
    let Some(position) = values.table().position(name) else {
        return Err(Simulation::<S>::unknown(name));
    };
    let causality = values.table().rows()[position].causality;
    if settable.contains(&causality) {
        return values.set(position, value);
    }
    Err(not_settable(name, causality))
}

fn not_settable(name: &str, causality: Causality) -> Error {
    let (why, remedy) = match causality {
        Causality::Parameter => (
            "is a parameter, frozen since the start",
            "Give it when the simulation is made.",
        ),
        _ => ("is computed by the scene", "Set a parameter or an input instead."),
    };
    Error::call(format!("{name} {why}"), remedy)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::packing::{PackingOnInput, PackingOnSine};

    fn told<T>(result: Result<T>) -> String {
        match result {
            Ok(_) => panic!("not refused"),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn refusals_name_variable_and_remedy() {
        let start = |given: &[(&str, Value)]| Simulation::<PackingOnInput>::new(5, given);
        assert!(told(start(&[("contact.glue", 1.0.into())])).contains("jostle describe packing --drive input"));
        assert!(told(start(&[("contact.friction", (-1.0).into())])).contains("contact.friction = -1"));
        assert!(told(start(&[("seed", 7.0.into())])).contains("a whole number"));
        assert!(told(start(&[("contacts", 7.into())])).contains("computed by the scene"));
        assert!(told(Simulation::<PackingOnInput>::new(0, &[])).contains("number of disks = 0"));
    }

    #[test]
    fn refused_calls_change_nothing() {
        let mut packing = Simulation::<PackingOnInput>::new(5, &[]).unwrap();
        packing.advance_to(0.5).unwrap();
        let before = packing.values().clone();
        assert!(told(packing.set("contact.friction", 0.2)).contains("frozen"));
        assert!(told(packing.set("base.displacement", f64::NAN)).contains("base.displacement"));
        assert!(told(packing.real("contacts")).contains("Read it as an integer"));
        assert!(told(packing.integer("energy.kinetic")).contains("Read it as a real"));
        for end_time in [0.5, 0.0] {
            assert!(told(packing.advance_to(end_time)).contains("after 0.5 s"));
        }
        for end_time in [f64::NAN, f64::INFINITY, 1e300] {
            assert!(told(packing.advance_to(end_time)).contains("to 1e10 s"));
        }
        assert_eq!((packing.values(), packing.time()), (&before, 0.5));
        assert!(packing.integer("contacts").unwrap() > 0);
    }

    #[test]
    fn a_simulation_is_its_scene() {
        let given = [("drive.amplitude", 1e-4.into()), ("seed", 3.into())];
        let mut packing = Simulation::<PackingOnSine>::new(20, &given).unwrap();
        let mut values = Values::new(Arc::new(Table::new(PackingOnSine::variables(Choice { disks: 20 }))));
        for (name, value) in given {
            values.set_by_name(name, value).unwrap();
        }
        let mut scene = PackingOnSine::new(Choice { disks: 20 }, 0.0, &values).unwrap();
        for end_time in [0.1, 0.25] {
            packing.advance_to(end_time).unwrap();
            scene.advance_to(end_time, &values).unwrap();
        }
        scene.write_outputs(values.writer());
        assert_eq!(packing.values(), &values);
        assert!(packing.scene().state() == scene.state());
    }
}
