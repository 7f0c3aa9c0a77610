//! `#[derive(Component)]`: the struct's table of variables, its values and its saved state.

use proc_macro2::TokenStream;
use quote::quote;
use syn::spanned::Spanned;
use syn::{Data, DeriveInput, Error, Fields, Ident, Result};

use crate::facts::Facts;
use crate::field::{Field, Role};
use crate::{rows, text};

/// The implementation of `fmi_component::Component` for a struct.
pub fn expand(input: &DeriveInput) -> Result<TokenStream> {
    let fields = fields(input)?;
    let name = &input.ident;
    let info = info(input)?;
    let settable = fields.iter().filter(|field| field.role.is_settable());
    let computed = fields.iter().filter(|field| !field.role.is_settable());
    let ordered: Vec<&Field> = settable.chain(computed).collect();
    let variables = ordered.iter().filter(|field| field.role != Role::State);
    let push = variables.filter_map(|field| Some(rows::push(field, field.shape.as_ref()?)));
    let push: Vec<TokenStream> = push.collect::<Result<_>>()?;
    let first = ordered.iter().map(|field| rows::first(field));
    let take = taken(&ordered, |field| field.role == Role::Input);
    let tune = taken(&ordered, |field| field.facts.fact("tunable").is_some());
    let saved = Saved::of(&fields);
    let Saved { kept, save, keep, load } = &saved;
    Ok(quote! {
        const _: () = {
            #[derive(
                Clone, PartialEq,
                ::fmi_component::derived::serde::Serialize, ::fmi_component::derived::serde::Deserialize
            )]
            #[serde(crate = "::fmi_component::derived::serde")]
            #[allow(missing_docs, non_snake_case)]
            pub struct State { #(#kept),* }

            #[automatically_derived]
            impl ::fmi_component::Component for #name {
                type State = State;

                fn info() -> ::fmi_component::ModelInfo { #info }

                fn rows() -> ::std::vec::Vec<::fmi_component::Row<::fmi_component::ComponentModel<Self>>> {
                    let mut rows = ::std::vec::Vec::new();
                    #({ #push })*
                    rows
                }

                fn first(values: &mut ::fmi_component::derived::Given<'_>) -> Self {
                    let _ = &values; // not used where nothing can be set
                    Self { #(#first),* }
                }

                fn take(&mut self, values: &mut ::fmi_component::derived::Given<'_>) {
                    let _ = &values;
                    #(#take)*
                }

                fn tune(&mut self, values: &mut ::fmi_component::derived::Given<'_>) {
                    let _ = &values;
                    #(#tune)*
                }

                fn save(&self) -> State { State { #(#save),* } }

                fn save_over(&self, state: &mut State) {
                    let _ = &state;
                    #(#keep)*
                }

                fn load(&mut self, state: &State) -> ::fmi_component::Result<()> {
                    let _ = &state;
                    #(#load)*
                    ::core::result::Result::Ok(())
                }
            }

            #[automatically_derived]
            impl ::fmi_component::Export for #name {
                type Model = ::fmi_component::ComponentModel<Self>;
                const LIBRARY: ::core::option::Option<&'static str> = ::core::option_env!("CARGO_CRATE_NAME");
            }
        };
    })
}

fn fields(input: &DeriveInput) -> Result<Vec<Field>> {
    let plain = "derive Component for a struct with named fields, the variables and states of the model";
    if let Some(parameter) = input.generics.params.first() {
        let message = "a component has no type parameters or lifetimes: write the struct with the types themselves";
        return Err(Error::new_spanned(parameter, message));
    }
    let Data::Struct(data) = &input.data else {
        return Err(Error::new(input.ident.span(), plain));
    };
    let Fields::Named(named) = &data.fields else {
        return Err(Error::new(input.ident.span(), plain));
    };
    // All errors at once, so that one build shows them.
    let mut fields: Vec<Field> = Vec::new();
    let mut errors: Option<Error> = None;
    for field in &named.named {
        let checked = Field::read(field).and_then(|field| match fields.iter().any(|former| same(former, &field)) {
            true => Err(Error::new(
                field.ident.span(),
                format!(
                    "another field is the variable `{}`: give this one another name",
                    field.name
                ),
            )),
            false => Ok(field),
        });
        match (checked, &mut errors) {
            (Ok(field), _) => fields.push(field),
            (Err(error), Some(errors)) => errors.combine(error),
            (Err(error), None) => errors = Some(error),
        }
    }
    errors.map_or(Ok(fields), Err)
}

/// Statements that take those values that are `wanted`, and pass over the others.
fn taken(ordered: &[&Field], wanted: impl Fn(&Field) -> bool) -> Vec<TokenStream> {
    let settable = ordered.iter().filter(|field| field.role.is_settable());
    let statement = settable.filter_map(|field| {
        let shape = field.shape.as_ref()?;
        if wanted(field) {
            return Some(rows::take(field, shape));
        }
        let count = rows::count(shape);
        Some(quote! { values.skip(#count); })
    });
    statement.collect()
}

fn same(one: &Field, other: &Field) -> bool {
    one.role != Role::State && other.role != Role::State && one.name == other.name
}

/// The facts of the model.
fn info(input: &DeriveInput) -> Result<TokenStream> {
    let attribute = input
        .attrs
        .iter()
        .find(|attribute| attribute.path().is_ident("component"));
    let facts = match attribute {
        Some(attribute) => Facts::read(attribute, &["name", "stop_time", "step_size"], &[])?,
        None => Facts::none(input.ident.span()),
    };
    let name = facts.text("name")?.unwrap_or_else(|| input.ident.to_string());
    let is_letter = |sign: char| sign.is_ascii_alphabetic() || sign == '_';
    if !(name.starts_with(is_letter) && name.chars().all(|sign| is_letter(sign) || sign.is_ascii_digit())) {
        let place = facts.value("name").map_or(input.ident.span(), Spanned::span);
        let message = format!(
            "\"{name}\" is no C identifier, which the name of a model is: write letters, digits and underscores"
        );
        return Err(Error::new(place, message));
    }
    let description = text::description(&input.attrs);
    let times = ["stop_time", "step_size"].into_iter().filter_map(|key| {
        let (field, value) = (Ident::new(key, facts.span), facts.value(key)?);
        Some(quote! { info.#field = ::core::convert::From::from(#value); })
    });
    Ok(quote! {
        let mut info = ::fmi_component::ModelInfo::new(#name, ::core::env!("CARGO_PKG_VERSION"), #description);
        info.package = ::core::env!("CARGO_PKG_NAME");
        #(#times)*
        info
    })
}

/// What a saved state has of each field.
struct Saved {
    /// Fields of the state.
    kept: Vec<TokenStream>,
    /// Their values from the component.
    save: Vec<TokenStream>,
    /// Statements that put them over those of a state.
    keep: Vec<TokenStream>,
    /// Statements that bring them back.
    load: Vec<TokenStream>,
}

impl Saved {
    fn of(fields: &[Field]) -> Self {
        let mut saved = Self {
            kept: Vec::new(),
            save: Vec::new(),
            keep: Vec::new(),
            load: Vec::new(),
        };
        for field in fields.iter().filter(|field| field.facts.fact("skip").is_none()) {
            saved.add(field);
        }
        saved
    }

    /// Arrays of any length are kept as vectors: serde knows those of up to 32 elements.
    fn add(&mut self, field: &Field) {
        let (ident, of) = (&field.ident, &field.of);
        let dimensions = field.shape.as_ref().map_or(0, |shape| shape.dimensions.len());
        let (of, save, keep, load) = match dimensions {
            0 => (
                quote! { #of },
                quote! { ::core::clone::Clone::clone(&self.#ident) },
                quote! { ::core::clone::Clone::clone_from(&mut state.#ident, &self.#ident); },
                quote! { ::core::clone::Clone::clone_from(&mut self.#ident, &state.#ident); },
            ),
            1 => (
                quote! { ::std::vec::Vec<f64> },
                quote! { self.#ident.to_vec() },
                quote! { ::std::borrow::ToOwned::clone_into(&self.#ident[..], &mut state.#ident); },
                quote! { ::fmi_component::derived::copy(&state.#ident, &mut self.#ident[..])?; },
            ),
            _ => (
                quote! { ::std::vec::Vec<f64> },
                quote! { self.#ident.as_flattened().to_vec() },
                quote! { ::std::borrow::ToOwned::clone_into(self.#ident.as_flattened(), &mut state.#ident); },
                quote! { ::fmi_component::derived::copy(&state.#ident, self.#ident.as_flattened_mut())?; },
            ),
        };
        self.kept.push(quote! { #ident: #of });
        self.save.push(quote! { #ident: #save });
        self.keep.push(keep);
        self.load.push(load);
    }
}
