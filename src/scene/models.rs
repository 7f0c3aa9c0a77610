//! All scenes as values, each under the name of the library that exports it: `jostle_wedge_map` exports [`WEDGE_MAP`].
//!
//! These are statics, and libraries export references to them: a constant, or a type, would compile a scene once more in each crate
//! that names it.

use super::{ModelType, disk_on_two_supports, packing, ratchet, wedge};

macro_rules! models {
    ($($name:ident: $model:ty;)*) => {
        $(
            #[doc = concat!("The model [`", stringify!($model), "`].")]
            pub static $name: ModelType = ModelType::of::<$model>();
        )*
        /// All scenes. The first engine of a scene is its default, and the first drive of an engine.
        pub static MODELS: &[&ModelType] = &[$(&$name),*];
    };
}

models! {
    PACKING: packing::PackingOnInput;
    PACKING_SINE: packing::PackingOnSine;
    PACKING_SINE_FIXED_BOTTOM: packing::PackingOnFixedBottom;
    PACKING_RANDOM_BOTTOM: packing::PackingOnRandomBottom;
    PACKING_LOCATED: packing::LocatedPackingOnInput;
    PACKING_LOCATED_SINE: packing::LocatedPackingOnSine;
    PACKING_EVENT_DRIVEN: packing::event_driven::HardPackingOnInput;
    PACKING_EVENT_DRIVEN_SINE: packing::event_driven::HardPackingOnSine;
    WEDGE_MAP: wedge::WedgeMap;
    WEDGE_EVENT_DRIVEN_INPUT: wedge::WedgeEventDrivenOnInput;
    WEDGE_EVENT_DRIVEN: wedge::WedgeEventDrivenOnSine;
    WEDGE_MOLECULAR_DYNAMICS_INPUT: wedge::WedgeMolecularDynamicsOnInput;
    WEDGE_MOLECULAR_DYNAMICS: wedge::WedgeMolecularDynamicsOnSine;
    RATCHET: ratchet::RatchetOnInput;
    RATCHET_SINE: ratchet::RatchetOnSine;
    THREE_DISK: disk_on_two_supports::DiskOnTwoSupportsOnInput;
    THREE_DISK_HARMONIC_TORQUE: disk_on_two_supports::DiskOnTwoSupportsOnHarmonicTorque;
    THREE_DISK_RANDOM_SUPPORTS: disk_on_two_supports::DiskOnTwoSupportsOnRandomSupports;
    THREE_DISK_SINE: disk_on_two_supports::DiskOnTwoSupportsOnSine;
}
