//! A thin layer over the XML writer: elements with attribute lists, written to memory.

use std::io::{self, Write};

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

/// Attributes in the order in which they are written.
pub type Attributes = Vec<(&'static str, String)>;
/// Writes XML to memory.
pub type Xml = Writer<Vec<u8>>;

/// The document that `content` writes.
pub fn document(content: impl FnOnce(&mut Xml) -> io::Result<()>) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    let written = xml
        .write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))
        .and_then(|()| content(&mut xml))
        .and_then(|()| xml.get_mut().write_all(b"\n"));
    debug_assert!(written.is_ok(), "writing to memory does not fail");
    String::from_utf8_lossy(&xml.into_inner()).into_owned()
}

/// `<name attributes/>`
pub fn empty(xml: &mut Xml, name: &str, attributes: &Attributes) -> io::Result<()> {
    let list = attributes.iter().map(|(key, value)| (*key, value.as_str()));
    xml.create_element(name).with_attributes(list).write_empty()?;
    Ok(())
}

/// `<name attributes>content</name>`
pub fn element(
    xml: &mut Xml,
    name: &str,
    attributes: &Attributes,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    let list = attributes.iter().map(|(key, value)| (*key, value.as_str()));
    xml.create_element(name)
        .with_attributes(list)
        .write_inner_content(content)?;
    Ok(())
}

/// Shortest text that reads back as the same bits.
pub fn number(value: f64) -> String {
    format!("{value:?}")
}
