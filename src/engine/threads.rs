//! Threads that share the work of a time step, and how work is divided among them.
//!
//! An engine has a type of threads: [`OneThread`], for which everything here is compiled to nothing, or [`ThreadPool`]. Which thread
//! does which part of the work, and when, must change no bit of the result: parts write to places of their own, and what they sum is
//! summed in an order that does not depend on the parts.

use std::fmt::Debug;

/// Threads that share work.
pub trait Threads: Debug + Clone + Default + Send + Sync + 'static {
    /// How many there are.
    fn count(&self) -> usize;

    /// Does `work` on one of them, so that [`Self::join`] inside of it costs least.
    fn within<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R;

    /// Does both, at the same time if a thread is free. A panic in one of them goes on here, after the other has ended.
    fn join<A: Send, B: Send>(&self, one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B + Send) -> (A, B);
}

/// The thread that calls, alone.
#[derive(Debug, Clone, Copy, Default)]
pub struct OneThread;

impl Threads for OneThread {
    #[inline(always)]
    fn count(&self) -> usize {
        1
    }

    #[inline(always)]
    fn within<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        work()
    }

    #[inline(always)]
    fn join<A: Send, B: Send>(&self, one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B + Send) -> (A, B) {
        (one(), other())
    }
}

/// Work that can be divided between any two of its units.
pub trait Divisible: Sized + Send {
    /// What comes out. Merging must give the same bits wherever the work was divided.
    type Output: Send;

    /// Units of work.
    fn units(&self) -> usize;

    /// The first `units`, and the others.
    fn split_at(self, units: usize) -> (Self, Self);

    /// Does it.
    fn run(self) -> Self::Output;

    /// What comes out of both.
    fn merged(one: Self::Output, other: Self::Output) -> Self::Output;
}

/// Parts for each thread: a thread that is held up, or slower than others, does fewer of them.
const PARTS_OF_A_THREAD: usize = 2;

/// Parts into which work is divided for these threads.
pub fn parts(threads: &impl Threads) -> usize {
    PARTS_OF_A_THREAD * threads.count()
}

/// Does the work in parts.
#[inline]
pub fn share<W: Divisible>(threads: &impl Threads, work: W) -> W::Output {
    match threads.count() {
        1 => work.run(),
        _ => in_parts(threads, work, parts(threads)),
    }
}

fn in_parts<W: Divisible>(threads: &impl Threads, work: W, parts: usize) -> W::Output {
    let units = work.units();
    if parts < 2 || units < 2 {
        return work.run();
    }
    let left = parts / 2;
    let (one, other) = work.split_at((units * left / parts).max(1));
    let (one, other) = threads.join(
        || in_parts(threads, one, left),
        || in_parts(threads, other, parts - left),
    );
    W::merged(one, other)
}

/// Does `work` on each of the items, which come with their numbers.
pub fn share_each<I: Send>(threads: &impl Threads, items: &mut [I], work: impl Fn(usize, &mut I) + Sync) {
    let (first, work) = (0, &work);
    share(threads, Each { first, items, work });
}

struct Each<'a, I, W> {
    /// Number of the first item.
    first: usize,
    items: &'a mut [I],
    work: &'a W,
}

impl<I: Send, W: Fn(usize, &mut I) + Sync> Divisible for Each<'_, I, W> {
    type Output = ();

    fn units(&self) -> usize {
        self.items.len()
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let (items, items_after) = self.items.split_at_mut(units);
        let one = Self { items, ..self };
        let other = Self {
            first: one.first + units,
            items: items_after,
            ..one
        };
        (one, other)
    }

    fn run(self) {
        for (number, item) in (self.first..).zip(self.items) {
            (self.work)(number, item);
        }
    }

    fn merged((): (), (): ()) {}
}

#[cfg(target_family = "wasm")]
pub use alone::ThreadPool;
#[cfg(not(target_family = "wasm"))]
pub use pool::ThreadPool;

/// Threads by the crate `rayon`, each with queues of its own.
#[cfg(not(target_family = "wasm"))]
mod pool {
    use std::io;
    use std::sync::Arc;
    use std::thread::{Builder, JoinHandle};

    use rayon::ThreadPoolBuilder;

    use super::Threads;

    /// Some threads, which end when the last copy of this value is dropped, before dropping returns; by default the calling thread
    /// alone.
    #[derive(Debug, Clone, Default)]
    pub struct ThreadPool(Option<Arc<Workers>>);

    impl ThreadPool {
        /// So many threads; of one, none is started.
        ///
        /// # Errors
        /// The system starts no more threads.
        pub fn new(count: usize) -> io::Result<Self> {
            if count < 2 {
                return Ok(Self(None));
            }
            let mut workers = Workers {
                pool: None,
                handles: Vec::with_capacity(count),
            };
            let pool = ThreadPoolBuilder::new()
                .num_threads(count)
                .spawn_handler(|thread| {
                    let builder = Builder::new().name("jostle".into());
                    workers.handles.push(builder.spawn(|| thread.run())?);
                    Ok(())
                })
                .build();
            // Those that have started end if one has not: `workers` is dropped.
            workers.pool = Some(pool.map_err(io::Error::other)?);
            Ok(Self(Some(Arc::new(workers))))
        }
    }

