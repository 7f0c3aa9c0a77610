//! What a run shows at the time last asked for: positions, momentum, impulses of the walls, energies.

use nalgebra::Vector2;

use crate::drive::Motion;
use crate::elementary::powi;
use crate::engine::{ContactNow, DiskMotion};

use super::fixed_grid::{FixedGrid, Stepper};

/// Disks and base at one instant.
#[derive(Debug, Clone, Copy)]
pub struct SoftDiskObservables<'engine> {
    /// x, y \[m\] and angle \[rad\] of each disk.
    pub positions: &'engine [[f64; 3]],
    /// Their rates.
    pub velocities: &'engine [[f64; 3]],
    /// Motion of the base.
    pub base: Motion,
    /// Work of the base so far \[J\].
    pub energy_input: f64,
    /// Energy lost so far \[J\].
    pub energy_lost: f64,
    /// Closed contacts.
    pub contacts: u32,
}

impl SoftDiskObservables<'_> {
    /// Motion of a disk, counted from 0.
    #[inline(always)]
    pub fn disk(&self, disk: usize) -> DiskMotion {
        let ([x, y, angle], [vx, vy, angular_velocity]) = (self.positions[disk], self.velocities[disk]);
        DiskMotion {
            position: Vector2::new(x, y),
            velocity: Vector2::new(vx, vy),
            angle,
            angular_velocity,
        }
    }
}

/// Energies of the disks \[J\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoftDiskEnergies {
    /// Translation and rotation.
    pub kinetic: f64,
    /// In gravity, zero at height zero.
    pub potential: f64,
    /// In the springs of closed contacts, normal and tangential.
    pub elastic: f64,
}

impl<S: Stepper, D> FixedGrid<S, D> {
    /// Disks and base.
    pub fn observables(&self) -> SoftDiskObservables<'_> {
        let now = self.now();
        let (positions, velocities) = self.stepper.motion(&now.disks);
        SoftDiskObservables {
            positions,
            velocities,
            base: now.base,
            energy_input: now.energy_input,
            energy_lost: now.energy_lost,
            contacts: now.contacts,
        }
    }

    /// Impulse (x, y) \[N.s\] that the wall has given to the disks since the start.
    pub fn impulse_of_wall(&self, wall: usize) -> [f64; 2] {
        self.stepper.impulse_of_wall(&self.now().disks, wall)
    }

    /// Vertical force \[N\] of the walls that follow the base on the disks now.
    pub fn base_force(&self) -> f64 {
        let now = self.now();
        self.stepper.base_force(&now.disks, now.base)
    }

    /// Total momentum (x, y) \[kg.m/s\].
    pub fn momentum(&self) -> [f64; 2] {
        let velocities = self.observables().velocities.iter();
        velocities
            .zip(&self.setup().masses)
            .fold([0.0; 2], |[x, y], (velocity, mass)| {
                [x + mass * velocity[0], y + mass * velocity[1]]
            })
    }

    /// Kinetic energy \[J\] of translation and rotation.
    pub fn kinetic_energy(&self) -> f64 {
        let matter = self.radii().iter().zip(&self.setup().masses);
        let disks = self.observables().velocities.iter().zip(matter);
        disks.fold(0.0, |sum, ([vx, vy, spin], (radius, mass))| {
            sum + 0.5 * mass * (vx * vx + vy * vy + 0.5 * powi(radius * spin, 2))
        })
    }

    /// Energy \[J\] in gravity, zero at height zero.
    pub fn potential_energy(&self) -> f64 {
        let disks = self.observables().positions.iter().zip(&self.setup().masses);
        self.setup().gravity * disks.fold(0.0, |sum, (position, mass)| sum + mass * position[1])
    }

    /// Energy \[J\] in the springs of closed contacts, normal and tangential.
    pub fn elastic_energy(&self) -> f64 {
        let now = self.now();
        self.stepper.elastic_energy(&now.disks, now.base)
    }

    /// The closed contacts, disks with disks first.
    pub fn contacts(&self) -> Vec<ContactNow> {
        let now = self.now();
        self.stepper.contacts(&now.disks, now.base)
    }

    /// Energies of the disks.
    pub fn energies(&self) -> SoftDiskEnergies {
        SoftDiskEnergies {
            kinetic: self.kinetic_energy(),
            potential: self.potential_energy(),
            elastic: self.elastic_energy(),
        }
    }
}
