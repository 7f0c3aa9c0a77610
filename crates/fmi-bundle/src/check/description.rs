//! A model description as it is in an FMU: what the checks of its contents need.

use fmi_component::Version;
use roxmltree::{Document, Node};

use super::grammar::place;

/// Path in an FMU.
pub const PATH: &str = "modelDescription.xml";

/// A model description of either version.
pub struct Described {
    /// Version of the standard.
    pub version: Version,
    /// Instantiation token or GUID.
    pub token: String,
    /// Model identifier for co-simulation.
    pub identifier: String,
    /// Names are structured.
    pub structured: bool,
    /// Units.
    pub units: Vec<Declared>,
    /// Declared types.
    pub types: Vec<Declared>,
    /// Variables in their order.
    pub variables: Vec<DescribedVariable>,
    /// Outputs and what they depend on.
    pub outputs: Vec<Unknown>,
    /// Initial unknowns and what they depend on.
    pub initial: Vec<Unknown>,
}

/// A unit or a type that variables name.
pub struct Declared {
    /// File and line.
    pub place: String,
    /// Its name.
    pub name: String,
    /// All that is said of it but its description.
    pub facts: String,
}

/// A variable.
pub struct DescribedVariable {
    /// File and line.
    pub place: String,
    /// Name of the element of its type, such as `Real` or `Float64`.
    pub element: String,
    /// All attributes but the description.
    pub attributes: Vec<(String, String)>,
    /// Start value, from an attribute or from an element.
    pub start: Option<String>,
    /// Lengths of an array.
    pub dimensions: Vec<String>,
}

/// An element of the model structure.
pub struct Unknown {
    /// File and line.
    pub place: String,
    /// Position of the variable in the list; none if there is no such variable.
    pub variable: Option<usize>,
    /// What it is called by: index or value reference.
    pub called: String,
    /// Positions of what it depends on; none for all. A number that means no variable is none.
    pub dependencies: Option<Vec<Option<usize>>>,
    /// Whether `dependenciesKind` has as many words as `dependencies`.
    pub kinds_fit: bool,
}

impl DescribedVariable {
    /// Value of an attribute.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.attributes
            .iter()
            .find(|(key, _)| key == name)
            .map(|(_, value)| value.as_str())
    }

    /// Its name.
    pub fn name(&self) -> &str {
        self.get("name").unwrap_or_default()
    }

    /// Value reference.
    pub fn reference(&self) -> Option<u32> {
        self.get("valueReference")?.parse().ok()
    }

    /// Causality, `local` where none is stated.
    pub fn causality(&self) -> &str {
        self.get("causality").unwrap_or("local")
    }

    /// Whether it is a real.
    pub fn is_real(&self) -> bool {
        matches!(self.element.as_str(), "Real" | "Float32" | "Float64")
    }

    /// Variability, by the rules of the standard where none is stated.
    pub fn variability(&self) -> &str {
        let default = match (self.causality(), self.is_real()) {
            ("parameter" | "calculatedParameter" | "structuralParameter", _) => "fixed",
            (_, true) => "continuous",
            _ => "discrete",
        };
        self.get("variability").unwrap_or(default)
    }

    /// How the start value is to be understood; none for inputs and the time.
    pub fn initial(&self) -> Option<&str> {
        let default = match (self.causality(), self.variability()) {
            ("input" | "independent", _) => return self.get("initial"),
            ("parameter" | "structuralParameter", _) | (_, "constant") => "exact",
            _ => "calculated",
        };
        self.get("initial").or(Some(default))
    }
}

