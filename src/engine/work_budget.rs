//! How much work one call may do, so that no call runs for hours.
//!
//! One unit of work is one event of an event-driven engine (an impact in closed form, a rebuild of a neighbour list):
//! 0.1 to 1 us on one core. An impact that has to be stitched costs more units
//! ([`CollisionLaw::most_work`](crate::collision::CollisionLaw)), a time step of velocity Verlet one unit for ten disks. A
//! call that would take more is refused and leaves the state unchanged; several shorter communication steps do the same
//! with the same bits. The budget counts operations, not time, so that every machine refuses the same calls.

/// Default budget of a call: some ten minutes to half an hour.
pub const MOST_WORK_IN_A_CALL: u64 = 2_000_000_000;

/// The work that one call may still do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WorkBudget {
    most: u64,
    left: u64,
}

impl Default for WorkBudget {
    fn default() -> Self {
        Self::at_most(MOST_WORK_IN_A_CALL)
    }
}

impl WorkBudget {
    /// A budget of `most` units.
    pub fn at_most(most: u64) -> Self {
        Self { most, left: most }
    }

    /// The whole budget, in units.
    pub fn most(&self) -> u64 {
        self.most
    }

    /// Takes `amount` units off what is left. If less is left, takes nothing and returns false.
    #[inline]
    pub fn spend(&mut self, amount: u64) -> bool {
        let enough = amount <= self.left;
        if enough {
            self.left -= amount;
        }
        enough
    }
}
