//! Disks on a vibrating base: the rows that several scenes have, and what these rows read from a scene.
//!
//! Names are the same in every scene; typical sizes and descriptions are the scene's own. Rows that say nothing else depend
//! on nothing while the component is initialised: see [`complete`].

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::drive::Motion;
use crate::engine::DiskMotion;
use crate::error::are_sane;

use super::base_drive::TERMINAL;
use super::{Causality, Row, Unit, Variable};

/// What the last communication step reported.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StepReport {
    /// Time reached \[s\].
    pub time: f64,
    /// Beginning of the last communication step \[s\].
    pub begun: f64,
    /// Vertical force of the disks on the base \[N\], mean over the last communication step.
    pub reaction_force: f64,
}

/// Which part of a communication step is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stretch {
    /// Its beginning, or all of it.
    Beginning,
    /// What comes after an intermediate update.
    Rest,
}

impl StepReport {
    /// Before the first step, at `time` \[s\].
    pub fn at_start(time: f64) -> Self {
        Self {
            time,
            begun: time,
            reaction_force: 0.0,
        }
    }

    /// After `stretch` of a communication step, which ends at `time` \[s\] and in which the disks gave the base `impulse` \[N.s\].
    #[must_use]
    pub fn after(&self, stretch: Stretch, time: f64, impulse: f64) -> Self {
        let (begun, earlier) = match stretch {
            Stretch::Beginning => (self.time, 0.0),
            Stretch::Rest => (self.begun, self.reaction_force * (self.time - self.begun)),
        };
        Self {
            time,
            begun,
            reaction_force: (earlier + impulse) / (time - begun),
        }
    }

    /// Whether every number is finite and far from overflow.
    pub fn is_sane(&self) -> bool {
        are_sane([self.time, self.begun, self.reaction_force])
    }
}

/// A scene of disks on a base, as far as its outputs show it.
pub trait DisksOnBase: Sized {
    /// The last communication step.
    fn report(&self) -> &StepReport;

    /// Number of disks.
    fn disk_count(&self) -> usize;

    /// Motion of a disk, counted from 0, at `time` \[s\], to which the engine was advanced last.
    fn disk_at(&self, time: f64, disk: usize) -> DiskMotion;

    /// Motion of the base at `time` \[s\], to which the engine was advanced last.
    fn base_at(&self, time: f64) -> Motion;

    /// Vertical impulse of the disks on the base since the start \[N.s\], up, until the time to which the engine was advanced
    /// last.
    fn base_impulse(&self) -> f64;

    /// Motion of a disk now.
    ///
    /// Always inlined: an output then computes only what it shows of a motion.
    #[inline(always)]
    fn disk(&self, disk: usize) -> DiskMotion {
        self.disk_at(self.report().time, disk)
    }

    /// Motion of the base now.
    fn base(&self) -> Motion {
        self.base_at(self.report().time)
    }

    /// Whether disks and base at `time` \[s\] are finite and far from overflow.
    fn motions_are_sane(&self, time: f64) -> bool {
        let Motion {
            displacement,
            velocity,
            acceleration,
        } = self.base_at(time);
        let disks_hold = (0..self.disk_count()).all(|disk| {
            let motion = self.disk_at(time, disk);
            are_sane(motion.position.iter().chain(&motion.velocity).copied())
                && are_sane([motion.angle, motion.angular_velocity])
        });
        disks_hold && are_sane([displacement, velocity, acceleration])
    }
}

fn mean<M: DisksOnBase>(scene: &M, of: impl Fn(DiskMotion) -> f64) -> f64 {
    let count = scene.disk_count();
    (0..count).map(|disk| of(scene.disk(disk))).sum::<f64>() / count as f64
}

/// Row `mean_velocity`: horizontal velocity, mean over the disks.
pub fn mean_velocity<M: DisksOnBase>(nominal: f64, description: &str) -> Row<M> {
    Row::output(
        "mean_velocity",
        Unit::METRE_PER_SECOND,
        nominal,
        description,
        |scene: &M| mean(scene, |disk| disk.velocity.x),
    )
}

