//! Reading and writing a C caller's memory: null, length and alignment are checked before anything is touched.
#![allow(unsafe_code)] // pointers of a C caller are followed here

use std::ffi::{CStr, c_char};

use crate::error::{Error, Result};

/// What to pass where one value is read or written.
const ONE: &str = "Pass the address of one value.";
/// What to pass where the caller says how many there are.
const MANY: &str = "Pass an array of the length that is given with it.";

/// The caller's array as a slice. Null is legal when `count` is 0.
///
/// # Safety
/// If `pointer` is not null, `count` elements behind it may be read while `'a` lasts and are valid values of `T`.
///
/// # Errors
/// Null, misaligned or impossibly long.
pub unsafe fn slice<'a, T>(pointer: *const T, count: usize, name: &str) -> Result<&'a [T]> {
    if count == 0 {
        return Ok(&[]);
    }
    check(pointer, count, name, MANY)?;
    // SAFETY: not null, aligned and of a possible size (checked); readable by the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// The caller's array to be filled. It need not hold valid values yet, so no slice is made of it.
pub struct Output<T> {
    pointer: *mut T,
    count: usize,
}

impl<T> Output<T> {
    /// Checks the array. Null is legal when `count` is 0.
    ///
    /// # Safety
    /// If `pointer` is not null, `count` elements behind it may be written while the value lives.
    ///
    /// # Errors
    /// Null, misaligned or impossibly long.
    pub unsafe fn new(pointer: *mut T, count: usize, name: &str) -> Result<Self> {
        if count > 0 {
            check(pointer, count, name, MANY)?;
        }
        Ok(Self { pointer, count })
    }

    /// Writes element `index`; beyond the end nothing is written.
    pub fn write(&mut self, index: usize, value: T) {
        if index < self.count {
            // SAFETY: inside the array that `new` checked and its caller vouched for.
            unsafe { self.pointer.add(index).write(value) };
        }
    }

    /// Writes all `values`, as many as there is room for.
    pub fn write_all(&mut self, values: &[T])
    where
        T: Copy,
    {
        let count = values.len().min(self.count);
        if count > 0 {
            // SAFETY: inside the array that `new` checked and its caller vouched for; memory of ours does not overlap it.
            unsafe { self.pointer.copy_from_nonoverlapping(values.as_ptr(), count) };
        }
    }
}

/// Reads one value, such as a handle that is to be replaced.
///
/// # Safety
/// If `pointer` is not null, it may be read and holds a valid value of `T`.
///
/// # Errors
/// Null or misaligned.
pub unsafe fn read<T: Copy>(pointer: *const T, name: &str) -> Result<T> {
    check(pointer, 1, name, ONE)?;
    // SAFETY: not null and aligned (checked); readable by the caller's promise.
    Ok(unsafe { pointer.read() })
}

/// Writes one value.
///
/// # Safety
/// If `pointer` is not null, it may be written.
///
/// # Errors
/// Null or misaligned.
pub unsafe fn write<T>(pointer: *mut T, value: T, name: &str) -> Result<()> {
    check(pointer, 1, name, ONE)?;
    // SAFETY: not null and aligned (checked); writable by the caller's promise.
    unsafe { pointer.write(value) };
    Ok(())
}

/// Copies a C string.
///
/// # Safety
/// If `pointer` is not null, it points to a string that ends with a zero byte.
///
/// # Errors
/// Null or not UTF-8.
pub unsafe fn text(pointer: *const c_char, name: &str) -> Result<String> {
    check(pointer, 1, name, "Pass a text that ends with a zero byte.")?;
    // SAFETY: not null (checked); zero-terminated by the caller's promise.
    let bytes = unsafe { CStr::from_ptr(pointer) };
    bytes
        .to_str()
        .map(String::from)
        .map_err(|_| Error::call(format!("{name} is not UTF-8"), "Pass UTF-8."))
}

/// Refuses arrays of other lengths than the standard's.
///
/// # Errors
/// `count` differs from `expected`.
pub fn check_length(count: usize, expected: usize, name: &str) -> Result<()> {
    if count == expected {
        return Ok(());
    }
    Err(Error::call(
        format!("{name} has {count} elements, expected are {expected}"),
        "Pass one value for each scalar, and as many as its dimension says for each array.",
    ))
}

#[inline]
fn check<T>(pointer: *const T, count: usize, name: &str, remedy: &str) -> Result<()> {
    let possible = count <= isize::MAX as usize / size_of::<T>().max(1);
    match !pointer.is_null() && pointer.is_aligned() && possible {
        true => Ok(()),
        false => Err(fault(pointer.is_null(), pointer.is_aligned(), name, remedy)),
    }
}

#[cold]
fn fault(null: bool, aligned: bool, name: &str, remedy: &str) -> Error {
    let fault = match (null, aligned) {
        (true, _) => "is a null pointer",
        (_, false) => "is not aligned for its type",
        _ => "is longer than memory can be",
    };
    Error::call(format!("{name} {fault}"), remedy)
}
