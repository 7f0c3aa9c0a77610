//! Command line: argument -> library call.
fn main() {}
