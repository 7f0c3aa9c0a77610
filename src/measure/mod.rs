//! Read-only observables: observations of a run in, numbers with their errors out. Nothing here changes what it observes.

mod batch_means;
pub mod disk_on_two_supports;
mod flow_fields;
mod rotation;
mod transport;

pub use batch_means::BatchMeans;
pub use flow_fields::{Cell, FlowFields, Grid, Layer};
pub use rotation::Rotation;
pub use transport::Transport;
