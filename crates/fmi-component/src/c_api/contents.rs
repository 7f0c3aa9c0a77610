//! Texts and binary variables: getters that lend memory to the importer, and setters that copy its own.
//!
//! What is lent lives until the next call for the same instance that lends, which is longer than both standards ask for.

use std::ffi::c_char;

use super::component::{Component, Entry};
use super::types::Status;
use super::values::Arrays;
use crate::error::Result;
use crate::instance::Access;
use crate::memory;

/// `fmi2GetString`, `fmi3GetString`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`].
pub unsafe fn get_text(entry: Entry, arrays: Arrays<*mut *const c_char>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.read_rarely(&mut |component| {
            let (references, mut values) = component.request(arrays)?;
            component.lend(references, Access::Text)?;
            for (index, text) in component.lent.iter().enumerate() {
                values.write(index, text.as_ptr().cast());
            }
            Ok(())
        })
    }
}

/// `fmi3GetBinary`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`]; `sizes` is null or has as many elements as there are values.
pub unsafe fn get_binary(entry: Entry, sizes: *mut usize, arrays: Arrays<*mut *const u8>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.read_rarely(&mut |component| {
            let (references, mut values) = component.request(arrays)?;
            let mut sizes = memory::Output::new(sizes, arrays.length, "the array of sizes")?;
            component.lend(references, Access::Binary)?;
            for (index, bytes) in component.lent.iter().enumerate() {
                values.write(index, bytes.as_ptr());
                sizes.write(index, bytes.len() - 1);
            }
            Ok(())
        })
    }
}

/// `fmi2SetString`, `fmi3SetString`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`]; the texts are null or zero-terminated.
pub unsafe fn set_text(entry: Entry, arrays: Arrays<*const *const c_char>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.set_rarely(&mut |component| {
            memory::check_length(arrays.length, arrays.count, "the array of values")?;
            let references = memory::slice(arrays.references, arrays.count, "the array of value references")?;
            let pointers = memory::slice(arrays.values, arrays.count, "the array of values")?;
            let texts: Result<Vec<String>> = pointers.iter().map(|text| memory::text(*text, "a text")).collect();
            let texts = texts?;
            let contents: Vec<&[u8]> = texts.iter().map(String::as_bytes).collect();
            component.instance.set_bytes(references, Access::Text, &contents)
        })
    }
}

/// `fmi3SetBinary`.
///
/// # Safety
/// As for [`Entry::change`] and [`Arrays`]; `sizes` is null or has as many elements as there are values, and each value is null or has
/// as many bytes as its size says.
pub unsafe fn set_binary(entry: Entry, sizes: *const usize, arrays: Arrays<*const *const u8>) -> Status {
    // SAFETY: passed on.
    unsafe {
        entry.set_rarely(&mut |component| {
            memory::check_length(arrays.length, arrays.count, "the array of values")?;
            let references = memory::slice(arrays.references, arrays.count, "the array of value references")?;
            let pointers = memory::slice(arrays.values, arrays.count, "the array of values")?;
            let sizes = memory::slice(sizes, arrays.count, "the array of sizes")?;
            let pairs = pointers.iter().zip(sizes);
            let contents: Result<Vec<&[u8]>> = pairs
                .map(|(bytes, size)| memory::slice(*bytes, *size, "a binary value"))
                .collect();
            component.instance.set_bytes(references, Access::Binary, &contents?)
        })
    }
}

impl Component {
    /// Keeps copies of what `references` hold, each with a zero byte at its end, for the importer to read.
    ///
    /// # Errors
    /// As [`Instance::get_bytes`](crate::Instance::get_bytes).
    fn lend(&mut self, references: &[u32], access: Access) -> Result<()> {
        self.lent.clear();
        for reference in references {
            let bytes = self.instance.get_bytes(*reference, access)?;
            let mut copy = Vec::with_capacity(bytes.len() + 1);
            copy.extend_from_slice(bytes);
            copy.push(0);
            self.lent.push(copy);
        }
        Ok(())
    }
}
