//! What a replay needs of a model description, of either version.

use std::collections::HashMap;

use fmi_component::Version;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// A column of the table as the library knows it.
pub struct Column {
    /// Value reference of the variable.
    pub reference: u32,
    /// Element of the variable, counted from 0.
    pub offset: usize,
    /// Elements of the variable.
    pub span: usize,
    /// Nominal value, 1 where none is stated.
    pub nominal: f64,
    /// Whether it is an input.
    pub input: bool,
}

/// What a replay needs of a model description.
pub struct Description {
    /// Version of the standard.
    pub version: Version,
    /// Instantiation token or GUID.
    pub token: String,
    /// Model identifier.
    pub identifier: String,
    variables: HashMap<String, Described>,
    /// Nominal values of the declared types that state one.
    types: HashMap<String, f64>,
}

#[derive(Default)]
struct Described {
    reference: u32,
    /// Lengths of an array, the outermost first.
    dimensions: Vec<usize>,
    nominal: Option<f64>,
    declared_type: Option<String>,
    input: bool,
}

impl Description {
    /// Reads the XML.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut reader = Reader::from_str(text);
        let mut found = Self {
            version: Version::Three,
            token: String::new(),
            identifier: String::new(),
            variables: HashMap::new(),
            types: HashMap::new(),
        };
        let mut last = None;
        loop {
            match reader.read_event().map_err(|error| error.to_string())? {
                Event::Start(element) | Event::Empty(element) => found.note(&element, &mut last)?,
                Event::Eof => return Ok(found),
                _ => {}
            }
        }
    }

    fn note(&mut self, element: &BytesStart<'_>, last: &mut Option<String>) -> Result<(), String> {
        let mut attributes = HashMap::new();
        for attribute in element.attributes() {
            let attribute = attribute.map_err(|error| error.to_string())?;
            let value = attribute
                .normalized_value(quick_xml::XmlVersion::Implicit1_0)
                .map_err(|error| error.to_string())?;
            attributes.insert(attribute.key.as_ref().to_owned(), value.into_owned());
        }
        let get = |key: &str| attributes.get(key);
        let number = |key: &str| get(key).and_then(|value| value.parse::<f64>().ok());
        match element.name().as_ref() {
            "fmiModelDescription" => {
                self.token = get("guid").or(get("instantiationToken")).cloned().unwrap_or_default();
                if get("guid").is_some() {
                    self.version = Version::Two;
                }
            }
            "CoSimulation" => self.identifier = get("modelIdentifier").cloned().unwrap_or_default(),
            "Float64Type" => {
                let stated = get("name").cloned().zip(number("nominal"));
                self.types.extend(stated);
            }
            "Dimension" => {
                if let Some(entry) = last.as_ref().and_then(|name| self.variables.get_mut(name)) {
                    entry.dimensions.extend(number("start").map(|length| length as usize));
                }
            }
            _ => match (get("name"), number("valueReference")) {
                (Some(name), Some(reference)) => {
                    let entry = Described {
                        reference: reference as u32,
                        dimensions: Vec::new(),
                        nominal: number("nominal"),
                        declared_type: get("declaredType").cloned(),
                        input: get("causality").is_some_and(|causality| causality == "input"),
                    };
                    self.variables.insert(name.clone(), entry);
                    *last = Some(name.clone());
                }
                // FMI 2.0 has the rest in an element of its own.
                _ => {
                    if let Some(entry) = last.as_ref().and_then(|name| self.variables.get_mut(name)) {
                        entry.nominal = entry.nominal.or(number("nominal"));
                    }
                }
            },
        }
        Ok(())
    }

    /// The variable called `name`, or the array that it is an element of.
    pub fn column(&self, name: &str) -> Option<Column> {
        let (entry, offset) = match self.variables.get(name) {
            Some(entry) => (entry, Some(0)),
            None => {
                let (stem, indices) = name.strip_suffix(']')?.rsplit_once('[')?;
                let entry = self.variables.get(stem)?;
                (entry, offset(&entry.dimensions, indices))
            }
        };
        let (offset, span) = (offset?, entry.dimensions.iter().product());
        let of_type = || self.types.get(entry.declared_type.as_ref()?).copied();
        (offset < span).then_some(Column {
            reference: entry.reference,
            offset,
            span,
            nominal: entry.nominal.or_else(of_type).unwrap_or(1.0),
            input: entry.input,
        })
    }
}

/// Place of the element with these `indices`, such as `2` or `1,3`, among those of an array, counted from 0.
fn offset(dimensions: &[usize], indices: &str) -> Option<usize> {
    let indices: Vec<usize> = indices
        .split(',')
        .map(|index| index.parse::<usize>().ok()?.checked_sub(1))
        .collect::<Option<_>>()?;
    let fit = indices.len() == dimensions.len() && indices.iter().zip(dimensions).all(|(index, length)| index < length);
    let pairs = indices.iter().zip(dimensions);
    fit.then(|| pairs.fold(0, |before, (index, length)| before * length + index))
}
