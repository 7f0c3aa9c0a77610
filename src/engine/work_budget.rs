//! How much work one call may do, so that no call runs for hours.
//!
//! One unit of work is one event of an event-driven engine (an impact in closed form, a rebuild of a neighbour list):
//! 0.1 to 1 us on one core. An impact that has to be stitched costs more units
//! ([`CollisionLaw::most_work`](crate::collision::CollisionLaw)), a time step of velocity Verlet one unit for ten disks. A
//! call that would take more is refused and leaves the state unchanged; several shorter communication steps do the same
//! with the same bits. The budget counts operations, not time, so that every machine refuses the same calls.

use super::interruption::{self, Question};

/// Default budget of a call: some ten minutes to half an hour.
pub const MOST_WORK_IN_A_CALL: u64 = 2_000_000_000;

/// Work between two questions whether to go on: 20 to 200 ms.
const BETWEEN_QUESTIONS: u64 = 200_000;

/// The work that one call may still do.
#[derive(Debug, Clone, Copy)]
pub struct WorkBudget {
    most: u64,
    /// What may be spent before the next question.
    left: u64,
    /// What is left after that.
    later: u64,
    /// Whether to go on: see [`interruptible`](super::interruptible).
    question: Option<Question>,
}

impl Default for WorkBudget {
    fn default() -> Self {
        Self::at_most(MOST_WORK_IN_A_CALL)
    }
}

impl WorkBudget {
    /// A budget of `most` units.
    pub fn at_most(most: u64) -> Self {
        let question = interruption::question();
        let left = match question {
            Some(_) => most.min(BETWEEN_QUESTIONS),
            None => most,
        };
        Self {
            most,
            left,
            later: most - left,
            question,
        }
    }

    /// The whole budget, in units.
    pub fn most(&self) -> u64 {
        self.most
    }

    /// Takes `amount` units off what is left. If less is left, or the step is to end, takes nothing and returns false.
    #[inline]
    pub fn spend(&mut self, amount: u64) -> bool {
        let enough = amount <= self.left;
        if enough {
            self.left -= amount;
        }
        enough || self.spend_later(amount)
    }

    #[cold]
    fn spend_later(&mut self, amount: u64) -> bool {
        let left = self.left + self.later;
        if amount > left || self.is_interrupted() {
            return false;
        }
        let left = left - amount;
        self.left = left.min(BETWEEN_QUESTIONS);
        self.later = left - self.left;
        true
    }

    /// Of work that was taken off at once: how much of it may be done before [`WorkBudget::is_interrupted`] is asked again; none if
    /// nobody wants to ask.
    pub fn work_between_questions(&self) -> Option<u64> {
        self.question.map(|_| BETWEEN_QUESTIONS)
    }

    /// Whether the step is to end, asked now.
    pub fn is_interrupted(&self) -> bool {
        self.question.is_some_and(interruption::is_wanted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::interruptible;

    #[test]
    fn all_of_it_can_be_spent_and_no_more() {
        for question in [None, Some((|| false) as Question)] {
            let spend_all = || {
                let mut budget = WorkBudget::at_most(1_000_003);
                assert!(!budget.spend(1_000_004));
                let mut spent = 0;
                while budget.spend(7) {
                    spent += 7;
                }
                assert!(budget.spend(1_000_003 - spent) && !budget.spend(1));
            };
            match question {
                None => spend_all(),
                Some(question) => assert!(!interruptible(question, spend_all).1),
            }
        }
    }

    #[test]
    fn a_yes_ends_it_and_is_told() {
        let (spent, ended) = interruptible(
            || true,
            || {
                let mut budget = WorkBudget::at_most(u64::MAX);
                (0..).find(|_| !budget.spend(1))
            },
        );
        assert_eq!((spent, ended), (Some(BETWEEN_QUESTIONS), true));
        assert!(WorkBudget::at_most(u64::MAX).spend(u64::MAX), "the question is gone");
    }
}
