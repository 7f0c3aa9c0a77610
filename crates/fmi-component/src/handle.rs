//! What a pointer in a caller's hands points to, for FMI and for the C library alike.
//!
//! A word at its beginning distinguishes it from other memory, from a handle of another kind and, as far as that can be,
//! from one that was freed. A lock lends its content to one call at a time: it refuses and does not wait, since the call
//! that holds it may be the caller's own, further up the stack. Only a call that left and resumes waits.
//!
//! Needs: a pointer that is null, leads to memory that may be read, or was handed out and not freed. Guarantees: nothing
//! behind the word is touched unless the word is right; no two calls hold the content at once; a panic leaves it unlocked.
#![allow(unsafe_code)] // the pointers that callers hold are made, followed and freed here

use std::any::Any;
use std::cell::UnsafeCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

/// A T in a caller's hands. WORD is another for each kind.
#[repr(C)] // the word comes first: it is read before anything is known of the rest
pub struct Handle<T, const WORD: u64> {
    word: AtomicU64,
    busy: AtomicBool,
    /// Calls that did not get in and could not be told of: see [`Handle::note_barred`].
    barred: Mutex<Vec<&'static str>>,
    /// Whether there are any: looked at by every call.
    has_barred: AtomicBool,
    content: UnsafeCell<T>,
}

/// Calls that are noted at most: a caller that asks again and again while another call is under way says nothing new.
const MOST_NOTES: usize = 8;

/// Why a call does not get in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Barred {
    /// Null, misaligned, or no handle of this kind (any more).
    NoHandle,
    /// A call is under way, on another thread or further up the stack.
    Busy,
}

/// Unlocks when it goes, by a panic too.
struct Lock<'a>(&'a AtomicBool);

impl<'a> Lock<'a> {
    fn take(busy: &'a AtomicBool) -> Result<Self, Barred> {
        match busy.swap(true, Ordering::Acquire) {
            false => Ok(Self(busy)),
            true => Err(Barred::Busy),
        }
    }
}

impl Drop for Lock<'_> {
    fn drop(&mut self) {
        self.0.store(false, Ordering::Release);
    }
}

impl<T, const WORD: u64> Handle<T, WORD> {
    /// Gives `content` into the caller's hands, until [`Handle::free`].
    pub fn hand_out(content: T) -> *mut Self {
        Box::into_raw(Box::new(Self {
            word: AtomicU64::new(WORD),
            busy: AtomicBool::new(false),
            barred: Mutex::default(),
            has_barred: AtomicBool::new(false),
            content: UnsafeCell::new(content),
        }))
    }

    /// Notes the name of a call that was barred since another was under way: what is needed to tell of it is in the content,
    /// which is lent. Whoever has it asks [`Handle::take_barred`].
    ///
    /// # Safety
    /// As for [`Handle::enter`].
    pub unsafe fn note_barred(pointer: *const Self, call: &'static str) {
        // SAFETY: by the caller's promise.
        if let Ok(handle) = unsafe { Self::alive(pointer) } {
            let mut barred = handle.barred.lock().unwrap_or_else(PoisonError::into_inner);
            if barred.len() < MOST_NOTES {
                barred.push(call);
            }
            handle.has_barred.store(true, Ordering::Release);
        }
    }

