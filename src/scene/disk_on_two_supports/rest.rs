//! Where the disk rests when a run starts, and who is to blame if it rests nowhere.

use crate::drive::excitation::Piece;
use crate::engine::disk_on_two_supports::{TimeStepLimits, TwoSupportsRig, equilibrium};
use crate::scene::{Error, Result, Values};

use super::{DiskOnTwoSupportsDrive, parameters};

/// The time step that the parameters choose \[s\].
///
/// # Errors
/// One that these contacts or this drive do not allow.
pub fn time_step<E: DiskOnTwoSupportsDrive>(rig: &TwoSupportsRig, values: &Values) -> Result<f64> {
    let (given, limits) = (values.real("time_step"), TimeStepLimits::of(rig, E::period(values)));
    if given == 0.0 {
        return Ok(limits.default);
    }
    if given > limits.largest {
        return Err(Error::parameter(
            "time_step",
            format!("{given:e} s"),
            format!("0, or up to {:e} s with these contacts and this drive", limits.largest),
            "Leave it 0, or soften the contacts or slow the drive down.",
        ));
    }
    Ok(given)
}

/// Place (x, y) \[m\] at which the disk rests on both supports.
///
/// # Errors
/// It rests nowhere, or a value that the scene does not take.
pub fn of<E: DiskOnTwoSupportsDrive>(start_time: f64, values: &Values) -> Result<[f64; 2]> {
    match place::<E>(start_time, values)? {
        Some(place) => Ok(place),
        None => Err(refusal::<E>(start_time, values)),
    }
}

fn place<E: DiskOnTwoSupportsDrive>(start_time: f64, values: &Values) -> Result<Option<[f64; 2]>> {
    let rig = parameters::rig(values)?;
    let excitation = E::new(start_time, time_step::<E>(&rig, values)?, values);
    Ok(equilibrium(&rig, &excitation.piece(start_time).supports(0.0)).ok())
}

/// Names the parameter that alone keeps the disk from resting: at its start value the disk would rest. If it takes several, the
/// stiffness is the one that mends most.
fn refusal<E: DiskOnTwoSupportsDrive>(start_time: f64, values: &Values) -> Error {
    let mut table = values.table().settable().iter().enumerate();
    let blamed = table.find(|(position, variable)| {
        let mut other = values.clone();
        values.get(*position) != Some(variable.start())
            && other.set(*position, variable.start()).is_ok()
            && matches!(place::<E>(start_time, &other), Ok(Some(_)))
    });
    let stiffness = || {
        let position = values.table().position("contact.normal_stiffness").unwrap_or(0);
        (position, &values.table().settable()[position])
    };
    let (position, variable) = blamed.unwrap_or_else(stiffness);
    let value = values.get(position).unwrap_or_else(|| variable.start());
    let remedy = match variable.name.as_str() {
        "contact.normal_stiffness" => {
            "Raise it, or lower disk.mass, gravity, tilt or the amplitude of the supports.".into()
        }
        _ => format!(
            "Bring it nearer to its start value, {}, or raise contact.normal_stiffness.",
            variable.text(variable.start())
        ),
    };
    Error::parameter(
        &variable.name,
        variable.text(value),
        "such that the disk rests on both contacts with overlaps far below its radius",
        remedy,
    )
}
