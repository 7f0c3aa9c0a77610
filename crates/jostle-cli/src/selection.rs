//! Which scene, engine, drive and number of disks: the arguments that commands share.

use clap::Args;
use jostle::Error;
use jostle::scene::catalogue::{self, Names};
use jostle::scene::{ModelInfo, ModelType, StructuralParameters};

use crate::nearest::did_you_mean;
use crate::text;

/// Which scene, as what component: shared by all commands.
#[derive(Args, Debug, Clone)]
pub struct Selection {
    /// Scene, such as packing.
    pub scene: String,
    /// Engine, such as molecular-dynamics. Without it the scene's first.
    #[arg(long)]
    pub engine: Option<String>,
    /// Number of disks. Without it the scene's usual number.
    #[arg(long, value_name = "N", value_parser = whole, allow_negative_numbers = true)]
    pub disks: Option<i64>,
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

fn whole(text: &str) -> Result<i64, String> {
    text.parse()
        .map_err(|_| "give a whole number, such as 60; jostle describe SCENE says which".into())
}

/// Every scene with its engines and their drives, as a text for the help.
pub fn list() -> String {
    let mut rows = vec![["  SCENE", "--engine", "--drive"].map(String::from).to_vec()];
    let names = catalogue::names();
    for (index, one) in names.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| names[before]);
        let same_scene = before.is_some_and(|before| before.scene == one.scene);
        if same_scene && before.is_some_and(|before| before.engine == one.engine) {
            if let Some(drives) = rows.last_mut().and_then(|row| row.last_mut()) {
                *drives += &format!(", {}", one.drive);
            }
            continue;
        }
        let scene = if same_scene { "" } else { one.scene };
        rows.push(vec![format!("  {scene}"), one.engine.into(), one.drive.into()]);
    }
    format!(
        "Scenes with their engines and drives; the first of each is the default (for run the drive sine):\n{}",
        text::table(&rows)
    )
}

impl Selection {
    /// The scene of these names; the engine's first drive if none is named.
    ///
    /// # Errors
    /// No such scene, engine or drive, or a number of disks that the scene does not take.
    pub fn find(&self, drive: Option<&str>) -> Result<Selected, Error> {
        let found = catalogue::find(&self.scene, self.engine.as_deref(), drive);
        self.of(*found.map_err(|error| self.propose(error))?)
    }

    /// The refusal of a scene, engine or drive with the name that may have been meant.
    fn propose(&self, error: Error) -> Error {
        let Error::Parameter { name, .. } = &error else {
            return error;
        };
        let of_scene = |names: &Names| names.scene == self.scene;
        let of_engine = |names: &Names| {
            let engine = self.engine.as_deref();
            of_scene(names) && engine.is_none_or(|engine| engine == names.engine)
        };
        let names = catalogue::names();
        let known: Vec<&str> = match name.as_str() {
            "scene" => names.iter().map(|names| names.scene).collect(),
            "engine" => names
                .iter()
                .filter(|names| of_scene(names))
                .map(|names| names.engine)
                .collect(),
            _ => names
                .iter()
                .filter(|names| of_engine(names))
                .map(|names| names.drive)
                .collect(),
        };
        did_you_mean(error, known)
    }

    /// A scene with the number of disks.
    ///
    /// # Errors
    /// A number of disks that the scene does not take.
    pub fn of(&self, model: ModelType) -> Result<Selected, Error> {
        let info = (model.info)();
        // What is no u32 is in no scene's range.
        let disks = self
            .disks
            .map(|disks| ("disks", u32::try_from(disks).unwrap_or_default()));
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
