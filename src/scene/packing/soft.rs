//! What the packing of soft disks asks of an engine, and the engines that it can have.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::drive::Motion;
use crate::engine::Work;
use crate::engine::located_dynamics::{self, LocatedDynamics};
use crate::engine::molecular_dynamics::{
    self, Breakdown, ContactLaws, Energies, Integrator, MolecularDynamics, Setup, TimeStepLimits,
};
use crate::geometry::Disk;
use crate::scene::base_drive::BaseDrive;
use crate::scene::{Unit, Values, Variable};

use super::rows;

/// Disks and base now.
#[derive(Debug, Clone, Copy)]
pub struct Look<'engine> {
    /// x, y \[m\] and angle \[rad\] of each disk.
    pub places: &'engine [[f64; 3]],
    /// Their rates.
    pub rates: &'engine [[f64; 3]],
    /// Motion of the base.
    pub base: Motion,
    /// Work of the base so far \[J\].
    pub energy_input: f64,
    /// Energy lost so far \[J\].
    pub energy_lost: f64,
    /// Closed contacts.
    pub contacts: u32,
}

/// An engine of soft disks.
///
/// Contract: that of [`crate::scene::Scene`] for steps, looks and states.
pub trait SoftEngine: Sized + Send + 'static {
    /// Motion of the base.
    type Drive: BaseDrive;
    /// Everything that changes with time.
    type State: Clone + PartialEq + Serialize + DeserializeOwned + Send;
    /// Name on the command line.
    const NAME: &'static str;
    /// Model identifier.
    const IDENTIFIER: &'static str;
    /// One sentence.
    const DESCRIPTION: &'static str;

    /// Parameters that choose the time step.
    fn parameters() -> Vec<Variable>;
    /// Time steps for these contacts and the tolerance among `values`.
    fn limits(laws: &ContactLaws, masses: &[f64], frequency: Option<f64>, values: &Values) -> TimeStepLimits;
    /// Disks at rest.
    fn new(setup: Setup, disks: &[Disk], drive: Self::Drive) -> Self;
    /// The drive, to be aimed.
    fn drive_mut(&mut self) -> &mut Self::Drive;
    /// Advances to `end_time` \[s\] with the work that it takes taken off `work`; on a breakdown nothing has changed.
    ///
    /// # Errors
    /// The step cannot be done.
    fn advance_within(&mut self, end_time: f64, work: &mut Work) -> Result<(), Breakdown>;
    /// Disks and base at the time last asked for.
    fn look(&self) -> Look<'_>;
    /// Energies at that time.
    fn energies(&self) -> Energies;
    /// Impulse (x, y) of a wall on the disks so far \[N.s\].
    fn impulse_of_wall(&self, wall: usize) -> [f64; 2];
    /// What stays as it is.
    fn setup(&self) -> &Setup;
    /// Radii \[m\].
    fn radii(&self) -> &[f64];
    /// All that the future depends on.
    fn state(&self) -> &Self::State;
    /// Whether `state`, seen at `time` \[s\], can be one of this run.
    fn fits(&self, state: &Self::State, time: f64) -> bool;
    /// Continues from a state that fits.
    ///
    /// # Errors
    /// The look at `time` cannot be computed; nothing has changed then.
    fn restore(&mut self, state: &Self::State, time: f64) -> Result<(), Breakdown>;
}

/// What both engines have under the same name.
macro_rules! same_by_name {
    () => {
        fn drive_mut(&mut self) -> &mut D {
            Self::drive_mut(self)
        }

        fn advance_within(&mut self, end_time: f64, work: &mut Work) -> Result<(), Breakdown> {
            Self::advance_within(self, end_time, work)
        }

        fn energies(&self) -> Energies {
            Self::energies(self)
        }

        fn impulse_of_wall(&self, wall: usize) -> [f64; 2] {
            Self::impulse_of_wall(self, wall)
        }

        fn setup(&self) -> &Setup {
            Self::setup(self)
        }

        fn radii(&self) -> &[f64] {
            Self::radii(self)
        }

        fn state(&self) -> &Self::State {
            Self::state(self)
        }

        fn fits(&self, state: &Self::State, time: f64) -> bool {
            Self::fits(self, state, time)
        }

        fn restore(&mut self, state: &Self::State, time: f64) -> Result<(), Breakdown> {
            Self::restore(self, state, time)
        }
    };
}

impl<I: Integrator, D: BaseDrive> SoftEngine for MolecularDynamics<I, D> {
    type Drive = D;
    type State = molecular_dynamics::State<D>;
    const NAME: &'static str = "molecular-dynamics";
    const IDENTIFIER: &'static str = if D::STEERED {
        "jostle_packing"
    } else {
        "jostle_packing_sine"
    };
    const DESCRIPTION: &'static str =
        "Packing of frictional disks in a box on a vibrating bottom, by molecular dynamics";

    fn parameters() -> Vec<Variable> {
        vec![rows::time_step(
            "Time step of the integration; 0: a hundredth of the shortest contact period",
        )]
    }

    fn limits(laws: &ContactLaws, masses: &[f64], frequency: Option<f64>, _values: &Values) -> TimeStepLimits {
        TimeStepLimits::of(laws, masses, frequency)
    }

    fn new(setup: Setup, disks: &[Disk], drive: D) -> Self {
        Self::new(setup, disks, drive)
    }

    fn look(&self) -> Look<'_> {
        let (now, count) = (self.now(), self.radii().len());
        Look {
            places: &now.places()[..count],
            rates: &now.rates()[..count],
            base: now.base,
            energy_input: now.energy_input,
            energy_lost: now.energy_lost,
            contacts: now.contacts,
        }
    }

    same_by_name!();
}

impl<D: BaseDrive> SoftEngine for LocatedDynamics<D> {
    type Drive = D;
    type State = located_dynamics::State<D>;
    const NAME: &'static str = "molecular-dynamics-located";
    const IDENTIFIER: &'static str = if D::STEERED {
        "jostle_packing_located"
    } else {
        "jostle_packing_located_sine"
    };
    const DESCRIPTION: &'static str = "Packing of frictional disks in a box on a vibrating bottom, by molecular \
        dynamics of fourth order with located contact events";

    fn parameters() -> Vec<Variable> {
        let tolerance = Variable::parameter(
            "tolerance",
            Unit::One,
            1e-12..=1e-4,
            1e-5,
            "Relative error that the velocities may have after one impact; chooses the time step",
        );
        let time_step = rows::time_step("Time step of the integration; 0: chosen by the tolerance");
        vec![tolerance, time_step]
    }

    fn limits(laws: &ContactLaws, masses: &[f64], frequency: Option<f64>, values: &Values) -> TimeStepLimits {
        located_dynamics::limits(laws, masses, frequency, values.real("tolerance"))
    }

    fn new(setup: Setup, disks: &[Disk], drive: D) -> Self {
        Self::new(setup, disks, drive)
    }

    fn look(&self) -> Look<'_> {
        let now = self.now();
        Look {
            places: &now.places,
            rates: &now.rates,
            base: now.base,
            energy_input: now.energy_input,
            energy_lost: now.energy_lost,
            contacts: now.contacts,
        }
    }

    same_by_name!();
}
