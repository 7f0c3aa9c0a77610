//! Read-only observables: what a run shows in, numbers with their errors out. Nothing here changes what it looks at.

mod batch_means;
pub mod three_disk;

pub use batch_means::BatchMeans;
