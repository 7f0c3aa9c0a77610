//! A simulation as a TOML text: which scene, and what it is given.
//!
//! ```toml
//! scene = "packing"
//! engine = "event-driven"     # these three may be left out
//! drive = "sine"
//! disks = 20
//!
//! [parameters]                # and the inputs at the start
//! drive.amplitude = 1e-3
//! base.model = "random_phase" # options go by name
//! seed = 7
//! ```

use toml::{Table, Value};

use super::{AnySimulation, Error, Result, Selection};

/// What a TOML text says, not yet held against the scene.
///
/// ```
/// use jostle::scene::Recipe;
///
/// let recipe: Recipe = "scene = 'wedge'\nparameters.seed = 7".parse()?;
/// let mut wedge = recipe.simulation()?;
/// wedge.advance_to(1.0)?;
/// assert_eq!(wedge.integer("seed")?, 7);
/// # jostle::Result::Ok(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recipe {
    scene: String,
    engine: Option<String>,
    drive: Option<String>,
    disks: Option<u32>,
    given: Vec<(String, String)>,
}

impl std::str::FromStr for Recipe {
    type Err = Error;

    /// # Errors
    /// Text that is no TOML (with the place), a key that is none of the five, a value of another kind.
    fn from_str(text: &str) -> Result<Self> {
        let mut table: Table = text.parse().map_err(|error: toml::de::Error| {
            Error::call(
                format!("the TOML text cannot be read: {}", error.to_string().trim_end()),
                "Mend it at this place.",
            )
        })?;
        let scene = take_text(&mut table, "scene")?
            .ok_or_else(|| Error::parameter("scene", "nothing", "the name of a scene", "Add scene = \"packing\"."))?;
        let (engine, drive) = (take_text(&mut table, "engine")?, take_text(&mut table, "drive")?);
        let disks = match table.remove("disks") {
            None => None,
            Some(value) => Some(
                value
                    .as_integer()
                    .and_then(|disks| u32::try_from(disks).ok())
                    .ok_or_else(|| Error::parameter("disks", value, "a count of disks", "Write it as disks = 60."))?,
            ),
        };
        let mut given = Vec::new();
        match table.remove("parameters") {
            None => {}
            Some(Value::Table(parameters)) => flatten("", &parameters, &mut given)?,
            Some(other) => {
                let remedy = "Write [parameters] and below it name = value.";
                return Err(Error::parameter("parameters", other, "a table", remedy));
            }
        }
        match table.keys().next() {
            None => Ok(Self {
                scene,
                engine,
                drive,
                disks,
                given,
            }),
            Some(key) => Err(Error::parameter(
                "key",
                key,
                "scene, engine, drive, disks or parameters",
                "Put parameters and inputs under [parameters].",
            )),
        }
    }
}

impl Recipe {
    /// Makes the simulation, at time 0.
    ///
    /// # Errors
    /// As [`AnySimulation::new`].
    pub fn simulation(&self) -> Result<AnySimulation> {
        let selection = Selection {
            scene: &self.scene,
            engine: self.engine.as_deref(),
            drive: self.drive.as_deref(),
            disks: self.disks,
        };
        let given = self.given.iter().map(|(name, text)| (name.as_str(), text.as_str()));
        AnySimulation::new(selection, &given.collect::<Vec<_>>())
    }
}

fn take_text(table: &mut Table, key: &str) -> Result<Option<String>> {
    match table.remove(key) {
        None => Ok(None),
        Some(Value::String(text)) => Ok(Some(text)),
        Some(other) => Err(Error::parameter(key, other, "a text", "Put it in quotes.")),
    }
}

/// `drive.amplitude = 1` is a table in a table in TOML, `"drive.amplitude" = 1` is not; both mean the same here.
fn flatten(prefix: &str, table: &Table, given: &mut Vec<(String, String)>) -> Result<()> {
    for (key, value) in table {
        let name = format!("{prefix}{key}");
        match value {
            Value::Table(inner) => flatten(&format!("{name}."), inner, given)?,
            Value::String(text) => given.push((name, text.clone())),
            Value::Integer(integer) => given.push((name, integer.to_string())),
            // All digits: reads back as the same bits.
            Value::Float(real) => given.push((name, real.to_string())),
            other => {
                let allowed = "a number or the name of an option in quotes";
                return Err(Error::parameter(name, other, allowed, "Give one."));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"
        scene = "packing"
        engine = "event-driven"
        drive = "sine"
        disks = 12
        [parameters]
        drive.amplitude = 1.1e-3
        "drive.frequency" = 20
        base.model = "random_phase"
        seed = 9007199254740993
    "#;

    #[test]
    fn a_text_is_its_simulation() {
        let simulation = TEXT.parse::<Recipe>().unwrap().simulation().unwrap();
        assert_eq!(simulation.real("drive.amplitude").unwrap(), 1.1e-3);
        assert_eq!(simulation.real("drive.frequency").unwrap(), 20.0);
        assert_eq!(simulation.integer("seed").unwrap(), 9_007_199_254_740_993);
        assert!(simulation.position("disk.angle[12]").is_ok() && simulation.position("disk.angle[13]").is_err());
    }

    #[test]
    fn what_is_wrong_is_named() {
        let message = |text: &str| text.parse::<Recipe>().unwrap_err().to_string();
        assert!(message("scene = ").contains("line 1"));
        assert!(message("disks = 3").starts_with("scene = nothing"));
        assert!(message("scene = 3").starts_with("scene = 3 is not allowed: a text"));
        assert!(message("scene = 'packing'\ndisks = -3").starts_with("disks = -3"));
        assert!(message("scene = 'packing'\nseed = 3").contains("[parameters]"));
        assert!(message("scene = 'packing'\nparameters = 3").contains("a table"));
        assert!(message("scene = 'packing'\nparameters.seed = [3]").starts_with("seed = [3]"));
        let recipe: Recipe = "scene = 'packing'\nparameters.gravity = nan".parse().unwrap();
        assert!(
            recipe
                .simulation()
                .unwrap_err()
                .to_string()
                .starts_with("gravity = NaN")
        );
    }
}
