//! The arguments of an attribute: `#[parameter(start = 1.0, min = 0.0, unit = "1/s", tunable)]`.

use proc_macro2::Span;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::{Attribute, Error, Expr, Ident, Meta, Result, Token};

/// A key, with its value unless it is a flag.
pub struct Fact {
    /// The key.
    pub key: Ident,
    /// The value.
    pub value: Option<Expr>,
}

impl Parse for Fact {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let key: Ident = input.parse()?;
        let value = match input.peek(Token![=]) {
            true => {
                input.parse::<Token![=]>()?;
                Some(input.parse()?)
            }
            false => None,
        };
        Ok(Self { key, value })
    }
}

/// The facts in an attribute, each key once.
pub struct Facts {
    list: Vec<Fact>,
    /// Where the attribute stands.
    pub span: Span,
}

impl Facts {
    /// No facts.
    pub fn none(span: Span) -> Self {
        Self { list: Vec::new(), span }
    }

    /// Reads `attribute`, whose keys with a value are `valued` and whose others are `flags`.
    pub fn read(attribute: &Attribute, valued: &[&str], flags: &[&str]) -> Result<Self> {
        let list: Vec<Fact> = match &attribute.meta {
            Meta::Path(_) => Vec::new(),
            Meta::List(list) => list
                .parse_args_with(Punctuated::<Fact, Token![,]>::parse_terminated)?
                .into_iter()
                .collect(),
            Meta::NameValue(pair) => {
                return Err(Error::new_spanned(
                    pair,
                    "write the facts in parentheses: (start = 1.0)",
                ));
            }
        };
        for (number, fact) in list.iter().enumerate() {
            let key = fact.key.to_string();
            let known = |keys: &[&str]| keys.contains(&key.as_str());
            if list[..number].iter().any(|former| former.key == fact.key) {
                return Err(Error::new(
                    fact.key.span(),
                    format!("`{key}` is given twice: write it once"),
                ));
            }
            match (known(valued), known(flags), &fact.value) {
                (true, _, Some(_)) | (_, true, None) => {}
                (true, _, None) => {
                    return Err(Error::new(
                        fact.key.span(),
                        format!("`{key}` needs a value: write `{key} = ..`"),
                    ));
                }
                (_, true, Some(value)) => {
                    return Err(Error::new(
                        value.span(),
                        format!("`{key}` takes no value: write `{key}` alone"),
                    ));
                }
                _ => {
                    let all: Vec<&str> = valued.iter().chain(flags).copied().collect();
                    let allowed = match all.as_slice() {
                        [] => "nothing is allowed here".into(),
                        all => format!("write one of: {}", all.join(", ")),
                    };
                    return Err(Error::new(
                        fact.key.span(),
                        format!("`{key}` has no meaning here: {allowed}"),
                    ));
                }
            }
        }
        Ok(Self {
            list,
            span: attribute.span(),
        })
    }

    /// The value of `key`.
    pub fn value(&self, key: &str) -> Option<&Expr> {
        self.fact(key).and_then(|fact| fact.value.as_ref())
    }

    /// The fact of `key`.
    pub fn fact(&self, key: &str) -> Option<&Fact> {
        self.list.iter().find(|fact| fact.key == key)
    }

    /// The value of `key` as a text in quotes.
    pub fn text(&self, key: &str) -> Result<Option<String>> {
        let Some(value) = self.value(key) else { return Ok(None) };
        match value {
            Expr::Lit(syn::ExprLit {
                lit: syn::Lit::Str(text),
                ..
            }) => Ok(Some(text.value())),
            _ => Err(Error::new_spanned(
                value,
                format!("`{key}` is a text: write `{key} = \"..\"`"),
            )),
        }
    }
}
