//! `jostle run`: a scene from start to end, sampled into a CSV file.
//!
//! Two files: the samples (time and every output) and beside them, in `NAME.parameters.csv`, all that made them: scene,
//! engine, drive, version and every parameter with its unit. So the samples stay plain CSV that any reader takes.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use jostle::Error;
use jostle::scene::catalogue::sine_if_known;
use jostle::scene::{Causality, DynSimulation, Kind};

use crate::csv_file::CsvFile;
use crate::failure::Failure;
use crate::selection::{self, Selected, Selection};
use crate::{assignments, output_file, progress, standard_output, text};

/// Most rows of one file; more is a slip of the keyboard.
const MOST_ROWS: f64 = 1e8;

/// Runs a scene and writes its outputs to a CSV file, with a progress bar.
///
/// The file has one row for every sample, from time 0 on: time [s] and all outputs, in SI units. The parameters go to a
/// second file beside it, run.parameters.csv. Both are replaced if they exist. Every row is on disk as soon as it is
/// computed: if a step is refused, or you interrupt the run, all rows before it are there.
#[derive(Args, Debug)]
#[command(after_help = format!(
    "{}\nExample:\n  jostle run packing --seconds 10 --set drive.amplitude=1e-4 --set seed=7\n\n\
    Exit code: 0 done, 2 wrong argument or parameter, 1 a step was refused or a file could not be written.",
    selection::list()
))]
pub struct Run {
    #[command(flatten)]
    selection: Selection,
    /// Simulated time.
    #[arg(long, value_parser = positive, allow_negative_numbers = true)]
    seconds: f64,
    /// File for the samples.
    #[arg(long, value_name = "FILE", default_value = "run.csv")]
    output: PathBuf,
    /// Time from one row to the next, in seconds; the last row is at the end in any case.
    #[arg(long, value_name = "SECONDS", default_value = "0.01", value_parser = positive, allow_negative_numbers = true)]
    sample: f64,
    /// Parameter or constant input, such as contact.friction=0.2; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    assignments: Vec<String>,
    /// What moves the base, such as sine or input (held at what --set says). Without it sine, or else the engine's first.
    #[arg(long)]
    drive: Option<String>,
    /// Show no progress bar.
    #[arg(long)]
    no_progress: bool,
}

pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("give a time in seconds above 0, such as 10 or 1e-3".into()),
    }
}

impl Run {
    pub fn execute(self) -> Result<(), Failure> {
        let sine = || sine_if_known(&self.selection.scene, self.selection.engine.as_deref());
        let selected = self.selection.find(self.drive.as_deref().or_else(sine))?;
        output_file::check_csv("--output", &self.output)?;
        let began = Instant::now();
        let rows = run(&self, &selected)?;
        let took = began.elapsed().as_secs_f64();
        standard_output::write(&format!(
            "{} s of {} in {took:.2} s, {:.3} simulated seconds per second\n{rows} rows in {}, parameters in {}\n",
            text::number(self.seconds),
            selected.names.scene,
            self.seconds / took,
            self.output.display(),
            self.parameter_file().display(),
        ))
    }

    /// Time of row `index` \[s\]: from the start, never a running sum.
    fn time(&self, index: u64) -> f64 {
        (index as f64 * self.sample).min(self.seconds)
    }

    /// Index of the last row. A remainder below a billionth of a sample is rounding, not a row.
    fn last_row(&self) -> Result<u64, Error> {
        let rows = (self.seconds / self.sample - 1e-9).ceil().max(1.0);
        if rows <= MOST_ROWS {
            return Ok(rows as u64);
        }
        let allowed = format!("at most {MOST_ROWS:e} rows, here {rows:e}");
        Err(Error::parameter(
            "--sample",
            format!("{:e} s", self.sample),
            allowed,
            "Sample less often or run shorter.",
        ))
    }

    /// See [`output_file::beside`].
    fn parameter_file(&self) -> PathBuf {
        output_file::beside(&self.output, "parameters.csv")
    }
}

