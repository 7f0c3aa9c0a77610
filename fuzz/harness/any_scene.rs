//! Every scene of the catalogue as one scene, chosen by the token: a program holds the exported functions only once. All
//! do little work in a call, so that the boundary is tried and not the patience.

use jostle::error::{Error, Result};
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::packing::{LocatedPackingOnInput, LocatedPackingOnSine, PackingOnInput, PackingOnSine};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine};
use jostle::scene::three_disk::{
    ThreeDiskOnHarmonicTorque, ThreeDiskOnInput, ThreeDiskOnRandomSupports, ThreeDiskOnSine,
};
use jostle::scene::wedge::{
    WedgeEventDrivenOnInput, WedgeEventDrivenOnSine, WedgeMap, WedgeMolecularDynamicsOnInput,
    WedgeMolecularDynamicsOnSine,
};
use jostle::scene::{Card, Choice, OutputWriter, Reached, Scene, Values, Variable};
use serde::{Deserialize, Serialize};

jostle::export_fmu!(super::AnyScene);

/// Work of one call.
const MOST_WORK: u64 = 2000;
/// The choice is this times the number of the scene, and the number of disks.
const SCENE: u32 = 10;

macro_rules! scenes {
    ($($name:ident = $number:literal,)*) => {
        /// One of them.
        #[allow(clippy::large_enum_variant)] // three of them live at a time
        pub enum AnyScene {$(
            $name($name),
        )*}

        /// The state of one of them.
        #[derive(Clone, PartialEq, Serialize, Deserialize)]
        pub enum AnyState {$(
            $name(Box<<$name as Scene>::State>),
        )*}

        /// Each scene with one disk, and with three if it may have so many.
        pub fn choices() -> Vec<u32> {
            let mut choices = Vec::new();
            $(
                choices.push(SCENE * $number + 1);
                if $name::card().disks.contains(&3) {
                    choices.push(SCENE * $number + 3);
                }
            )*
            choices
        }

        impl Scene for AnyScene {
            type State = AnyState;
            const EVENTS: bool = true;

            fn card() -> Card {
                Card {
                    scene: "any",
                    engine: "any",
                    drive: "any",
                    disks: 1..=u32::MAX,
                    ..PackingOnInput::card()
                }
            }

            fn variables(choice: Choice) -> Vec<Variable> {
                let disks = Choice { disks: choice.disks % SCENE };
                match choice.disks / SCENE {
                    $($number => $name::variables(disks),)*
                    _ => Vec::new(),
                }
            }

            fn new(choice: Choice, start_time: f64, values: &Values) -> Result<Self> {
                let disks = Choice { disks: choice.disks % SCENE };
                match choice.disks / SCENE {
                    $($number => {
                        let mut scene = $name::new(disks, start_time, values)?;
                        scene.limit_work(MOST_WORK);
                        Ok(Self::$name(scene))
                    })*
                    _ => Err(Error::call("no such scene", "Choose another.")),
                }
            }

            fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
                match self {
                    $(Self::$name(scene) => scene.advance_to(end_time, values),)*
                }
            }

            fn advance_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
                match self {
                    $(Self::$name(scene) => scene.advance_to_event(end_time, values),)*
                }
            }

            fn go_on_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
                match self {
                    $(Self::$name(scene) => scene.go_on_to_event(end_time, values),)*
                }
            }

            fn write_outputs(&self, outputs: OutputWriter<'_>) {
                match self {
                    $(Self::$name(scene) => scene.write_outputs(outputs),)*
                }
            }

            fn state(&self) -> AnyState {
                match self {
                    $(Self::$name(scene) => AnyState::$name(Box::new(scene.state())),)*
                }
            }

            fn time_of(state: &AnyState) -> f64 {
                match state {
                    $(AnyState::$name(state) => $name::time_of(state),)*
                }
            }

            fn restore(&mut self, state: &AnyState) -> Result<()> {
                match (self, state) {
                    $((Self::$name(scene), AnyState::$name(state)) => scene.restore(state),)*
                    _ => Err(Error::state("it is of another scene", "Restore it where it was saved.")),
                }
            }
        }
    };
}

scenes! {
    PackingOnInput = 0,
    PackingOnSine = 1,
    LocatedPackingOnInput = 2,
    LocatedPackingOnSine = 3,
    HardPackingOnInput = 4,
    HardPackingOnSine = 5,
    WedgeMap = 6,
    WedgeEventDrivenOnInput = 7,
    WedgeEventDrivenOnSine = 8,
    WedgeMolecularDynamicsOnInput = 9,
    WedgeMolecularDynamicsOnSine = 10,
    RatchetOnInput = 11,
    RatchetOnSine = 12,
    ThreeDiskOnInput = 13,
    ThreeDiskOnHarmonicTorque = 14,
    ThreeDiskOnRandomSupports = 15,
    ThreeDiskOnSine = 16,
}
