//! Contact-time (TC) model against inelastic collapse: impacts that follow too soon lose nothing along the normal.

use serde::{Deserialize, Serialize};

use super::{CollisionLaw, Impact, checked};
use crate::error::Result;

/// The law inside, with normal restitution 1 where either body had its last impact within the contact time t_c.
///
/// A real contact lasts about t_c; bodies that meet again within it are in touch, and what is in touch stops losing
/// energy with each of the many impacts that stand for the touch. Friction stays the law's own: a lasting contact may
/// still slide. The engine keeps the time of the last impact of each body and gives the shorter one.
/// Source: S. Luding and S. McNamara, Granular Matter 1, 113 (1998), doi 10.1007/s100350050017.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactTime<L> {
    law: L,
    contact_time: f64,
}

impl<L> ContactTime<L> {
    /// Law with a contact time t_c >= 0 \[s\].
    ///
    /// # Errors
    /// A time out of range, by the name `collision.contact_time`.
    pub fn new(law: L, contact_time: f64) -> Result<Self> {
        let remedy = "Give about the duration of a contact; 0 has no effect.";
        let contact_time = checked("collision.contact_time", contact_time, f64::INFINITY, remedy)?;
        Ok(Self { law, contact_time })
    }
}

impl<L: CollisionLaw> CollisionLaw for ContactTime<L> {
    const ROTATES: bool = L::ROTATES;
    const REMEMBERS: bool = true;

    #[inline]
    fn separation_velocity(&self, impact: &Impact) -> f64 {
        if impact.time_since_last < self.contact_time {
            impact.normal_velocity.abs()
        } else {
            self.law.separation_velocity(impact)
        }
    }

    #[inline]
    fn tangential_impulse(&self, impact: &Impact, normal_impulse: f64) -> f64 {
        self.law.tangential_impulse(impact, normal_impulse)
    }

    fn most_work(&self) -> u64 {
        self.law.most_work()
    }
}
