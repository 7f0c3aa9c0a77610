//! What the type of a field says of its variable.

use syn::{Error, Expr, GenericArgument, PathArguments, Result, Type, TypePath};

/// What a variable holds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// `f64`.
    Real,
    /// `f32`.
    Single,
    /// A whole number: name of the Rust type.
    Whole(&'static str),
    /// `bool`.
    Boolean,
    /// `String`.
    Text,
    /// `Vec<u8>`.
    Binary,
    /// Any other type: that it is an enumeration is for the compiler to check.
    Enumeration,
}

impl Class {
    /// Whether it is a floating-point number.
    pub fn is_real(self) -> bool {
        matches!(self, Self::Real | Self::Single)
    }

    /// How errors call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Real => "an f64",
            Self::Single => "an f32",
            Self::Whole(_) => "a whole number",
            Self::Boolean => "a bool",
            Self::Text => "a String",
            Self::Binary => "a Vec<u8>",
            Self::Enumeration => "an enumeration",
        }
    }
}

const WHOLE: [&str; 8] = ["i8", "u8", "i16", "u16", "i32", "u32", "i64", "u64"];

/// A variable, or an array of as many as its dimensions say.
pub struct Shape {
    /// What each element holds.
    pub class: Class,
    /// Lengths, the outermost first; empty for a scalar.
    pub dimensions: Vec<Expr>,
}

/// What is allowed, for errors.
pub const TYPES: &str = "f64, f32, bool, String, Vec<u8>, a whole number of 8 to 64 bits, an enum with \
                         #[derive(Enumeration)], or an array of f64 such as [f64; 3]";

/// The shape of a variable of type `of`.
pub fn of(of: &Type) -> Result<Shape> {
    let unfit = || Error::new_spanned(of, format!("no variable has this type: write {TYPES}"));
    match of {
        Type::Array(array) => {
            let mut inner = self::of(&array.elem)?;
            if inner.class != Class::Real {
                let message = "arrays of variables are arrays of f64: write [f64; N], or one field for each element";
                return Err(Error::new_spanned(&array.elem, message));
            }
            inner.dimensions.insert(0, array.len.clone());
            if inner.dimensions.len() > 2 {
                return Err(Error::new_spanned(of, "write an array with one or two dimensions"));
            }
            Ok(inner)
        }
        Type::Path(path) if path.qself.is_none() => Ok(Shape {
            class: class(path).ok_or_else(unfit)?,
            dimensions: Vec::new(),
        }),
        Type::Group(group) => self::of(&group.elem),
        Type::Paren(paren) => self::of(&paren.elem),
        _ => Err(unfit()),
    }
}

fn class(of: &TypePath) -> Option<Class> {
    let last = of.path.segments.last()?;
    let name = last.ident.to_string();
    if let PathArguments::AngleBracketed(arguments) = &last.arguments {
        let of_bytes = matches!(arguments.args.first(), Some(GenericArgument::Type(Type::Path(element))) if element.path.is_ident("u8"));
        return (name == "Vec" && of_bytes && arguments.args.len() == 1).then_some(Class::Binary);
    }
    let whole = WHOLE.iter().find(|known| **known == name);
    Some(match (name.as_str(), whole) {
        (_, Some(whole)) => Class::Whole(whole),
        ("f64", _) => Class::Real,
        ("f32", _) => Class::Single,
        ("bool", _) => Class::Boolean,
        ("String", _) => Class::Text,
        ("usize" | "isize" | "u128" | "i128" | "char" | "str", _) => return None,
        _ => Class::Enumeration,
    })
}
