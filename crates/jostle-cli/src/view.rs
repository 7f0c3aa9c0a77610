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
        let run = Self {
            samples: text(path)?,
            parameters: text(&parameters)?,
            name,
        };
        match run.defect() {
            None => Ok(run),
            Some(defect) => Err(Error::parameter(
                "--replay",
                path.display(),
                format!("a run whose disks can be drawn, and {defect}"),
                "Record it again with jostle run.",
            )
            .into()),
        }
    }

    /// Why its disks cannot be drawn, if they cannot.
    fn defect(&self) -> Option<String> {
        let parameter = |name: &str| {
            let mut lines = self.parameters.lines().map(|line| line.split(','));
            lines.find_map(|mut fields| (fields.next() == Some(name)).then(|| fields.next().unwrap_or_default()))
        };
        let (Some(scene), Some(Ok(disks))) = (parameter("scene"), parameter("disks").map(str::parse::<u32>)) else {
            return Some("its parameters name no scene and number of disks".into());
        };
        if !SHOWN.iter().any(|(shown, _)| *shown == scene) {
            return Some(format!("the page does not know the scene {scene}"));
        }
        let mut lines = self.samples.lines();
        let columns: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let last = ["disk.x", "disk.y", "disk.angle"].map(|name| format!("{name}[{disks}]"));
        if let Some(missing) = last.iter().find(|name| !columns.contains(&name.as_str())) {
            return Some(format!(
                "it has no column {missing} for the {disks} disks of its parameters"
            ));
        }
        let cells = lines.next().map_or(0, |row| row.split(',').count());
        (cells != columns.len()).then(|| "it has no whole row".into())
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
    fn a_run_that_cannot_be_drawn_is_refused_with_the_reason() {
        let defect = |samples: &str, parameters: &str| {
            let run = Run {
                samples: samples.into(),
                parameters: parameters.into(),
                name: "run.csv".into(),
            };
            run.defect()
        };
        let (columns, made) = (
            "time,disk.x[1],disk.y[1],disk.angle[1]",
            "name,value,unit\nscene,wedge,\ndisks,1,\n",
        );
        assert_eq!(defect(&format!("{columns}\n0,1,2,3\n"), made), None);
        for (samples, parameters, reason) in [
            ("", made, "no column disk.x[1]"),
            ("time,disk.x[1]", made, "no column disk.y[1]"),
            (columns, made, "no whole row"),
            ("time,disk.x[1],disk.y[1],disk.angle[1]\n0,1", made, "no whole row"),
            (columns, "", "name no scene"),
            (
                columns,
                "scene,three_disk,\ndisks,1,",
                "does not know the scene three_disk",
            ),
        ] {
            let found = defect(samples, parameters).unwrap_or_default();
            assert!(found.contains(reason), "{found}, and not {reason}");
        }
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
