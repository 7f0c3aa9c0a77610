//! Component in, `modelDescription.xml` out, for both versions of the standard.
//!
//! Guarantees: the start values are those of a new instance, the capability flags say what is there and no more, and the
//! same input gives the same bytes (the date is part of the input). Outputs depend on no input at the same instant: they
//! change in a step only, so that an importer need not search for algebraic loops. While the component is initialised they
//! depend on the parameters and inputs that the model names, and on no others; a variable without a list leaves it out, which
//! the standards read as all.

mod structure;
mod types;
mod variables;

use fmi_component::{Causality, Kind, LOG_CATEGORIES, TOLERANCE, Variable, Version};

use crate::component::Component;
use crate::xml::{self, Attributes, number};
pub(crate) use variables::of_each;

/// The model description of a component.
pub fn write(component: &Component, version: Version) -> String {
    let layout = Layout::new(component, version);
    let variables = component.table().variables();
    xml::document(|xml| {
        xml::element(xml, "fmiModelDescription", &root(component, version), |xml| {
            xml::empty(xml, "CoSimulation", &capabilities(component, version))?;
            xml::element(xml, "UnitDefinitions", &vec![], |xml| types::units(xml, variables))?;
            xml::element(xml, "TypeDefinitions", &vec![], |xml| {
                types::type_definitions(xml, variables, version)
            })?;
            xml::element(xml, "LogCategories", &vec![], |xml| {
                LOG_CATEGORIES.iter().try_for_each(|(name, description)| {
                    let attributes = vec![("name", (*name).into()), ("description", (*description).into())];
                    xml::empty(xml, "Category", &attributes)
                })
            })?;
            xml::empty(xml, "DefaultExperiment", &experiment(component))?;
            xml::element(xml, "ModelVariables", &vec![], |xml| variables::write(xml, &layout))?;
            xml::element(xml, "ModelStructure", &vec![], |xml| structure::write(xml, &layout))
        })
    })
}

fn root(component: &Component, version: Version) -> Attributes {
    let token_name = match version {
        Version::Two => "guid",
        Version::Three => "instantiationToken",
    };
    let (info, notices) = (component.info(), &component.notices);
    // The first part of a variant distinguishes models of one name.
    let model_name: Vec<_> = [info.name]
        .into_iter()
        .chain(info.variant.first().map(|(_, value)| *value))
        .collect();
    let optional = |name, value: &str| (!value.is_empty()).then(|| (name, value.to_owned()));
    let mut attributes = vec![
        ("fmiVersion", version.number().into()),
        ("modelName", model_name.join(" ")),
        (token_name, component.token()),
        ("description", info.description.into()),
        ("version", info.version.into()),
    ];
    attributes.extend(optional("copyright", &notices.copyright));
    attributes.extend(optional("license", &notices.license));
    attributes.push(("generationTool", component.tool()));
    attributes.extend(
        component
            .date
            .iter()
            .map(|date| ("generationDateAndTime", date.clone())),
    );
    attributes.push(("variableNamingConvention", "structured".into()));
    attributes
}

/// Every flag is written, those that are the default too, so that a reader need not know the defaults.
fn capabilities(component: &Component, version: Version) -> Attributes {
    let offered = |causality| component.table().has_derivatives(causality);
    let order = if offered(Causality::Output) { "1" } else { "0" };
    let flag = |is: bool| if is { "true" } else { "false" };
    let interpolates = flag(offered(Causality::Input));
    let events = flag(component.has_events());
    let updates = flag(component.updates_inside_steps());
    let flags: &[(&'static str, &str)] = match version {
        Version::Two => &[
            ("needsExecutionTool", "false"),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("canInterpolateInputs", interpolates),
            ("maxOutputDerivativeOrder", order),
            ("canRunAsynchronuously", "false"),
            ("canBeInstantiatedOnlyOncePerProcess", "false"),
            ("canNotUseMemoryManagementFunctions", "true"),
            ("canGetAndSetFMUstate", "true"),
            ("canSerializeFMUstate", "true"),
            ("providesDirectionalDerivative", "false"),
        ],
        Version::Three => &[
            ("needsExecutionTool", "false"),
            ("canBeInstantiatedOnlyOncePerProcess", "false"),
            ("canGetAndSetFMUState", "true"),
            ("canSerializeFMUState", "true"),
            ("providesDirectionalDerivatives", "false"),
            ("providesAdjointDerivatives", "false"),
            ("providesPerElementDependencies", "false"),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("maxOutputDerivativeOrder", order),
            ("providesIntermediateUpdate", updates),
            ("mightReturnEarlyFromDoStep", events),
            ("canReturnEarlyAfterIntermediateUpdate", updates),
            ("hasEventMode", events),
            ("providesEvaluateDiscreteStates", "false"),
        ],
    };
    let mut attributes = vec![("modelIdentifier", component.info().identifier.to_string())];
    attributes.extend(flags.iter().map(|(name, value)| (*name, (*value).into())));
    attributes
}

/// The tolerance is there where a model has a parameter of that name, since an importer's tolerance goes to it.
fn experiment(component: &Component) -> Attributes {
    let info = component.info();
    let tolerance = component
        .table()
        .variables()
        .iter()
        .find_map(|variable| match &variable.kind {
            Kind::Real(quantity) if variable.name == TOLERANCE => Some(("tolerance", number(quantity.start))),
            _ => None,
        });
    let times = [
        ("startTime", number(0.0)),
        ("stopTime", number(info.stop_time)),
        ("stepSize", number(info.step_size)),
    ];
    times.into_iter().chain(tolerance).collect()
}

/// Which variables the description lists, and what they are called by.
struct Layout<'a> {
    component: &'a Component,
    version: Version,
    /// Elements of the variable at each position; 0 inside an array.
    spans: Vec<usize>,
    /// For each position the output of which it is the derivative.
    integrals: Vec<Option<usize>>,
}

impl<'a> Layout<'a> {
    fn new(component: &'a Component, version: Version) -> Self {
        let table = component.table();
        let mut integrals = vec![None; table.variables().len()];
        for (position, variable) in table.variables().iter().enumerate() {
            if let (Causality::Output, Some(derivative)) = (variable.causality, table.derivative(position)) {
                integrals[derivative] = Some(position);
            }
        }
        Self {
            component,
            version,
            spans: component.spans(),
            integrals,
        }
    }

    fn variable(&self, position: usize) -> &Variable {
        &self.component.table().variables()[position]
    }

    /// Positions at which a variable begins that this version has.
    fn positions(&self) -> impl Iterator<Item = usize> {
        (0..self.spans.len()).filter(|position| self.lists(*position))
    }

    fn lists(&self, position: usize) -> bool {
        self.spans[position] > 0 && self.component.is_in(self.version, position)
    }

    /// Index of the variable at `position` in FMI 2.0: counted from 1, and the time comes first.
    fn index(&self, position: usize) -> String {
        let before = (0..position).filter(|before| self.lists(*before)).count();
        (before + 2).to_string()
    }
}
