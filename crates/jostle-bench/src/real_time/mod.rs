//! `jostle-bench real-time`: how long `fmi3DoStep` takes at the rates at which controllers run.
//!
//! Libraries of FMUs are loaded as an importer does it (`library`), each case is run twice and its steps are timed
//! (`samples`). The page is written from the CSV files by `python -m tools real-time`.

mod library;
mod samples;

use std::collections::BTreeSet;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use fmi_component::{Variable, token, value_reference};
use jostle::Error;
use jostle::scene::{ModelType, StructuralParameters, catalogue};

use crate::budget::positive;
use crate::csv_file::write_csv;
use crate::machine;
use crate::nearest::unknown;
use samples::{Case, INPUTS, OUTPUTS, Summary};

/// Scenes and engines, all on inputs, with numbers of disks.
const SCENES: [Chosen; 4] = [
    ("packing", "molecular-dynamics", &[60, 200, 1000]),
    ("packing", "molecular-dynamics-located", &[60, 200, 1000]),
    ("packing", "event-driven", &[60, 200, 1000]),
    ("ratchet", "event-driven", &[20, 60]),
];
/// A scene, its engine and its numbers of disks.
type Chosen = (&'static str, &'static str, &'static [u32]);
/// Communication steps a second.
const RATES: [u32; 3] = [1000, 2000, 5000];

const HEADER: [&str; 15] = [
    "scene",
    "engine",
    "disks",
    "rate",
    "steps",
    "mean",
    "percentile_99",
    "percentile_9999",
    "worst",
    "worst_twice",
    "wall_percentile_9999",
    "wall_worst",
    "set_and_get",
    "page_faults",
    "refused",
];

/// Times `fmi3DoStep` at 1, 2 and 5 kHz with 60, 200 and 1000 disks.
///
/// The base is on inputs: a sine of twice gravity at 80 Hz, set before each step; four outputs are read after it. Writes
/// steps.csv (times in seconds) and machine.csv into a folder. Each case is run twice with the same steps. Needs the
/// libraries of the FMUs beside this program.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  cargo build --release -p jostle-bench -p fmu-packing -p fmu-packing-located \
    -p fmu-packing-event-driven -p fmu-ratchet\n  target/release/jostle-bench real-time --out results/real-time\n\n\
    All cases take some half an hour on an idle core."
)]
pub struct RealTime {
    /// Folder for the files; made if it does not exist.
    #[arg(long, value_name = "FOLDER", default_value = "results/real-time")]
    out: PathBuf,
    /// Steps to time in each of two runs, after a quarter of a simulated second.
    #[arg(long, default_value = "100000", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    steps: u32,
    /// CPU seconds after which a run ends with the steps that it has done.
    #[arg(long, value_name = "SECONDS", default_value = "40", value_parser = positive, allow_negative_numbers = true)]
    budget: f64,
    /// Only scenes or engines of this name; may be repeated.
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Only this number of disks; may be repeated.
    #[arg(long, value_name = "N")]
    disks: Vec<u32>,
}

impl RealTime {
    pub fn execute(self) -> Result<()> {
        let scenes = self.chosen()?;
        std::fs::create_dir_all(&self.out)
            .with_context(|| format!("the folder {} cannot be made", self.out.display()))?;
        let mut rows = vec![HEADER.map(String::from)];
        for (scene, engine, counts) in scenes {
            for &disks in counts.iter().filter(|disks| self.wants(**disks)) {
                for rate in RATES {
                    let row = self.measure(scene, engine, disks, rate)?;
                    println!("{}", row.join(", "));
                    rows.push(row);
                }
            }
            // After each scene, so that an end before the end loses little.
            write_csv(&self.out.join("steps.csv"), rows.clone())?;
        }
        let clock = format!("{:e}", samples::clock_cost());
        machine::write(&self.out.join("machine.csv"), &[("clock_cost", clock)])
    }

    fn wants(&self, disks: u32) -> bool {
        self.disks.is_empty() || self.disks.contains(&disks)
    }

    /// The scenes and engines of the names that are given.
    ///
    /// # Errors
    /// A name that none has, or a number of disks that none of the chosen ones has.
    fn chosen(&self) -> Result<Vec<Chosen>, Error> {
        let known: BTreeSet<&str> = SCENES.iter().flat_map(|(scene, engine, _)| [*scene, *engine]).collect();
        if let Some(wrong) = self.only.iter().find(|name| !known.contains(name.as_str())) {
            return Err(unknown("--only", wrong, &Vec::from_iter(known)));
        }
        let wanted =
            |names: [&str; 2]| self.only.is_empty() || self.only.iter().any(|only| names.contains(&only.as_str()));
        let chosen: Vec<Chosen> = SCENES
            .into_iter()
            .filter(|(scene, engine, _)| wanted([scene, engine]))
            .collect();
        let counts: BTreeSet<u32> = chosen.iter().flat_map(|(_, _, counts)| *counts).copied().collect();
        if let Some(wrong) = self.disks.iter().find(|disks| !counts.contains(disks)) {
            let allowed = Vec::from_iter(counts.iter().map(u32::to_string)).join(", ");
            let remedy = "Give one of these, or other names to --only.";
            return Err(Error::parameter("--disks", wrong, format!("one of: {allowed}"), remedy));
        }
        Ok(chosen)
    }

