//! Inputs in, time on, outputs out: by name, or by number for those who do it often.

use std::ffi::c_char;

use fmi_component::memory;
use jostle::scene::{AnySimulation, Value, Variable};
use jostle::{Error, Result};

use crate::handle::{Access, JostleSimulation, JostleStatus, enter};
use crate::texts::unknown;

/// Advances to `end_time` in seconds, under the inputs as they stand, as one communication step. `end_time` must lie after the
/// present time. If the step is refused, nothing has changed.
///
/// # Safety
/// `simulation` is null or was made here and not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_advance_to(simulation: *mut JostleSimulation, end_time: f64) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Change, |inner| {
            inner.simulation.advance_to(end_time)
        })
    }
}

/// Lets one step do no more than so much work, instead of what takes half an hour at most. A unit is an event (0.1 to 1
/// microseconds) or a time step of ten disks; a step that asks for more is refused. No part of the state.
///
/// # Safety
/// `simulation` is null or was made here and not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_limit_work(simulation: *mut JostleSimulation, most: u64) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Change, |inner| {
            inner.simulation.limit_work(most);
            Ok(())
        })
    }
}

/// Writes the time reached, in seconds.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `time` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_time(simulation: *const JostleSimulation, time: *mut f64) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Read, |inner| {
            memory::write(time, inner.simulation.time(), "time")
        })
    }
}

/// Writes the number of the variable called `name`, for `jostle_set`, `jostle_get` and `jostle_variable`. It is the same
/// for as long as the simulation lives.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `name` is null or a text; `variable` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_find(
    simulation: *const JostleSimulation,
    name: *const c_char,
    variable: *mut u32,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Read, |inner| {
            let position = inner.simulation.position(&memory::text(name, "name")?)?;
            memory::write(variable, position as u32, "variable")
        })
    }
}

/// Sets inputs and tunable parameters: all, or none if one is refused. They hold until they are set again. A tunable parameter
/// acts from the next step on, which is refused if its value does not go with the others.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `variables` and `values` are null or have `count` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_set(
    simulation: *mut JostleSimulation,
    variables: *const u32,
    values: *const f64,
    count: usize,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Change, |inner| {
            let variables = memory::slice(variables, count, "variables")?;
            let values = memory::slice(values, count, "values")?;
            set_all(&mut inner.simulation, variables, values)
        })
    }
}

/// Sets the input or tunable parameter called `name`. It holds until it is set again.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `name` is null or a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_set_by_name(
    simulation: *mut JostleSimulation,
    name: *const c_char,
    value: f64,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Change, |inner| {
            inner.simulation.set(&memory::text(name, "name")?, value)
        })
    }
}

/// Reads real variables, as of now. If one is refused, `values` holds those before it.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `variables` and `values` are null or have `count` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_get(
    simulation: *const JostleSimulation,
    variables: *const u32,
    values: *mut f64,
    count: usize,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe { read(simulation, (variables, count), values, real) }
}

/// Reads whole numbers, enumerations among them (1 is the first option), as of now. If one is refused, `values` holds
/// those before it.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `variables` and `values` are null or have `count` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_get_integers(
    simulation: *const JostleSimulation,
    variables: *const u32,
    values: *mut i64,
    count: usize,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe { read(simulation, (variables, count), values, integer) }
}

/// Reads the real variable called `name`, as of now.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `name` is null or a text; `value` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_get_by_name(
    simulation: *const JostleSimulation,
    name: *const c_char,
    value: *mut f64,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Read, |inner| {
            let found = inner.simulation.real(&memory::text(name, "name")?)?;
            memory::write(value, found, "value")
        })
    }
}

/// Reads the whole number called `name`, as of now.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `name` is null or a text; `value` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_get_integer_by_name(
    simulation: *const JostleSimulation,
    name: *const c_char,
    value: *mut i64,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Read, |inner| {
            let found = inner.simulation.integer(&memory::text(name, "name")?)?;
            memory::write(value, found, "value")
        })
    }
}

fn set_all(simulation: &mut AnySimulation, variables: &[u32], values: &[f64]) -> Result<()> {
    let mut before = Vec::with_capacity(variables.len());
    for (&variable, &value) in variables.iter().zip(values) {
        let position = variable as usize;
        let kept = simulation.value(position);
        if let Err(error) = simulation.set_at(position, value) {
            for (position, kept) in before.into_iter().rev() {
                simulation.set_at(position, kept)?;
            }
            return Err(error);
        }
        before.push((position, kept?));
    }
    Ok(())
}

/// # Safety
/// As for `jostle_get`.
unsafe fn read<T>(
    simulation: *const JostleSimulation,
    (variables, count): (*const u32, usize),
    values: *mut T,
    convert: impl Fn(&Variable, Value) -> Result<T>,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Read, |inner| {
            let variables = memory::slice(variables, count, "variables")?;
            let mut values = memory::Output::new(values, count, "values")?;
            for (index, &variable) in variables.iter().enumerate() {
                let position = variable as usize;
                let all = inner.simulation.variables();
                let described = all.get(position).ok_or_else(|| unknown(all, variable))?;
                values.write(index, convert(described, inner.simulation.value(position)?)?);
            }
            Ok(())
        })
    }
}

fn real(variable: &Variable, value: Value) -> Result<f64> {
    match value {
        Value::Real(real) => Ok(real),
        Value::Integer(_) => Err(other_kind(variable, "a whole number", "jostle_get_integers")),
    }
}

fn integer(variable: &Variable, value: Value) -> Result<i64> {
    match value {
        Value::Integer(integer) => Ok(integer),
        Value::Real(_) => Err(other_kind(variable, "a real number", "jostle_get")),
    }
}

fn other_kind(variable: &Variable, kind: &str, function: &str) -> Error {
    Error::call(
        format!("{} is {kind}", variable.name),
        format!("Read it with {function}."),
    )
}
