//! Theory of one disk on two supports that it does not leave (P chapters 4 and 5): parameters in, curves out.
//!
//! Pure functions of a [`Setting`]; they need no run. Contact 1 is the left one, 2 the right one. Tangential forces
//! `tau_i` on the disk are positive where they turn it counter-clockwise, so that the torque on it is `R (tau_1 + tau_2)`.
//! Sliding counter-clockwise, both contacts pull at `-mu n`: the point S2.
//!
//! | file | what | source |
//! |---|---|---|
//! | `balance` | normal forces from tangential ones and accelerations | 4.23 to 4.30 |
//! | `region` | admissible region of departure and stretch, its corners | 4.32 to 4.49 |
//! | `limits` | torques at which the disk slides, tilt at which a contact opens | 4.50, 5.3 to 5.5 |
//! | `regime` | senses in which a harmonic torque makes it slide | 5.2.1, Fig. 5.1 |
//! | `slide` | one slide under a harmonic torque, from rest to rest | 5.6 to 5.8 |
//! | `closed_form` | mean angular velocity while the disk rests between slides | 5.9 |
//! | `cycle` | the same for any amplitude, by marching through slides and rests | from 5.6 |
//! | `inertia` | what the inertia of the centre adds to 5.9 | first order in `m omega_e^2 / k_n` |
//! | `mean_torques` | torques at the corners and their mean | 5.15 to 5.21 |
//! | `relaxed` | limits and corners with the overlap of soft contacts | from 4.1, 4.23, 4.24 |
//!
//! Not here: how the centre of the disk and the tangential springs ring after a stop. That vanishes as the torque becomes slow.

mod balance;
mod closed_form;
mod cycle;
mod inertia;
mod limits;
mod mean_torques;
mod regime;
mod region;
mod relaxed;
mod setting;
mod slide;

pub use balance::{Acceleration, Tangential, normal_forces};
pub use closed_form::{closed_form, closed_form_range};
pub use cycle::{Cycle, cycle};
pub use inertia::closed_form_with_inertia;
pub use limits::{Limits, critical_tilt, detachment_friction, detachment_tilt, limits};
pub use mean_torques::{MeanTorques, mean_torques};
pub use regime::{Regime, regime};
pub use region::{Corner, Point, amonton_margins, point};
pub use relaxed::{Relaxed, relaxed};
pub use setting::Setting;
pub use slide::{HarmonicTorque, Slide, slide};

#[cfg(test)]
mod tests;
