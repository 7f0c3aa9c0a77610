//! A simulation whose scene is named at run time.
//!
//! Needs: names from the [`catalogue`](super::catalogue). Guarantees: the bits of the [`Simulation`] of that scene; one
//! indirect call for each step, none inside. Programs that know their scene take [`Simulation`] and compile no other.

use std::fmt;

use super::{
    DynSimulation, Error, Listed, Model, Result, Simulation, StructuralParameters, Value, Variable, Warning, catalogue,
};

/// Which scene, by name. What is left out is the scene's first: `jostle describe` and the README list them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Selection<'a> {
    /// Scene, such as `packing`.
    pub scene: &'a str,
    /// Engine, such as `molecular-dynamics`.
    pub engine: Option<&'a str>,
    /// Drive, such as `input` or `sine`.
    pub drive: Option<&'a str>,
    /// Number of disks.
    pub disks: Option<u32>,
}

impl<'a> Selection<'a> {
    /// The scene called `scene`, all else as it comes.
    pub fn of(scene: &'a str) -> Self {
        Self {
            scene,
            ..Self::default()
        }
    }
}

/// One run of any scene, from time 0 on.
///
/// ```
/// use jostle::scene::{AnySimulation, Selection};
///
/// let selection = Selection { drive: Some("sine"), disks: Some(20), ..Selection::of("packing") };
/// let mut packing = AnySimulation::new(selection, &[("drive.amplitude", "1e-4"), ("seed", "7")])?;
/// packing.advance_to(0.25)?;
/// let bytes = packing.to_bytes()?;
/// println!("disk 1 has turned by {} rad", packing.real("disk.angle[1]")?);
///
/// let mut later = AnySimulation::new(selection, &[])?;
/// later.restore_bytes(&bytes)?;
/// assert_eq!(later.real("disk.angle[1]")?, packing.real("disk.angle[1]")?);
/// # jostle::Result::Ok(())
/// ```
pub struct AnySimulation(Box<dyn DynSimulation>);

impl fmt::Debug for AnySimulation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "AnySimulation at t = {} s", self.time())
    }
}

impl AnySimulation {
    /// The selected scene; `given` holds the parameters, and the inputs at the start, that differ from the start values:
    /// names and texts as on the command line. Of several texts for one name the last counts.
    ///
    /// # Errors
    /// A scene, engine, drive or disk count that does not exist, a name or a value that the scene does not take.
    pub fn new(selection: Selection<'_>, given: &[(&str, &str)]) -> Result<Self> {
        let mut simulation = prepare(selection)?;
        for (name, text) in given {
            let position = settable(&*simulation, name)?;
            let value = simulation.values().table().variables()[position].parse(text)?;
            simulation.set_at(position, value)?;
        }
        simulation.start(0.0)?;
        Ok(Self(simulation))
    }

    /// As [`AnySimulation::new`], with values in the place of texts.
    ///
    /// # Errors
    /// As [`AnySimulation::new`].
    pub fn with_values(selection: Selection<'_>, given: &[(&str, Value)]) -> Result<Self> {
        let mut simulation = prepare(selection)?;
        for (name, value) in given {
            let position = settable(&*simulation, name)?;
            simulation.set_at(position, *value)?;
        }
        simulation.start(0.0)?;
        Ok(Self(simulation))
    }

    /// Sets an input, which holds until it is set again, or a tunable parameter, which acts from the next step on.
    ///
    /// # Errors
    /// No input or tunable parameter of this name, or a value out of range.
    pub fn set(&mut self, name: &str, value: impl Into<Value>) -> Result<()> {
        let position = self.position(name)?;
        self.set_at(position, value)
    }

    /// [`AnySimulation::set`] at a `position`, as [`AnySimulation::position`] gave it.
    ///
    /// # Errors
    /// As [`AnySimulation::set`].
    pub fn set_at(&mut self, position: usize, value: impl Into<Value>) -> Result<()> {
        self.0.set_at(position, value.into())
    }

    /// Position of the variable called `name`: the same for as long as the simulation lives.
    ///
    /// # Errors
    /// The scene has no such variable.
    pub fn position(&self, name: &str) -> Result<usize> {
        self.0.position(name)
    }

    /// What is doubtful about the parameters, each a sentence or two with what to do.
    pub fn warnings(&self) -> Vec<Warning> {
        self.0.warnings(&[])
    }

    /// Advances to `end_time` \[s\] under the inputs as they stand, as one communication step.
    ///
    /// # Errors
    /// `end_time` is not after the present time, or the scene cannot do the step. Nothing has changed then.
    pub fn advance_to(&mut self, end_time: f64) -> Result<()> {
        self.0.advance_to(end_time)
    }

    /// Limits the work of one step, instead of what takes half an hour at most: see
    /// [`WorkBudget`](crate::engine::WorkBudget).
    pub fn limit_work(&mut self, most: u64) {
        self.0.limit_work(most);
    }

    /// Time reached \[s\].
    pub fn time(&self) -> f64 {
        self.0.time()
    }

