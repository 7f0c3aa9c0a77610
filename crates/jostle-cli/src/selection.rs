//! Which scene, engine, drive and number of disks: the arguments that commands share.

use clap::Args;
use jostle::Error;
use jostle::scene::catalogue::{self, Names};
use jostle::scene::{ModelInfo, ModelType, StructuralParameters};

/// Which scene, as what component: shared by all commands.
#[derive(Args, Debug, Clone)]
pub struct Selection {
    /// Scene, such as packing.
    pub scene: String,
    /// Engine, such as molecular-dynamics. Without it the scene's first.
    #[arg(long)]
    pub engine: Option<String>,
    /// Number of disks. Without it the scene's usual number.
    #[arg(long, value_name = "N")]
    pub disks: Option<u32>,
}

/// A scene that was found, with what the commands say of it.
pub struct Selected {
    /// The scene.
    pub model: ModelType,
    /// Its static facts.
    pub info: ModelInfo,
    /// Its names.
    pub names: Names,
    /// Its number of disks.
    pub structure: StructuralParameters,
}

impl Selection {
    /// The scene of these names; the engine's first drive if none is named.
    ///
    /// # Errors
    /// No such scene, engine or drive, or a number of disks that the scene does not take.
    pub fn find(&self, drive: Option<&str>) -> Result<Selected, Error> {
        self.of(*catalogue::find(&self.scene, self.engine.as_deref(), drive)?)
    }

    /// A scene with the number of disks.
    ///
    /// # Errors
    /// A number of disks that the scene does not take.
    pub fn of(&self, model: ModelType) -> Result<Selected, Error> {
        let info = (model.info)();
        let disks = self.disks.map(|disks| ("disks", disks));
        let structure = StructuralParameters::choose(&info, disks.as_slice()).map_err(|_| {
            let range = &info.structure[0].range;
            let allowed = format!("from {} to {} for the scene {}", range.start(), range.end(), info.name);
            Error::parameter(
                "--disks",
                self.disks.unwrap_or_default(),
                allowed,
                "Give a number in this range.",
            )
        })?;
        Ok(Selected {
            model,
            names: Names::from(&info),
            info,
            structure,
        })
    }
}
