//! Changes of what disks fly and collide by, during a run: another collision law, another gravity.

use crate::collision::CollisionLaw;

use super::{Boundary, EventDriven, Observer, Space};

impl<L: CollisionLaw, B: Boundary, S: Space> EventDriven<L, B, S> {
    /// Collides by another law from now on. Flights and their next events stay: no law acts before an impact.
    pub fn set_law(&mut self, law: L) {
        let radii = self.state.bodies.iter().map(|body| body.radius);
        let largest = radii.fold(0.0, f64::max);
        self.work_of_event = law.most_work() + self.state.boundary.most_work(largest);
        self.law = law;
    }

    /// Changes gravity \[m/s2\] at `time` \[s\], up to which all events are handled: all disks fly there under the old one and
    /// are predicted anew under the new one. Shows the flights that it cuts in two.
    pub fn set_gravity(&mut self, time: f64, gravity: f64, observer: &mut impl Observer) {
        let now = time - self.state.epoch;
        let disks = self.state.bodies.len() as u32;
        for disk in 0..disks {
            self.fly(disk, now, observer);
        }
        self.gravity = gravity;
        for disk in 0..disks {
            self.predict(disk);
        }
        // The mean delay of an event is another one.
        self.fill_calendar();
    }
}
