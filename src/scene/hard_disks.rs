//! What the scenes of hard disks on a base share: the base as their parameters tell, energies, the report of a step.

use serde::{Deserialize, Serialize};

use crate::drive::{Drive, FollowsInput, Sine};
use crate::engine::DiskMotion;
use crate::engine::event_driven::{Counts, Moving, VibratingBase};
use crate::error::{Result, are_sane};

use super::base_drive::BaseDrive;
use super::{OutputWriter, Values};

/// A base that a scene of hard disks can stand on.
pub trait HardBase: VibratingBase {
    /// Where its variables come from.
    type Drive: BaseDrive;

    /// The base as the parameters tell.
    ///
    /// # Errors
    /// Values that are no motion.
    fn from_values(start_time: f64, values: &Values) -> Result<Self>;

    /// Takes new inputs at `time` \[s\] for a step of `duration` \[s\]; false if nothing has changed.
    fn aim(&mut self, time: f64, duration: f64, values: &Values) -> bool;
}

impl HardBase for Moving<Sine> {
    type Drive = Sine;

    fn from_values(start_time: f64, values: &Values) -> Result<Self> {
        let drive = <Sine as BaseDrive>::new(start_time, values)?;
        Ok(Self {
            drive,
            farthest: drive.amplitude,
        })
    }

    fn aim(&mut self, _time: f64, _duration: f64, _values: &Values) -> bool {
        false
    }
}

impl HardBase for Moving<FollowsInput> {
    type Drive = FollowsInput;

    fn from_values(start_time: f64, values: &Values) -> Result<Self> {
        let drive = <FollowsInput as BaseDrive>::new(start_time, values)?;
        let farthest = drive.motion(start_time).displacement;
        Ok(Self { drive, farthest })
    }

    fn aim(&mut self, time: f64, duration: f64, values: &Values) -> bool {
        BaseDrive::aim(&mut self.drive, time, duration, values);
        self.farthest = self.drive.highest();
        true
    }
}

/// What the last communication step reported.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Time reached \[s\].
    pub time: f64,
    /// Vertical force of the disks on the base \[N\], mean over the last communication step.
    pub reaction_force: f64,
    /// Total energy at the start \[J\].
    pub start_energy: f64,
}

impl Report {
    /// Before the first step, at `time` \[s\].
    pub fn at_start(time: f64) -> Self {
        Self {
            time,
            reaction_force: 0.0,
            start_energy: 0.0,
        }
    }

    /// Whether every number is finite and far from overflow.
    pub fn is_sane(&self) -> bool {
        are_sane([self.time, self.reaction_force, self.start_energy])
    }
}

/// What disks of a scene are made of.
#[derive(Debug, Clone, Copy)]
pub struct Matter<'scene> {
    /// Masses \[kg\].
    pub masses: &'scene [f64],
    /// g \[m/s2\].
    pub gravity: f64,
    /// Moment of inertia over m R^2.
    pub inertia_factor: f64,
}

/// Kinetic and potential energy \[J\] of the disks at one time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energies {
    /// Of translation and rotation \[J\].
    pub kinetic: f64,
    /// In gravity, zero at height zero \[J\].
    pub potential: f64,
}

impl Energies {
    /// Of disks by their radii \[m\] and motions.
    pub fn of(matter: Matter<'_>, disks: impl Iterator<Item = (f64, DiskMotion)>) -> Self {
        let mut energies = Self::default();
        for (mass, (radius, motion)) in matter.masses.iter().zip(disks) {
            let rim = radius * motion.angular_velocity;
            energies.kinetic += 0.5 * mass * (motion.velocity.norm_squared() + matter.inertia_factor * rim * rim);
            energies.potential += mass * matter.gravity * motion.position.y;
        }
        energies
    }

    /// Both together \[J\].
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential
    }

    /// Writes the outputs `energy.*` of a run that began with `start` \[J\].
    pub fn write(&self, outputs: &mut OutputWriter<'_>, counts: &Counts, start: f64) {
        outputs.real("energy.kinetic", self.kinetic);
        outputs.real("energy.potential", self.potential);
        outputs.real("energy.input", counts.energy_input);
        outputs.real("energy.lost", counts.energy_lost);
        let change = self.total() - start;
        outputs.real("energy.residual", change - counts.energy_input + counts.energy_lost);
    }
}
