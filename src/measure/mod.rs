//! Observables: samples or flights of a run in, numbers with their errors out. Nothing here changes the run.

mod batch_means;
mod flow_fields;
pub mod three_disk;
mod transport;

pub use batch_means::BatchMeans;
pub use flow_fields::{Cell, FlowFields, Grid, Layer};
pub use transport::{Transport, TransportAverages};
