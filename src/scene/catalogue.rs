//! All scenes by name, for programs that choose one at run time: the command line, the C library.
//!
//! Code that names a scene's type does not need this module.

pub use super::MODELS;
use super::{Error, ModelInfo, ModelType, Result};

/// Names of a scene, its engine and its drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Names {
    /// Scene, such as `packing`.
    pub scene: &'static str,
    /// Engine, such as `molecular-dynamics`.
    pub engine: &'static str,
    /// Drive, such as `input` or `sine`.
    pub drive: &'static str,
}

impl From<&ModelInfo> for Names {
    fn from(info: &ModelInfo) -> Self {
        Self {
            scene: info.name,
            engine: info.variant_of("engine").unwrap_or_default(),
            drive: info.variant_of("drive").unwrap_or_default(),
        }
    }
}

/// Names of all scenes, in the order of [`MODELS`].
pub fn names() -> Vec<Names> {
    MODELS.iter().map(|model| Names::from(&(model.info)())).collect()
}

/// The scene of this name, engine and drive: the default ones if none are named.
///
/// # Errors
/// No such scene, engine or drive; says which there are.
pub fn find(scene: &str, engine: Option<&str>, drive: Option<&str>) -> Result<&'static ModelType> {
    let names = names();
    let of_scene: Vec<&Names> = names.iter().filter(|names| names.scene == scene).collect();
    let Some(first) = of_scene.first() else {
        return Err(unknown("scene", scene, names.iter().map(|names| names.scene)));
    };
    let engine = engine.unwrap_or(first.engine);
    let of_engine: Vec<&&Names> = of_scene.iter().filter(|names| names.engine == engine).collect();
    let Some(first) = of_engine.first() else {
        return Err(unknown("engine", engine, of_scene.iter().map(|names| names.engine)));
    };
    let drive = drive.unwrap_or(first.drive);
    let wanted = |names: &Names| (names.scene, names.engine, names.drive) == (scene, engine, drive);
    match names.iter().position(wanted) {
        Some(index) => Ok(MODELS[index]),
        None => Err(unknown("drive", drive, of_engine.iter().map(|names| names.drive))),
    }
}

/// `sine` if this scene and engine know it: what a run without an importer needs.
pub fn sine_if_known(scene: &str, engine: Option<&str>) -> Option<&'static str> {
    find(scene, engine, Some("sine")).ok().map(|_| "sine")
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

    fn found(scene: &str, engine: Option<&str>, drive: Option<&str>) -> Result<Names> {
        find(scene, engine, drive).map(|model| Names::from(&(model.info)()))
    }

    #[test]
    fn every_scene_is_found_by_its_own_names() {
        for names in names() {
            assert_eq!(found(names.scene, Some(names.engine), Some(names.drive)), Ok(names));
        }
    }

    #[test]
    fn what_is_unknown_is_named_with_what_is_known() {
        let message = |scene, engine, drive| found(scene, engine, Some(drive)).unwrap_err().to_string();
        assert!(message("sandpile", None, "sine").starts_with("scene = sandpile is not allowed: one of: packing"));
        assert!(message("packing", Some("magic"), "sine").contains("one of: molecular-dynamics"));
        assert!(message("packing", None, "wind").contains("one of: input, sine"));
        assert!(message("wedge", None, "input").contains("one of: sine"));
    }

    #[test]
    fn what_is_not_named_is_the_first() {
        let found = |scene, engine| found(scene, engine, None).map(|names| (names.scene, names.drive));
        assert_eq!(found("packing", None), Ok(("packing", "input")));
        assert_eq!(found("wedge", None), Ok(("wedge", "sine")));
        assert_eq!(found("wedge", Some("event-driven")), Ok(("wedge", "input")));
        assert_eq!(sine_if_known("wedge", Some("event-driven")), Some("sine"));
        assert_eq!(sine_if_known("wedge", Some("magic")), None);
    }
}