    /// A pool of `rayon` with the handles of its threads: it would not wait for their end, and a library whose code they still run
    /// could be unloaded.
    #[derive(Debug)]
    struct Workers {
        pool: Option<rayon::ThreadPool>,
        handles: Vec<JoinHandle<()>>,
    }

    impl Drop for Workers {
        fn drop(&mut self) {
            drop(self.pool.take());
            for handle in self.handles.drain(..) {
                // What panics in a worker has gone on in the thread that waited for it.
                let _ = handle.join();
            }
        }
    }

    impl ThreadPool {
        fn pool(&self) -> Option<&rayon::ThreadPool> {
            self.0.as_ref()?.pool.as_ref()
        }
    }

    impl Threads for ThreadPool {
        fn count(&self) -> usize {
            self.0.as_ref().map_or(1, |workers| workers.handles.len())
        }

        fn within<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
            match self.pool() {
                Some(pool) => pool.install(work),
                None => work(),
            }
        }

        fn join<A: Send, B: Send>(&self, one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B + Send) -> (A, B) {
            match self.pool() {
                Some(pool) => pool.join(one, other),
                None => (one(), other()),
            }
        }
    }
}

/// Where a program has one thread.
#[cfg(target_family = "wasm")]
mod alone {
    use std::io;

    use super::Threads;

    /// The calling thread, however many are asked for: the bits are the same.
    #[derive(Debug, Clone, Default)]
    pub struct ThreadPool(());

    impl ThreadPool {
        /// One thread.
        ///
        /// # Errors
        /// None.
        pub fn new(_count: usize) -> io::Result<Self> {
            Ok(Self(()))
        }
    }

    impl Threads for ThreadPool {
        fn count(&self) -> usize {
            1
        }

        fn within<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
            work()
        }

        fn join<A: Send, B: Send>(&self, one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B + Send) -> (A, B) {
            (one(), other())
        }
    }
}

#[cfg(all(test, not(target_family = "wasm")))]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    struct Count<'a>(&'a mut [u32]);

    impl Divisible for Count<'_> {
        type Output = usize;

        fn units(&self) -> usize {
            self.0.len()
        }

        fn split_at(self, units: usize) -> (Self, Self) {
            let (one, other) = self.0.split_at_mut(units);
            (Self(one), Self(other))
        }

        fn run(self) -> usize {
            self.0.iter_mut().for_each(|number| *number += 1);
            self.0.len()
        }

        fn merged(one: usize, other: usize) -> usize {
            one + other
        }
    }

    #[test]
    fn each_unit_of_work_is_done_once() {
        for threads in [1, 2, 3, 8] {
            let pool = ThreadPool::new(threads).unwrap();
            assert_eq!(pool.count(), threads);
            for units in 0..40 {
                let mut numbers = vec![0; units];
                assert_eq!(pool.within(|| share(&pool, Count(&mut numbers))), units);
                assert!(
                    numbers.iter().all(|number| *number == 1),
                    "{threads} threads, {units} units"
                );
            }
        }
    }

    /// Threads are gone when the pool is: what counts them is only theirs.
    #[test]
    fn dropping_a_pool_waits_for_its_threads() {
        struct Ending(std::sync::Arc<AtomicUsize>);
        impl Drop for Ending {
            fn drop(&mut self) {
                std::thread::sleep(std::time::Duration::from_millis(20));
                self.0.fetch_add(1, Ordering::SeqCst);
            }
        }
        thread_local!(static MARK: std::cell::RefCell<Option<Ending>> = const { std::cell::RefCell::new(None) });
        let ended = std::sync::Arc::new(AtomicUsize::new(0));
        let pool = ThreadPool::new(2).unwrap();
        let copy = pool.clone();
        let ending = Ending(std::sync::Arc::clone(&ended));
        pool.within(|| MARK.with(|mark| *mark.borrow_mut() = Some(ending)));
        drop(pool);
        assert_eq!(ended.load(Ordering::SeqCst), 0, "a copy holds the threads");
        drop(copy);
        assert_eq!(ended.load(Ordering::SeqCst), 1);
    }

    #[test]
    fn a_panic_of_one_part_reaches_the_caller_and_the_pool_goes_on() {
        let pool = ThreadPool::new(2).unwrap();
        let both = || pool.join(|| 1, || if pool.count() == 2 { panic!("meant") } else { 2 });
        let caught = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| pool.within(both)));
        assert!(caught.is_err());
        assert_eq!(pool.join(|| 1, || 2), (1, 2));
    }
}
