//! The functions that JavaScript calls. WebAssembly has numbers only: a text is written into [`jostle_room`] first, and read back
//! from [`jostle_text`]. Functions that can fail return -1, and the text is then what is wrong.
// no_mangle: the names are those of the module's exports; nothing else here is unsafe. They have a prefix since `open`, `read`
// and `close` of a program that links this crate for its tests would take the place of the C library's.
#![allow(unsafe_code)]

use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use jostle::Result;

use crate::module::Module;

static MODULE: LazyLock<Mutex<Module>> = LazyLock::new(Mutex::default);

/// What a panic said: it ends the module, whose memory can still be read.
static PANIC: Mutex<String> = Mutex::new(String::new());

fn module() -> MutexGuard<'static, Module> {
    MODULE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The value, or -1 with the error in the text.
fn told<T>(work: impl FnOnce(&mut Module) -> Result<T>, value: impl FnOnce(T) -> i32) -> i32 {
    let mut module = module();
    match work(&mut module) {
        Ok(found) => value(found),
        Err(error) => {
            module.text = error.to_string().into_bytes();
            -1
        }
    }
}

/// To be called once, before all else.
#[unsafe(no_mangle)]
pub extern "C" fn jostle_prepare() {
    std::panic::set_hook(Box::new(|info| {
        *PANIC.lock().unwrap_or_else(PoisonError::into_inner) = info.to_string();
    }));
}

/// Address of room for a text of so many bytes, which the page fills before it calls [`jostle_open`].
#[unsafe(no_mangle)]
pub extern "C" fn jostle_room(length: usize) -> *mut u8 {
    let mut module = module();
    module.text = vec![0; length];
    module.text.as_mut_ptr()
}

/// Address of the text.
#[unsafe(no_mangle)]
pub extern "C" fn jostle_text() -> *const u8 {
    module().text.as_ptr()
}

/// Bytes of the text.
#[unsafe(no_mangle)]
pub extern "C" fn jostle_text_length() -> usize {
    module().text.len()
}

/// Address of what a panic said.
#[unsafe(no_mangle)]
pub extern "C" fn jostle_panic_text() -> *const u8 {
    PANIC.lock().unwrap_or_else(PoisonError::into_inner).as_ptr()
}

/// Bytes of it.
#[unsafe(no_mangle)]
pub extern "C" fn jostle_panic_length() -> usize {
    PANIC.lock().unwrap_or_else(PoisonError::into_inner).len()
}

/// Address of the numbers, doubles, which the next call may move.
#[unsafe(no_mangle)]
pub extern "C" fn jostle_numbers() -> *const f64 {
    module().numbers.as_ptr()
}

/// [`Module::scenes`].
#[unsafe(no_mangle)]
pub extern "C" fn jostle_scenes() {
    module().scenes();
}

/// [`Module::open`].
#[unsafe(no_mangle)]
pub extern "C" fn jostle_open() -> i32 {
    told(Module::open, |number| number as i32)
}

/// [`Module::close`].
#[unsafe(no_mangle)]
pub extern "C" fn jostle_close(number: usize) {
    module().close(number);
}

/// [`Module::variables`].
#[unsafe(no_mangle)]
pub extern "C" fn jostle_variables(number: usize) -> i32 {
    told(|module| module.variables(number), |()| 0)
}

/// [`Module::warnings`].
#[unsafe(no_mangle)]
pub extern "C" fn jostle_warnings(number: usize) -> i32 {
    told(|module| module.warnings(number), |()| 0)
}

/// [`Module::advance`].
#[unsafe(no_mangle)]
pub extern "C" fn jostle_advance(number: usize, time: f64) -> i32 {
    told(|module| module.advance(number, time), |()| 0)
}

/// [`Module::read`].
#[unsafe(no_mangle)]
pub extern "C" fn jostle_read(number: usize, first: usize, count: usize) -> i32 {
    told(|module| module.read(number, first, count), |()| 0)
}

/// [`Module::contacts`]; how many there are.
#[unsafe(no_mangle)]
pub extern "C" fn jostle_contacts(number: usize) -> i32 {
    told(
        |module| module.contacts(number).map(|()| module.numbers.len() / 9),
        |count| count as i32,
    )
}
