//! A field of the struct: its role, the shape of its variable, and what its attribute says of it.

use syn::spanned::Spanned;
use syn::{Attribute, Error, Expr, Ident, Result, Type};

use crate::facts::Facts;
use crate::shape::{self, Class, Shape};
use crate::text;

/// What a field is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// `#[parameter]`
    Parameter,
    /// `#[input]`
    Input,
    /// `#[calculated]`: computed when the component is initialised, constant from then on.
    Calculated,
    /// `#[output]`
    Output,
    /// `#[state]`, or no attribute: no variable, but a part of saved states.
    State,
}

impl Role {
    const ALL: [(&'static str, Self); 5] = [
        ("parameter", Self::Parameter),
        ("input", Self::Input),
        ("calculated", Self::Calculated),
        ("output", Self::Output),
        ("state", Self::State),
    ];

    /// Whether the importer gives its value.
    pub fn is_settable(self) -> bool {
        matches!(self, Self::Parameter | Self::Input)
    }
}

/// A field.
pub struct Field {
    /// Its name in the struct.
    pub ident: Ident,
    /// Its type in the struct.
    pub of: Type,
    /// What it is.
    pub role: Role,
    /// Of a variable, and of a state that is an array.
    pub shape: Option<Shape>,
    /// Name of its variable.
    pub name: String,
    /// Description of its variable.
    pub description: String,
    /// What its attribute says.
    pub facts: Facts,
}

impl Field {
    /// Reads a field.
    pub fn read(field: &syn::Field) -> Result<Self> {
        let ident = field
            .ident
            .clone()
            .ok_or_else(|| Error::new_spanned(field, "name the field"))?;
        let attributes: Vec<(Role, &Attribute)> = field
            .attrs
            .iter()
            .filter_map(|attribute| {
                let (_, role) = Role::ALL.iter().find(|(name, _)| attribute.path().is_ident(name))?;
                Some((*role, attribute))
            })
            .collect();
        if attributes.len() > 1 {
            let message = format!("`{ident}` has a role already: write one of {}", roles());
            return Err(Error::new(ident.span(), message));
        }
        let (role, facts) = match attributes.first() {
            None => (Role::State, Facts::none(ident.span())),
            Some((role, attribute)) => {
                let (valued, flags) = keys(*role);
                (*role, Facts::read(attribute, valued, flags)?)
            }
        };
        let shape = match (role, &field.ty) {
            (Role::State, Type::Array(_)) => shape::of(&field.ty).ok(),
            (Role::State, _) => None,
            _ => Some(shape::of(&field.ty)?),
        };
        let field = Self {
            name: facts.text("name")?.unwrap_or_else(|| plain(&ident)),
            description: text::description(&field.attrs),
            of: field.ty.clone(),
            ident,
            role,
            shape,
            facts,
        };
        field.check()?;
        Ok(field)
    }

    fn check(&self) -> Result<()> {
        if self.role == Role::Parameter && self.facts.value("start").is_none() {
            let message = format!(
                "the parameter `{}` has no start value: write #[parameter(start = ..)]",
                self.ident
            );
            return Err(Error::new(self.facts.span, message));
        }
        let Some(shape) = self.shape.as_ref().filter(|_| self.role != Role::State) else {
            return Ok(());
        };
        let of_reals = ["unit", "nominal", "derivative"];
        let of_numbers = ["min", "max"];
        let is_number = shape.class.is_real() || matches!(shape.class, Class::Whole(_));
        let unfit = of_reals
            .iter()
            .filter(|_| !shape.class.is_real())
            .chain(of_numbers.iter().filter(|_| !is_number))
            .find_map(|key| self.facts.fact(key));
        if let Some(fact) = unfit {
            let needed = match of_numbers.contains(&fact.key.to_string().as_str()) {
                true => "a number",
                false => "an f64 or f32",
            };
            let message = format!(
                "`{}` is for {needed}, and `{}` is {}: leave it out",
                fact.key,
                self.ident,
                shape.class.name()
            );
            return Err(Error::new(fact.key.span(), message));
        }
        let unfit = match (self.facts.fact("tunable"), self.facts.fact("discrete")) {
            (Some(fact), _) if matches!(shape.class, Class::Text | Class::Binary) => {
                Some((fact, "tunable parameters are numbers"))
            }
            (_, Some(fact)) if !shape.class.is_real() => Some((fact, "it is discrete without being told")),
            _ => None,
        };
        if let Some((fact, why)) = unfit {
            let message = format!(
                "`{}` is {}, and {why}: leave `{}` out",
                self.ident,
                shape.class.name(),
                fact.key
            );
            return Err(Error::new(fact.key.span(), message));
        }
        if let (Some(fact), false) = (self.facts.fact("mime_type"), shape.class == Class::Binary) {
            let message = format!(
                "`mime_type` is for a Vec<u8>, and `{}` is {}: leave it out",
                self.ident,
                shape.class.name()
            );
            return Err(Error::new(fact.key.span(), message));
        }
        Ok(())
    }

    /// The start value as it is written.
    pub fn start(&self) -> Option<&Expr> {
        self.facts.value("start")
    }

    /// Where to point at for the field as a whole.
    pub fn span(&self) -> proc_macro2::Span {
        self.of.span()
    }
}

/// Keys with a value and flags of an attribute.
fn keys(role: Role) -> (&'static [&'static str], &'static [&'static str]) {
    match role {
        Role::Parameter => (
            &["start", "min", "max", "unit", "nominal", "name", "mime_type"],
            &["tunable"],
        ),
        Role::Input | Role::Output => (
            &[
                "start",
                "min",
                "max",
                "unit",
                "nominal",
                "derivative",
                "name",
                "mime_type",
            ],
            &["discrete"],
        ),
        Role::Calculated => (&["start", "min", "max", "unit", "nominal", "name", "mime_type"], &[]),
        Role::State => (&["start"], &["skip"]),
    }
}

fn roles() -> String {
    let names: Vec<String> = Role::ALL.iter().map(|(name, _)| format!("#[{name}]")).collect();
    names.join(", ")
}

/// The name of a field, `r#type` as `type`.
fn plain(ident: &Ident) -> String {
    let text = ident.to_string();
    text.strip_prefix("r#").map_or(text.clone(), str::to_owned)
}
