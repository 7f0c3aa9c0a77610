//! Values of variables: getters and setters of every type, alike in both versions but for the names of the functions.

use super::component::{Component, Entry};
use super::types::Status;
use crate::error::{Error, Result};
use crate::instance::{Access, Instance, does_not_fit};
use crate::life_cycle::Version;
use crate::memory;
use crate::value::Value;

/// The arrays of a getter (`T = *mut f64`) or setter (`T = *const f64`), each null or of the length given.
#[derive(Clone, Copy)]
pub struct Arrays<T> {
    /// Value references.
    pub references: *const u32,
    /// How many references there are.
    pub count: usize,
    /// Values.
    pub values: T,
    /// How many values there are; in FMI 2.0 as many as references.
    pub length: usize,
}

/// `fmi2GetReal`, `fmi3GetFloat64`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn get_real(entry: Entry, arrays: Arrays<*mut f64>) -> Status {
    // SAFETY: passed on.
    unsafe { entry.read(|component| component.get_reals(arrays, real_of(entry))) }
}

/// `fmi3GetFloat32`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn get_single(entry: Entry, arrays: Arrays<*mut f32>) -> Status {
    let read = |instance: &mut Instance, _, reference, offset| {
        let value = instance.element(reference, offset, Access::Single)?;
        Ok(value.to_f64() as f32)
    };
    // SAFETY: passed on.
    unsafe { entry.read_rarely(&mut |component| component.fill(arrays, read)) }
}

/// `fmi2GetInteger` and the getters of whole numbers of FMI 3.0.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn get_whole<T: TryFrom<i64>>(entry: Entry, arrays: Arrays<*mut T>, access: Access) -> Status {
    // SAFETY: passed on.
    unsafe { entry.read_rarely(&mut |component| component.get_whole(arrays, access)) }
}

/// `fmi2GetBoolean` with `T = c_int`, `fmi3GetBoolean` with a byte.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn get_boolean<T: From<bool>>(entry: Entry, arrays: Arrays<*mut T>) -> Status {
    let read = |instance: &mut Instance, _, reference, offset| {
        let value = instance.element(reference, offset, Access::Boolean)?;
        Ok(T::from(value != Value::Integer(0)))
    };
    // SAFETY: passed on.
    unsafe { entry.read_rarely(&mut |component| component.fill(arrays, read)) }
}

/// `fmi2SetReal`, `fmi3SetFloat64`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn set_real(entry: Entry, arrays: Arrays<*const f64>) -> Status {
    // SAFETY: passed on.
    unsafe { entry.set(|component| component.set_reals(arrays, real_of(entry))) }
}

/// `fmi3SetFloat32`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn set_single(entry: Entry, arrays: Arrays<*const f32>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.set_rarely(&mut |component| {
            component.set_any(arrays, Access::Single, |value| Some(Value::Real(value.into())))
        })
    }
}

/// `fmi2SetInteger` and the setters of whole numbers of FMI 3.0.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn set_whole<T: TryInto<i64> + Copy>(entry: Entry, arrays: Arrays<*const T>, access: Access) -> Status {
    let convert = |value: T| value.try_into().ok().map(Value::Integer);
    // SAFETY: passed on.
    unsafe { entry.set_rarely(&mut |component| component.set_any(arrays, access, convert)) }
}

/// `fmi2SetBoolean` with `T = c_int`, `fmi3SetBoolean` with a byte. Anything but 0 is true, as in C.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn set_boolean<T: Default + PartialEq + Copy>(entry: Entry, arrays: Arrays<*const T>) -> Status {
    let convert = |value: T| Some(Value::from(value != T::default()));
    // SAFETY: passed on.
    unsafe { entry.set_rarely(&mut |component| component.set_any(arrays, Access::Boolean, convert)) }
}

/// FMI 2.0 has one type of reals.
fn real_of(entry: Entry) -> Access {
    match entry.version {
        Version::Two => Access::AnyReal,
        Version::Three => Access::Real,
    }
}

#[cold]
fn above_what_is_held(reference: u32) -> Error {
    Error::call(
        format!(
            "the value for value reference {reference} is above 9223372036854775807, the largest whole number that is held"
        ),
        "Give a smaller one.",
    )
}

/// `fmi2GetRealOutputDerivatives`, `fmi3GetOutputDerivatives`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`]; `orders` is null or has as many elements as there are references.
pub unsafe fn get_output_derivatives(entry: Entry, orders: *const i32, arrays: Arrays<*mut f64>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.read(|component| {
            let orders = memory::slice(orders, arrays.count, "the array of orders")?;
            component.fill(arrays, |instance, number, reference, offset| {
                instance.output_derivative(reference, offset, orders[number])
            })
        })
    }
}

/// `fmi2SetRealInputDerivatives`. FMI 3.0 has no such function.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`]; `orders` is null or has as many elements as there are references.
pub unsafe fn set_input_derivatives(entry: Entry, orders: *const i32, arrays: Arrays<*const f64>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.change(|component| {
            let references = memory::slice(arrays.references, arrays.count, "the array of value references")?;
            let orders = memory::slice(orders, arrays.count, "the array of orders")?;
            let values = memory::slice(arrays.values, arrays.length, "the array of values")?;
            component.instance.set_input_derivatives(references, orders, values)
        })
    }
}

