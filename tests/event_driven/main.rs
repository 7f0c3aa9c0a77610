//! The event-driven engine: conservation, hardness, bits, and agreement with closed forms.
#![allow(clippy::unwrap_used)]

mod boxed;
mod gas;
