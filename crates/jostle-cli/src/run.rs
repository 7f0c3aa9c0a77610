//! `jostle run`: a scene from start to end, sampled into a file.
//!
//! CSV is two files: the samples (time and every output) and beside them, in `NAME.parameters.csv`, all that made them: scene,
//! engine, drive, version and every parameter with its unit. So the samples stay plain CSV that any reader takes. Parquet and
//! NetCDF hold both.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use jostle::Error;
use jostle::engine::interruptible;
use jostle::scene::DynSimulation;
use jostle::scene::catalogue::sine_if_known;

use crate::failure::Failure;
use crate::interruption::{Interruption, Signal};
use crate::output_file::{self, Format};
use crate::run_files::{FileNames, Files};
use crate::sample_times::SampleTimes;
use crate::selection::{self, Selected, Selection};
use crate::{assignments, interruption, progress, standard_output, text};

/// Runs a scene and writes its outputs to a file, with a progress bar.
///
/// The file has one row for every sample, from time 0 on: time [s] and all outputs, in SI units. Its ending chooses the format:
/// .csv, .txt, .dat, a number or none is CSV; .parquet is Parquet; .nc is NetCDF; - is CSV to standard output. With CSV the
/// parameters go to a second file beside it, run.parameters.csv; Parquet and NetCDF hold them. Files that exist are replaced.
///
/// Rows of CSV and NetCDF are on disk as soon as they are computed. Parquet is written in groups of rows, and cannot be read
/// before it is complete. If a step is refused, the disk is full, or Ctrl-C or SIGTERM stops the run, the file is completed
/// with all rows that it holds, and the message says how many. A second Ctrl-C stops at once.
#[derive(Args, Debug)]
#[command(after_help = format!(
    "{}\nExample:\n  jostle run packing --seconds 10 --set drive.amplitude=1e-4 --set seed=7\n  \
    jostle run ratchet --seconds 10 --output run.parquet --trajectory run.xyz\n  \
    jostle run ratchet --seconds 20 --output more.parquet --resume run.state\n\n\
    Exit code: 0 done, 2 wrong argument or parameter, 1 a step was refused or a file could not be written, 130 Ctrl-C, 143 \
    SIGTERM.",
    selection::list()
))]
pub struct Run {
    #[command(flatten)]
    selection: Selection,
    /// Simulated time; with --resume counted from the beginning of the saved run.
    #[arg(long, value_parser = positive, allow_negative_numbers = true)]
    seconds: f64,
    #[command(flatten)]
    names: FileNames,
    /// Time from one row to the next, in seconds; the last row is at the end in any case.
    #[arg(long, value_name = "SECONDS", default_value = "0.01", value_parser = positive, allow_negative_numbers = true)]
    sample: f64,
    /// Parameter or constant input, such as contact.friction=0.2; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    assignments: Vec<String>,
    /// What moves the base, such as sine or input (held at what --set says). Without it sine, or else the engine's first.
    #[arg(long)]
    drive: Option<String>,
    /// Goes on from a saved state, with its parameters and with the bits of a run that was never stopped. The first row is the
    /// one after the last of the saved run. Scene, engine, drive and disks must be the same.
    #[arg(long, value_name = "FILE", conflicts_with = "assignments")]
    resume: Option<PathBuf>,
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
        let format = self.names.check(self.resume.as_deref())?;
        let began = Instant::now();
        let interruption = Interruption::listen().map_err(Failure::Signals)?;
        let done = run(&self, &selected, &interruption)?;
        let summary = self.summary(&done, &selected, began.elapsed().as_secs_f64());
        if format == Format::StandardOutput {
            eprint!("{summary}");
            return Ok(());
        }
        standard_output::write(&summary)
    }

    fn summary(&self, done: &Done, selected: &Selected, took: f64) -> String {
        let mut files = vec![format!(
            "{} rows in {}",
            done.rows,
            output_file::shown(&self.names.output)
        )];
        let mut add = |what: &str, path: Option<&Path>| {
            files.extend(path.map(|path| format!("{what} in {}", path.display())));
        };
        add("parameters", self.names.parameter_file().as_deref());
        add("trajectory", self.names.trajectory.as_deref());
        add("state", self.names.state.as_deref());
        format!(
            "{} s of {} in {took:.2} s, {:.3} simulated seconds per second\n{}\n",
            text::number(done.seconds),
            selected.names.scene,
            done.seconds / took,
            files.join(", "),
        )
    }

    /// The simulation at its start, or where the saved one has come to.
    fn prepare(&self, selected: &Selected) -> Result<Box<dyn DynSimulation>, Failure> {
        let mut simulation = (selected.model.prepare)(selected.structure.clone());
        let Some(path) = &self.resume else {
            assignments::assign(&mut *simulation, &self.assignments)?;
            simulation.start(0.0)?;
            return Ok(simulation);
        };
        let names = selected.names;
        let refused = |why: String| {
            let disks = selected.structure.get("disks");
            let allowed = format!(
                "the saved state of a run of {}, {}, drive {}, disks {disks}: {why}",
                names.scene, names.engine, names.drive
            );
            let remedy = "Give scene, --engine, --drive and --disks of the run that was stopped.";
            Error::parameter("--resume", path.display(), allowed, remedy)
        };
        let bytes = std::fs::read(path).map_err(|error| {
            let allowed = format!("a file that can be read: {error}");
            Error::parameter("--resume", path.display(), allowed, "Name the .state file of a run.")
        })?;
        let restored = simulation.restore_bytes(&bytes);
        restored.map_err(|error| refused(error.to_string()))?;
        if !simulation.is_started() {
            return Err(refused("it was saved before its start".into()).into());
        }
        Ok(simulation)
    }
}

