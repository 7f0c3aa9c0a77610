//! `#[derive(Enumeration)]`: the options of a variable from an `enum` without fields.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Data, DeriveInput, Error, Result};

use crate::facts::Facts;
use crate::text;

/// The implementation of `fmi_component::Enumeration`, and serde's, which saved states need.
pub fn expand(input: &DeriveInput) -> Result<TokenStream> {
    let ident = &input.ident;
    let Data::Enum(data) = &input.data else {
        return Err(Error::new(ident.span(), "derive Enumeration for an enum"));
    };
    if data.variants.is_empty() {
        return Err(Error::new(
            ident.span(),
            "an enumeration has at least one option: write one",
        ));
    }
    let mut options = Vec::new();
    for variant in &data.variants {
        if !variant.fields.is_empty() {
            let message = format!("an option has no fields: write `{}` alone", variant.ident);
            return Err(Error::new_spanned(&variant.fields, message));
        }
        let attribute = variant
            .attrs
            .iter()
            .find(|attribute| attribute.path().is_ident("enumeration"));
        let name = match attribute {
            Some(attribute) => Facts::read(attribute, &["name"], &[])?.text("name")?,
            None => None,
        };
        let name = name.unwrap_or_else(|| variant.ident.to_string());
        if options.iter().any(|(former, _)| *former == name) {
            let message =
                format!("another option is named `{name}`: write #[enumeration(name = \"..\")] with another name");
            return Err(Error::new(variant.ident.span(), message));
        }
        options.push((name, text::description(&variant.attrs)));
    }
    let attribute = input
        .attrs
        .iter()
        .find(|attribute| attribute.path().is_ident("enumeration"));
    let name = match attribute {
        Some(attribute) => Facts::read(attribute, &["name"], &[])?.text("name")?,
        None => None,
    };
    let name = name.unwrap_or_else(|| ident.to_string());
    let variants: Vec<_> = data.variants.iter().map(|variant| &variant.ident).collect();
    let numbers = 1_i64..;
    let numbers: Vec<i64> = numbers.take(variants.len()).collect();
    let pairs = options
        .iter()
        .map(|(name, description)| quote! { (#name, #description) });
    Ok(quote! {
        const _: () = {
            use ::fmi_component::derived::serde;

            #[automatically_derived]
            impl ::fmi_component::Enumeration for #ident {
                const NAME: &'static str = #name;
                const OPTIONS: &'static [(&'static str, &'static str)] = &[#(#pairs),*];
                const ALL: &'static [Self] = &[#(Self::#variants),*];

                fn number(self) -> i64 {
                    match self { #(Self::#variants => #numbers),* }
                }
            }

            #[automatically_derived]
            impl serde::Serialize for #ident {
                fn serialize<S: serde::Serializer>(&self, serializer: S) -> ::core::result::Result<S::Ok, S::Error> {
                    serializer.serialize_i64(::fmi_component::Enumeration::number(*self))
                }
            }

            #[automatically_derived]
            impl<'de> serde::Deserialize<'de> for #ident {
                fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> ::core::result::Result<Self, D::Error> {
                    let number = <i64 as serde::Deserialize>::deserialize(deserializer)?;
                    ::fmi_component::Enumeration::of_number(number)
                        .ok_or_else(|| <D::Error as serde::de::Error>::custom("no option has this number"))
                }
            }
        };
    })
}
