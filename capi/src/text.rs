//! Texts into the caller's memory.

use std::ffi::c_char;

use fmi_component::memory;
use jostle::Result;

/// Writes as much of `text` as fits, a zero byte behind it, and returns the size of all of it with the zero byte.
///
/// # Safety
/// `buffer` is null or has `size` bytes.
pub unsafe fn write(text: &str, buffer: *mut c_char, size: usize) -> usize {
    // Zero bytes would end the text early; our own texts have none, but they may quote the caller's.
    let text = text.replace('\0', "\u{fffd}");
    // SAFETY: by the caller's promise.
    let output = unsafe { memory::Output::new(buffer.cast::<u8>(), size, "the text") };
    if let Ok(mut output) = output
        && size > 0
    {
        let fits = text.floor_char_boundary(size - 1);
        for (index, byte) in text.as_bytes()[..fits].iter().enumerate() {
            output.write(index, *byte);
        }
        output.write(fits, 0);
    }
    text.len() + 1
}

/// A text that may be left out.
///
/// # Safety
/// `pointer` is null or a text that ends with a zero byte.
///
/// # Errors
/// Not UTF-8.
pub unsafe fn optional(pointer: *const c_char, name: &str) -> Result<Option<String>> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: by the caller's promise.
    unsafe { memory::text(pointer, name) }.map(Some)
}
