//! How much one call may do, so that none runs for hours.
//!
//! A unit is an event of an event-driven engine: an impact in closed form, a listing of neighbours; 0.1 to 1 us on a core.
//! An impact that has to be stitched costs more units ([`CollisionLaw::most_work`](crate::collision::CollisionLaw)), a
//! time step of molecular dynamics one for ten disks. What would take more is refused with the state as it was; shorter
//! communication steps do the same in many calls, with the same bits. Counts, not clocks, decide: the same call is refused
//! on every machine.

/// Work of a call if nobody asks for less: some ten minutes to half an hour.
pub const MOST_WORK_IN_A_CALL: u64 = 2_000_000_000;

/// What a call may still do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Work {
    most: u64,
    left: u64,
}

impl Default for Work {
    fn default() -> Self {
        Self::at_most(MOST_WORK_IN_A_CALL)
    }
}

impl Work {
    /// A call that may do so much.
    pub fn at_most(most: u64) -> Self {
        Self { most, left: most }
    }

    /// What it may do in all.
    pub fn most(&self) -> u64 {
        self.most
    }

    /// Takes `amount` off what is left; false, and nothing taken, if there is less.
    #[inline]
    pub fn spend(&mut self, amount: u64) -> bool {
        let enough = amount <= self.left;
        if enough {
            self.left -= amount;
        }
        enough
    }
}
