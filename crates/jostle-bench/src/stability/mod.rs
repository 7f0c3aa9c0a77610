//! `jostle-bench stability`: stiff and extreme cases of every scene and engine, each with its criteria and its result.
//!
//! A case is a scene with some parameters changed (`matrix`), watched while it runs (`watch`) and judged (`judge`). The
//! page is written from the CSV file by `python -m jostle_lab stability`.

mod judge;
mod matrix;
mod watch;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result};
use clap::Args;
use jostle::Error;

use crate::budget::positive;
use crate::nearest::unknown;
use judge::{Judged, judge};
use matrix::Probe;

/// Runs stiff and extreme cases of every scene and engine, and judges each by criteria.
///
/// Writes cases.csv (scene, engine, drive, dimension, value, result, criteria) into a folder. Results: holds; refused,
/// with the reason and the remedy that were reported; violated, with the criterion and the numbers.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  jostle-bench stability --out results/stability --only wedge\n\n\
    Exit code: 0 all run, whatever the results; 1 a file could not be written."
)]
pub struct Stability {
    /// Folder for the file; made if it does not exist.
    #[arg(long, value_name = "FOLDER", default_value = "results/stability")]
    out: PathBuf,
    /// CPU seconds after which a case is judged by what it has simulated so far.
    #[arg(long, value_name = "SECONDS", default_value = "1", value_parser = positive, allow_negative_numbers = true)]
    budget: f64,
    /// Only cases whose scene, engine or dimension has this name; may be repeated.
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// The long runs of 1e8 to 1e9 steps, bounces or impacts, and nothing else; half an hour.
    #[arg(long)]
    long: bool,
}

impl Stability {
    pub fn execute(self) -> Result<()> {
        let probes = self.chosen()?;
        std::fs::create_dir_all(&self.out)
            .with_context(|| format!("the folder {} cannot be made", self.out.display()))?;
        let path = self.out.join(if self.long { "long.csv" } else { "cases.csv" });
        let cannot = || format!("{} cannot be written", path.display());
        let mut writer = csv::Writer::from_path(&path).with_context(cannot)?;
        writer.write_record(Judged::HEADER).with_context(cannot)?;
        let (mut counts, began) = ([0; 3], Instant::now());
        for probe in probes {
            let judged = judge(&probe, if self.long { f64::INFINITY } else { self.budget });
            counts[judged.rank()] += 1;
            println!("{}", judged.line(&probe));
            writer.write_record(judged.record(&probe)).with_context(cannot)?;
            writer.flush().with_context(cannot)?;
        }
        let [holds, refused, violated] = counts;
        println!(
            "{holds} hold, {refused} are refused, {violated} are violated; {:.0} s; {}",
            began.elapsed().as_secs_f64(),
            path.display()
        );
        Ok(())
    }

    /// The cases of the names that are given.
    ///
    /// # Errors
    /// A name that no case has.
    fn chosen(&self) -> Result<Vec<Probe>, Error> {
        let mut probes = if self.long { matrix::long() } else { matrix::all() };
        let known: BTreeSet<&str> = probes
            .iter()
            .flat_map(|probe| [probe.scene, probe.engine, probe.dimension])
            .collect();
        if let Some(wrong) = self.only.iter().find(|name| !known.contains(name.as_str())) {
            return Err(unknown("--only", wrong, &Vec::from_iter(known)));
        }
        probes.retain(|probe| {
            let names = [probe.scene, probe.engine, probe.dimension];
            self.only.is_empty() || self.only.iter().any(|only| names.contains(&only.as_str()))
        });
        Ok(probes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_name_is_refused_with_the_known_ones() {
        let stability = Stability {
            out: PathBuf::new(),
            budget: 1.0,
            only: vec!["wegde".into()],
            long: false,
        };
        let message = stability.execute().unwrap_err().to_string();
        assert!(
            message.starts_with("--only = wegde is not allowed: one of: "),
            "{message}"
        );
        assert!(message.contains("Did you mean wedge? Name one of these."), "{message}");
    }

    /// The corners of the matrix that are cheap. Whatever is violated is a defect; nothing may be violated here.
    #[test]
    fn cheap_corners_hold_or_are_refused() {
        let dimensions = ["tilt", "aperture", "restitution", "vertical tooth", "base jump"];
        let probes = matrix::all();
        let chosen: Vec<&Probe> = probes
            .iter()
            .filter(|probe| dimensions.contains(&probe.dimension) && probe.engine != "molecular-dynamics")
            .collect();
        assert!(chosen.len() > 20, "{}", chosen.len());
        for probe in chosen {
            let judged = judge(probe, 0.05);
            assert!(judged.rank() < 2, "{}", judged.line(probe));
        }
    }
}
