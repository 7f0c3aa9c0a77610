//! By which functions of the standards a variable may be read and written, worked out once for each instance.

use crate::arrays;
use crate::kind::{Kind, WholeSize};
use crate::variable::{Causality, Variable};

/// The type by which an importer reads or writes a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// `fmi3Float64`.
    Real,
    /// `fmi3Int32`.
    Integer,
    /// `fmi3Int64`, which serves enumerations too.
    Long,
    /// `fmi2Integer`, which serves all whole numbers.
    AnyInteger,
    /// `fmi2Real`, which serves reals of either size.
    AnyReal,
    /// `fmi3Float32`.
    Single,
    /// `fmi3Int8`.
    Int8,
    /// `fmi3UInt8`.
    UInt8,
    /// `fmi3Int16`.
    Int16,
    /// `fmi3UInt16`.
    UInt16,
    /// `fmi3UInt32`.
    UInt32,
    /// `fmi3UInt64`.
    UInt64,
    /// `fmi2Boolean`, `fmi3Boolean`.
    Boolean,
    /// `fmi2String`, `fmi3String`.
    Text,
    /// `fmi3Binary`.
    Binary,
}

impl Access {
    const ALL: [Self; 15] = [
        Self::Real,
        Self::Integer,
        Self::Long,
        Self::AnyInteger,
        Self::AnyReal,
        Self::Single,
        Self::Int8,
        Self::UInt8,
        Self::Int16,
        Self::UInt16,
        Self::UInt32,
        Self::UInt64,
        Self::Boolean,
        Self::Text,
        Self::Binary,
    ];

    /// A count or an option among the outputs may be read as a real too: there are importers that read all outputs so.
    fn fits(self, variable: &Variable) -> bool {
        let is_real = matches!(self, Self::Real | Self::AnyReal);
        let read_as_real = is_real && variable.causality == Causality::Output;
        match variable.kind {
            Kind::Real(_) => is_real,
            Kind::Single(_) => matches!(self, Self::Single | Self::AnyReal),
            Kind::Integer { .. } => matches!(self, Self::Integer | Self::AnyInteger) || read_as_real,
            Kind::Enumeration { .. } => matches!(self, Self::Long | Self::AnyInteger) || read_as_real,
            Kind::Long { .. } => matches!(self, Self::Long | Self::AnyInteger),
            Kind::Sized { size, .. } => self == Self::AnyInteger || self == Self::of(size),
            Kind::Boolean { .. } => self == Self::Boolean,
            Kind::Text { .. } => self == Self::Text,
            Kind::Binary { .. } => self == Self::Binary,
        }
    }

    fn of(size: WholeSize) -> Self {
        match size {
            WholeSize::Int8 => Self::Int8,
            WholeSize::UInt8 => Self::UInt8,
            WholeSize::Int16 => Self::Int16,
            WholeSize::UInt16 => Self::UInt16,
            WholeSize::UInt32 => Self::UInt32,
            WholeSize::UInt64 => Self::UInt64,
        }
    }
}

/// What each get and set looks up of a variable.
pub(super) struct Slot {
    /// Elements of the variable: 1 for a scalar, 0 inside of an array.
    pub(super) span: usize,
    /// Bit n is set if access number n fits.
    pub(super) accesses: u16,
    pub(super) computed: bool,
    /// Of a [`Kind::Real`].
    pub(super) real: bool,
    /// How many scalars from this one on are such reals and all computed or all given; none, if this is none.
    pub(super) run: u32,
    /// What a scalar [`Kind::Real`] among the inputs may be given; nothing, if it is none.
    pub(super) signal: [f64; 2],
}

impl Slot {
    /// Those of `variables`, of which those with an index are `arrays` or scalars.
    pub(super) fn of(variables: &[Variable], arrays: bool) -> Vec<Self> {
        let spans = match arrays {
            true => arrays::spans(variables),
            false => vec![1; variables.len()],
        };
        let slot = |(variable, span): (&Variable, usize)| Self {
            span,
            accesses: Access::ALL
                .iter()
                .map(|access| u16::from(access.fits(variable)) << *access as u16)
                .sum(),
            computed: !variable.causality.is_settable(),
            real: matches!(variable.kind, Kind::Real(_)),
            run: 0,
            signal: match variable.kind {
                Kind::Real(ref quantity) if variable.causality == Causality::Input && span == 1 => {
                    [quantity.min, quantity.max]
                }
                _ => [f64::INFINITY, f64::NEG_INFINITY],
            },
        };
        let mut slots: Vec<Self> = variables.iter().zip(spans).map(slot).collect();
        let (mut run, mut computed) = (0, false);
        for slot in slots.iter_mut().rev() {
            run = match (slot.real && slot.span == 1, slot.computed == computed) {
                (true, true) => run + 1,
                (true, false) => 1,
                (false, _) => 0,
            };
            (slot.run, computed) = (run, slot.computed);
        }
        slots
    }
}
