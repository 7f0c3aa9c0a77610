//! One row per variable of a model `M`: what is known of it, and how its value is read.

use std::ops::RangeInclusive;
use std::sync::Arc;

use crate::kind::{Kind, Quantity};
use crate::recommended::{Derived, Recommended};
use crate::unit::Unit;
use crate::value::Value;
use crate::variable::{Causality, TerminalMember, Variable};

/// Fills a slice with the elements of a real array from an index on, counted from 0.
pub(crate) type Fill<M> = Arc<dyn Fn(&M, usize, &mut [f64]) + Send + Sync>;

/// How the value of a computed variable is read from a model. Reading changes nothing.
pub enum Read<M> {
    /// A real.
    Real(fn(&M) -> f64),
    /// Element of a real array whose elements are variables in a row.
    RealArray {
        /// Reads any number of them.
        fill: Fill<M>,
        /// Number of the element, counted from 0.
        index: usize,
        /// Elements of the array.
        count: usize,
    },
    /// A whole number, the number of an option, or 1 for true and 0 for false.
    Integer(fn(&M) -> i64),
    /// The bytes of a text, or those of a binary variable.
    Bytes(fn(&M) -> &[u8]),
}

// A derived one would ask for M: Clone.
impl<M> Clone for Read<M> {
    fn clone(&self) -> Self {
        match *self {
            Self::Real(read) => Self::Real(read),
            Self::RealArray { ref fill, index, count } => Self::RealArray {
                fill: Arc::clone(fill),
                index,
                count,
            },
            Self::Integer(read) => Self::Integer(read),
            Self::Bytes(read) => Self::Bytes(read),
        }
    }
}

impl<M> std::fmt::Debug for Read<M> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("Read")
    }
}

impl<M> Read<M> {
    /// The present value.
    pub fn value(&self, model: &M) -> Value {
        let mut real = [0.0];
        match *self {
            Self::Integer(read) => Value::Integer(read(model)),
            Self::Bytes(read) => Value::Integer(read(model).len() as i64),
            _ => {
                self.fill(model, &mut real);
                Value::Real(real[0])
            }
        }
    }

    /// Fills `out`, which is not empty, from its beginning with this value and, of an array, with the elements that follow;
    /// gives how many values that were. Whole numbers are read by [`Read::value`] alone: none is filled.
    #[inline]
    pub(crate) fn fill(&self, model: &M, out: &mut [f64]) -> usize {
        match *self {
            Self::Real(read) => out[0] = read(model),
            Self::RealArray { ref fill, index, count } => {
                let filled = out.len().min(count - index);
                fill(model, index, &mut out[..filled]);
                return filled;
            }
            Self::Integer(_) | Self::Bytes(_) => return 0,
        }
        1
    }
}

/// A variable of a model `M`. Made by the constructors, refined by the methods that return it.
///
/// ```
/// use fmi_component::{Row, Unit};
///
/// struct Pendulum { angle: f64, rate: f64 }
///
/// let rows: Vec<Row<Pendulum>> = vec![
///     Row::parameter("length", Unit::METRE, 0.1..=10.0, 1.0, "Length of the rod"),
///     Row::output("angle", Unit::RADIAN, 1.0, "Angle", |pendulum: &Pendulum| pendulum.angle).with_derivative("rate"),
///     Row::output("rate", Unit::RADIAN_PER_SECOND, 1.0, "Angular velocity", |pendulum| pendulum.rate),
/// ];
/// assert_eq!(rows[1].variable.derivative.as_deref(), Some("rate"));
/// ```
#[derive(Debug)]
pub struct Row<M> {
    /// All but how it is read.
    pub variable: Variable,
    /// How it is read; `None` for parameters and inputs.
    pub read: Option<Read<M>>,
}

impl<M> Row<M> {
    /// A fixed real parameter with its allowed range and default, which is its nominal value too, or 1 if it is zero.
    pub fn parameter(name: &str, unit: Unit, range: RangeInclusive<f64>, start: f64, description: &str) -> Self {
        let nominal = if start == 0.0 { 1.0 } else { start.abs() };
        let quantity = Quantity {
            unit,
            min: *range.start(),
            max: *range.end(),
            nominal,
            start,
        };
        Self::new(name, description, Causality::Parameter, Kind::Real(quantity), None)
    }

    /// A fixed parameter that is a whole number of 64 bits.
    pub fn long_parameter(name: &str, range: RangeInclusive<i64>, start: i64, description: &str) -> Self {
        Self::new(
            name,
            description,
            Causality::Parameter,
            Kind::Long { range, start },
            None,
        )
    }

    /// A fixed parameter that takes one of `options`, each a name and a sentence; `start` is a number, the first being 1.
    pub fn enumeration_parameter(
        name: &str,
        type_name: &'static str,
        options: &'static [(&'static str, &'static str)],
        start: i64,
        description: &str,
    ) -> Self {
        let kind = Kind::Enumeration {
            type_name,
            options,
            start,
        };
        Self::new(name, description, Causality::Parameter, kind, None)
    }

    /// A continuous input that starts at zero and may take any finite value.
    pub fn input(name: &str, unit: Unit, nominal: f64, description: &str) -> Self {
        Self::new(name, description, Causality::Input, unbounded(unit, nominal), None)
    }

    /// A continuous output.
    pub fn output(
        name: impl Into<String>,
        unit: Unit,
        nominal: f64,
        description: impl Into<String>,
        read: fn(&M) -> f64,
    ) -> Self {
        let kind = unbounded(unit, nominal);
        Self::new(name, description, Causality::Output, kind, Some(Read::Real(read)))
    }

