//! Component in, the documentation page inside the FMU out: a data sheet that needs nothing but itself.

mod capabilities;
mod curves;
mod diagram;
mod example;
mod origin;
mod tables;

use fmi_component::{Result, Version};
use quick_xml::escape::escape;

use crate::component::Component;
pub use origin::{libraries, with_libraries, without_build};

/// Path of the page in an FMU.
pub const PATH: &str = "documentation/index.html";

const STYLE: &str = include_str!("documentation/style.css");

/// The page: what goes in and out, what the model is for and where it is wrong, a run, equations, variables, what an importer can
/// use, and where it comes from. `libraries` is a text of [`libraries()`].
///
/// # Errors
/// The model panics in the run that the page shows, which is a defect of it.
pub fn write(component: &Component, version: Version, libraries: &str) -> Result<String> {
    let info = component.info();
    let title = title(component);
    let sections = [
        ("use", "What it is for", purpose(component)),
        ("run", "A run", example::write(component)?),
        ("equations", "Equations", equations(component)),
        ("variables", "Variables", tables::variables(component)),
        (
            "fmi",
            "What an importer can use",
            capabilities::write(component, version),
        ),
        ("origin", "Version and licence", origin::write(component, libraries)),
    ];
    let shown = sections.iter().filter(|(.., content)| !content.is_empty());
    let links: Vec<String> = shown
        .clone()
        .map(|(id, title, _)| format!("<a href=\"#{id}\">{title}</a>"))
        .collect();
    let content: String = shown
        .map(|(id, title, content)| format!("<h2 id=\"{id}\">{title}</h2>\n{content}"))
        .collect();
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n<p>{description}.</p>\n<p class=\"facts\">{facts}</p>\n{diagram}\
         <nav>{links}</nav>\n{content}</body>\n</html>\n",
        title = escape(title.as_str()),
        description = escape(info.description.trim_end_matches('.')),
        facts = facts(component, version),
        diagram = diagram::write(component),
        links = links.join(" &middot; "),
    ))
}

fn title(component: &Component) -> String {
    let info = component.info();
    let variant: Vec<&str> = info.variant.iter().map(|(_, value)| *value).collect();
    match variant.as_slice() {
        [] => info.name.into(),
        variant => format!("{} ({})", info.name, variant.join(", ")),
    }
}

/// What was decided when the FMU was written.
fn facts(component: &Component, version: Version) -> String {
    let standard = match version {
        Version::Two => "Co-simulation FMU for FMI 2.0",
        Version::Three => "Co-simulation FMU for FMI 3.0",
    };
    let variant = component
        .info()
        .variant
        .iter()
        .map(|(key, value)| format!("{key}: {value}"));
    let structure = component
        .structure()
        .iter()
        .map(|(name, value)| format!("{name}: {value}"));
    let all: Vec<String> = [standard.into()].into_iter().chain(variant).chain(structure).collect();
    format!(
        "{}. Made by {}.",
        escape(all.join(", ").as_str()),
        escape(component.tool().as_str())
    )
}

fn purpose(component: &Component) -> String {
    let sheet = &component.info().sheet;
    let purpose = match sheet.purpose {
        "" => String::new(),
        text => format!("<p>{text}</p>\n"),
    };
    let limits: String = sheet.limits.iter().map(|limit| format!("<li>{limit}</li>\n")).collect();
    match limits.as_str() {
        "" => purpose,
        limits => format!("{purpose}<h3>Where it is wrong or refuses</h3>\n<ul>\n{limits}</ul>\n"),
    }
}

fn equations(component: &Component) -> String {
    let fragment = component.info().equations;
    let symbols = tables::symbols(component);
    match (fragment, symbols.as_str()) {
        ("", "") => String::new(),
        (fragment, symbols) => format!("{fragment}\n{symbols}"),
    }
}
