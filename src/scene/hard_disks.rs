//! What the scenes of hard disks on a base share: the base that their parameters describe, radii and energies.

use std::sync::Arc;

use crate::drive::{Drive, FollowsInput, Sine};
use crate::engine::DiskMotion;
use crate::engine::event_driven::{Counts, EventDrivenStop, Moving, Partner, VibratingBase};
use crate::error::are_sane;

use super::base_drive::BaseDrive;
use super::disks_on_base::DisksOnBase;
use super::{Error, Result, Row, Unit, Values, Warning, work_limit};

/// A base that a scene of hard disks can stand on.
pub trait HardBase: VibratingBase {
    /// Where its variables come from.
    type Drive: BaseDrive;

    /// The base that the parameters describe.
    ///
    /// # Errors
    /// Values that are no motion.
    fn from_values(start_time: f64, values: &Values) -> Result<Self>;

    /// Takes new inputs at `time` \[s\] for a step of `duration` \[s\]; false if nothing has changed.
    fn set_target(&mut self, time: f64, duration: f64, values: &Values) -> bool;

    /// What is doubtful of the inputs so far.
    fn warning(&self, _told: &[&'static str]) -> Option<Warning> {
        None
    }
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

    fn set_target(&mut self, _time: f64, _duration: f64, _values: &Values) -> bool {
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

    fn set_target(&mut self, time: f64, duration: f64, values: &Values) -> bool {
        BaseDrive::set_target(&mut self.drive, time, duration, values);
        self.farthest = self.drive.path().highest();
        true
    }

    fn warning(&self, told: &[&'static str]) -> Option<Warning> {
        self.drive.warning(told)
    }
}

/// The refusal of a step that an event-driven engine could not finish; `partner` names walls and the edge of a shell, `crowded`
/// says what makes many events.
pub fn refused_step(
    scene: &'static str,
    stop: EventDrivenStop,
    partner: impl FnOnce(Partner) -> &'static str,
    remedy: &str,
    crowded: &str,
) -> Error {
    let stop = match stop {
        EventDrivenStop::NoHeadway(stop) => stop,
        EventDrivenStop::TooManyEvents { time, most } => {
            let asked = match most {
                0 => "events beyond those of the seconds simulated so far".into(),
                _ => format!("more than {most} events"),
            };
            return work_limit::refusal(scene, time, &asked, crowded);
        }
    };
    let partner = match stop.partner {
        Partner::Disk(other) => format!("disk {}", other + 1),
        wall_or_shell => partner(wall_or_shell).into(),
    };
    let within = match stop.duration {
        0.0 => "at one instant".into(),
        duration => format!("within {duration:.1e} s"),
    };
    Error::Step {
        model: scene,
        time: stop.time,
        what: format!(
            "no headway: {} events {within}, the last of disk {} with {partner}",
            stop.events,
            stop.disk + 1
        ),
        remedy: remedy.into(),
    }
}

/// Kinetic and potential energy \[J\] of hard disks at one time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HardDiskEnergies {
    /// Of translation and rotation \[J\].
    pub kinetic: f64,
    /// In gravity, zero at height zero \[J\].
    pub potential: f64,
}

impl HardDiskEnergies {
    /// Both together \[J\].
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential
    }
}

/// A scene of hard disks, as far as the outputs `energy.*` show it.
pub trait HardDisksOnBase: DisksOnBase {
    /// Masses \[kg\].
    fn masses(&self) -> &[f64];
    /// Radius of a disk \[m\].
    fn radius(&self, disk: usize) -> f64;
    /// g \[m/s2\].
    fn gravity(&self) -> f64;
    /// Moment of inertia over m R^2.
    fn inertia_factor(&self) -> f64;
    /// Sums since the start.
    fn counts(&self) -> Counts;
    /// Total energy at the start \[J\], with all that changes of gravity have added since.
    fn start_energy(&self) -> f64;

