//! Values of variables: getters and setters of every type, alike in both versions but for the names of the functions.

use super::common::{Inner, Opaque, Status, enter, enter_to_read};
use super::memory;
use crate::error::{Error, Result};
use crate::fmi::instance::{Access, Instance};
use crate::fmi::life_cycle::Version;
use crate::scene::{Scene, Value};

/// References with their number, values with theirs. FMI 2.0 has one number for both.
pub type Arrays<T> = (*const u32, usize, T, usize);

/// `fmi2GetReal`, `fmi3GetFloat64`.
///
/// # Safety
/// As for [`enter`]; arrays are null or have the length given.
pub unsafe fn get_real<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    arrays: Arrays<*mut f64>,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter_to_read::<S>(pointer, version, function, |inner| {
            inner.get(arrays, Access::Real, real)
        })
    }
}

/// `fmi2GetInteger`, `fmi3GetInt32`, `fmi3GetInt64`.
///
/// # Safety
/// As for [`enter`]; arrays are null or have the length given.
pub unsafe fn get_whole<S: Scene, T: TryFrom<i64>>(
    pointer: Opaque,
    version: Version,
    function: &str,
    arrays: Arrays<*mut T>,
    access: Access,
) -> Status {
    // SAFETY: passed on.
    unsafe { enter_to_read::<S>(pointer, version, function, |inner| inner.get(arrays, access, whole)) }
}

/// `fmi2SetReal`, `fmi3SetFloat64`.
///
/// # Safety
/// As for [`enter`]; arrays are null or have the length given.
pub unsafe fn set_real<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    arrays: Arrays<*const f64>,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            inner.set(arrays, Access::Real, Value::Real)
        })
    }
}

/// `fmi2SetInteger`, `fmi3SetInt32`, `fmi3SetInt64`.
///
/// # Safety
/// As for [`enter`]; arrays are null or have the length given.
pub unsafe fn set_whole<S: Scene, T: Copy + Into<i64>>(
    pointer: Opaque,
    version: Version,
    function: &str,
    arrays: Arrays<*const T>,
    access: Access,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, version, function, |inner| {
            inner.set(arrays, access, |value: T| Value::Integer(value.into()))
        })
    }
}

/// `fmi2GetRealOutputDerivatives`, `fmi3GetOutputDerivatives`.
///
/// # Safety
/// As for [`enter`]; `orders` is null or has as many elements as there are references, the other arrays the length given.
pub unsafe fn get_output_derivatives<S: Scene>(
    pointer: Opaque,
    version: Version,
    function: &str,
    orders: *const i32,
    arrays: Arrays<*mut f64>,
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter_to_read::<S>(pointer, version, function, |inner| {
            let orders = memory::slice(orders, arrays.1, "the array of orders")?;
            inner.fill(arrays, |instance, number, reference, offset| {
                instance.output_derivative(reference, offset, orders[number])
            })
        })
    }
}

/// `fmi2SetRealInputDerivatives`. FMI 3.0 has no such function.
///
/// # Safety
/// As for [`enter`]; the arrays are null or have `count` elements.
pub unsafe fn set_input_derivatives<S: Scene>(
    pointer: Opaque,
    function: &str,
    orders: *const i32,
    (references, values, count): (*const u32, *const f64, usize),
) -> Status {
    // SAFETY: passed on.
    unsafe {
        enter::<S>(pointer, Version::Two, function, |inner| {
            let references = memory::slice(references, count, "the array of value references")?;
            let orders = memory::slice(orders, count, "the array of orders")?;
            let values = memory::slice(values, count, "the array of values")?;
            inner.instance.set_input_derivatives(references, orders, values)
        })
    }
}

impl<S: Scene> Inner<S> {
    /// Reads variables into the importer's array.
    ///
    /// # Safety
    /// The arrays are null or have the length given.
    ///
    /// # Errors
    /// Bad pointers, wrong lengths, unknown references, other types, not computed yet.
    unsafe fn get<T>(
        &mut self,
        arrays: Arrays<*mut T>,
        access: Access,
        convert: impl Fn(Value) -> Option<T>,
    ) -> Result<()> {
        let read = |instance: &mut Instance<S>, _, reference, offset| {
            let value = instance.element(reference, offset, access)?;
            convert(value).ok_or_else(|| {
                Error::call(
                    format!("value reference {reference} holds {value:?}, which does not fit this type"),
                    "Read it through FMI 3.0.",
                )
            })
        };
        // SAFETY: by the caller's promise.
        unsafe { self.fill(arrays, read) }
    }

    /// Fills the importer's array with what `read` gives for each element: number of the reference, reference, offset.
    ///
    /// # Safety
    /// The arrays are null or have the length given.
    ///
    /// # Errors
    /// Bad pointers, wrong lengths, and what `read` refuses.
    unsafe fn fill<T>(
        &mut self,
        (references, count, values, length): Arrays<*mut T>,
        read: impl Fn(&mut Instance<S>, usize, u32, usize) -> Result<T>,
    ) -> Result<()> {
        // SAFETY: by the caller's promise.
        let references = unsafe { memory::slice(references, count, "the array of value references") }?;
        // SAFETY: by the caller's promise.
        let mut values = unsafe { memory::Output::new(values, length, "the array of values") }?;
        let elements = references.iter().map(|reference| self.instance.span(*reference)).sum();
        memory::check_length(length, elements, "the array of values")?;
        let mut index = 0;
        for (number, reference) in references.iter().enumerate() {
            for offset in 0..self.instance.span(*reference) {
                values.write(index, read(&mut self.instance, number, *reference, offset)?);
                index += 1;
            }
        }
        Ok(())
    }

    /// Sets variables from the importer's array: all, or none if one is refused. Nothing that can be set is an array.
    ///
    /// # Safety
    /// The arrays are null or have the length given.
    ///
    /// # Errors
    /// Bad pointers, wrong lengths, unknown references, other types, values out of range, wrong phase.
    unsafe fn set<T: Copy>(
        &mut self,
        (references, count, values, length): Arrays<*const T>,
        access: Access,
        convert: impl Fn(T) -> Value,
    ) -> Result<()> {
        memory::check_length(length, count, "the array of values")?;
        // SAFETY: by the caller's promise.
        let references = unsafe { memory::slice(references, count, "the array of value references") }?;
        // SAFETY: by the caller's promise.
        let values = unsafe { memory::slice(values, count, "the array of values") }?;
        self.instance.set(references, access, |index| convert(values[index]))
    }
}

/// The real in a value. A count read as a real is that number.
fn real(value: Value) -> Option<f64> {
    match value {
        Value::Real(real) => Some(real),
        Value::Integer(integer) => i32::try_from(integer).ok().map(f64::from),
    }
}

/// The integer in a value, if it fits.
fn whole<T: TryFrom<i64>>(value: Value) -> Option<T> {
    match value {
        Value::Integer(integer) => T::try_from(integer).ok(),
        Value::Real(_) => None,
    }
}