    /// Names of the calls that were noted since the last time.
    ///
    /// # Safety
    /// As for [`Handle::enter`].
    pub unsafe fn take_barred(pointer: *const Self) -> Vec<&'static str> {
        // SAFETY: by the caller's promise.
        match unsafe { Self::alive(pointer) } {
            Ok(handle) if handle.has_barred.load(Ordering::Acquire) => {
                let mut barred = handle.barred.lock().unwrap_or_else(PoisonError::into_inner);
                handle.has_barred.store(false, Ordering::Release);
                std::mem::take(&mut *barred)
            }
            _ => Vec::new(),
        }
    }

    /// Does `work` with the content under its lock.
    ///
    /// # Safety
    /// `pointer` is null, leads to eight bytes that may be read, or was handed out and not freed.
    ///
    /// # Errors
    /// See [`Barred`]; nothing has been done.
    pub unsafe fn enter<R>(pointer: *const Self, work: impl FnOnce(&mut T) -> R) -> Result<R, Barred> {
        // SAFETY: by the caller's promise.
        let handle = unsafe { Self::alive(pointer) }?;
        let _lock = Lock::take(&handle.busy)?;
        // SAFETY: the lock was taken, so this is the only reference to the content until the lock goes, after `work`.
        Ok(work(unsafe { &mut *handle.content.get() }))
    }

    /// Takes the lock again for a call that released it midway. Who holds it now is on another thread, since
    /// all that the caller did meanwhile has returned: it is waited for.
    ///
    /// # Safety
    /// As for [`Handle::enter`].
    ///
    /// # Errors
    /// No handle; nothing has been done.
    pub unsafe fn resume<R>(pointer: *const Self, work: impl FnOnce(&mut T) -> R) -> Result<R, Barred> {
        // SAFETY: by the caller's promise.
        let handle = unsafe { Self::alive(pointer) }?;
        let _lock = loop {
            match Lock::take(&handle.busy) {
                Ok(lock) => break lock,
                Err(_) => std::thread::yield_now(),
            }
        };
        // SAFETY: as in `enter`.
        Ok(work(unsafe { &mut *handle.content.get() }))
    }

    /// Takes the content back and drops it, if `may` allows it. One that is at work stays: freeing it now would pull it
    /// from under the call.
    ///
    /// # Safety
    /// As for [`Handle::enter`].
    ///
    /// # Errors
    /// See [`Barred`]; nothing has been done.
    pub unsafe fn free(pointer: *mut Self, may: impl FnOnce(&T) -> bool) -> Result<(), Barred> {
        // SAFETY: by the caller's promise.
        let handle = unsafe { Self::alive(pointer) }?;
        let lock = Lock::take(&handle.busy)?;
        // SAFETY: the lock was taken, so nobody changes the content.
        if !may(unsafe { &*handle.content.get() }) {
            return Ok(());
        }
        std::mem::forget(lock); // it stays shut, and its reference ends here
        handle.word.store(0, Ordering::Relaxed);
        // SAFETY: the word is right, so `pointer` was made by `Box::into_raw` above; by the caller's promise it was not
        // freed before.
        let boxed = unsafe { Box::from_raw(pointer) };
        // Content that panics when it is dropped can report to nobody.
        let _ = catch_unwind(AssertUnwindSafe(|| drop(boxed)));
        Ok(())
    }

    /// # Safety
    /// As for [`Handle::enter`].
    unsafe fn alive<'a>(pointer: *const Self) -> Result<&'a Self, Barred> {
        if pointer.is_null() || !pointer.is_aligned() {
            return Err(Barred::NoHandle);
        }
        // SAFETY: not null, aligned (checked) and eight bytes that may be read, by the caller's promise.
        let word = unsafe { &*pointer.cast::<AtomicU64>() };
        if word.load(Ordering::Relaxed) != WORD {
            return Err(Barred::NoHandle);
        }
        // SAFETY: a handle that is alive, by its word and the caller's promise. A shared reference is enough: what changes
        // is in atomics and in the cell.
        Ok(unsafe { &*pointer })
    }
}

/// How the text of a panic begins.
pub const DEFECT: &str = "internal defect, please report it";

/// The text of a panic, for the caller to report.
pub fn describe(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    format!("{DEFECT}: {}", text.unwrap_or("panic without a message"))
}

#[cfg(test)]
#[allow(clippy::undocumented_unsafe_blocks)] // what each test does wrong or right is its name
mod tests {
    use std::ptr::{null, null_mut};
    use std::sync::atomic::AtomicU32;

    use super::*;

    type Counter = Handle<u32, 0x1234>;
    type Other = Handle<u32, 0x4321>;

    fn increase(pointer: *const Counter) -> Result<u32, Barred> {
        unsafe {
            Counter::enter(pointer, |count| {
                *count += 1;
                *count
            })
        }
    }

    fn free(pointer: *mut Counter) -> Result<(), Barred> {
        unsafe { Counter::free(pointer, |_| true) }
    }

    #[test]
    fn content_is_lent_and_given_back() {
        let counter = Counter::hand_out(40);
        assert_eq!((increase(counter), increase(counter)), (Ok(41), Ok(42)));
        assert_eq!(free(counter), Ok(()));
    }

    #[test]
    fn pointers_to_anything_else_are_refused() {
        let (word, counter) = (7_u64, Counter::hand_out(0)); // eight bytes are all that is read
        let others = [
            null(),
            (&raw const word).cast(),
            counter.wrapping_byte_add(1).cast_const(),
        ];
        for other in others {
            assert_eq!(increase(other), Err(Barred::NoHandle));
            assert_eq!(free(other.cast_mut()), Err(Barred::NoHandle));
        }
        assert_eq!(unsafe { Other::enter(counter.cast(), |_| ()) }, Err(Barred::NoHandle));
        assert_eq!(unsafe { Other::free(null_mut(), |_| true) }, Err(Barred::NoHandle));
        assert_eq!(free(counter), Ok(()));
    }

