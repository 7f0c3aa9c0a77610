//! A simulation whose scene is named at run time: the one place where a scene stands behind a pointer.
//!
//! Needs: names from the [`catalogue`](super::catalogue). Guarantees: the bits of the [`Simulation`] of that scene; one
//! indirect call for each step, none inside. Programs that know their scene take [`Simulation`] and compile no other.

use std::fmt;

use super::catalogue::{Visitor, with_scene};
use super::{Causality, Scene, Simulation, Value, Values};
use crate::error::{Error, Result};

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
pub struct AnySimulation(Box<dyn Run>);

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
        let Selection {
            scene,
            engine,
            drive,
            disks,
        } = selection;
        with_scene(scene, engine, drive, Make { disks, given })?
    }

    /// Sets an input; it holds until it is set again.
    ///
    /// # Errors
    /// No input of this name, or not a finite number.
    pub fn set(&mut self, name: &str, value: impl Into<Value>) -> Result<()> {
        let position = self.position(name)?;
        self.set_at(position, value)
    }

    /// Sets the input at `position`, as [`AnySimulation::position`] gave it.
    ///
    /// # Errors
    /// No input there, or not a finite number.
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

    /// Goes on to `end_time` \[s\] under the inputs as they stand, as one communication step.
    ///
    /// # Errors
    /// `end_time` is not after the present time, or the scene cannot do the step. Nothing has changed then.
    pub fn advance_to(&mut self, end_time: f64) -> Result<()> {
        self.0.advance_to(end_time)
    }

    /// Lets one step do no more than so much, instead of what takes half an hour at most: see
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
    /// The scene has no such variable.
    pub fn real(&self, name: &str) -> Result<f64> {
        self.0.real(name)
    }

    /// The whole number called `name`, as of now.
    ///
    /// # Errors
    /// The scene has no such variable.
    pub fn integer(&self, name: &str) -> Result<i64> {
        self.0.integer(name)
    }

    /// All values, with the table of the variables.
    pub fn values(&self) -> &Values {
        self.0.values()
    }

    /// The state as bytes without pointers, for a file or another process: see [`crate::saved_bytes`].
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

    /// As [`AnySimulation::restore_bytes`], with the scene made anew: for one that a panic may have left in pieces.
    ///
    /// # Errors
    /// As [`AnySimulation::restore_bytes`].
    pub fn restore_bytes_anew(&mut self, bytes: &[u8]) -> Result<()> {
        self.0.restore_bytes_anew(bytes)
    }
}

impl<S: Scene> From<Simulation<S>> for AnySimulation {
    fn from(simulation: Simulation<S>) -> Self {
        Self(Box::new(simulation))
    }
}

/// What [`AnySimulation`] asks of the simulation that it holds: the methods of [`Simulation`], without types.
trait Run: Send {
    fn set_at(&mut self, position: usize, value: Value) -> Result<()>;
    fn position(&self, name: &str) -> Result<usize>;
    fn advance_to(&mut self, end_time: f64) -> Result<()>;
    fn limit_work(&mut self, most: u64);
    fn time(&self) -> f64;
    fn real(&self, name: &str) -> Result<f64>;
    fn integer(&self, name: &str) -> Result<i64>;
    fn values(&self) -> &Values;
    fn to_bytes(&self) -> Result<Vec<u8>>;
    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<()>;
    fn restore_bytes_anew(&mut self, bytes: &[u8]) -> Result<()>;
}

impl<S: Scene> Run for Simulation<S> {
    fn set_at(&mut self, position: usize, value: Value) -> Result<()> {
        self.set_at(position, value)
    }

    fn position(&self, name: &str) -> Result<usize> {
        self.position(name)
    }

    fn advance_to(&mut self, end_time: f64) -> Result<()> {
        self.advance_to(end_time)
    }

    fn limit_work(&mut self, most: u64) {
        self.limit_work(most);
    }

    fn time(&self) -> f64 {
        self.time()
    }

    fn real(&self, name: &str) -> Result<f64> {
        self.real(name)
    }

    fn integer(&self, name: &str) -> Result<i64> {
        self.integer(name)
    }

    fn values(&self) -> &Values {
        self.values()
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

struct Make<'a> {
    disks: Option<u32>,
    given: &'a [(&'a str, &'a str)],
}

impl Visitor for Make<'_> {
    type Output = Result<AnySimulation>;

    fn visit<S: Scene>(self) -> Self::Output {
        let disks = self.disks.unwrap_or(S::card().default_disks);
        Simulation::<S>::from_texts(disks, self.given).map(AnySimulation::from)
    }
}

impl<S: Scene> Simulation<S> {
    /// As [`Simulation::new`], from texts.
    fn from_texts(disks: u32, given: &[(&str, &str)]) -> Result<Self> {
        let mut values = Self::start_values(disks)?;
        for (name, text) in given {
            let position = values.table().position(name).ok_or_else(|| Self::unknown(name))?;
            let row = &values.table().rows()[position];
            if !matches!(row.causality, Causality::Parameter | Causality::Input) {
                let remedy = "Give a parameter or an input instead.";
                return Err(Error::call(format!("{name} is computed by the scene"), remedy));
            }
            let value = row.read(text)?;
            values.set(position, value)?;
        }
        Self::start(disks, values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::catalogue::cards;
    use crate::scene::packing::PackingOnSine;

    #[test]
    fn every_scene_runs_saves_and_restores() {
        for card in cards() {
            let selection = Selection {
                scene: card.scene,
                engine: Some(card.engine),
                drive: Some(card.drive),
                disks: Some(3.min(*card.disks.end())),
            };
            let mut one = AnySimulation::new(selection, &[]).unwrap();
            let mut other = AnySimulation::new(selection, &[]).unwrap();
            one.advance_to(0.01).unwrap();
            other.restore_bytes(&one.to_bytes().unwrap()).unwrap();
            for simulation in [&mut one, &mut other] {
                simulation.advance_to(0.02).unwrap();
            }
            assert_eq!(one.values(), other.values(), "{card:?}");
        }
    }

    #[test]
    fn the_bits_are_those_of_the_typed_simulation() {
        let mut typed = Simulation::<PackingOnSine>::new(10, &[("drive.amplitude", 1e-4.into())]).unwrap();
        let selection = Selection {
            drive: Some("sine"),
            disks: Some(10),
            ..Selection::of("packing")
        };
        let mut named = AnySimulation::new(selection, &[("drive.amplitude", "1e-4")]).unwrap();
        typed.advance_to(0.1).unwrap();
        named.advance_to(0.1).unwrap();
        assert_eq!(typed.values(), named.values());
    }

    #[test]
    fn what_is_wrong_is_named() {
        let told = |selection, given: &[(&str, &str)]| AnySimulation::new(selection, given).unwrap_err().to_string();
        let packing = Selection::of("packing");
        assert!(told(Selection::of("sandpile"), &[]).contains("one of: packing"));
        assert!(told(packing, &[("glue", "1")]).contains("no variable glue"));
        assert!(told(packing, &[("contacts", "1")]).contains("computed by the scene"));
        assert!(told(packing, &[("seed", "1.5")]).contains("a whole number"));
        assert!(told(packing, &[("gravity", "1,5")]).contains("gravity = 1,5"));
        assert!(
            told(
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
