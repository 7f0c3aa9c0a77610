//! The engines of soft disks that the packing can have: names, parameters and time steps.

use crate::contact::ContactLaws;
use crate::engine::dem::event_located::EventStepper;
use crate::engine::dem::verlet::{Integrator, PredictorCorrector};
use crate::engine::dem::{Stepper, TimeStepLimits};
use crate::engine::threads::{OneThread, ThreadPool};
use crate::scene::soft_disks::SceneNormalForce;
use crate::scene::{Result, Row, Unit, Values, threads};

use super::rows;

/// A stepper of soft disks as the packing presents it.
pub trait SoftMethod: Stepper<Normal: SceneNormalForce> {
    /// Name on the command line.
    const NAME: &'static str;
    /// Model identifier on a base that follows inputs.
    const IDENTIFIER: &'static str;
    /// One sentence.
    const DESCRIPTION: &'static str;

    /// Parameters that choose the time step and the threads.
    fn parameters<M>() -> Vec<Row<M>>;

    /// The threads that `values` ask for, for so many disks.
    ///
    /// # Errors
    /// The system starts no more threads.
    fn threads(disks: usize, values: &Values) -> Result<Self::Threads>;

    /// Time steps for these contacts and the tolerance among `values`.
    fn limits(
        laws: &ContactLaws<Self::Normal>,
        masses: &[f64],
        frequency: Option<f64>,
        values: &Values,
    ) -> TimeStepLimits;
}

impl<I: Integrator, N: SceneNormalForce> SoftMethod for PredictorCorrector<I, N, ThreadPool> {
    const NAME: &'static str = N::ENGINE;
    const IDENTIFIER: &'static str = N::PACKING;
    const DESCRIPTION: &'static str = "Packing of frictional disks on a vibrating bottom between side walls that stand still unless wall.motion says otherwise, by \
         molecular dynamics";

    fn parameters<M>() -> Vec<Row<M>> {
        let time_step = rows::time_step("Time step of the integration; 0: a hundredth of the shortest contact period");
        vec![time_step, threads::row()]
    }

    fn threads(disks: usize, values: &Values) -> Result<ThreadPool> {
        threads::pool(disks, values)
    }

    fn limits(laws: &ContactLaws<N>, masses: &[f64], frequency: Option<f64>, _values: &Values) -> TimeStepLimits {
        TimeStepLimits::verlet(laws, masses, frequency)
    }
}

impl SoftMethod for EventStepper {
    const NAME: &'static str = "molecular-dynamics-located";
    const IDENTIFIER: &'static str = "jostle_packing_located";
    const DESCRIPTION: &'static str = "Packing of frictional disks on a vibrating bottom between side walls that \
        stand still unless wall.motion says otherwise, by molecular dynamics of fourth order with located contact events";

    fn parameters<M>() -> Vec<Row<M>> {
        let tolerance = Row::parameter(
            "tolerance",
            Unit::ONE,
            1e-12..=1e-4,
            1e-5,
            "Relative error that the velocities may have after one impact; chooses the time step",
        );
        let time_step = rows::time_step("Time step of the integration; 0: chosen by the tolerance");
        vec![tolerance, time_step]
    }

    fn threads(_disks: usize, _values: &Values) -> Result<OneThread> {
        Ok(OneThread)
    }

    fn limits(laws: &ContactLaws, masses: &[f64], frequency: Option<f64>, values: &Values) -> TimeStepLimits {
        TimeStepLimits::event_located(laws, masses, frequency, values.real("tolerance"))
    }
}