/// Row `mean_angular_velocity`, mean over the disks.
pub fn mean_angular_velocity<M: DisksOnBase>(nominal: f64, description: &str) -> Row<M> {
    Row::output(
        "mean_angular_velocity",
        Unit::RADIAN_PER_SECOND,
        nominal,
        description,
        |scene: &M| mean(scene, |disk| disk.angular_velocity),
    )
}

/// Row `base.reaction_force`; `bodies` as in "disks on the base".
pub fn reaction_force<M: DisksOnBase>(nominal: f64, bodies: &str) -> Row<M> {
    let description =
        format!("Vertical force of the {bodies}, up: impulse over the last communication step divided by its length");
    Row::output(
        "base.reaction_force",
        Unit::NEWTON,
        nominal,
        description,
        |scene: &M| scene.report().reaction_force,
    )
    .in_terminal(TERMINAL, "reaction_force")
}

/// Row `base.impulse`; `bodies` as in "disks on the base".
pub fn base_impulse<M: DisksOnBase>(nominal: f64, bodies: &str) -> Row<M> {
    let description = format!(
        "Vertical impulse of the {bodies} since the start, up; its change over any time is the mean force then times that time"
    );
    Row::output(
        "base.impulse",
        Unit::NEWTON_SECOND,
        nominal,
        description,
        |scene: &M| scene.base_impulse(),
    )
    .in_terminal(TERMINAL, "impulse")
}

/// Row `base.position`: displacement of the base.
pub fn base_position<M: DisksOnBase>(nominal: f64, description: &str) -> Row<M> {
    Row::output("base.position", Unit::METRE, nominal, description, |scene: &M| {
        scene.base().displacement
    })
    .in_terminal(TERMINAL, "position")
}

/// Row `base.velocity_output`, named so because the input `base.velocity` may stand beside it.
pub fn base_velocity<M: DisksOnBase>(nominal: f64, description: &str) -> Row<M> {
    let unit = Unit::METRE_PER_SECOND;
    Row::output("base.velocity_output", unit, nominal, description, |scene: &M| {
        scene.base().velocity
    })
    .in_terminal(TERMINAL, "velocity_output")
}

/// Row `base.acceleration`.
pub fn base_acceleration<M: DisksOnBase>(nominal: f64, description: &str) -> Row<M> {
    let unit = Unit::METRE_PER_SECOND_SQUARED;
    Row::output("base.acceleration", unit, nominal, description, |scene: &M| {
        scene.base().acceleration
    })
    .in_terminal(TERMINAL, "acceleration")
}

/// Rows of the base among the outputs: reaction force, impulse, position, velocity, acceleration.
pub struct BaseRows<'a> {
    /// Typical reaction force \[N\].
    pub force: f64,
    /// What pushes on what, as in "disks on the base".
    pub bodies: &'a str,
    /// What follows the descriptions of position, velocity and acceleration.
    pub note: &'a str,
    /// What the position at the start depends on.
    pub position_at_start: &'a Arc<[&'static str]>,
    /// What the velocity at the start depends on.
    pub velocity_at_start: &'a Arc<[&'static str]>,
    /// What the acceleration at the start depends on.
    pub acceleration_at_start: &'a Arc<[&'static str]>,
}

impl BaseRows<'_> {
    /// The rows.
    pub fn rows<M: DisksOnBase>(&self) -> [Row<M>; 5] {
        let note = self.note;
        [
            reaction_force(self.force, self.bodies),
            base_impulse(self.force, self.bodies),
            base_position(1e-3, &format!("Displacement of the base now, up{note}"))
                .with_derivative("base.velocity_output")
                .depending_on(self.position_at_start),
            base_velocity(0.1, &format!("Velocity of the base now, up{note}"))
                .with_derivative("base.acceleration")
                .depending_on(self.velocity_at_start),
            base_acceleration(10.0, &format!("Acceleration of the base now, up{note}"))
                .depending_on(self.acceleration_at_start),
        ]
    }
}

/// Rows `disk.angle[1]` and on, then their derivatives `disk.angular_velocity[1]` and on, with the typical rate \[rad/s\].
pub fn rotations<M: DisksOnBase>(disks: u32, angle: &str, nominal: f64, rate: &str) -> impl Iterator<Item = Row<M>> {
    let angles = Row::outputs("disk.angle", disks, Unit::RADIAN, 1.0, angle, |scene: &M, disk| {
        scene.disk(disk).angle
    });
    let unit = Unit::RADIAN_PER_SECOND;
    with_derivatives(angles, "disk.angular_velocity").chain(Row::outputs(
        "disk.angular_velocity",
        disks,
        unit,
        nominal,
        rate,
        |scene: &M, disk| scene.disk(disk).angular_velocity,
    ))
}

