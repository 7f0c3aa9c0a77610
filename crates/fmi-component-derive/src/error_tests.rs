//! What the macros refuse: each error points at the words that are wrong and says what to write.

use proc_macro2::{LineColumn, Span};
use syn::{DeriveInput, Error};

use crate::{component, enumeration};

/// The source with `«` and `»` around what the error must point at, and words of its message.
const COMPONENTS: &[(&str, &[&str])] = &[
    (
        "struct A { «#[parameter(unit = \"m\")]» length: f64 }",
        &["`length` has no start value", "#[parameter(start = ..)]"],
    ),
    (
        "struct A { #[parameter(start = 1.0, unit = «\"furlong/s\"»)] speed: f64 }",
        &["\"furlong\"", "coherent units kg, m, s", "unit = MY_UNIT"],
    ),
    (
        "struct A { #[output(unit = «\"m/s/s\"»)] a: f64 }",
        &["one slash, such as \"N.m/s2\""],
    ),
    (
        "struct A { #[output(«units» = \"m\")] x: f64 }",
        &["`units` has no meaning here", "write one of: start, min, max, unit"],
    ),
    (
        "struct A { #[parameter(start = 1, «min»)] n: i32 }",
        &["`min` needs a value", "write `min = ..`"],
    ),
    (
        "struct A { #[parameter(start = 1, tunable = «true»)] n: i32 }",
        &["`tunable` takes no value", "write `tunable` alone"],
    ),
    (
        "struct A { #[parameter(start = 1, «start» = 2)] n: i32 }",
        &["`start` is given twice"],
    ),
    (
        "struct A { #[parameter(start = true, «unit» = \"m\")] on: bool }",
        &["`unit` is for an f64 or f32", "`on` is a bool", "leave it out"],
    ),
    (
        "struct A { #[input(«max» = 3)] name: String }",
        &["`max` is for a number", "`name` is a String"],
    ),
    (
        "struct A { #[parameter(start = \"a\", «tunable»)] name: String }",
        &["tunable parameters are numbers", "leave `tunable` out"],
    ),
    (
        "struct A { #[output(«discrete»)] count: i32 }",
        &["it is discrete without being told"],
    ),
    (
        "struct A { #[output] size: «usize» }",
        &[
            "no variable has this type",
            "f64, f32, bool, String, Vec<u8>",
            "#[derive(Enumeration)]",
        ],
    ),
    (
        "struct A { #[output] pair: «(f64, f64)» }",
        &["no variable has this type"],
    ),
    (
        "struct A { #[output] list: «Vec<f64>» }",
        &["no variable has this type", "[f64; 3]"],
    ),
    (
        "struct A { #[output] flags: [«bool»; 3] }",
        &["write [f64; N], or one field for each element"],
    ),
    (
        "struct A { #[output] #[input] «x»: f64 }",
        &["`x` has a role already", "#[parameter], #[input]"],
    ),
    (
        "struct A { #[output] x: f64, #[input(name = \"x\")] «y»: f64 }",
        &["another field is the variable `x`", "another name"],
    ),
    (
        "struct A { #[output(name = «x»)] x: f64 }",
        &["`name` is a text", "write `name = \"..\"`"],
    ),
    (
        "#[component(«stop» = 1.0)] struct A { #[output] x: f64 }",
        &["write one of: name, stop_time, step_size"],
    ),
    (
        "#[component(name = «\"my model\"»)] struct A { #[output] x: f64 }",
        &["\"my model\" is no C identifier", "letters, digits and underscores"],
    ),
    ("struct A<«T»> { #[output] x: T }", &["no type parameters"]),
    ("struct «A»(f64);", &["a struct with named fields"]),
    ("enum «A» { B }", &["a struct with named fields"]),
];

const ENUMERATIONS: &[(&str, &[&str])] = &[
    ("struct «A»;", &["for an enum"]),
    ("enum «A» {}", &["at least one option"]),
    ("enum A { B«(f64)» }", &["write `B` alone"]),
    (
        "enum A { #[enumeration(name = \"C\")] B, «C» }",
        &["another option is named `C`", "#[enumeration(name = \"..\")]"],
    ),
];

/// The source without marks, and the text between them.
fn unmarked(source: &str) -> (String, String) {
    let (before, rest) = source.split_once('«').expect("a mark");
    let (marked, after) = rest.split_once('»').expect("a second mark");
    (format!("{before}{marked}{after}"), marked.to_owned())
}

/// What `span` covers of a source of one line.
fn covered(source: &str, span: Span) -> String {
    let (LineColumn { column: start, .. }, LineColumn { column: end, .. }) = (span.start(), span.end());
    source.chars().skip(start).take(end - start).collect()
}

fn check(expand: fn(&DeriveInput) -> syn::Result<proc_macro2::TokenStream>, cases: &[(&str, &[&str])]) {
    for (marked, words) in cases {
        let (source, wrong) = unmarked(marked);
        let input: DeriveInput = syn::parse_str(&source).expect("a type");
        let error: Error = expand(&input).expect_err(&source);
        let message = error.to_string();
        for word in *words {
            assert!(message.contains(word), "{source}: {message}");
        }
        let first = covered(&source, error.span());
        // An attribute is pointed at by its first token where spans cannot be joined.
        assert!(
            !first.is_empty() && wrong.starts_with(&first),
            "{source}: points at {first:?}"
        );
    }
}

#[test]
fn errors_of_components_point_at_the_fault_and_say_what_to_write() {
    check(component::expand, COMPONENTS);
}

#[test]
fn errors_of_enumerations_point_at_the_fault_and_say_what_to_write() {
    check(enumeration::expand, ENUMERATIONS);
}

#[test]
fn all_faulty_fields_are_told_of_at_once() {
    let input: DeriveInput =
        syn::parse_str("struct A { #[output] a: usize, #[output] good: f64, #[parameter] b: f64 }").expect("a type");
    let errors = component::expand(&input).expect_err("two faults");
    assert_eq!(errors.into_iter().count(), 2);
}
