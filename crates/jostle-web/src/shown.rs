//! A scene as the page sees it.
//!
//! Not [`DynSimulation`](jostle::scene::DynSimulation): what that can do besides, such as states as bytes, would double the module.

use jostle::Result;
use jostle::scene::packing::PackingOnSine;
use jostle::scene::ratchet::RatchetOnSine;
use jostle::scene::wedge::WedgeEventDrivenOnSine;
use jostle::scene::{Listed, Model, ModelInfo, Simulation, StructuralParameters, Table, Value, Warning};

/// The methods of [`Simulation`] that the page needs, without its type.
pub trait Shown: Send {
    fn table(&self) -> &Table;
    fn set(&mut self, name: &str, text: &str) -> Result<()>;
    fn start(&mut self) -> Result<()>;
    fn advance_to(&mut self, time: f64) -> Result<()>;
    fn value(&self, position: usize) -> Result<Value>;
    fn list(&self, name: &str) -> Result<Listed>;
    fn warnings(&self) -> Vec<Warning>;
    fn limit_work(&mut self, most: u64);
}

impl<M: Model> Shown for Simulation<M> {
    fn table(&self) -> &Table {
        self.values().table()
    }

    fn set(&mut self, name: &str, text: &str) -> Result<()> {
        let position = self.position(name)?;
        let value = self.values().table().variables()[position].parse(text)?;
        self.set_at(position, value)
    }

    fn start(&mut self) -> Result<()> {
        self.start(0.0)
    }

    fn advance_to(&mut self, time: f64) -> Result<()> {
        self.advance_to(time)
    }

    fn value(&self, position: usize) -> Result<Value> {
        self.value(position)
    }

    fn list(&self, name: &str) -> Result<Listed> {
        self.list(name)
    }

    fn warnings(&self) -> Vec<Warning> {
        self.warnings(&[])
    }

    fn limit_work(&mut self, most: u64) {
        self.limit_work(most);
    }
}

/// A scene that the page can show.
pub struct Scene {
    /// Static facts.
    pub info: fn() -> ModelInfo,
    /// The scene with start values, not started.
    prepare: fn(StructuralParameters) -> Box<dyn Shown>,
}

impl Scene {
    /// The model `M`.
    pub const fn of<M: Model>() -> Self {
        Self {
            info: M::info,
            prepare: |structure| Box::new(Simulation::<M>::prepare(structure)),
        }
    }

    /// The scene with so many disks, or the usual number, not started.
    ///
    /// # Errors
    /// A number of disks that the scene does not take.
    pub fn prepare(&self, disks: Option<u32>) -> Result<Box<dyn Shown>> {
        let structure = StructuralParameters::choose(&(self.info)(), disks.map(|disks| ("disks", disks)).as_slice())?;
        Ok((self.prepare)(structure))
    }
}

/// What the page can show: one engine of each scene in which one sees disks move, driven by a sine. More would make the
/// module larger than a page should load.
pub const SCENES: [Scene; 3] = [
    Scene::of::<PackingOnSine>(),
    Scene::of::<RatchetOnSine>(),
    Scene::of::<WedgeEventDrivenOnSine>(),
];
