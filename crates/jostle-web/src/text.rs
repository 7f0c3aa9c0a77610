//! What the page is told, as lines of fields with tabs between them.

use jostle::scene::Value;
use jostle::scene::catalogue::Names;
use jostle::{Error, Result};

use crate::shown::{SCENES, Shown};

/// Scene, engine, drive, fewest, most and usual number of disks, description.
pub fn scenes() -> String {
    let mut text = String::new();
    for scene in SCENES {
        let info = (scene.info)();
        let (names, disks) = (Names::from(&info), &info.structure[0]);
        let numbers = [*disks.range.start(), *disks.range.end(), disks.default];
        let [fewest, most, usual] = numbers.map(|number| number.to_string());
        line(
            &mut text,
            &[
                names.scene,
                names.engine,
                names.drive,
                &fewest,
                &most,
                &usual,
                info.description,
            ],
        );
    }
    text
}

/// Name, causality, kind, unit, smallest, largest and start value, value, options (with commas between), description. Numbers
/// read back to the same bits.
///
/// # Errors
/// None once it has started.
pub fn variables(simulation: &dyn Shown) -> Result<String> {
    let mut text = String::new();
    for (position, variable) in simulation.table().variables().iter().enumerate() {
        let kind = &variable.kind;
        let options = kind.options().collect::<Vec<_>>().join(",");
        let value = simulation.value(position)?.to_string();
        let [min, max] = kind.bounds().map(|number| Value::Real(number).to_string());
        line(
            &mut text,
            &[
                &variable.name,
                variable.causality.word(),
                kind.word(),
                kind.unit().name,
                &min,
                &max,
                &variable.start().to_string(),
                &value,
                &options,
                &variable.description,
            ],
        );
    }
    Ok(text)
}

/// A number of disks.
///
/// # Errors
/// No whole number.
pub fn disks(text: &str) -> Result<u32> {
    text.parse()
        .map_err(|_| Error::parameter("disks", text, "a whole number", "Write, say, 60."))
}

fn line(text: &mut String, fields: &[&str]) {
    text.push_str(&fields.join("\t"));
    text.push('\n');
}
