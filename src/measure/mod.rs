//! Read-only observables: what a run shows in, numbers with their errors out. Nothing here changes what it looks at.

mod batch_means;
mod flow_fields;
pub mod three_disk;
mod transport;

pub use batch_means::BatchMeans;
pub use flow_fields::{Cell, FlowFields, Grid, Layer};
pub use transport::{Told, Transport};