impl Described {
    /// Reads what the grammar may have refused in parts.
    pub fn read(document: &Document<'_>) -> Self {
        let root = document.root_element();
        let version = match root.attribute("fmiVersion") {
            Some(number) if number.starts_with('2') => Version::Two,
            _ => Version::Three,
        };
        let token = root.attribute("guid").or(root.attribute("instantiationToken"));
        let child = |name: &str| root.children().find(|node| node.has_tag_name(name));
        let children = |name: &str| {
            child(name)
                .into_iter()
                .flat_map(|node| node.children().filter(Node::is_element))
        };
        let declared = |name: &str| {
            let declared = |node: Node<'_, '_>| {
                Some(Declared {
                    place: place(PATH, node),
                    name: node.attribute("name")?.into(),
                    facts: facts(node),
                })
            };
            children(name).filter_map(declared).collect()
        };
        let variables: Vec<_> = children("ModelVariables").map(variable).collect();
        let listed = |element: &str| -> Vec<Unknown> {
            let nodes: Vec<Node<'_, '_>> = match version {
                Version::Two => {
                    let lists =
                        children("ModelStructure").filter(|node| node.has_tag_name(format!("{element}s").as_str()));
                    lists
                        .flat_map(|list| list.children().filter(Node::is_element))
                        .collect()
                }
                Version::Three => children("ModelStructure")
                    .filter(|node| node.has_tag_name(element))
                    .collect(),
            };
            nodes
                .into_iter()
                .map(|node| unknown(node, version, &variables))
                .collect()
        };
        let (outputs, initial) = (listed("Output"), listed("InitialUnknown"));
        Self {
            version,
            token: token.unwrap_or_default().into(),
            identifier: child("CoSimulation")
                .and_then(|node| node.attribute("modelIdentifier"))
                .unwrap_or_default()
                .into(),
            structured: root.attribute("variableNamingConvention") == Some("structured"),
            units: declared("UnitDefinitions"),
            types: declared("TypeDefinitions"),
            variables,
            outputs,
            initial,
        }
    }
}

/// Attributes of an element and of those inside of it, but for descriptions, in one order.
fn facts(node: Node<'_, '_>) -> String {
    let list = node.attributes().filter(|attribute| attribute.name() != "description");
    let mut list: Vec<_> = list
        .map(|attribute| format!("{}={}", attribute.name(), attribute.value()))
        .collect();
    list.sort();
    let inside = node
        .children()
        .filter(Node::is_element)
        .map(facts)
        .filter(|text| !text.is_empty());
    list.extend(inside.map(|text| format!("({text})")));
    list.join(" ")
}

fn variable(node: Node<'_, '_>) -> DescribedVariable {
    let own = |node: Node<'_, '_>| -> Vec<(String, String)> {
        let list = node.attributes().filter(|attribute| attribute.name() != "description");
        list.map(|attribute| (attribute.name().into(), attribute.value().into()))
            .collect()
    };
    let mut attributes = own(node);
    // FMI 2.0 has the rest in an element of its own.
    let typed = match node.has_tag_name("ScalarVariable") {
        true => node
            .children()
            .find(|child| child.is_element() && !child.has_tag_name("Annotations"))
            .unwrap_or(node),
        false => node,
    };
    if typed != node {
        attributes.extend(own(typed));
    }
    let of_children = |element: &str, key: &str| -> Vec<String> {
        let list = typed.children().filter(|child| child.has_tag_name(element));
        list.map(|child| child.attribute(key).unwrap_or_default().to_string())
            .collect()
    };
    let starts = of_children("Start", "value");
    let start = typed.attribute("start").map(String::from);
    DescribedVariable {
        place: place(PATH, node),
        element: typed.tag_name().name().into(),
        start: start.or_else(|| starts.first().cloned()),
        dimensions: of_children("Dimension", "start"),
        attributes,
    }
}

fn unknown(node: Node<'_, '_>, version: Version, variables: &[DescribedVariable]) -> Unknown {
    let find = |word: &str| -> Option<usize> {
        let number: u32 = word.parse().ok()?;
        match version {
            Version::Two => (number as usize)
                .checked_sub(1)
                .filter(|position| *position < variables.len()),
            Version::Three => variables
                .iter()
                .position(|variable| variable.reference() == Some(number)),
        }
    };
    let called = node
        .attribute("index")
        .or(node.attribute("valueReference"))
        .unwrap_or_default();
    let words = |name: &str| {
        node.attribute(name)
            .map(|text| text.split_whitespace().collect::<Vec<_>>())
    };
    let (dependencies, kinds) = (words("dependencies"), words("dependenciesKind"));
    Unknown {
        place: place(PATH, node),
        variable: find(called),
        called: called.into(),
        kinds_fit: match (&dependencies, &kinds) {
            (_, None) => true,
            (Some(all), Some(kinds)) => all.len() == kinds.len(),
            (None, Some(_)) => false,
        },
        dependencies: dependencies.map(|list| list.into_iter().map(find).collect()),
    }
}
