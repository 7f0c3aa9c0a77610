//! The files of a run: their names as options, and what is written to them as the run goes.

use std::path::{Path, PathBuf};

use clap::Args;
use jostle::Error;
use jostle::scene::DynSimulation;

use crate::failure::Failure;
use crate::output_file::{self, Format};
use crate::sample_times::SampleTimes;
use crate::samples::{self, Samples};
use crate::selection::Selected;
use crate::text;
use crate::trajectory::Trajectory;

/// Names of the files of a run.
#[derive(Args, Debug)]
pub struct FileNames {
    /// File for the samples: .csv, .parquet, .nc, or - for CSV to standard output.
    #[arg(long, value_name = "FILE", default_value = "run.csv")]
    pub output: PathBuf,
    /// CSV file for the parameters. Without it NAME.parameters.csv beside NAME.csv, and none beside other formats.
    #[arg(long, value_name = "FILE")]
    pub parameters: Option<PathBuf>,
    /// File for places and velocities of the disks at each sample, such as for OVITO: .xyz (extended XYZ) or .dump (LAMMPS).
    #[arg(long, value_name = "FILE")]
    pub trajectory: Option<PathBuf>,
    /// File for the state at the end, from which --resume goes on. A run that is stopped writes it without being asked, to
    /// NAME.state beside NAME.csv.
    #[arg(long, value_name = "FILE")]
    pub state: Option<PathBuf>,
}

impl FileNames {
    /// The format of the samples.
    ///
    /// # Errors
    /// A name of another format, a name that two files have, or the file of the run that is `resumed`.
    pub fn check(&self, resumed: Option<&Path>) -> Result<Format, Error> {
        let format = output_file::table_format("--output", &self.output)?;
        if let Some(path) = &self.parameters {
            output_file::check_csv("--parameters", path)?;
        }
        if let Some(path) = &self.trajectory {
            output_file::trajectory_format("--trajectory", path)?;
        }
        let parameters = self.parameter_file();
        let mut files = vec![("--output", self.output.as_path())];
        files.extend(parameters.as_deref().map(|path| ("--parameters", path)));
        files.extend(self.trajectory.as_deref().map(|path| ("--trajectory", path)));
        files.extend(self.state.as_deref().map(|path| ("--state", path)));
        output_file::check_distinct(&files)?;
        if resumed.is_some() && resumed == self.state_file().as_deref() && self.output.exists() {
            let allowed = "another file than that of the saved run, whose rows it would replace";
            let remedy = "Name another --output; its rows follow those of the first.";
            return Err(Error::parameter("--output", self.output.display(), allowed, remedy));
        }
        if let Some(path) = self
            .trajectory
            .as_deref()
            .filter(|path| resumed.is_some() && path.is_file())
        {
            let allowed = "a file that is not there yet, since it may hold the frames of the saved run";
            let remedy = "Name another --trajectory; its frames follow those of the first.";
            return Err(Error::parameter("--trajectory", path.display(), allowed, remedy));
        }
        Ok(format)
    }

    /// `run.parameters.csv` for `run.csv`.
    pub fn parameter_file(&self) -> Option<PathBuf> {
        let is_csv = output_file::table_format("--output", &self.output) == Ok(Format::Csv);
        let beside = || is_csv.then(|| output_file::beside(&self.output, "parameters.csv"));
        self.parameters.clone().or_else(beside)
    }

    /// `run.state` for `run.csv`.
    pub fn state_file(&self) -> Option<PathBuf> {
        let beside =
            || (!output_file::is_standard_output(&self.output)).then(|| output_file::beside(&self.output, "state"));
        self.state.clone().or_else(beside)
    }
}

/// The files that a run writes as it goes.
pub struct Files {
    samples: Samples,
    trajectory: Option<Trajectory>,
}

impl Files {
    /// Empty files. First what may be refused: parameters must not stand beside the samples of another run.
    ///
    /// # Errors
    /// A file cannot be made, or the scene has no trajectory.
    pub fn create(
        names: &FileNames,
        selected: &Selected,
        simulation: &dyn DynSimulation,
        times: &SampleTimes,
    ) -> Result<Self, Failure> {
        let beside = [&names.parameter_file(), &names.trajectory, &names.state];
        let trajectory_format = match &names.trajectory {
            Some(path) => Some((path, output_file::trajectory_format("--trajectory", path)?)),
            None => None,
        };
        for path in beside.into_iter().flatten() {
            output_file::check_writable(path)?;
        }
        let trajectory = match trajectory_format {
            Some((path, format)) => Some(Trajectory::create(path, format, simulation)?),
            None => None,
        };
        let facts = samples::facts(selected, simulation)?;
        let format = output_file::table_format("--output", &names.output)?;
        let samples = Samples::create(format, &names.output, simulation, &facts)?;
        if let Some(path) = names.parameter_file() {
            let seconds = times.of_parameters();
            samples::write_parameters(&path, &facts, seconds)?;
        }
        Ok(Self { samples, trajectory })
    }

    /// Adds the sample and the frame of now.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn write(&mut self, times: &SampleTimes, row: u64, simulation: &dyn DynSimulation) -> Result<(), Failure> {
        let time = times.at(row);
        self.samples.write(time, simulation)?;
        match &mut self.trajectory {
            Some(trajectory) => trajectory.write(times.number(row), time, simulation),
            None => Ok(()),
        }
    }

    /// Completes the files.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn finish(&mut self) -> Result<(), Failure> {
        self.samples.finish()
    }

    /// Rows that a reader finds.
    pub fn whole_rows(&self) -> u64 {
        self.samples.whole_rows()
    }

    /// Says what a reader finds. `first` is the number of the first row.
    pub fn kept(&self, names: &FileNames, times: &SampleTimes, first: u64) -> String {
        let (rows, place) = (self.samples.whole_rows(), output_file::shown(&names.output));
        let mut kept = match rows {
            0 => format!("No whole row is in {place}."),
            _ => {
                let until = text::number(times.at(first + rows - 1));
                format!("{rows} whole rows up to t = {until} s are in {place}.")
            }
        };
        if let Some(trajectory) = &self.trajectory {
            let (frames, path) = (trajectory.frames(), trajectory.path().display());
            kept += &format!(" {frames} whole frames are in {path}.");
        }
        kept
    }
}