/// Runs the scene and returns how many rows were written.
fn run(options: &Run, selected: &Selected) -> Result<u64, Failure> {
    let last = options.last_row()?;
    let mut simulation = (selected.model.prepare)(selected.structure.clone());
    assignments::assign(&mut *simulation, &options.assignments)?;
    simulation.start(0.0)?;
    // First what may be refused: parameters must not stand beside the samples of another run.
    let mut samples = Samples::create(&options.output, &*simulation)?;
    write_parameters(options, selected, &*simulation)?;
    samples.write(0.0, &*simulation)?;
    let bar = progress::bar(last, !options.no_progress);
    for row in 1..=last {
        let time = options.time(row);
        let advanced = simulation.advance_to(time).map_err(Failure::from);
        if let Err(failure) = advanced.and_then(|()| samples.write(time, &*simulation)) {
            bar.abandon();
            warn(&*simulation);
            let until = text::number(options.time(row - 1));
            let kept = format!(
                "{row} whole rows up to t = {until} s are in {}.",
                options.output.display()
            );
            return Err(failure.keeping(kept));
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    warn(&*simulation);
    Ok(last + 1)
}

/// Says on standard error what is doubtful about the run.
fn warn(simulation: &dyn DynSimulation) {
    for warning in simulation.warnings(&[]) {
        eprintln!("jostle: warning: {}", warning.text);
    }
}

/// The CSV file of samples.
struct Samples<'options> {
    file: CsvFile<'options>,
    /// Positions of the outputs in the table.
    outputs: Vec<usize>,
}

impl<'options> Samples<'options> {
    fn create(path: &'options Path, simulation: &dyn DynSimulation) -> Result<Self, Failure> {
        let variables = simulation.values().table().variables();
        let is_output = |position: &usize| variables[*position].causality == Causality::Output;
        let outputs: Vec<usize> = (0..variables.len()).filter(is_output).collect();
        let mut file = CsvFile::create(path)?;
        let names = outputs.iter().map(|&position| variables[position].name.as_str());
        file.write(std::iter::once("time").chain(names))?;
        Ok(Self { file, outputs })
    }

    /// Writes one row and hands it to the operating system at once, so that nothing is lost by what comes next.
    fn write(&mut self, time: f64, simulation: &dyn DynSimulation) -> Result<(), Failure> {
        let mut record = vec![text::number(time)];
        for &position in &self.outputs {
            record.push(simulation.value(position)?.to_string());
        }
        self.file.write(record)?;
        self.file.flush()
    }
}

/// Writes all that made the samples: name, value, unit.
fn write_parameters(options: &Run, selected: &Selected, simulation: &dyn DynSimulation) -> Result<(), Failure> {
    let path = options.parameter_file();
    let names = selected.names;
    let mut records = vec![
        ["name".into(), "value".into(), "unit".into()],
        ["scene".into(), names.scene.into(), String::new()],
        ["engine".into(), names.engine.into(), String::new()],
        ["drive".into(), names.drive.into(), String::new()],
        [
            "disks".into(),
            selected.structure.get("disks").to_string(),
            String::new(),
        ],
        ["version".into(), env!("CARGO_PKG_VERSION").into(), String::new()],
        ["seconds".into(), text::number(options.seconds), "s".into()],
        ["sample".into(), text::number(options.sample), "s".into()],
    ];
    for (position, variable) in simulation.values().table().variables().iter().enumerate() {
        if variable.causality != Causality::Output {
            let unit = match &variable.kind {
                Kind::Real(quantity) => quantity.unit.name,
                _ => "1",
            };
            records.push([
                variable.name.clone(),
                simulation.value(position)?.to_string(),
                unit.into(),
            ]);
        }
    }
    let mut file = CsvFile::create(&path)?;
    for record in &records {
        file.write(record)?;
    }
    file.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock;

    fn options(folder: &Path, seconds: f64, sample: f64, assignments: &[&str]) -> Run {
        Run {
            selection: Selection {
                scene: "clock".into(),
                engine: None,
                disks: Some(2),
            },
            seconds,
            output: folder.join("run.csv"),
            sample,
            assignments: assignments.iter().map(|text| text.to_string()).collect(),
            drive: None,
            no_progress: true,
        }
    }

    fn run_clock(options: &Run) -> Result<u64, Failure> {
        run(options, &options.selection.of(clock::MODEL)?)
    }

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("jostle-run-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn lines(path: &Path) -> Vec<String> {
        std::fs::read_to_string(path)
            .unwrap()
            .lines()
            .map(String::from)
            .collect()
    }

    #[test]
    fn rows_start_at_zero_and_end_at_the_end() {
        let folder = folder("rows");
        let options = options(&folder, 1.0, 0.4, &["rate=2"]);
        assert_eq!(run_clock(&options).unwrap(), 4);
        let expected = [
            "time,angle[1],angle[2],ticks",
            "0,0,0,0",
            "0.4,0.8,0.8,0",
            "0.8,1.6,1.6,1",
            "1,2,2,2",
        ];
        assert_eq!(lines(&options.output), expected);
        let parameters = lines(&options.parameter_file());
        for line in [
            "name,value,unit",
            "scene,clock,",
            "disks,2,",
            "rate,2,rad/s",
            "seed,1,1",
            "sample,0.4,s",
        ] {
            assert!(
                parameters.iter().any(|found| found == line),
                "{line} is not in {parameters:?}"
            );
        }
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn whole_samples_are_counted_despite_rounding() {
        let rows = |seconds, sample| options(Path::new(""), seconds, sample, &[]).last_row().unwrap();
        assert_eq!(
            (rows(0.3, 0.1), rows(10.0, 0.01), rows(1.0, 3.0), rows(0.7, 0.1)),
            (3, 1000, 1, 7)
        );
        let many = options(Path::new(""), 1e9, 1e-9, &[])
            .last_row()
            .unwrap_err()
            .to_string();
        assert!(many.starts_with("--sample = "), "{many}");
    }

    #[test]
    fn a_refused_step_keeps_the_rows_before_it() {
        let folder = folder("refused");
        let options = options(&folder, 1.0, 0.1, &["limit=0.45"]);
        let failure = run_clock(&options).unwrap_err();
        assert_eq!(failure.exit_code(), 1);
        let message = failure.to_string();
        assert!(
            message.contains("the clock has stopped") && message.contains("5 whole rows up to t = 0.4 s"),
            "{message}"
        );
        assert_eq!(lines(&options.output).len(), 6);
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_wrong_parameter_leaves_earlier_files_alone() {
        let folder = folder("wrong");
        let options = options(&folder, 1.0, 0.1, &["rate=11"]);
        std::fs::write(&options.output, "precious").unwrap();
        let failure = run_clock(&options).unwrap_err();
        assert_eq!(failure.exit_code(), 2);
        assert_eq!(lines(&options.output), ["precious"]);
        std::fs::remove_dir_all(folder).unwrap();
    }
}
