//! What the wedge scene asks of an engine.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::drive::Motion;
use crate::engine::WorkBudget;
use crate::error::{Result, are_sane};
use crate::scene::{OutputWriter, Values, Variable};

use super::initial::AtStart;

/// Disk and base at one instant; impulse and energies per mass of the disk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Centre of the disk \[m\] from the vertex of the wedge with its base at rest.
    pub place: [f64; 2],
    /// Velocity of the centre \[m/s\].
    pub velocity: [f64; 2],
    /// Angle turned \[rad\].
    pub angle: f64,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: f64,
    /// Motion of the base.
    pub base: Motion,
    /// Vertical impulse of the base on the disk since the start \[N.s/kg\].
    pub impulse: f64,
    /// Energies.
    pub energy: Energy,
}

impl Look {
    /// Whether all of it is finite and far from overflow.
    pub fn is_sane(&self) -> bool {
        let Motion {
            displacement,
            velocity,
            acceleration,
        } = self.base;
        let Energy {
            kinetic,
            potential,
            input,
            lost,
        } = self.energy;
        let scalars = [self.angle, self.angular_velocity, self.impulse];
        are_sane(self.place)
            && are_sane(self.velocity)
            && are_sane(scalars)
            && are_sane([displacement, velocity, acceleration])
            && are_sane([kinetic, potential, input, lost])
    }
}

/// Energies per mass of the disk \[J/kg\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// Translation and rotation.
    pub kinetic: f64,
    /// In gravity, zero at the height of the wedge's vertex with its base at rest.
    pub potential: f64,
    /// Work done by the base since the start.
    pub input: f64,
    /// Lost in impacts since the start.
    pub lost: f64,
}

/// A way to advance one disk in a wedge.
///
/// Contract: the trajectory does not depend on where it is advanced to or looked at on the way.
pub trait Engine: Sized + Send + 'static {
    /// Everything that changes with time.
    type State: Clone + PartialEq + Serialize + DeserializeOwned + Send;
    /// Name on the command line.
    const NAME: &'static str;
    /// Name of the drive.
    const DRIVE: &'static str;
    /// Model identifier.
    const IDENTIFIER: &'static str;
    /// One sentence.
    const DESCRIPTION: &'static str;

    /// What its outputs depend on at the start.
    const AT_START: AtStart;

    /// Parameters of its contacts.
    fn parameters() -> Vec<Variable>;
    /// Parameters and inputs of the drive.
    fn drive() -> Vec<Variable>;
    /// Outputs that it counts.
    fn counts() -> Vec<Variable>;

    /// The disk at the start.
    ///
    /// # Errors
    /// A parameter out of range, by name.
    fn new(start_time: f64, values: &Values) -> Result<Self>;

    /// Takes the inputs at `time` \[s\] for a step of `duration` \[s\].
    fn aim(&mut self, time: f64, duration: f64, values: &Values);

    /// Advances to `end_time` \[s\] with the work that it takes taken off `work`.
    ///
    /// # Errors
    /// It cannot be done; the state is then of no use.
    fn advance_to(&mut self, end_time: f64, work: &mut WorkBudget) -> Result<()>;

    /// Disk and base at `time` \[s\], to which it was advanced last.
    fn look(&self, time: f64) -> Look;

    /// Writes what [`Engine::counts`] lists.
    fn write_counts(&self, outputs: &mut OutputWriter<'_>);

    /// A copy of the present state.
    fn state(&self) -> Self::State;

    /// Goes back (or on) to a state at `time` \[s\].
    ///
    /// # Errors
    /// The state cannot be one of this engine, which is then as before.
    fn restore(&mut self, state: &Self::State, time: f64) -> Result<()>;
}
