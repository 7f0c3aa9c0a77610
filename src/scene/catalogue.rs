//! All scenes by name, for programs that choose one at run time: the command line and the C library.
//!
//! A new scene is one line in [`with_scene`]'s table. Whoever names a scene's type needs nothing of this.

use super::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use super::packing::{LocatedPackingOnInput, LocatedPackingOnSine, PackingOnInput, PackingOnSine};
use super::ratchet::{RatchetOnInput, RatchetOnSine};
use super::three_disk::{ThreeDiskOnHarmonicTorque, ThreeDiskOnInput, ThreeDiskOnRandomSupports, ThreeDiskOnSine};
use super::wedge::{
    WedgeEventDrivenOnInput, WedgeEventDrivenOnSine, WedgeMap, WedgeMolecularDynamicsOnInput,
    WedgeMolecularDynamicsOnSine,
};
use super::{Card, Scene};
use crate::error::{Error, Result};

/// Something to do with a scene whose type is found by name.
pub trait Visitor {
    /// What comes of it.
    type Output;

    /// Does it.
    fn visit<S: Scene>(self) -> Self::Output;
}

macro_rules! scenes {
    ($($scene:ty,)*) => {
        /// All cards. The first engine of a scene is its default, and the first drive of an engine.
        pub fn cards() -> Vec<Card> {
            vec![$(<$scene>::card()),*]
        }

        /// Calls `visitor` with the scene of this name, engine and drive (the default ones if none are named).
        ///
        /// # Errors
        /// No such scene, engine or drive; says which there are.
        pub fn with_scene<V: Visitor>(name: &str, engine: Option<&str>, drive: Option<&str>, visitor: V) -> Result<V::Output> {
            let wanted = find(&cards(), name, engine, drive)?;
            let mut index = 0;
            $(
                if index == wanted {
                    return Ok(visitor.visit::<$scene>());
                }
                index += 1;
            )*
            unreachable!("card {wanted} of {index}")
        }
    };
}

scenes![
    PackingOnInput,
    PackingOnSine,
    LocatedPackingOnInput,
    LocatedPackingOnSine,
    HardPackingOnInput,
    HardPackingOnSine,
    WedgeMap,
    WedgeEventDrivenOnInput,
    WedgeEventDrivenOnSine,
    WedgeMolecularDynamicsOnInput,
    WedgeMolecularDynamicsOnSine,
    RatchetOnInput,
    RatchetOnSine,
    ThreeDiskOnInput,
    ThreeDiskOnHarmonicTorque,
    ThreeDiskOnRandomSupports,
    ThreeDiskOnSine,
];

/// Position of the card with this scene, engine and drive.
fn find(cards: &[Card], name: &str, engine: Option<&str>, drive: Option<&str>) -> Result<usize> {
    let of_scene: Vec<&Card> = cards.iter().filter(|card| card.scene == name).collect();
    let Some(first) = of_scene.first() else {
        return Err(unknown("scene", name, cards.iter().map(|card| card.scene)));
    };
    let engine = engine.unwrap_or(first.engine);
    let of_engine: Vec<&&Card> = of_scene.iter().filter(|card| card.engine == engine).collect();
    let Some(first) = of_engine.first() else {
        return Err(unknown("engine", engine, of_scene.iter().map(|card| card.engine)));
    };
    let drive = drive.unwrap_or(first.drive);
    cards
        .iter()
        .position(|card| (card.scene, card.engine, card.drive) == (name, engine, drive))
        .ok_or_else(|| unknown("drive", drive, of_engine.iter().map(|card| card.drive)))
}

/// `sine` if this scene and engine know it: what a run without an importer needs.
pub fn sine_if_known(name: &str, engine: Option<&str>) -> Option<&'static str> {
    let cards = cards();
    let found = find(&cards, name, engine, Some("sine")).ok()?;
    Some(cards[found].drive)
}

fn unknown<'a>(what: &str, given: &str, known: impl Iterator<Item = &'a str>) -> Error {
    let mut known: Vec<&str> = known.collect();
    known.dedup();
    Error::parameter(
        what,
        given,
        format!("one of: {}", known.join(", ")),
        "Name one of these.",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Name;

    impl Visitor for Name {
        type Output = (&'static str, &'static str);

        fn visit<S: Scene>(self) -> Self::Output {
            (S::card().scene, S::card().drive)
        }
    }

    #[test]
    fn every_scene_is_found_by_its_own_card() {
        for card in cards() {
            let found = with_scene(card.scene, Some(card.engine), Some(card.drive), Name);
            assert_eq!(found, Ok((card.scene, card.drive)));
        }
    }

    #[test]
    fn what_is_unknown_is_named_with_what_is_known() {
        let told = |name, engine, drive| with_scene(name, engine, Some(drive), Name).unwrap_err().to_string();
        assert!(told("sandpile", None, "sine").starts_with("scene = sandpile is not allowed: one of: packing"));
        assert!(told("packing", Some("magic"), "sine").contains("one of: molecular-dynamics"));
        assert!(told("packing", None, "wind").contains("one of: input, sine"));
        assert!(told("wedge", None, "input").contains("one of: sine"));
    }

    #[test]
    fn what_is_not_named_is_the_first() {
        let found = |name, engine| with_scene(name, engine, None, Name).unwrap();
        assert_eq!(found("packing", None), ("packing", "input"));
        assert_eq!(found("wedge", None), ("wedge", "sine"));
        assert_eq!(found("wedge", Some("event-driven")), ("wedge", "input"));
        assert_eq!(sine_if_known("wedge", Some("event-driven")), Some("sine"));
        assert_eq!(sine_if_known("wedge", Some("magic")), None);
    }
}
