//! Engines of soft disks as the report sees them: the same start, the same end, places and rates.
//!
//! A new engine is one more implementation, and one more line in [`each_engine`].

use jostle::drive::Sine;
use jostle::engine::Engine;
use jostle::engine::dem::verlet::{Integrator, PredictorCorrector};
use jostle::engine::dem::{self, Breakdown, EventLocated, FixedGrid, SoftDiskSetup};
use jostle::geometry::Disk;

/// An engine that advances soft disks over a sine base.
pub trait SoftEngine: Engine<Stop = Breakdown> + Clone {
    /// Name of its curves.
    const METHOD: &'static str;
    /// Passes over all contacts in a step.
    const PASSES: f64;

    /// Disks at `rates` (x, y, spin), whose contacts hold nothing yet.
    fn start(setup: SoftDiskSetup, disks: &[Disk], drive: Sine, rates: &[[f64; 3]]) -> Self;

    /// x, y and angle of each of `count` disks.
    fn places(&self, count: usize) -> Vec<[f64; 3]>;

    /// Velocities and angular velocity of the first disk.
    fn first_rate(&self) -> [f64; 3];

    /// Steps done.
    fn steps(&self) -> u64;
}

impl<I: Integrator> SoftEngine for FixedGrid<PredictorCorrector<I>, Sine> {
    const METHOD: &'static str = I::NAME;
    const PASSES: f64 = 1.0;

    fn start(setup: SoftDiskSetup, disks: &[Disk], drive: Sine, rates: &[[f64; 3]]) -> Self {
        let mut engine = Self::new(setup, disks, drive);
        engine.set_motion(|disks| disks.velocity[..3 * rates.len()].copy_from_slice(rates.as_flattened()));
        engine
    }

    fn places(&self, count: usize) -> Vec<[f64; 3]> {
        self.observables().positions[..count].to_vec()
    }

    fn first_rate(&self) -> [f64; 3] {
        self.observables().velocities[0]
    }

    fn steps(&self) -> u64 {
        self.state().steps
    }
}

impl SoftEngine for Located {
    const METHOD: &'static str = "located events, order 4";
    const PASSES: f64 = 2.0;

    fn start(setup: SoftDiskSetup, disks: &[Disk], drive: Sine, rates: &[[f64; 3]]) -> Self {
        let mut engine = Self::new(setup, disks, drive);
        engine.set_motion(|disks| disks.velocities.copy_from_slice(rates));
        engine
    }

    fn places(&self, count: usize) -> Vec<[f64; 3]> {
        self.now().disks.positions[..count].to_vec()
    }

    fn first_rate(&self) -> [f64; 3] {
        self.now().disks.velocities[0]
    }

    fn steps(&self) -> u64 {
        self.state().steps
    }
}

/// Velocity Verlet on a sine.
pub type Verlet = dem::Verlet<Sine>;
/// Gear's method on a sine.
pub type Gear = dem::Gear<Sine>;
/// The fourth-order engine on a sine.
pub type Located = EventLocated<Sine>;

/// The points that `$point::<Engine>(...)` makes, for each engine.
macro_rules! each_engine {
    ($points:ident, $point:ident($($argument:expr),*)) => {
        $points.push($point::<$crate::report::engines::Verlet>($($argument),*));
        $points.push($point::<$crate::report::engines::Gear>($($argument),*));
        $points.push($point::<$crate::report::engines::Located>($($argument),*));
    };
}
pub(super) use each_engine;