    #[test]
    fn a_call_from_inside_is_refused_and_frees_nothing() {
        let counter = Counter::hand_out(0);
        let inside = unsafe { Counter::enter(counter, |_| (increase(counter), free(counter))) };
        assert_eq!(inside, Ok((Err(Barred::Busy), Err(Barred::Busy))));
        assert_eq!((increase(counter), free(counter)), (Ok(1), Ok(())));
    }

    #[test]
    fn barred_calls_are_noted_up_to_a_few_and_taken_once() {
        let counter = Counter::hand_out(0);
        let note = || unsafe { Counter::note_barred(counter, "set") };
        let taken = unsafe {
            Counter::enter(counter, |_| {
                (0..100).for_each(|_| note());
                (Counter::take_barred(counter), Counter::take_barred(counter))
            })
        };
        assert_eq!(taken, Ok((vec!["set"; MOST_NOTES], vec![])));
        assert_eq!(unsafe { Counter::take_barred(null()) }, Vec::<&str>::new());
        assert_eq!(free(counter), Ok(()));
    }

    #[test]
    fn a_panic_unlocks() {
        let counter = Counter::hand_out(0);
        let panics = || unsafe { Counter::enter(counter, |_| panic!("set to panic")) };
        assert!(catch_unwind(AssertUnwindSafe(panics)).is_err());
        assert_eq!((increase(counter), free(counter)), (Ok(1), Ok(())));
    }

    #[test]
    fn content_that_may_not_be_freed_lives_on() {
        let counter = Counter::hand_out(0);
        assert_eq!(unsafe { Counter::free(counter, |count| *count > 0) }, Ok(()));
        assert_eq!(increase(counter), Ok(1));
        assert_eq!(unsafe { Counter::free(counter, |count| *count > 0) }, Ok(()));
    }

    #[test]
    fn content_that_panics_when_dropped_is_freed() {
        struct Panics;
        impl Drop for Panics {
            fn drop(&mut self) {
                panic!("set to panic");
            }
        }
        let handle = Handle::<Panics, 1>::hand_out(Panics);
        assert_eq!(unsafe { Handle::free(handle, |_| true) }, Ok(()));
    }

    /// No call is lost, and no two are inside at once.
    #[test]
    fn threads_take_turns() {
        struct Shared(*mut Counter);
        unsafe impl Sync for Shared {}
        let (shared, done) = (Shared(Counter::hand_out(0)), AtomicU32::new(0));
        std::thread::scope(|scope| {
            for _ in 0..4 {
                let (shared, done) = (&shared, &done);
                scope.spawn(move || {
                    for _ in 0..10_000 {
                        done.fetch_add(u32::from(increase(shared.0).is_ok()), Ordering::Relaxed);
                    }
                });
            }
        });
        assert_eq!(increase(shared.0), Ok(done.into_inner() + 1));
        assert_eq!(free(shared.0), Ok(()));
    }

    #[test]
    fn a_call_that_resumes_waits() {
        struct Shared(*mut Counter);
        unsafe impl Sync for Shared {}
        let (shared, inside) = (Shared(Counter::hand_out(0)), AtomicBool::new(false));
        std::thread::scope(|scope| {
            let (shared, inside) = (&shared, &inside);
            scope.spawn(move || unsafe {
                Counter::enter(shared.0, |count| {
                    inside.store(true, Ordering::Release);
                    std::thread::sleep(std::time::Duration::from_millis(20));
                    *count = 7;
                })
            });
            while !inside.load(Ordering::Acquire) {
                std::thread::yield_now();
            }
            assert_eq!(unsafe { Counter::resume(shared.0, |count| *count) }, Ok(7));
        });
        assert_eq!(unsafe { Counter::resume(null(), |_| ()) }, Err(Barred::NoHandle));
        assert_eq!(free(shared.0), Ok(()));
    }

    #[test]
    fn panics_are_described() {
        assert!(describe(&"why").ends_with("report it: why"));
        assert!(describe(&String::from("why")).ends_with("report it: why"));
        assert!(describe(&7).ends_with("without a message"));
    }
}
