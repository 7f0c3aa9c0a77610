//! Values of an instance by the functions of FMI 3.0 for their types.
#![allow(unsafe_code)] // C functions of a library that is known at run time alone

use std::ffi::{CStr, c_char, c_int, c_void};
use std::ptr::null;

use fmi_component::{Error, Kind, Result, Value, WholeSize};

use super::instance::Instance;

type Get<T> = unsafe extern "C" fn(*mut c_void, *const u32, usize, *mut T, usize) -> c_int;
type Set<T> = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const T, usize) -> c_int;
type GetBinary = unsafe extern "C" fn(*mut c_void, *const u32, usize, *mut usize, *mut *const u8, usize) -> c_int;

impl Instance {
    /// Sets all elements of a real variable.
    ///
    /// # Errors
    /// The library refuses.
    pub fn set(&mut self, reference: u32, values: &[f64]) -> Result<()> {
        self.set_all(c"fmi3SetFloat64", reference, values)
    }

    /// Reads the `span` elements of a variable as reals.
    ///
    /// # Errors
    /// The library refuses.
    pub fn get(&mut self, reference: u32, span: usize) -> Result<Vec<f64>> {
        self.get_all(c"fmi3GetFloat64", reference, span, f64::NAN)
    }

    /// Sets a scalar of this `kind`, which is no text and not binary.
    ///
    /// # Errors
    /// The library refuses; a whole number that is too large for its type.
    pub fn set_value(&mut self, kind: &Kind, reference: u32, value: Value) -> Result<()> {
        let number = value.to_f64();
        let Value::Integer(whole) = value else {
            return match kind {
                Kind::Single(_) => self.set_all(c"fmi3SetFloat32", reference, &[number as f32]),
                _ => self.set_all(c"fmi3SetFloat64", reference, &[number]),
            };
        };
        match kind {
            Kind::Boolean { .. } => self.set_all(c"fmi3SetBoolean", reference, &[u8::from(whole != 0)]),
            Kind::Integer { .. } => self.set_whole::<i32>(c"fmi3SetInt32", reference, whole),
            Kind::Sized { size, .. } => match size {
                WholeSize::Int8 => self.set_whole::<i8>(c"fmi3SetInt8", reference, whole),
                WholeSize::UInt8 => self.set_whole::<u8>(c"fmi3SetUInt8", reference, whole),
                WholeSize::Int16 => self.set_whole::<i16>(c"fmi3SetInt16", reference, whole),
                WholeSize::UInt16 => self.set_whole::<u16>(c"fmi3SetUInt16", reference, whole),
                WholeSize::UInt32 => self.set_whole::<u32>(c"fmi3SetUInt32", reference, whole),
                WholeSize::UInt64 => self.set_whole::<u64>(c"fmi3SetUInt64", reference, whole),
            },
            _ => self.set_whole::<i64>(c"fmi3SetInt64", reference, whole),
        }
    }

    /// Reads the `span` elements of a variable of this `kind`, which is no text and not binary.
    ///
    /// # Errors
    /// The library refuses.
    pub fn values(&mut self, kind: &Kind, reference: u32, span: usize) -> Result<Vec<Value>> {
        match kind {
            Kind::Real(_) => {
                let values = self.get(reference, span)?;
                Ok(values.into_iter().map(Value::Real).collect())
            }
            Kind::Single(_) => {
                let values = self.get_all(c"fmi3GetFloat32", reference, span, f32::NAN)?;
                Ok(values.into_iter().map(|value| Value::Real(value.into())).collect())
            }
            Kind::Boolean { .. } => self.whole::<u8>(c"fmi3GetBoolean", reference, span),
            Kind::Integer { .. } => self.whole::<i32>(c"fmi3GetInt32", reference, span),
            Kind::Sized { size, .. } => match size {
                WholeSize::Int8 => self.whole::<i8>(c"fmi3GetInt8", reference, span),
                WholeSize::UInt8 => self.whole::<u8>(c"fmi3GetUInt8", reference, span),
                WholeSize::Int16 => self.whole::<i16>(c"fmi3GetInt16", reference, span),
                WholeSize::UInt16 => self.whole::<u16>(c"fmi3GetUInt16", reference, span),
                WholeSize::UInt32 => self.whole::<u32>(c"fmi3GetUInt32", reference, span),
                WholeSize::UInt64 => self.whole::<u64>(c"fmi3GetUInt64", reference, span),
            },
            _ => self.whole::<i64>(c"fmi3GetInt64", reference, span),
        }
    }