impl Component {
    /// Reads variables as reals into the importer's array.
    ///
    /// # Safety
    /// As for [`Arrays`].
    ///
    /// # Errors
    /// Bad pointers, wrong lengths, unknown references, other types, not computed yet.
    unsafe fn get_reals(&mut self, arrays: Arrays<*mut f64>, access: Access) -> Result<()> {
        if arrays.count == arrays.length && arrays.count <= self.instance.scalars() {
            // SAFETY: by the caller's promise.
            let references =
                unsafe { memory::slice(arrays.references, arrays.count, "the array of value references") }?;
            // SAFETY: by the caller's promise.
            let mut values = unsafe { memory::Output::new(arrays.values, arrays.length, "the array of values") }?;
            self.reals.resize(arrays.length, 0.0);
            if self.instance.get_run(references, &mut self.reals)? {
                values.write_all(&self.reals);
                return Ok(());
            }
        }
        // SAFETY: by the caller's promise.
        let (references, mut values) = unsafe { self.request(arrays) }?;
        self.reals.resize(arrays.length, 0.0);
        self.instance.get_reals(references, &mut self.reals, access)?;
        values.write_all(&self.reals);
        Ok(())
    }

    /// Reads variables as whole numbers into the importer's array.
    ///
    /// # Safety
    /// As for [`Arrays`].
    ///
    /// # Errors
    /// As [`Component::get_reals`].
    unsafe fn get_whole<T: TryFrom<i64>>(&mut self, arrays: Arrays<*mut T>, access: Access) -> Result<()> {
        let read = |instance: &mut Instance, _, reference, offset| {
            let value = instance.element(reference, offset, access)?;
            whole(value).ok_or_else(|| does_not_fit(reference, value))
        };
        // SAFETY: by the caller's promise.
        unsafe { self.fill(arrays, read) }
    }

    /// The importer's arrays of a getter, of the right lengths.
    ///
    /// # Safety
    /// As for [`Arrays`].
    pub(super) unsafe fn request<'a, T>(&self, arrays: Arrays<*mut T>) -> Result<(&'a [u32], memory::Output<T>)> {
        // SAFETY: by the caller's promise.
        let references = unsafe { memory::slice(arrays.references, arrays.count, "the array of value references") }?;
        // SAFETY: by the caller's promise.
        let values = unsafe { memory::Output::new(arrays.values, arrays.length, "the array of values") }?;
        let elements = references.iter().map(|reference| self.instance.span(*reference)).sum();
        memory::check_length(arrays.length, elements, "the array of values")?;
        Ok((references, values))
    }

    /// Fills the importer's array with what `read` gives for each element: number of the reference, reference, offset.
    ///
    /// # Safety
    /// As for [`Arrays`].
    ///
    /// # Errors
    /// Bad pointers, wrong lengths, and what `read` refuses.
    unsafe fn fill<T>(
        &mut self,
        arrays: Arrays<*mut T>,
        read: impl Fn(&mut Instance, usize, u32, usize) -> Result<T>,
    ) -> Result<()> {
        // SAFETY: by the caller's promise.
        let (references, mut values) = unsafe { self.request(arrays) }?;
        let mut index = 0;
        for (number, reference) in references.iter().enumerate() {
            for offset in 0..self.instance.span(*reference) {
                values.write(index, read(&mut self.instance, number, *reference, offset)?);
                index += 1;
            }
        }
        Ok(())
    }

    /// Sets reals from the importer's array: all, or none if one is refused.
    ///
    /// # Safety
    /// As for [`Arrays`].
    ///
    /// # Errors
    /// Bad pointers, wrong lengths, unknown references, other types, values out of range, wrong phase.
    unsafe fn set_reals(&mut self, arrays: Arrays<*const f64>, access: Access) -> Result<()> {
        // SAFETY: by the caller's promise.
        let references = unsafe { memory::slice(arrays.references, arrays.count, "the array of value references") }?;
        // SAFETY: by the caller's promise.
        let values = unsafe { memory::slice(arrays.values, arrays.length, "the array of values") }?;
        match arrays.length == arrays.count {
            true => self.instance.set_reals(references, access, values),
            false => self
                .instance
                .set_elements(references, access, values.len(), |index| Value::Real(values[index])),
        }
    }

    /// Sets scalars of any other type from the importer's array: all, or none if one is refused.
    ///
    /// # Safety
    /// As for [`Arrays`].
    ///
    /// # Errors
    /// As [`Component::set_reals`]; a value that cannot be held.
    unsafe fn set_any<T: Copy>(
        &mut self,
        arrays: Arrays<*const T>,
        access: Access,
        convert: impl Fn(T) -> Option<Value>,
    ) -> Result<()> {
        memory::check_length(arrays.length, arrays.count, "the array of values")?;
        // SAFETY: by the caller's promise.
        let references = unsafe { memory::slice(arrays.references, arrays.count, "the array of value references") }?;
        // SAFETY: by the caller's promise.
        let values = unsafe { memory::slice(arrays.values, arrays.length, "the array of values") }?;
        let held: Vec<Value> = values.iter().map_while(|value| convert(*value)).collect();
        if let Some(refused) = references.get(held.len()) {
            return Err(above_what_is_held(*refused));
        }
        self.store(references, access, &held)
    }

    fn store(&mut self, references: &[u32], access: Access, values: &[Value]) -> Result<()> {
        self.instance.set(references, access, |index| values[index])
    }
}

/// The integer in a value, if it fits.
fn whole<T: TryFrom<i64>>(value: Value) -> Option<T> {
    match value {
        Value::Integer(integer) => T::try_from(integer).ok(),
        Value::Real(_) => None,
    }
}
