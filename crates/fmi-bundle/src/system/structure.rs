//! Elements of a system, their connections, and what does not fit together.

use fmi_component::{Causality, Error, Kind, Result, Value, Variable};

use crate::component::Component;
use crate::libraries::Libraries;

/// An instance of a component in a system.
#[derive(Debug)]
pub struct Element<'components> {
    /// Its name in the system.
    pub name: &'static str,
    /// What it is an instance of.
    pub component: &'components Component,
    /// Libraries that export that.
    pub libraries: &'components Libraries,
    /// Values of parameters and start values of inputs.
    pub parameters: Vec<(&'static str, Value)>,
    /// Outputs that have a connector besides those that are connected: what is to be looked at.
    pub outputs: Vec<&'static str>,
    /// Lower left corner in the diagram; an element is [`WIDTH`] wide and [`HEIGHT`] high.
    pub place: (f64, f64),
}

/// Width of an element in the diagram.
pub const WIDTH: f64 = 40.0;
/// Height of an element in the diagram.
pub const HEIGHT: f64 = 30.0;

/// From the output of an element to the input of another: pairs of element and variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Connection {
    /// Element and output.
    pub from: (&'static str, &'static str),
    /// Element and input.
    pub to: (&'static str, &'static str),
}

/// Elements and their connections.
#[derive(Debug)]
pub struct System<'components> {
    /// Name.
    pub name: &'static str,
    /// One sentence.
    pub description: &'static str,
    /// What it consists of.
    pub elements: Vec<Element<'components>>,
    /// What is connected.
    pub connections: Vec<Connection>,
    /// Default experiment: stop time \[s\].
    pub stop_time: f64,
    /// Default experiment: communication step \[s\].
    pub step_size: f64,
}

impl Element<'_> {
    /// The variable `name`.
    pub(crate) fn variable(&self, name: &str) -> Result<&Variable> {
        let variables = self.component.table().variables();
        variables.iter().find(|variable| variable.name == name).ok_or_else(|| {
            let identifier = &self.component.info().identifier;
            Error::call(
                format!("{} has no variable {name}", self.name),
                format!("See the variables of {identifier}."),
            )
        })
    }

    /// Where its FMU is in the archive.
    pub(crate) fn source(&self) -> String {
        format!("resources/{}.fmu", self.component.info().identifier)
    }

    /// Where its parameter set is in the archive.
    pub(crate) fn parameter_source(&self) -> String {
        format!("resources/{}.ssv", self.name)
    }
}

impl System<'_> {
    /// The element `name`.
    pub(crate) fn element(&self, name: &str) -> Result<&Element<'_>> {
        let found = self.elements.iter().find(|element| element.name == name);
        found.ok_or_else(|| {
            Error::call(
                format!("{} has no element {name}", self.name),
                "Add it, or correct the connection.",
            )
        })
    }

    /// Refuses what does not fit together.
    pub(crate) fn check(&self) -> Result<()> {
        for (number, element) in self.elements.iter().enumerate() {
            if self.elements[..number].iter().any(|former| former.name == element.name) {
                return Err(Error::call(
                    format!("two elements are called {}", element.name),
                    "Give each a name of its own.",
                ));
            }
            for (name, value) in &element.parameters {
                let variable = element.variable(name)?;
                if !variable.causality.is_settable() {
                    let what = format!(
                        "{}.{name} is an {}, and cannot be set",
                        element.name,
                        variable.causality.word()
                    );
                    return Err(Error::call(what, "Set parameters and inputs alone."));
                }
                variable.check(*value)?;
            }
        }
        for (number, connection) in self.connections.iter().enumerate() {
            self.check_connection(connection)?;
            if self.connections[..number]
                .iter()
                .any(|former| former.to == connection.to)
            {
                let (element, input) = connection.to;
                return Err(Error::call(
                    format!("{element}.{input} has two sources"),
                    "Connect each input once.",
                ));
            }
        }
        Ok(())
    }

    fn check_connection(&self, connection: &Connection) -> Result<()> {
        let end = |(element, name): (&str, &str), causality: Causality| {
            let variable = self.element(element)?.variable(name)?;
            match (variable.causality == causality, &variable.kind) {
                (true, Kind::Real(quantity)) => Ok(quantity.unit),
                _ => Err(Error::call(
                    format!("{element}.{name} is no {} of reals", causality.word()),
                    "Connect an output to an input, both reals of 64 bits.",
                )),
            }
        };
        let (from, to) = (
            end(connection.from, Causality::Output)?,
            end(connection.to, Causality::Input)?,
        );
        if from.name == to.name && from.exponents == to.exponents {
            return Ok(());
        }
        let what = format!("{connection:?} goes from {} to {}", from.name, to.name);
        Err(Error::call(what, "Connect variables of one unit."))
    }
}
