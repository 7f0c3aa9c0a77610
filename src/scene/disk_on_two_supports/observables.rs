//! What the rows read from the engine: the disk, contacts, supports and energies at the time reached.

use crate::drive::excitation::SupportMotion;
use crate::engine::disk_on_two_supports::dynamics::{place, rates};
use crate::engine::disk_on_two_supports::support::kinematics;
use crate::engine::disk_on_two_supports::{Node, Record};
use crate::engine::{ContactNow, Touched};

use super::{DiskOnTwoSupportsDrive, DiskOnTwoSupportsScene};

impl<E: DiskOnTwoSupportsDrive> DiskOnTwoSupportsScene<E> {
    pub(super) fn now(&self) -> &Node {
        &self.engine.state().now
    }

    /// What the contacts did since `measure.start`.
    pub(super) fn record(&self) -> Record {
        let now = self.now().record;
        now.since(self.report.before.as_ref().unwrap_or(&now))
    }

    pub(super) fn support(&self, index: usize) -> SupportMotion {
        self.engine.driven().1[index]
    }

    pub(super) fn tangential_forces(&self) -> [f64; 2] {
        self.contacts.map(|contact| contact.tangential)
    }

    /// Tangential force \[N/rad\] of both contacts over the angle by which the disk turns against them, 2 k_t R.
    pub(super) fn force_per_angle(&self) -> f64 {
        let setup = self.engine.setup();
        2.0 * setup.tangential.stiffness * setup.radius
    }

    /// The contacts that overlap; positions count from where the disk just touches both supports at rest.
    pub(super) fn closed_contacts(&self) -> impl Iterator<Item = ContactNow> {
        let (setup, disk) = (self.engine.setup(), self.now().disk);
        let [x, y, _] = place(&disk);
        let closed = (0..2).filter(|&index| self.contacts[index].overlap > 0.0);
        closed.map(move |index| {
            let (frame, force) = (&setup.frames[index], self.contacts[index]);
            let motion = kinematics(
                frame,
                setup.curvature,
                setup.radius,
                place(&disk),
                rates(&disk),
                &self.support(index),
            );
            let along = |axis: usize| motion.normal * frame.normal[axis] + motion.tangent * frame.tangent[axis];
            let normal = [along(0), along(1)];
            let inside = setup.radius - 0.5 * force.overlap;
            ContactNow {
                first: 0,
                other: Touched::Wall(index as u32),
                point: [x - inside * normal[0], y - inside * normal[1]],
                normal,
                normal_force: force.normal,
                tangential_force: force.tangential,
            }
        })
    }

    /// Energy of translation and rotation \[J\].
    pub(super) fn kinetic_energy(&self) -> f64 {
        let (setup, [_, _, _, vx, vy, spin, ..]) = (self.engine.setup(), self.now().disk);
        0.5 * (setup.mass * (vx * vx + vy * vy) + setup.inertia() * spin * spin)
    }

    /// Energy in gravity \[J\], zero where the disk just touches both supports at rest.
    pub(super) fn potential_energy(&self) -> f64 {
        let setup = self.engine.setup();
        setup.mass * setup.gravity * self.now().disk[1]
    }

    /// Energy in the normal and tangential springs of the contacts \[J\].
    pub(super) fn elastic_energy(&self) -> f64 {
        let setup = self.engine.setup();
        let [left, right] = self.contacts.map(|contact| {
            let normal = if contact.overlap > 0.0 {
                setup.normal.energy(contact.overlap)
            } else {
                0.0
            };
            normal + setup.tangential.energy(contact.stretch)
        });
        left + right
    }

    /// Kinetic, potential and elastic energy together \[J\].
    pub(super) fn energy(&self) -> f64 {
        self.kinetic_energy() + self.potential_energy() + self.elastic_energy()
    }
}
