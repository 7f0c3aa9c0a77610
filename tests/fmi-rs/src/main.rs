//! `fmi-rs-importer FOLDER RESULT.csv STOP STEP`: validates the FMU that was unpacked to FOLDER, simulates it with its
//! start values from 0 to STOP by steps of STEP (seconds), writes all its outputs. Problems go to standard error. The model description
//! is read by the schema of the crate fmi too.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fmi_rs::model_description::{FMIMajorVersion, peek_fmi_major_version};
use fmi_rs::sim::{fmi2, fmi3};

type Outcome = Result<(), Box<dyn Error>>;

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, result, stop, step] = arguments.as_slice() else {
        return Err("arguments: FOLDER RESULT.csv STOP STEP".into());
    };
    let (folder, result) = (Path::new(folder), Path::new(result));
    let times = (stop.parse()?, step.parse()?);
    read_strictly(folder)?;
    match peek_fmi_major_version(&folder.join("modelDescription.xml"))? {
        FMIMajorVersion::V2 => two(folder, result, times),
        _ => three(folder, result, times),
    }
}

/// A reader that refuses elements and attributes that it does not know.
fn read_strictly(folder: &Path) -> Outcome {
    use fmi_schema::{deserialize, fmi2, fmi3};
    let description = std::fs::read_to_string(folder.join("modelDescription.xml"))?;
    match peek_fmi_major_version(&folder.join("modelDescription.xml"))? {
        FMIMajorVersion::V2 => drop(deserialize::<fmi2::Fmi2ModelDescription>(&description)?),
        _ => drop(deserialize::<fmi3::Fmi3ModelDescription>(&description)?),
    }
    Ok(())
}

fn refuse(problems: Vec<String>) -> Outcome {
    match problems.is_empty() {
        true => Ok(()),
        false => Err(problems.join("\n").into()),
    }
}

fn two(folder: &Path, result: &Path, (stop_time, output_interval): (f64, f64)) -> Outcome {
    use fmi_rs::model_description::fmi2::{Causality, ModelDescription};
    let description = Arc::new(ModelDescription::from_path(&folder.join("modelDescription.xml"))?);
    refuse(
        description
            .validate()
            .into_iter()
            .map(|problem| problem.message)
            .collect(),
    )?;
    let variables = description.modelVariables.iter().enumerate();
    let outputs = variables.filter(|(_, variable)| variable.causality == Causality::Output);
    let outputs = outputs.map(|(index, _)| index).collect();
    let recorder = Arc::new(fmi2::recorder::Recorder::new(fmi2::Trajectories::new(
        Arc::clone(&description),
        outputs,
    )));
    let settings = fmi2::SimulationSettings {
        unzipdir: PathBuf::from(folder),
        model_description: description,
        start_time: 0.0,
        stop_time,
        logging_on: true,
        set_stop_time: true,
        output_interval,
        log_time_scale: false,
        tolerance: 1e-9,
        set_tolerance: false,
        start_values: vec![],
        log_fmi_calls: false,
        input_file: None,
        early_return_allowed: true,
        event_mode_used: false,
        log_file: None,
        initial_fmu_state_file: None,
        final_fmu_state_file: None,
    };
    fmi2::cs::simulate(&settings, None, Arc::clone(&recorder))?;
    Ok(fmi2::csv::write_csv(&recorder.trajectories.borrow(), result)?)
}

fn three(folder: &Path, result: &Path, (stop_time, output_interval): (f64, f64)) -> Outcome {
    use fmi_rs::model_description::fmi3::{Causality, ModelDescription};
    let description = Arc::new(ModelDescription::from_path(&folder.join("modelDescription.xml"))?);
    refuse(
        description
            .validate()
            .into_iter()
            .map(|problem| problem.message)
            .collect(),
    )?;
    let variables = description.modelVariables.iter().enumerate();
    let outputs = variables.filter(|(_, variable)| variable.causality == Causality::Output);
    let outputs = outputs.map(|(index, _)| index).collect();
    let recorder = Arc::new(fmi3::recorder::Recorder::new(fmi3::Trajectories::new(
        Arc::clone(&description),
        outputs,
    )));
    let settings = fmi3::SimulationSettings {
        unzipdir: PathBuf::from(folder),
        library_kind: fmi_rs::fmi3::LibraryKind::Native,
        enable_dae: false,
        event_mode_used: description
            .coSimulation
            .as_ref()
            .is_some_and(|interface| interface.hasEventMode),
        model_description: description,
        start_time: 0.0,
        stop_time,
        visible: false,
        logging_on: true,
        set_stop_time: true,
        output_interval,
        log_time_scale: false,
        tolerance: 1e-9,
        set_tolerance: false,
        start_values: vec![],
        log_fmi_calls: false,
        intermediate_update: false,
        input_file: None,
        early_return_allowed: true,
        log_file: None,
        initial_fmu_state_file: None,
        final_fmu_state_file: None,
    };
    fmi3::cs::simulate(&settings, None, Arc::clone(&recorder))?;
    Ok(fmi3::csv::write_csv(&recorder.trajectories.borrow(), result)?)
}
