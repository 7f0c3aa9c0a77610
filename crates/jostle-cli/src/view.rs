//! `jostle view`: the page on which scenes move, as one HTML file that needs neither a server nor a network.

mod page;

use std::path::{Path, PathBuf};

use clap::Args;
use jostle::Error;
use jostle::scene::Value;

use crate::failure::Failure;
use crate::nearest::did_you_mean;
use crate::selection::Selection;
use crate::{assignments, output_file, standard_output};

use page::Run;

/// Scenes of the page with their engines. Their drive is the sine.
pub const SHOWN: [(&str, &str); 3] = [
    ("packing", "molecular-dynamics"),
    ("ratchet", "event-driven"),
    ("wedge", "event-driven"),
];

/// Writes a page on which the scene moves: open it in any browser.
///
/// The page computes the scene itself, with the bits of this program, and works offline. It has sliders, plots and files of
/// the run. With --replay it plays a run that was recorded.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  jostle view packing --set drive.amplitude=1e-4\n  jostle view --replay run.csv --output run.html\n\n\
    Exit code: 0 done, 2 wrong argument or parameter, 1 a file could not be read or written."
)]
pub struct View {
    /// Scene that the page shows first: packing, ratchet or wedge. Without it the page's own choice.
    scene: Option<String>,
    /// Number of disks. Without it the scene's usual number.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    disks: Option<i64>,
    /// Parameter, such as contact.friction=0.2; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    assignments: Vec<String>,
    /// Run to play: a CSV file of jostle run, with its .parameters.csv beside it.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scene", "disks", "assignments"])]
    replay: Option<PathBuf>,
    /// The page.
    #[arg(long, value_name = "FILE", default_value = "jostle.html")]
    output: PathBuf,
}

impl View {
    pub fn execute(self) -> Result<(), Failure> {
        output_file::check_html("--output", &self.output)?;
        let start = self.start()?;
        let run = self.replay.as_deref().map(Run::read).transpose()?;
        let html = page::html(&start, run.as_ref());
        std::fs::write(&self.output, html).map_err(|error| Failure::file(&self.output, &error))?;
        let shown = std::path::absolute(&self.output).unwrap_or(self.output);
        standard_output::write(&format!("{}\nOpen it in a browser.\n", shown.display()))
    }

    /// What follows # in a link to the page: the scene and what is set of it.
    fn start(&self) -> Result<String, Error> {
        let Some(scene) = &self.scene else {
            return match (self.disks, self.assignments.first()) {
                (None, None) => Ok(String::new()),
                _ => Err(Error::call(
                    "--disks and --set need a scene",
                    "Write, say: jostle view packing --disks 30",
                )),
            };
        };
        let engine = SHOWN.iter().find(|(shown, _)| shown == scene);
        let (_, engine) = engine.ok_or_else(|| {
            let known = SHOWN.map(|(scene, _)| scene);
            let error = Error::parameter(
                "scene",
                scene,
                format!("one of: {}", known.join(", ")),
                "Of other scenes and engines make a film.",
            );
            did_you_mean(error, known)
        })?;
        let selection = Selection {
            scene: scene.clone(),
            engine: Some((*engine).into()),
            disks: self.disks,
        };
        let selected = selection.find(Some("sine"))?;
        let mut simulation = (selected.model.prepare)(selected.structure.clone());
        assignments::assign(&mut *simulation, &self.assignments)?;
        simulation.start(0.0)?;
        let mut start = format!("scene={scene}&disks={}", selected.structure.get("disks"));
        let values = simulation.values();
        for (name, _) in assignments::split(&self.assignments, "NAME=VALUE", "contact.friction=0.2")? {
            if let Some(value) = values.table().position(name).and_then(|position| values.get(position)) {
                let text = match value {
                    Value::Real(real) => Value::Real(real).to_string(),
                    Value::Integer(integer) => integer.to_string(),
                };
                start += &format!("&{name}={text}");
            }
        }
        Ok(start)
    }
}

impl Run {
    /// The samples, and the parameters beside them.
    fn read(path: &Path) -> Result<Self, Failure> {
        output_file::check_csv("--replay", path)?;
        let parameters = output_file::beside(path, "parameters.csv");
        let text = |path: &Path| std::fs::read_to_string(path).map_err(|error| cannot_read(path, &error));
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self {
            samples: text(path)?,
            parameters: text(&parameters)?,
            name,
        })
    }
}

fn cannot_read(path: &Path, error: &std::io::Error) -> Failure {
    Failure::File(Error::call(
        format!("{} cannot be read: {error}", path.display()),
        "Give a CSV file that jostle run wrote, with its .parameters.csv beside it.",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(scene: Option<&str>, assignments: &[&str]) -> View {
        View {
            scene: scene.map(String::from),
            disks: None,
            assignments: assignments.iter().map(|text| text.to_string()).collect(),
            replay: None,
            output: "x.html".into(),
        }
    }

    #[test]
    fn the_page_starts_with_what_was_asked_for() {
        assert_eq!(view(None, &[]).start(), Ok(String::new()));
        let start = view(
            Some("ratchet"),
            &["drive.frequency = 25", "disk.mass_rule=equal_density"],
        )
        .start();
        assert_eq!(
            start.unwrap(),
            "scene=ratchet&disks=20&drive.frequency=25&disk.mass_rule=2"
        );
    }

    #[test]
    fn what_the_page_cannot_show_is_refused() {
        let message = |scene, set: &[&str]| view(scene, set).start().unwrap_err().to_string();
        assert!(message(Some("three_disk"), &[]).contains("one of: packing, ratchet, wedge"));
        assert!(message(Some("rachet"), &[]).contains("Did you mean ratchet?"));
        assert!(message(Some("packing"), &["gravity=-1"]).contains("gravity = -1"));
        assert!(message(None, &["gravity=1"]).contains("need a scene"));
    }

    #[test]
    fn the_module_has_the_scenes_that_are_offered() {
        let mut module = jostle_web::Module::default();
        module.scenes();
        let text = String::from_utf8(module.text).unwrap();
        for (line, (scene, engine)) in text.lines().zip(SHOWN) {
            assert!(line.starts_with(&format!("{scene}\t{engine}\tsine\t")), "{line}");
        }
        assert_eq!(text.lines().count(), SHOWN.len());
    }
}
