//! Ends a long step from outside, such as by Ctrl-C.
//!
//! An engine on the thread that called [`interruptible`] asks a few times a second whether to go on. A step that is not to go on
//! ends as one that asks for too much work: the simulation is as before it. What was asked, and when, changes no bit of a
//! step that is finished.

use std::cell::Cell;

/// Asked whether the step is to end.
pub type Question = fn() -> bool;

thread_local! {
    static QUESTION: Cell<Option<Question>> = const { Cell::new(None) };
    static ENDED: Cell<bool> = const { Cell::new(false) };
}

/// Does `work`, whose steps end where `wanted` says yes. Returns whether one did, too.
pub fn interruptible<T>(wanted: Question, work: impl FnOnce() -> T) -> (T, bool) {
    /// Puts back what was there, after a panic too.
    struct Before(Option<Question>, bool);
    impl Drop for Before {
        fn drop(&mut self) {
            QUESTION.set(self.0);
            ENDED.set(self.1);
        }
    }
    let before = Before(QUESTION.replace(Some(wanted)), ENDED.replace(false));
    let done = work();
    let ended = ENDED.get();
    drop(before);
    (done, ended)
}

/// The question of this thread.
pub(super) fn question() -> Option<Question> {
    QUESTION.get()
}

/// Whether the answer is to end; it is then known to [`interruptible`].
pub(super) fn is_wanted(question: Question) -> bool {
    let wanted = question();
    if wanted {
        ENDED.set(true);
    }
    wanted
}