    fn measure(&self, scene: &str, engine: &str, disks: u32, rate: u32) -> Result<[String; HEADER.len()]> {
        let model = catalogue::find(scene, Some(engine), Some("input"))?;
        let model = Loadable::new(model, disks)?;
        let case = Case {
            library: &model.library,
            token: &model.token,
            inputs: &model.inputs,
            outputs: &model.outputs,
            step: 1.0 / f64::from(rate),
        };
        let steps = self.steps as usize;
        let runs = samples::run(&case, steps, self.budget)
            .and_then(|first| samples::run(&case, first.cpu.len(), f64::INFINITY).map(|second| [first, second]));
        let names = [scene.into(), engine.into(), disks.to_string(), rate.to_string()];
        Ok(match runs {
            Ok([first, second]) => row(names, &Summary::of([&first, &second])),
            Err(refused) => refusal(names, format!("{refused:#}")),
        })
    }
}

/// A model with its library and what an importer knows of it.
struct Loadable {
    library: PathBuf,
    token: String,
    inputs: Vec<u32>,
    outputs: Vec<u32>,
}

impl Loadable {
    fn new(model: &ModelType, disks: u32) -> Result<Self> {
        let info = (model.info)();
        let structure = StructuralParameters::choose(&info, &[("disks", disks)])?;
        let variables = (model.variables)(&structure);
        let program = std::env::current_exe().context("where this program is, is not known")?;
        // Beside the program; tests run one folder below the libraries.
        let folders: Vec<_> = program.ancestors().skip(1).take(2).collect();
        Ok(Self {
            library: fmi_bundle::find_library(&info.identifier, &folders)?,
            token: token::write(&info, &structure, &variables, false),
            inputs: references(&variables, &INPUTS),
            outputs: references(&variables, &OUTPUTS),
        })
    }
}

/// Value references of the variables of these names, in their order.
fn references(variables: &[Variable], names: &[&str]) -> Vec<u32> {
    let place = |name: &&str| variables.iter().position(|variable| variable.name == **name);
    names.iter().filter_map(place).map(value_reference).collect()
}

fn row([scene, engine, disks, rate]: [String; 4], summary: &Summary) -> [String; HEADER.len()] {
    let [percentile, tail] = summary.percentiles;
    let [wall_tail, wall_worst] = summary.wall;
    [
        scene,
        engine,
        disks,
        rate,
        summary.steps.to_string(),
        seconds(summary.mean),
        seconds(percentile),
        seconds(tail),
        seconds(summary.worst),
        seconds(summary.worst_twice),
        seconds(wall_tail),
        seconds(wall_worst),
        seconds(summary.exchange),
        summary.page_faults.to_string(),
        String::new(),
    ]
}

fn refusal([scene, engine, disks, rate]: [String; 4], why: String) -> [String; HEADER.len()] {
    let mut row: [String; HEADER.len()] = Default::default();
    [row[0], row[1], row[2], row[3]] = [scene, engine, disks, rate];
    row[HEADER.len() - 1] = why;
    row
}

/// Four digits; nothing for what is not known.
fn seconds(time: f64) -> String {
    if time.is_nan() {
        String::new()
    } else {
        format!("{time:.3e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The refusal of these names and numbers of disks.
    fn refusal_of(only: &[&str], disks: &[u32]) -> String {
        let out = std::env::temp_dir().join(format!("jostle-bench-refused-{}", std::process::id()));
        let command = RealTime {
            out: out.clone(),
            steps: 1,
            budget: 1.0,
            only: only.iter().map(|name| String::from(*name)).collect(),
            disks: disks.to_vec(),
        };
        let error = command.execute().unwrap_err();
        assert!(!out.exists(), "a refused command makes no folder");
        assert!(matches!(error.downcast_ref(), Some(Error::Parameter { .. })), "{error}");
        error.to_string()
    }

    #[test]
    fn an_unknown_name_is_refused_with_the_known_ones() {
        let message = refusal_of(&["packign"], &[]);
        assert!(
            message.starts_with("--only = packign is not allowed: one of: event-driven"),
            "{message}"
        );
        assert!(
            message.contains("Did you mean packing? Name one of these."),
            "{message}"
        );
    }

    #[test]
    fn disks_that_no_chosen_scene_has_are_refused() {
        let message = refusal_of(&[], &[60, 61]);
        assert!(
            message.starts_with("--disks = 61 is not allowed: one of: 20, 60, 200, 1000"),
            "{message}"
        );
        let message = refusal_of(&["ratchet"], &[1000]);
        assert!(
            message.starts_with("--disks = 1000 is not allowed: one of: 20, 60. "),
            "{message}"
        );
    }

    #[test]
    fn a_budget_that_is_no_time_is_refused() {
        #[derive(clap::Parser, Debug)]
        struct Arguments {
            #[command(flatten)]
            command: RealTime,
        }
        let parse = |budget| <Arguments as clap::Parser>::try_parse_from(["real-time", "--budget", budget]);
        for wrong in ["NaN", "-1", "0"] {
            let message = parse(wrong).unwrap_err().to_string();
            assert!(message.contains("give CPU seconds above 0"), "{message}");
        }
        assert_eq!(parse("inf").unwrap().command.budget, f64::INFINITY);
    }

    #[test]
    fn every_scene_takes_the_inputs_and_gives_outputs() {
        for (scene, engine, _) in SCENES {
            let model = catalogue::find(scene, Some(engine), Some("input")).unwrap();
            let structure = StructuralParameters::choose(&(model.info)(), &[("disks", 60)]).unwrap();
            let variables = (model.variables)(&structure);
            assert_eq!(references(&variables, &INPUTS).len(), INPUTS.len(), "{scene}, {engine}");
            assert_eq!(
                references(&variables, &OUTPUTS).len(),
                OUTPUTS.len(),
                "{scene}, {engine}"
            );
        }
    }
}