/// Rows `disk.x[1]` and on. Their derivatives are among the rows of [`velocities`].
pub fn horizontal_positions<M: DisksOnBase>(disks: u32, nominal: f64, what: &str) -> impl Iterator<Item = Row<M>> {
    let rows = Row::outputs("disk.x", disks, Unit::METRE, nominal, what, |scene: &M, disk| {
        scene.disk(disk).position.x
    });
    with_derivatives(rows, "disk.velocity_x")
}

/// Rows `disk.y[1]` and on. Their derivatives are among the rows of [`velocities`].
pub fn heights<M: DisksOnBase>(disks: u32, nominal: f64, what: &str) -> impl Iterator<Item = Row<M>> {
    let rows = Row::outputs("disk.y", disks, Unit::METRE, nominal, what, |scene: &M, disk| {
        scene.disk(disk).position.y
    });
    with_derivatives(rows, "disk.velocity_y")
}

/// Rows `disk.velocity_x[1]` and on, then `disk.velocity_y[1]` and on, with the typical speed \[m/s\] and what they depend on.
pub fn velocities<M: DisksOnBase>(
    disks: u32,
    nominal: f64,
    x_at_start: &[&'static str],
    y_at_start: &[&'static str],
) -> impl Iterator<Item = Row<M>> {
    let unit = Unit::METRE_PER_SECOND;
    let (x_at_start, y_at_start): (Arc<[_]>, Arc<[_]>) = (x_at_start.into(), y_at_start.into());
    let across = "Horizontal velocity of the centre, to the right, of disk {}";
    let up = "Vertical velocity of the centre, up, of disk {}";
    let x = Row::outputs("disk.velocity_x", disks, unit, nominal, across, |scene: &M, disk| {
        scene.disk(disk).velocity.x
    });
    let y = Row::outputs("disk.velocity_y", disks, unit, nominal, up, |scene: &M, disk| {
        scene.disk(disk).velocity.y
    });
    x.map(move |row| row.depending_on(&x_at_start))
        .chain(y.map(move |row| row.depending_on(&y_at_start)))
}

fn with_derivatives<M>(rows: impl Iterator<Item = Row<M>>, rate: &str) -> impl Iterator<Item = Row<M>> {
    let rate = rate.to_owned();
    rows.zip(1_u32..)
        .map(move |(row, disk)| row.with_derivative(format!("{rate}[{disk}]")))
}

/// Rows `disk.radius[1]` and on, which stay; with the typical radius \[m\] and what the radii depend on.
pub fn radii<M>(
    disks: u32,
    nominal: f64,
    at_start: &Arc<[&'static str]>,
    read: impl Fn(&M, usize) -> f64 + Send + Sync + 'static,
) -> impl Iterator<Item = Row<M>> {
    Row::outputs("disk.radius", disks, Unit::METRE, nominal, "Radius of disk {}", read)
        .map(|row| row.constant().depending_on(at_start))
}

/// Names that a row depends on, in one list.
pub fn names(parts: &[&[&'static str]]) -> Arc<[&'static str]> {
    parts.concat().into()
}

/// The rows of a scene, completed: computed rows that name no dependencies have none, since at the start the disks are at
/// rest and nothing has happened yet; and without inputs that move the base there is no terminal for it.
pub fn complete<M>(mut rows: Vec<Row<M>>) -> Vec<Row<M>> {
    let nothing: Arc<[&'static str]> = Arc::from([]);
    let in_terminal = |variable: &Variable| variable.terminal.as_ref().is_some_and(|of| of.terminal == TERMINAL);
    let steered = rows
        .iter()
        .any(|row| row.variable.causality == Causality::Input && in_terminal(&row.variable));
    for Row { variable, .. } in &mut rows {
        if !variable.causality.is_settable() && variable.dependencies.is_none() {
            variable.dependencies = Some(Arc::clone(&nothing));
        }
        if !steered && in_terminal(variable) {
            variable.terminal = None;
        }
    }
    rows
}
