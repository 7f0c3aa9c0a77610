//! Units written as texts, such as `"kg.m2/s3"`: names as in model descriptions, dot for products, one slash, whole exponents.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Error, LitStr, Result};

/// Units that `fmi_component::Unit` knows with their quantity: text and constant.
const CONSTANTS: [(&str, &str); 18] = [
    ("1", "ONE"),
    ("m", "METRE"),
    ("m/s", "METRE_PER_SECOND"),
    ("m/s2", "METRE_PER_SECOND_SQUARED"),
    ("rad", "RADIAN"),
    ("rad/s", "RADIAN_PER_SECOND"),
    ("s", "SECOND"),
    ("Hz", "HERTZ"),
    ("kg", "KILOGRAM"),
    ("kg/s", "KILOGRAM_PER_SECOND"),
    ("kg/m2", "KILOGRAM_PER_SQUARE_METRE"),
    ("N", "NEWTON"),
    ("N/m", "NEWTON_PER_METRE"),
    ("N.s", "NEWTON_SECOND"),
    ("J", "JOULE"),
    ("W", "WATT"),
    ("N.m", "NEWTON_METRE"),
    ("N.m/s", "NEWTON_METRE_PER_SECOND"),
];

/// Coherent units of the SI: name, exponents of kg, m, s, A, K, mol, cd and rad.
const SYMBOLS: [(&str, [i32; 8]); 24] = [
    ("kg", [1, 0, 0, 0, 0, 0, 0, 0]),
    ("m", [0, 1, 0, 0, 0, 0, 0, 0]),
    ("s", [0, 0, 1, 0, 0, 0, 0, 0]),
    ("A", [0, 0, 0, 1, 0, 0, 0, 0]),
    ("K", [0, 0, 0, 0, 1, 0, 0, 0]),
    ("mol", [0, 0, 0, 0, 0, 1, 0, 0]),
    ("cd", [0, 0, 0, 0, 0, 0, 1, 0]),
    ("rad", [0, 0, 0, 0, 0, 0, 0, 1]),
    ("Hz", [0, 0, -1, 0, 0, 0, 0, 0]),
    ("N", [1, 1, -2, 0, 0, 0, 0, 0]),
    ("Pa", [1, -1, -2, 0, 0, 0, 0, 0]),
    ("J", [1, 2, -2, 0, 0, 0, 0, 0]),
    ("W", [1, 2, -3, 0, 0, 0, 0, 0]),
    ("C", [0, 0, 1, 1, 0, 0, 0, 0]),
    ("V", [1, 2, -3, -1, 0, 0, 0, 0]),
    ("F", [-1, -2, 4, 2, 0, 0, 0, 0]),
    ("Ohm", [1, 2, -3, -2, 0, 0, 0, 0]),
    ("S", [-1, -2, 3, 2, 0, 0, 0, 0]),
    ("Wb", [1, 2, -2, -1, 0, 0, 0, 0]),
    ("T", [1, 0, -2, -1, 0, 0, 0, 0]),
    ("H", [1, 2, -2, -2, 0, 0, 0, 0]),
    ("lm", [0, 0, 0, 0, 0, 0, 1, 0]),
    ("lx", [0, -2, 0, 0, 0, 0, 1, 0]),
    ("kat", [0, 0, -1, 0, 0, 1, 0, 0]),
];

/// The unit that `text` names, as an expression.
pub fn parse(text: &LitStr) -> Result<TokenStream> {
    let name = text.value();
    if let Some((_, constant)) = CONSTANTS.iter().find(|(known, _)| *known == name) {
        let constant = syn::Ident::new(constant, text.span());
        return Ok(quote! { ::fmi_component::Unit::#constant });
    }
    let exponents = exponents(&name).map_err(|unknown| {
        let symbols: Vec<&str> = SYMBOLS.iter().map(|(symbol, _)| *symbol).collect();
        let message = format!(
            "the unit \"{name}\" is not understood at \"{unknown}\". Write products with a dot and one slash, such as \
             \"N.m/s2\", of the coherent units {}; or name a constant: unit = MY_UNIT with \
             const MY_UNIT: fmi_component::Unit = Unit::new(..)",
            symbols.join(", ")
        );
        Error::new(text.span(), message)
    })?;
    Ok(quote! { ::fmi_component::Unit::new(#text, [#(#exponents),*]) })
}

/// Exponents of the base units, or what is not understood.
fn exponents(name: &str) -> std::result::Result<Vec<proc_macro2::Literal>, String> {
    let mut sum = [0_i32; 8];
    let parts: Vec<&str> = name.split('/').collect();
    if parts.len() > 2 {
        return Err(name.to_owned());
    }
    for (part, sign) in parts.into_iter().zip([1, -1]) {
        let part = part
            .strip_prefix('(')
            .and_then(|part| part.strip_suffix(')'))
            .unwrap_or(part);
        for factor in part.split('.') {
            if factor == "1" {
                continue;
            }
            let letters = factor.trim_end_matches(|sign: char| sign.is_ascii_digit() || sign == '-');
            let power = match &factor[letters.len()..] {
                "" => Ok(1),
                digits => digits.parse::<i32>(),
            };
            let symbol = SYMBOLS.iter().find(|(symbol, _)| *symbol == letters);
            let (Some((_, of_symbol)), Ok(power)) = (symbol, power) else {
                return Err(factor.to_owned());
            };
            for (total, exponent) in sum.iter_mut().zip(of_symbol) {
                *total = exponent
                    .checked_mul(power)
                    .and_then(|product| total.checked_add(sign * product))
                    .ok_or_else(|| factor.to_owned())?;
            }
        }
    }
    let small: std::result::Result<Vec<i8>, _> = sum.into_iter().map(i8::try_from).collect();
    let small = small.map_err(|_| name.to_owned())?;
    Ok(small.into_iter().map(proc_macro2::Literal::i8_unsuffixed).collect())
}
