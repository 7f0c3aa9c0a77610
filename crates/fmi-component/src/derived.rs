//! What the code calls that `#[derive(Component)]` writes. Not meant to be called by hand.
#![allow(missing_docs)] // each is a part of a row, and stands in for a line of generated code

use std::borrow::Cow;
use std::ops::RangeInclusive;
use std::sync::Arc;

pub use serde;

use crate::enumeration::Enumeration;
use crate::error::{Error, Result};
use crate::kind::{Kind, Quantity, WholeSize};
use crate::row::{Fill, Read, Row};
use crate::unit::Unit;
use crate::value::Value;
use crate::values::Values;
use crate::variable::Causality;

/// Size of a typical value where none is said: that of the start value.
pub fn quantity(unit: Unit, min: f64, max: f64, nominal: Option<f64>, start: f64) -> Quantity {
    let typical = if start == 0.0 { 1.0 } else { start.abs() };
    Quantity {
        unit,
        min,
        max,
        nominal: nominal.unwrap_or(typical),
        start,
    }
}

pub fn single(unit: Unit, min: f32, max: f32, nominal: Option<f32>, start: f32) -> Quantity {
    let [min, max, start] = [min, max, start].map(f64::from);
    quantity(unit, min, max, nominal.map(f64::from), start)
}

pub fn text(start: &'static str) -> Kind {
    Kind::Text {
        start: Cow::Borrowed(start),
    }
}

pub fn binary(start: &'static [u8], mime_type: &'static str) -> Kind {
    Kind::Binary {
        start: Cow::Borrowed(start),
        mime_type: Cow::Borrowed(mime_type),
    }
}

pub fn bytes(start: &[u8]) -> Vec<u8> {
    start.to_vec()
}

pub fn options<E: Enumeration>(start: E) -> Kind {
    Kind::Enumeration {
        type_name: E::NAME,
        options: E::OPTIONS,
        start: start.number(),
    }
}

/// A whole number of Rust that can be a variable.
pub trait WholeNumber: Copy + TryFrom<i64> + TryInto<i64> + std::fmt::Display {
    fn kind(range: RangeInclusive<i64>, start: i64) -> Kind;
}

macro_rules! whole_numbers {
    ($($of:ty: $size:ident),*) => {$(
        impl WholeNumber for $of {
            fn kind(range: RangeInclusive<i64>, start: i64) -> Kind {
                Kind::Sized { size: WholeSize::$size, range, start }
            }
        }
    )*};
}

whole_numbers!(i8: Int8, u8: UInt8, i16: Int16, u16: UInt16, u32: UInt32, u64: UInt64);

impl WholeNumber for i32 {
    fn kind(range: RangeInclusive<i64>, start: i64) -> Kind {
        Kind::Integer { range, start }
    }
}

impl WholeNumber for i64 {
    fn kind(range: RangeInclusive<i64>, start: i64) -> Kind {
        Kind::Long { range, start }
    }
}

/// Kind of a whole number; what is above 2^63 - 1 is not held.
pub fn whole<T: WholeNumber>(min: T, max: T, start: T) -> Kind {
    let [min, max, start] = [min, max, start].map(|value| value.try_into().unwrap_or(i64::MAX));
    T::kind(min..=max, start)
}

/// A computed whole number as variables hold it. One above 2^63 - 1 is a defect of the component and panics.
pub fn number<T: WholeNumber>(value: T) -> i64 {
    let held: std::result::Result<i64, _> = value.try_into();
    held.unwrap_or_else(|_| {
        panic!("a whole number of the component is {value}, above 2^63 - 1, the largest that is held")
    })
}

/// Reads elements of an array from an index on.
type ReadElements<M> = fn(&M, usize, &mut [f64]);

/// The rows of an array, each a scalar: `name[1]`, or `name[1,1]` with two dimensions.
pub fn array<M: 'static>(
    name: &str,
    description: &str,
    causality: Causality,
    kind: Kind,
    dimensions: &[usize],
    start: &[f64],
    fill: Option<ReadElements<M>>,
) -> Vec<Row<M>> {
    let count = start.len();
    let shared: Option<Fill<M>> = match fill {
        Some(fill) => Some(Arc::new(fill)),
        None => None,
    };
    let what = description.trim_end_matches('.');
    let row = |(index, start): (usize, &f64)| {
        let number = match dimensions {
            [_, columns] => format!("{},{}", index / columns + 1, index % columns + 1),
            _ => (index + 1).to_string(),
        };
        let mut kind = kind.clone();
        if let Kind::Real(quantity) = &mut kind {
            quantity.start = *start;
        }
        let read = shared.as_ref().map(|fill| Read::RealArray {
            fill: Arc::clone(fill),
            index,
            count,
        });
        let description = format!("{what}, element {number}.");
        Row::new(format!("{name}[{number}]"), description, causality, kind, read)
    };
    start.iter().enumerate().map(row).collect()
}

/// Names the derivative of each of `rows`: that of an element has its index.
pub fn derive<M>(rows: &mut [Row<M>], derivative: &str) {
    for row in rows {
        let index = row.variable.name.find('[').map_or("", |at| &row.variable.name[at..]);
        row.variable.derivative = Some(format!("{derivative}{index}"));
    }
}

/// Copies the saved elements of an array.
///
/// # Errors
/// There are others than the array has.
pub fn copy(saved: &[f64], array: &mut [f64]) -> Result<()> {
    if saved.len() != array.len() {
        return Err(Error::state(
            format!(
                "an array in it has {} elements, that of the model {}",
                saved.len(),
                array.len()
            ),
            "Restore it with the FMU that wrote it.",
        ));
    }
    array.copy_from_slice(saved);
    Ok(())
}

/// Parameters and inputs, one after the other as the table lists them.
#[derive(Debug)]
pub struct Given<'values> {
    values: &'values Values,
    position: usize,
}

impl<'values> Given<'values> {
    pub(crate) fn new(values: &'values Values) -> Self {
        Self { values, position: 0 }
    }

    pub fn skip(&mut self, count: usize) {
        self.position += count;
    }

    fn next(&mut self) -> Value {
        self.position += 1;
        let value = self.values.get(self.position - 1);
        value.unwrap_or_else(|| panic!("the table has no parameter or input number {}", self.position))
    }

    pub fn real(&mut self) -> f64 {
        self.next().to_f64()
    }

    pub fn reals(&mut self, out: &mut [f64]) {
        let first = self.position;
        self.position += out.len();
        let Some(values) = self.values.as_slice().get(first..self.position) else {
            panic!("the table has no parameter or input number {}", self.position);
        };
        for (real, value) in out.iter_mut().zip(values) {
            *real = value.to_f64();
        }
    }

    pub fn integer(&mut self) -> i64 {
        match self.next() {
            Value::Integer(integer) => integer,
            Value::Real(real) => panic!("parameter or input number {} is the real {real}", self.position),
        }
    }

    pub fn whole<T: WholeNumber>(&mut self) -> T {
        let integer = self.integer();
        T::try_from(integer).unwrap_or_else(|_| panic!("{integer} does not fit its type"))
    }

    pub fn option<E: Enumeration>(&mut self) -> E {
        let number = self.integer();
        E::of_number(number).unwrap_or_else(|| panic!("no option has the number {number}"))
    }

    pub fn bytes(&mut self) -> Vec<u8> {
        self.position += 1;
        self.values.bytes(self.position - 1).unwrap_or_default().to_vec()
    }

    pub fn text(&mut self) -> String {
        String::from_utf8(self.bytes()).unwrap_or_default()
    }
}