/// What a run has come to.
#[derive(Debug, PartialEq)]
struct Done {
    /// Rows written.
    rows: u64,
    /// Time simulated \[s\].
    seconds: f64,
}

/// Runs the scene and writes its files.
fn run(options: &Run, selected: &Selected, interruption: &Interruption) -> Result<Done, Failure> {
    let mut simulation = options.prepare(selected)?;
    let start = simulation.time();
    let times = SampleTimes::new(start, options.sample, options.seconds)?;
    let mut files = Files::create(&options.names, selected, &*simulation, &times)?;
    let first = u64::from(options.resume.is_some());
    let done = advance(options, &times, first, &mut *simulation, &mut files, interruption);
    // Whatever happened, what can be read shall be; the first failure is the one to tell of.
    let finished = files.finish();
    let stopped = done.and_then(|stopped| finished.map(|()| stopped));
    let kept = |files: &Files| files.kept(&options.names, &times, first);
    if !matches!(stopped, Err(Failure::ReaderGone)) {
        warn(&*simulation);
    }
    match stopped {
        Err(failure) => Err(failure.keeping(kept(&files))),
        Ok(Some(signal)) => {
            let kept = format!("{}{}", kept(&files), how_to_go_on(options, &*simulation));
            Err(Failure::Interrupted { signal, kept })
        }
        Ok(None) => {
            if let Some(path) = &options.names.state {
                save(path, &*simulation)?;
            }
            Ok(Done {
                rows: files.whole_rows(),
                seconds: options.seconds - start,
            })
        }
    }
}

/// Goes from row to row until the end or a signal.
fn advance(
    options: &Run,
    times: &SampleTimes,
    first: u64,
    simulation: &mut dyn DynSimulation,
    files: &mut Files,
    interruption: &Interruption,
) -> Result<Option<Signal>, Failure> {
    if first == 0 {
        files.write(times, 0, simulation)?;
    }
    let bar = progress::bar(times.last(), !options.no_progress);
    for row in 1..=times.last() {
        if let Some(signal) = interruption.received() {
            bar.abandon();
            return Ok(Some(signal));
        }
        let (advanced, ended) = interruptible(interruption::is_wanted, || simulation.advance_to(times.at(row)));
        if ended && let Some(signal) = interruption.received() {
            bar.abandon();
            return Ok(Some(signal)); // the step has not been done
        }
        let written = advanced
            .map_err(Failure::from)
            .and_then(|()| files.write(times, row, simulation));
        written.inspect_err(|_| bar.abandon())?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(None)
}

/// Writes the state.
fn save(path: &Path, simulation: &dyn DynSimulation) -> Result<(), Failure> {
    let bytes = simulation.to_bytes()?;
    std::fs::write(path, bytes).map_err(|error| Failure::file(path, &error))
}

/// Saves the state of a run that a signal has stopped, and says how to go on from it.
fn how_to_go_on(options: &Run, simulation: &dyn DynSimulation) -> String {
    let Some(path) = options.names.state_file() else {
        return String::new();
    };
    match save(&path, simulation) {
        Ok(()) => format!(
            "\nThe state is in {path}. To go on, give the same command without --set, with --resume {path} and other files.",
            path = path.display()
        ),
        Err(failure) => format!("\nThe state could not be saved: {failure}"),
    }
}

/// Says on standard error what is doubtful about the run.
fn warn(simulation: &dyn DynSimulation) {
    for warning in simulation.warnings(&[]) {
        eprintln!("jostle: warning: {}", warning.text);
    }
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
            names: FileNames {
                output: folder.join("run.csv"),
                parameters: None,
                trajectory: None,
                state: None,
            },
            sample,
            assignments: assignments.iter().map(|text| text.to_string()).collect(),
            drive: None,
            resume: None,
            no_progress: true,
        }
    }

    fn run_clock(options: &Run) -> Result<u64, Failure> {
        let selected = options.selection.of(clock::MODEL)?;
        run(options, &selected, &Interruption::default()).map(|done| done.rows)
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
        assert_eq!(lines(&options.names.output), expected);
        let parameters = lines(&options.names.parameter_file().unwrap());
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
        assert_eq!(lines(&options.names.output).len(), 6);
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_wrong_parameter_leaves_earlier_files_alone() {
        let folder = folder("wrong");
        let options = options(&folder, 1.0, 0.1, &["rate=11"]);
        std::fs::write(&options.names.output, "precious").unwrap();
        let failure = run_clock(&options).unwrap_err();
        assert_eq!(failure.exit_code(), 2);
        assert_eq!(lines(&options.names.output), ["precious"]);
        std::fs::remove_dir_all(folder).unwrap();
    }
}
