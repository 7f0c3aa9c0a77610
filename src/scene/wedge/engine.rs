//! What the wedge scene needs of an engine.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::drive::Motion;
use crate::engine::{DiskMotion, WorkBudget};
use crate::error::are_sane;
use crate::scene::{Result, Row, Values};

/// Energies per mass of the disk \[J/kg\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpecificEnergies {
    /// Translation and rotation.
    pub kinetic: f64,
    /// In gravity, zero at the height of the wedge's vertex with its base at rest.
    pub potential: f64,
    /// Work done by the base since the start.
    pub input: f64,
    /// Lost in impacts since the start.
    pub lost: f64,
}

impl SpecificEnergies {
    /// Whether all of them are finite and far from overflow.
    pub fn are_sane(&self) -> bool {
        are_sane([self.kinetic, self.potential, self.input, self.lost])
    }
}

/// What outputs depend on before the first step, where that differs between engines.
#[derive(Debug, Clone, Copy)]
pub struct AtStart {
    /// What the place depends on besides the wedge: the seed where the frame is that of the wall that the disk flies to, since
    /// the two differ in rounding.
    pub place: &'static [&'static str],
    /// What the displacement of the base depends on.
    pub displacement: &'static [&'static str],
    /// What its acceleration depends on.
    pub acceleration: &'static [&'static str],
}

/// A scene around an engine E.
pub trait Around<E> {
    /// The engine.
    fn engine(&self) -> &E;
}

/// A way to advance one disk in a wedge.
///
/// Contract: the trajectory does not depend on the times to which it is advanced or at which it is observed. The time of an
/// observation is that to which it was advanced last. Positions count from the vertex of the wedge with its base at rest.
pub trait WedgeEngine: Sized + Send + 'static {
    /// Everything that changes with time.
    type State: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static;
    /// Name on the command line.
    const NAME: &'static str;
    /// Name of the drive.
    const DRIVE: &'static str;
    /// Model identifier on a sine.
    const IDENTIFIER: &'static str;
    /// One sentence.
    const DESCRIPTION: &'static str;
    /// What its outputs depend on at the start.
    const AT_START: AtStart;

    /// Parameters of its contacts.
    fn contact_rows<M>() -> Vec<Row<M>>;
    /// Parameters and inputs of the drive.
    fn drive_rows<M>() -> Vec<Row<M>>;
    /// Outputs that other engines do not have.
    fn own_outputs<M: Around<Self>>() -> Vec<Row<M>>;

    /// The disk at the start.
    ///
    /// # Errors
    /// A parameter out of range, by name.
    fn new(start_time: f64, values: &Values) -> Result<Self>;

    /// Takes the inputs at `time` \[s\] for a step of `duration` \[s\].
    fn set_target(&mut self, time: f64, duration: f64, values: &Values);

    /// Advances to `end_time` \[s\] and takes the work that it costs off `budget`.
    ///
    /// # Errors
    /// It cannot be done; the state is then of no use.
    fn advance_to(&mut self, end_time: f64, budget: &mut WorkBudget) -> Result<()>;

    /// Motion of the disk at `time` \[s\].
    fn disk_at(&self, time: f64) -> DiskMotion;

    /// Motion of the base at `time` \[s\].
    fn base_at(&self, time: f64) -> Motion;

    /// Energies at `time` \[s\].
    fn energies_at(&self, time: f64) -> SpecificEnergies;

    /// Vertical impulse of the base on the disk since the start, per mass of the disk \[N.s/kg\].
    fn impulse(&self) -> f64;

    /// A copy of the present state.
    fn state(&self) -> Self::State;

    /// Goes to a state at `time` \[s\].
    ///
    /// # Errors
    /// The state cannot be one of this engine, which is then as before.
    fn restore(&mut self, state: &Self::State, time: f64) -> Result<()>;
}
