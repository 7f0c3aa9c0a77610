//! The parameter that shares the work of a time step among threads.

use crate::engine::threads::ThreadPool;

use super::{Error, Result, Row, Values};

const NAME: &str = "threads";

/// Most threads that can be asked for: beyond some tens a step of any packing is too short to be divided further.
const MOST: i64 = 64;

/// Disks from which on threads are started. With 2,000, waiting for each other costs what they save
/// (`cargo bench --bench threads`).
pub const LEAST_DISKS: usize = 2500;

/// The parameter.
pub fn row<M>() -> Row<M> {
    Row::long_parameter(
        NAME,
        1..=MOST,
        1,
        &format!(
            "Threads that share the work of a time step; no result depends on them. Packings of fewer than {LEAST_DISKS} disks are \
             computed by one. No state holds this: one that is restored goes on with the threads that there are"
        ),
    )
    .outside_states()
}

/// The threads that the parameter asks for, for so many disks.
///
/// # Errors
/// The system starts no more threads.
pub fn pool(disks: usize, values: &Values) -> Result<ThreadPool> {
    if disks < LEAST_DISKS {
        return Ok(ThreadPool::default());
    }
    let asked = values.integer(NAME);
    ThreadPool::new(asked as usize).map_err(|error| {
        Error::parameter(
            NAME,
            asked,
            format!("a number of threads that the system starts, which it refused ({error})"),
            "Take fewer threads, or 1, or raise the limits of threads and of memory that this process has.",
        )
    })
}