    /// Reads a text.
    ///
    /// # Errors
    /// The library refuses, or gives no UTF-8.
    pub fn text(&mut self, reference: u32) -> Result<String> {
        let texts = self.get_all::<*const c_char>(c"fmi3GetString", reference, 1, null())?;
        if texts[0].is_null() {
            return Err(Error::call(
                format!("fmi3GetString gives no text for {reference}"),
                "Mend the library.",
            ));
        }
        // SAFETY: not null; the library promises a zero-terminated text that lives until the next call.
        let text = unsafe { CStr::from_ptr(texts[0]) };
        Ok(text.to_string_lossy().into_owned())
    }

    /// Reads a binary variable.
    ///
    /// # Errors
    /// The library refuses.
    pub fn bytes(&mut self, reference: u32) -> Result<Vec<u8>> {
        let get = self.library.symbol::<GetBinary>(c"fmi3GetBinary")?;
        let (mut size, mut bytes) = (0, null());
        // SAFETY: the signature is that of the standard; the pointers are to one living value each.
        let status = unsafe { get(self.pointer, &reference, 1, &mut size, &mut bytes, 1) };
        self.check("fmi3GetBinary", status)?;
        match bytes.is_null() || size == 0 {
            true => Ok(Vec::new()),
            // SAFETY: not null; the library promises `size` bytes that live until the next call.
            false => Ok(unsafe { std::slice::from_raw_parts(bytes, size) }.to_vec()),
        }
    }

    fn whole<T: Copy + Default + TryInto<i64>>(
        &mut self,
        function: &CStr,
        reference: u32,
        span: usize,
    ) -> Result<Vec<Value>> {
        let values = self.get_all(function, reference, span, T::default())?;
        let whole = |value: T| {
            let what = || Error::call("a whole number above 2^63 - 1", "This program reads none.");
            value.try_into().map(Value::Integer).map_err(|_| what())
        };
        values.into_iter().map(whole).collect()
    }

    fn set_whole<T: TryFrom<i64>>(&mut self, function: &CStr, reference: u32, whole: i64) -> Result<()> {
        let value = T::try_from(whole).map_err(|_| {
            let what = format!("{whole} is too large for {}", function.to_string_lossy());
            Error::call(what, "Give a smaller number.")
        })?;
        self.set_all(function, reference, &[value])
    }

    fn get_all<T: Copy>(&mut self, function: &CStr, reference: u32, span: usize, fill: T) -> Result<Vec<T>> {
        let get = self.library.symbol::<Get<T>>(function)?;
        let mut values = vec![fill; span];
        // SAFETY: the signature is that of the standard, by the callers' choice of T; the arrays have the lengths given.
        let status = unsafe { get(self.pointer, &reference, 1, values.as_mut_ptr(), span) };
        self.check(&function.to_string_lossy(), status).map(|()| values)
    }

    fn set_all<T>(&mut self, function: &CStr, reference: u32, values: &[T]) -> Result<()> {
        let set = self.library.symbol::<Set<T>>(function)?;
        // SAFETY: the signature is that of the standard, by the callers' choice of T; the arrays have the lengths given.
        let status = unsafe { set(self.pointer, &reference, 1, values.as_ptr(), values.len()) };
        self.check(&function.to_string_lossy(), status)
    }
}