    /// The real variable called `name`, as of now.
    ///
    /// # Errors
    /// The scene has no such variable, or it is a whole number.
    pub fn real(&self, name: &str) -> Result<f64> {
        match self.value(self.position(name)?)? {
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
    /// The scene has no such variable, or it is a real.
    pub fn integer(&self, name: &str) -> Result<i64> {
        match self.value(self.position(name)?)? {
            Value::Integer(integer) => Ok(integer),
            Value::Real(_) => Err(Error::call(format!("{name} is a real number"), "Read it as a real.")),
        }
    }

    /// Value of the variable at `position`, as of now.
    ///
    /// # Errors
    /// No variable there.
    pub fn value(&self, position: usize) -> Result<Value> {
        self.0.value(position)
    }

    /// The list called `name` as of now, such as `contacts`.
    ///
    /// # Errors
    /// The scene's engine has no such list.
    pub fn list(&self, name: &str) -> Result<Listed> {
        self.0.list(name)
    }

    /// All values as of now, in the order of [`AnySimulation::variables`].
    ///
    /// # Errors
    /// None once it is made.
    pub fn all_values(&self) -> Result<Vec<Value>> {
        (0..self.variables().len())
            .map(|position| self.value(position))
            .collect()
    }

    /// The parameter or input called `name`, and what it holds now; none if the scene has no such parameter or input.
    pub fn given(&self, name: &str) -> Option<Value> {
        let values = self.0.values();
        values.table().position(name).and_then(|position| values.get(position))
    }

    /// The variables: parameters and inputs first.
    pub fn variables(&self) -> &[Variable] {
        self.0.values().table().variables()
    }

    /// The state as bytes without pointers, for a file or another process: see [`fmi_component::saved_bytes`].
    ///
    /// # Errors
    /// The state cannot be written: a defect.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        self.0.to_bytes()
    }

    /// Goes to the state in bytes that a simulation of the same selection and version of jostle wrote, parameters
    /// included.
    ///
    /// # Errors
    /// The bytes are damaged or foreign, or hold values out of range. The simulation is then as before.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<()> {
        self.0.restore_bytes(bytes)
    }

    /// As [`AnySimulation::restore_bytes`], with the scene made anew: for one that a panic may have left inconsistent.
    ///
    /// # Errors
    /// As [`AnySimulation::restore_bytes`].
    pub fn restore_bytes_anew(&mut self, bytes: &[u8]) -> Result<()> {
        self.0.restore_bytes_anew(bytes)
    }
}

/// The selected scene with start values, not started.
fn prepare(selection: Selection<'_>) -> Result<Box<dyn DynSimulation>> {
    let model = catalogue::find(selection.scene, selection.engine, selection.drive)?;
    let disks = selection.disks.map(|disks| ("disks", disks));
    let structure = StructuralParameters::choose(&(model.info)(), disks.as_slice())?;
    Ok((model.prepare)(structure))
}

/// Position of the parameter or input called `name`.
fn settable(simulation: &dyn DynSimulation, name: &str) -> Result<usize> {
    let position = simulation.position(name)?;
    match simulation.values().table().variables()[position]
        .causality
        .is_settable()
    {
        true => Ok(position),
        false => Err(Error::call(
            format!("{name} is computed by the scene"),
            "Give a parameter or an input instead.",
        )),
    }
}

impl<M: Model> From<Simulation<M>> for AnySimulation {
    fn from(simulation: Simulation<M>) -> Self {
        Self(Box::new(simulation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::catalogue::{MODELS, Names};
    use crate::scene::packing::PackingOnSine;

    #[test]
    fn every_scene_runs_saves_and_restores() {
        for model in MODELS {
            let info = (model.info)();
            let names = Names::from(&info);
            let selection = Selection {
                scene: names.scene,
                engine: Some(names.engine),
                drive: Some(names.drive),
                disks: Some(3.min(*info.structure[0].range.end())),
            };
            let mut one = AnySimulation::new(selection, &[]).unwrap();
            let mut other = AnySimulation::new(selection, &[]).unwrap();
            one.advance_to(0.01).unwrap();
            other.restore_bytes(&one.to_bytes().unwrap()).unwrap();
            for simulation in [&mut one, &mut other] {
                simulation.advance_to(0.02).unwrap();
            }
            assert_eq!(one.all_values(), other.all_values(), "{names:?}");
        }
    }

    #[test]
    fn the_bits_are_those_of_the_typed_simulation() {
        let mut typed =
            Simulation::<PackingOnSine>::new(&[("disks", 10)], &[("drive.amplitude", 1e-4.into())]).unwrap();
        let selection = Selection {
            drive: Some("sine"),
            disks: Some(10),
            ..Selection::of("packing")
        };
        let mut named = AnySimulation::new(selection, &[("drive.amplitude", "1e-4")]).unwrap();
        typed.advance_to(0.1).unwrap();
        named.advance_to(0.1).unwrap();
        assert_eq!(typed.all_values(), named.all_values());
    }

    #[test]
    fn what_is_wrong_is_named() {
        let message = |selection, given: &[(&str, &str)]| AnySimulation::new(selection, given).unwrap_err().to_string();
        let packing = Selection::of("packing");
        assert!(message(Selection::of("sandpile"), &[]).contains("one of: packing"));
        assert!(message(packing, &[("glue", "1")]).contains("no variable glue"));
        assert!(message(packing, &[("contacts", "1")]).contains("computed by the scene"));
        assert!(message(packing, &[("seed", "1.5")]).contains("a whole number"));
        assert!(message(packing, &[("gravity", "1,5")]).contains("gravity = 1,5"));
        assert!(
            message(
                Selection {
                    disks: Some(0),
                    ..packing
                },
                &[]
            )
            .contains("number of disks = 0")
        );
        let mut packing = AnySimulation::new(packing, &[]).unwrap();
        assert!(packing.set("seed", 3_i64).unwrap_err().to_string().contains("frozen"));
        assert!(packing.set_at(100_000, 1.0).is_err());
    }
}
