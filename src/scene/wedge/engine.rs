//! What the wedge scene needs of an engine.

use crate::drive::Motion;
use crate::engine::{DiskMotion, Engine};
use crate::error::are_sane;
use crate::scene::{Error, Listing, Result, Row, Values, Warning};

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
    /// What its velocity depends on.
    pub velocity: &'static [&'static str],
    /// What its acceleration depends on.
    pub acceleration: &'static [&'static str],
}

/// An engine of one disk in a wedge as the scene presents it.
///
/// The time of an observation is that to which the engine was advanced last. Positions count from the vertex of the wedge
/// with its base at rest.
pub trait WedgeEngine: Engine {
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
    /// See [`BaseDrive::INPUT_PARTS`](crate::scene::base_drive::BaseDrive::INPUT_PARTS).
    const INPUT_PARTS: u32 = 0;

    /// Parameters of its contacts.
    fn contact_rows<M>() -> Vec<Row<M>>;
    /// Parameters and inputs of the drive.
    fn drive_rows<M>() -> Vec<Row<M>>;
    /// Outputs that other engines do not have, of a scene M that holds this one.
    fn own_outputs<M: AsRef<Self>>() -> Vec<Row<M>>;

    /// Lists that other engines do not have.
    fn listings<M: AsRef<Self>>() -> Vec<Listing<M>> {
        Vec::new()
    }

    /// The disk at the start.
    ///
    /// # Errors
    /// A parameter out of range, by name.
    fn from_values(start_time: f64, values: &Values) -> Result<Self>;

    /// Takes over the tunable parameters at `time` \[s\].
    ///
    /// # Errors
    /// Values that do not go together, by name. All is then as before.
    fn tune(&mut self, time: f64, values: &Values) -> Result<()>;

    /// Takes the inputs at `time` \[s\] for a step of `duration` \[s\].
    fn set_target(&mut self, time: f64, duration: f64, values: &Values);

    /// What is doubtful of the inputs so far.
    fn warning(&self, _told: &[&'static str]) -> Option<Warning> {
        None
    }

    /// The refusal of a step that the engine could not finish.
    fn refused_step(stop: Self::Stop) -> Error;

    /// Motion of the disk at `time` \[s\].
    fn disk_at(&self, time: f64) -> DiskMotion;

    /// Motion of the base at `time` \[s\].
    fn base_at(&self, time: f64) -> Motion;

    /// Energies at `time` \[s\].
    fn energies_at(&self, time: f64) -> SpecificEnergies;

    /// Vertical impulse of the base on the disk since the start, per mass of the disk \[N.s/kg\].
    fn impulse(&self) -> f64;
}
