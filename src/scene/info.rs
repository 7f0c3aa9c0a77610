//! What a scene says of itself.

use std::ops::RangeInclusive;

use fmi_component::{DataSheet, ModelInfo, StructuralParameter, StructuralParameters};

/// Name of the structural parameter of every scene.
const DISKS: &str = "disks";

/// Description of the parameter `gravity` of every scene: the papers take different values.
pub const GRAVITY: &str =
    "Gravity, downwards; at the start 9.8 m/s2 in packing, 9.81 in wedge and ratchet, 10 in three_disk";

/// Static facts of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneInfo {
    /// Scene, such as `packing`.
    pub scene: &'static str,
    /// Engine, such as `molecular-dynamics`.
    pub engine: &'static str,
    /// Drive, such as `input` or `sine`.
    pub drive: &'static str,
    /// Model identifier with the drive `unnamed_drive`, such as `jostle_packing`; with any other its name is appended.
    pub identifier: &'static str,
    /// The drive that the model identifier does not name.
    pub unnamed_drive: &'static str,
    /// One sentence.
    pub description: &'static str,
    /// HTML fragment with the equations and their sources, for the documentation page.
    pub equations: &'static str,
    /// Allowed numbers of disks.
    pub disks: RangeInclusive<u32>,
    /// Number of disks where none is chosen.
    pub default_disks: u32,
    /// Default experiment: stop time \[s\].
    pub stop_time: f64,
    /// Default experiment: communication step \[s\].
    pub step_size: f64,
    /// What the documentation page says besides.
    pub sheet: DataSheet,
}

impl From<SceneInfo> for ModelInfo {
    fn from(info: SceneInfo) -> Self {
        Self {
            package: env!("CARGO_PKG_NAME"),
            version: env!("CARGO_PKG_VERSION"),
            name: info.scene,
            variant: vec![("engine", info.engine), ("drive", info.drive)],
            identifier: if info.drive == info.unnamed_drive {
                info.identifier.into()
            } else {
                format!("{}_{}", info.identifier, info.drive.replace('-', "_")).into()
            },
            description: info.description,
            equations: info.equations,
            structure: vec![StructuralParameter {
                name: DISKS,
                description: "Number of disks",
                range: info.disks,
                default: info.default_disks,
            }],
            stop_time: info.stop_time,
            step_size: info.step_size,
            sheet: info.sheet,
        }
    }
}

/// Number of disks that was chosen.
pub(super) fn disks(structure: &StructuralParameters) -> u32 {
    structure.get(DISKS)
}