    /// A real that is known when initialisation ends and stays, unless a tunable parameter that it depends on changes.
    pub fn calculated(
        name: impl Into<String>,
        unit: Unit,
        nominal: f64,
        description: impl Into<String>,
        read: fn(&M) -> f64,
    ) -> Self {
        let kind = unbounded(unit, nominal);
        Self::new(
            name,
            description,
            Causality::CalculatedParameter,
            kind,
            Some(Read::Real(read)),
        )
    }

    /// A whole number among the outputs, such as the contacts that are closed.
    pub fn count_output(name: impl Into<String>, description: impl Into<String>, read: fn(&M) -> i64) -> Self {
        let kind = Kind::Integer {
            range: 0..=i64::from(i32::MAX),
            start: 0,
        };
        Self::new(name, description, Causality::Output, kind, Some(Read::Integer(read)))
    }

    /// One of `options` among the outputs, each a name and a sentence; the first has the number 1.
    pub fn enumeration_output(
        name: impl Into<String>,
        type_name: &'static str,
        options: &'static [(&'static str, &'static str)],
        description: impl Into<String>,
        read: fn(&M) -> i64,
    ) -> Self {
        let kind = Kind::Enumeration {
            type_name,
            options,
            start: 1,
        };
        Self::new(name, description, Causality::Output, kind, Some(Read::Integer(read)))
    }

    /// Continuous outputs `name[1]` to `name[count]`; `read` gets the element counted from 0. The description of element 3 is
    /// `what` with `{}` replaced by 3.
    pub fn outputs(
        name: &str,
        count: u32,
        unit: Unit,
        nominal: f64,
        what: &str,
        read: impl Fn(&M, usize) -> f64 + Send + Sync + 'static,
    ) -> impl Iterator<Item = Self> {
        let fill: Fill<M> = Arc::new(move |model, first, out: &mut [f64]| {
            for (index, value) in (first..).zip(out) {
                *value = read(model, index);
            }
        });
        (0..count as usize).map(move |index| {
            let number = (index + 1).to_string();
            let kind = unbounded(unit, nominal);
            let read = Some(Read::RealArray {
                fill: Arc::clone(&fill),
                index,
                count: count as usize,
            });
            let name = format!("{name}[{number}]");
            Self::new(name, what.replace("{}", &number), Causality::Output, kind, read)
        })
    }

    /// The same parameter, which may change between steps too: see [`Model::tune`](crate::Model::tune).
    #[must_use]
    pub fn tunable(mut self) -> Self {
        self.variable.tunable = true;
        self
    }

    /// The same parameter, which says how the model computes and changes no result: saved states do not bring it along, so that one
    /// that is restored leaves it as it is.
    #[must_use]
    pub fn outside_states(mut self) -> Self {
        self.variable.outside_states = true;
        self
    }

    /// The same real input or output, which changes at events or between steps alone.
    #[must_use]
    pub fn discrete(mut self) -> Self {
        self.variable.discrete = true;
        self
    }

    /// The same output as a calculated parameter: known when initialisation ends, constant from then on unless a tunable
    /// parameter that it depends on changes.
    #[must_use]
    pub fn constant(mut self) -> Self {
        self.variable.causality = Causality::CalculatedParameter;
        self
    }

    /// The same real with another nominal value: for parameters that start at zero, of which one cannot be read off.
    #[must_use]
    pub fn with_nominal(mut self, nominal: f64) -> Self {
        if let Kind::Real(quantity) = &mut self.variable.kind {
            quantity.nominal = nominal;
        }
        self
    }

    /// The same computed variable, which depends on no more than these parameters, inputs and [`TIME`](crate::TIME) while the
    /// component is initialised. Names that the model does not have are left out.
    #[must_use]
    pub fn depending_on(mut self, names: &Arc<[&'static str]>) -> Self {
        self.variable.dependencies = Some(Arc::clone(names));
        self
    }

    /// The same variable with the name of the variable that is its time derivative.
    #[must_use]
    pub fn with_derivative(mut self, name: impl Into<String>) -> Self {
        self.variable.derivative = Some(name.into());
        self
    }

    /// The same variable as a member of a terminal.
    #[must_use]
    pub fn in_terminal(mut self, terminal: &'static str, member: &'static str) -> Self {
        self.variable.terminal = Some(TerminalMember { terminal, member });
        self
    }

    /// The same parameter with the range in which the model makes sense; outside of it the simulation warns with `reason`, which says
    /// what is wrong there.
    #[must_use]
    pub fn recommended(mut self, range: RangeInclusive<f64>, reason: &'static str) -> Self {
        self.variable.recommended = Some(Recommended {
            of: None,
            range,
            reason,
        });
        self
    }

    /// As [`Row::recommended`], with the range of a quantity that the parameter makes together with others.
    #[must_use]
    pub fn recommended_by(mut self, of: Derived, range: RangeInclusive<f64>, reason: &'static str) -> Self {
        self.variable.recommended = Some(Recommended {
            of: Some(of),
            range,
            reason,
        });
        self
    }

    /// A variable of any kind; `read` is `None` for parameters and inputs alone.
    pub fn new(
        name: impl Into<String>,
        description: impl Into<String>,
        causality: Causality,
        kind: Kind,
        read: Option<Read<M>>,
    ) -> Self {
        let variable = Variable {
            name: name.into(),
            description: description.into(),
            causality,
            kind,
            tunable: false,
            outside_states: false,
            discrete: false,
            dependencies: None,
            derivative: None,
            terminal: None,
            recommended: None,
        };
        Self { variable, read }
    }
}

fn unbounded(unit: Unit, nominal: f64) -> Kind {
    Kind::Real(Quantity {
        unit,
        min: f64::NEG_INFINITY,
        max: f64::INFINITY,
        nominal,
        start: 0.0,
    })
}
