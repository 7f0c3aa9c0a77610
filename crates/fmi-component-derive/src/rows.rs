//! The code that lists, reads, gives and saves the variable of a field.

use proc_macro2::TokenStream;
use quote::{format_ident, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Expr, ExprLit, Lit, Result, UnOp};

use crate::field::{Field, Role};
use crate::shape::{Class, Shape};
use crate::unit;

/// Statement that pushes the rows of `field` to `rows`.
pub fn push(field: &Field, shape: &Shape) -> Result<TokenStream> {
    let (name, description) = (&field.name, &field.description);
    let causality = match field.role {
        Role::Parameter => quote!(Parameter),
        Role::Input => quote!(Input),
        Role::Calculated => quote!(CalculatedParameter),
        Role::Output | Role::State => quote!(Output),
    };
    let about = quote! { #name, #description, ::fmi_component::Causality::#causality };
    let kind = kind(field, shape)?;
    let push = match shape.dimensions.is_empty() {
        true => {
            let read = read(field, shape.class);
            quote! { rows.push(::fmi_component::Row::new(#about, #kind, #read)); }
        }
        false => {
            let (start, dimensions) = (array(field, shape), &shape.dimensions);
            let (of, flat) = (&field.of, flattened(shape, &quote!(start)));
            let fill = fill(field, shape);
            quote! {
                let start: #of = #start;
                rows.extend(::fmi_component::derived::array(#about, #kind, &[#(#dimensions),*], #flat, #fill));
            }
        }
    };
    let derivative = field.facts.text("derivative")?.map(|derivative| {
        quote! { ::fmi_component::derived::derive(&mut rows[first..], #derivative); }
    });
    let flags = ["tunable", "discrete"].into_iter().filter_map(|flag| {
        let key = &field.facts.fact(flag)?.key;
        Some(quote! { rows[first..].iter_mut().for_each(|row| row.variable.#key = true); })
    });
    let flags: Vec<TokenStream> = flags.collect();
    Ok(match (derivative, flags.as_slice()) {
        (None, []) => push,
        (derivative, flags) => quote! { let first = rows.len(); #push #derivative #(#flags)* },
    })
}

fn kind(field: &Field, shape: &Shape) -> Result<TokenStream> {
    let start = start(field, shape.class);
    let fact = |key: &str| field.facts.value(key).map(|value| number(value, shape.class));
    let kinds = quote! { ::fmi_component::Kind };
    let derived = quote! { ::fmi_component::derived };
    Ok(match shape.class {
        Class::Real | Class::Single => {
            let unit = match field.facts.value("unit") {
                None => quote! { ::fmi_component::Unit::ONE },
                Some(Expr::Lit(ExprLit {
                    lit: Lit::Str(text), ..
                })) => unit::parse(text)?,
                Some(constant) => quote! { #constant },
            };
            let of = if shape.class == Class::Real {
                quote!(f64)
            } else {
                quote!(f32)
            };
            let min = fact("min").unwrap_or(quote! { #of::NEG_INFINITY });
            let max = fact("max").unwrap_or(quote! { #of::INFINITY });
            let nominal = match fact("nominal") {
                None => quote! { ::core::option::Option::None },
                Some(nominal) => quote! { ::core::option::Option::Some(#nominal) },
            };
            let start = if shape.dimensions.is_empty() {
                start
            } else {
                quote!(0.0)
            };
            let (make, variant) = match shape.class {
                Class::Single => (format_ident!("single"), format_ident!("Single")),
                _ => (format_ident!("quantity"), format_ident!("Real")),
            };
            quote! { #kinds::#variant(#derived::#make(#unit, #min, #max, #nominal, #start)) }
        }
        Class::Whole(of) => {
            let of = format_ident!("{of}");
            let min = fact("min").unwrap_or(quote! { #of::MIN });
            let max = fact("max").unwrap_or(quote! { #of::MAX });
            quote! { #derived::whole::<#of>(#min, #max, #start) }
        }
        Class::Boolean => quote! { #kinds::Boolean { start: #start } },
        Class::Text => quote! { #derived::text(#start) },
        Class::Binary => {
            let mime = match field.facts.text("mime_type")? {
                None => "application/octet-stream".to_owned(),
                Some(mime) => mime,
            };
            quote! { #derived::binary(#start, #mime) }
        }
        Class::Enumeration => {
            let of = &field.of;
            quote_spanned! { field.span() => #derived::options::<#of>(#start) }
        }
    })
}

/// How the value is read; nothing for what the importer gives.
fn read(field: &Field, class: Class) -> TokenStream {
    if field.role.is_settable() {
        return quote! { ::core::option::Option::None };
    }
    let ident = &field.ident;
    let value = quote! { model.component().#ident };
    let (variant, value) = match class {
        Class::Real => ("Real", value),
        Class::Single => ("Real", quote! { f64::from(#value) }),
        Class::Whole(_) => ("Integer", quote! { ::fmi_component::derived::number(#value) }),
        Class::Boolean => ("Integer", quote! { i64::from(#value) }),
        Class::Enumeration => ("Integer", quote! { ::fmi_component::Enumeration::number(#value) }),
        Class::Text => ("Bytes", quote! { #value.as_bytes() }),
        Class::Binary => ("Bytes", quote! { #value.as_slice() }),
    };
    let variant = format_ident!("{variant}");
    quote! {
        ::core::option::Option::Some(::fmi_component::Read::#variant(
            |model: &::fmi_component::ComponentModel<Self>| #value
        ))
    }
}

/// How the elements of an array are read.
fn fill(field: &Field, shape: &Shape) -> TokenStream {
    if field.role.is_settable() {
        return quote! { ::core::option::Option::None };
    }
    let ident = &field.ident;
    let elements = flattened(shape, &quote! { model.component().#ident });
    quote! {
        ::core::option::Option::Some(|model: &::fmi_component::ComponentModel<Self>, first: usize, out: &mut [f64]| {
            let elements: &[f64] = #elements;
            out.copy_from_slice(&elements[first..first + out.len()]);
        })
    }
}

fn flattened(shape: &Shape, value: &TokenStream) -> TokenStream {
    match shape.dimensions.len() {
        1 => quote! { &#value[..] },
        _ => quote! { #value.as_flattened() },
    }
}

/// Expression for the field in a new component; `values` gives what the importer sets, in the order of the rows.
pub fn first(field: &Field) -> TokenStream {
    let ident = &field.ident;
    let value = match (&field.shape, field.role) {
        (Some(shape), role) if role.is_settable() => {
            let start = array(field, shape);
            let given = given(field, shape, &quote!(field));
            match (shape.dimensions.len(), &field.of) {
                (0, _) => given,
                (_, of) => quote! { { let mut field: #of = #start; #given field } },
            }
        }
        (Some(shape), _) if !shape.dimensions.is_empty() => array(field, shape),
        (Some(shape), _) => match (shape.class, start(field, shape.class)) {
            (Class::Text, start) => quote! { ::std::string::String::from(#start) },
            (Class::Binary, start) => quote! { ::fmi_component::derived::bytes(#start) },
            (_, start) => start,
        },
        (None, _) => match field.start() {
            Some(start) => quote! { #start },
            None => quote_spanned! { field.span() => ::core::default::Default::default() },
        },
    };
    quote! { #ident: #value }
}

/// Statement that takes the value that the importer has set.
pub fn take(field: &Field, shape: &Shape) -> TokenStream {
    let ident = &field.ident;
    match shape.dimensions.is_empty() {
        true => {
            let given = given(field, shape, &quote!(self.#ident));
            quote! { self.#ident = #given; }
        }
        false => given(field, shape, &quote!(self.#ident)),
    }
}

/// The next value among `values`: an expression, or of an array a statement that fills `place`.
fn given(field: &Field, shape: &Shape, place: &TokenStream) -> TokenStream {
    let of = &field.of;
    match (shape.dimensions.len(), shape.class) {
        (1, _) => quote! { values.reals(&mut #place[..]); },
        (2.., _) => quote! { values.reals(#place.as_flattened_mut()); },
        (0, Class::Real) => quote! { values.real() },
        (0, Class::Single) => quote! { values.real() as f32 },
        (0, Class::Whole(_)) => quote! { values.whole::<#of>() },
        (0, Class::Boolean) => quote! { (values.integer() != 0) },
        (0, Class::Text) => quote! { values.text() },
        (0, Class::Binary) => quote! { values.bytes() },
        (0, Class::Enumeration) => quote_spanned! { field.span() => values.option::<#of>() },
    }
}

/// How many positions of the table the variable takes.
pub fn count(shape: &Shape) -> TokenStream {
    let dimensions = &shape.dimensions;
    quote! { (1_usize #(* (#dimensions))*) }
}

/// The start value of a scalar, or of each element of an array.
fn start(field: &Field, class: Class) -> TokenStream {
    match (field.start(), class) {
        (Some(start), _) => number(start, class),
        (None, Class::Real | Class::Single) => quote!(0.0),
        (None, Class::Whole(_)) => quote!(0),
        (None, Class::Boolean) => quote!(false),
        (None, Class::Text) => quote!(""),
        (None, Class::Binary) => quote!(&[]),
        (None, Class::Enumeration) => {
            let of = &field.of;
            quote_spanned! { field.span() => <#of as ::fmi_component::Enumeration>::ALL[0] }
        }
    }
}

/// The start value of an array: as it is written, or a number for each element.
fn array(field: &Field, shape: &Shape) -> TokenStream {
    let start = start(field, shape.class);
    let is_number = match field.start() {
        None | Some(Expr::Lit(_)) => true,
        Some(Expr::Unary(unary)) => matches!(*unary.expr, Expr::Lit(_)),
        Some(_) => false,
    };
    if !is_number {
        return start;
    }
    let lengths = shape.dimensions.iter().rev();
    lengths.fold(start, |inner, length| quote! { [#inner; #length] })
}

/// A number as it is written, but that whole numbers stand for reals too: `start = 1` for an `f64`.
fn number(value: &Expr, class: Class) -> TokenStream {
    if !class.is_real() {
        return quote! { #value };
    }
    match value {
        Expr::Lit(ExprLit {
            lit: Lit::Int(whole), ..
        }) if whole.suffix().is_empty() => {
            let real = Lit::new(proc_macro2::Literal::f64_unsuffixed(
                whole.base10_parse::<f64>().unwrap_or(f64::NAN),
            ));
            quote_spanned! { whole.span() => #real }
        }
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            let inner = number(&unary.expr, class);
            quote_spanned! { value.span() => -#inner }
        }
        Expr::Array(array) => {
            let elements = array.elems.iter().map(|element| number(element, class));
            quote_spanned! { value.span() => [#(#elements),*] }
        }
        Expr::Repeat(repeat) => {
            let (element, length) = (number(&repeat.expr, class), &repeat.len);
            quote_spanned! { value.span() => [#element; #length] }
        }
        _ => quote! { #value },
    }
}