    /// Energies of the disks now.
    #[inline(always)]
    fn energies(&self) -> HardDiskEnergies {
        let mut energies = HardDiskEnergies::default();
        for (disk, mass) in self.masses().iter().enumerate() {
            let DiskMotion {
                position,
                velocity,
                angular_velocity,
                ..
            } = self.disk(disk);
            let surface_velocity = self.radius(disk) * angular_velocity;
            energies.kinetic +=
                0.5 * mass * (velocity.norm_squared() + self.inertia_factor() * surface_velocity * surface_velocity);
            energies.potential += mass * self.gravity() * position.y;
        }
        energies
    }

    /// Sum of mass times height of the disks \[kg.m\] now: their energy in gravity over gravity.
    fn height_moment(&self) -> f64 {
        let disks = self.masses().iter().enumerate();
        disks.map(|(disk, mass)| mass * self.disk(disk).position.y).sum()
    }

    /// Whether disks, base and sums at `time` \[s\] are finite and far from overflow.
    fn is_sane(&self, time: f64) -> bool {
        let counts = self.counts();
        self.motions_are_sane(time) && are_sane([counts.energy_lost, counts.energy_input, counts.base_impulse])
    }

    /// Refuses a step of the scene that ended at `time` \[s\] with numbers beyond use.
    ///
    /// # Errors
    /// A disk, the base or a sum is not finite or close to overflow.
    fn check(&self, scene: &'static str, time: f64) -> Result<()> {
        if self.is_sane(time) {
            return Ok(());
        }
        Err(Error::Step {
            model: scene,
            time,
            what: "a disk or the base is beyond 1e100 or no longer finite".into(),
            remedy: "Check the base's amplitude and the inputs.".into(),
        })
    }
}

/// Texts and typical size of the outputs `energy.*`.
pub struct EnergyRows<'a> {
    /// Typical energy \[J\].
    pub nominal: f64,
    /// Description of the potential energy, with its zero.
    pub potential: &'a str,
    /// Description of the energy lost.
    pub lost: &'a str,
    /// Description of what the balance misses.
    pub residual: &'a str,
    /// What the kinetic energy at the start depends on.
    pub kinetic_at_start: &'a Arc<[&'static str]>,
    /// What the potential energy at the start depends on.
    pub potential_at_start: &'a Arc<[&'static str]>,
}

impl EnergyRows<'_> {
    /// The rows.
    pub fn rows<M: HardDisksOnBase>(&self) -> [Row<M>; 5] {
        let energy = |name: &str, description: &str, read: fn(&M) -> f64| {
            Row::output(name, Unit::JOULE, self.nominal, description, read)
        };
        [
            energy(
                "energy.kinetic",
                "Kinetic energy of translation and rotation",
                |scene| scene.energies().kinetic,
            )
            .depending_on(self.kinetic_at_start),
            energy("energy.potential", self.potential, |scene| scene.energies().potential)
                .depending_on(self.potential_at_start),
            energy(
                "energy.input",
                "Work done by the base on the disks since the start",
                |scene| scene.counts().energy_input,
            ),
            energy("energy.lost", self.lost, |scene| scene.counts().energy_lost),
            energy("energy.residual", self.residual, |scene| {
                let counts = scene.counts();
                let change = scene.energies().total() - scene.start_energy();
                change - counts.energy_input + counts.energy_lost
            }),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::event_driven::NoHeadway;

    #[test]
    fn a_refusal_without_headway_reads_as_a_sentence() {
        let message = |duration| {
            let (time, events, disk) = (0.5, 100_000, 1);
            let stop = NoHeadway {
                time,
                events,
                duration,
                disk,
                partner: Partner::Disk(6),
            };
            refused_step("packing", EventDrivenStop::NoHeadway(stop), |_| "the base", "Wait.", "").to_string()
        };
        let end = "the last of disk 2 with disk 7. Wait.";
        assert!(message(0.0).ends_with(&format!("100000 events at one instant, {end}")));
        assert!(message(1.339878809708539e-7).ends_with(&format!("100000 events within 1.3e-7 s, {end}")));
    }
}
