//! Sums over the contacts of one evaluation, in an order that depends neither on lanes nor on threads.
//!
//! Contacts go to groups of [`GROUP`](super::eights::GROUP) eights in the order of the list. Each group has sums of its own,
//! in eight parts ([`EightSums`]), and groups are added up in their order.

use fearless_simd::Simd;

use crate::engine::dem::lanes::{EightSums, Lanes, largest};

/// Sums over the contacts of one evaluation.
#[derive(Debug, Clone, Copy, Default)]
pub struct ForceSums {
    /// Power lost in the dashpots \[W\].
    pub dissipated_power: f64,
    /// Energy lost by slip since the last evaluation \[J\].
    pub slip_heat: f64,
    /// Deepest overlap \[m\].
    pub deepest: f64,
    /// Closed contacts.
    pub contacts: u32,
}

/// The same sums, in parts, over some of the contacts.
#[derive(Debug, Clone, Copy, Default)]
pub struct PartialSums {
    /// Power lost in the dashpots \[W\].
    pub dissipated_power: EightSums,
    /// Energy lost by slip of springs since the last evaluation \[J\].
    pub slip_heat: EightSums,
    /// Closed contacts without springs, which do not remember that they are closed.
    pub touching: EightSums,
    /// Contacts with springs that closed less those that opened since the last evaluation.
    pub closed: i64,
    /// Energy that was left in the springs of those that opened \[J\].
    pub lost_spring_energy: f64,
    deepest: f64,
}

impl PartialSums {
    /// Adds those of the next contacts.
    pub fn add(&mut self, next: &Self) {
        self.dissipated_power.add_all(&next.dissipated_power);
        self.slip_heat.add_all(&next.slip_heat);
        self.touching.add_all(&next.touching);
        self.closed += next.closed;
        self.lost_spring_energy += next.lost_spring_energy;
        self.deepest = self.deepest.max(next.deepest);
    }

    /// All parts together; with springs, `closed` contacts were closed before.
    pub fn total<const SPRING: bool>(&self, closed: u32) -> ForceSums {
        ForceSums {
            dissipated_power: self.dissipated_power.total(),
            slip_heat: self.slip_heat.total() + self.lost_spring_energy,
            deepest: self.deepest,
            contacts: if SPRING {
                (i64::from(closed) + self.closed) as u32
            } else {
                self.touching.total() as u32
            },
        }
    }
}

/// The same while registers are added to them.
#[derive(Debug, Clone, Copy)]
pub struct LaneSums<V> {
    /// All but the deepest overlap.
    pub parts: PartialSums,
    /// Of what each lane has seen: no order changes a maximum.
    pub deepest: V,
}

impl<V> LaneSums<V> {
    /// To be added to what there is.
    #[inline(always)]
    pub fn after<S: Simd>(simd: S, parts: PartialSums) -> Self
    where
        V: Lanes<S>,
    {
        Self {
            parts,
            deepest: V::splat(simd, parts.deepest),
        }
    }

    /// Nothing yet.
    #[inline(always)]
    pub fn new<S: Simd>(simd: S) -> Self
    where
        V: Lanes<S>,
    {
        Self::after(simd, PartialSums::default())
    }

    /// What there is now.
    #[inline(always)]
    pub fn partial<S: Simd>(&self) -> PartialSums
    where
        V: Lanes<S>,
    {
        PartialSums {
            deepest: largest(self.deepest),
            ..self.parts
        }
    }
}
