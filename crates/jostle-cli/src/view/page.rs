//! The parts of the page, put into one file.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

const INDEX: &str = include_str!("../../page/index.html");
const STYLE: &str = include_str!("../../page/style.css");
const MODULE: &[u8] = include_bytes!("../../page/jostle.wasm.gz");

macro_rules! scripts {
    ($($name:literal),*) => {
        [$(($name, include_str!(concat!("../../page/", $name, ".js")))),*]
    };
}

/// Scripts by name; they import each other as jostle/NAME.
const SCRIPTS: [(&str, &str); 11] = scripts!(
    "app", "colours", "controls", "draw", "form", "module", "plots", "record", "replay", "shapes", "sources"
);

/// A recorded run.
pub struct Run {
    /// CSV file of the samples.
    pub samples: String,
    /// CSV file of the parameters.
    pub parameters: String,
    /// Name of the file of the samples.
    pub name: String,
}

/// The page. `start` is what follows # in a link to the scene that it shows first.
pub fn html(start: &str, run: Option<&Run>) -> String {
    // A script of a page from a file may import no other file; a map of names to scripts inside of the page works everywhere.
    let imports = SCRIPTS.map(|(name, script)| {
        let script = BASE64_STANDARD.encode(script);
        format!("\"jostle/{name}\":\"data:text/javascript;base64,{script}\"")
    });
    let parts = [
        ("{{version}}", env!("CARGO_PKG_VERSION").to_string()),
        ("{{start}}", escaped(start)),
        ("{{style}}", STYLE.to_string()),
        ("{{imports}}", format!("{{\"imports\":{{{}}}}}", imports.join(","))),
        ("{{module}}", BASE64_STANDARD.encode(MODULE)),
        ("{{run}}", run.map(elements).unwrap_or_default()),
    ];
    let mut html = String::new();
    let mut rest = INDEX;
    // In the order of the places, so that nothing is replaced inside of what was put in.
    for (place, content) in &parts {
        if let Some((before, after)) = rest.split_once(place) {
            html.push_str(before);
            html.push_str(content);
            rest = after;
        }
    }
    html + rest
}

fn elements(run: &Run) -> String {
    let element = |id: &str, name: &str, text: &str| {
        let (name, text) = (escaped(name), escaped(text));
        format!("<pre hidden id=\"{id}\" data-name=\"{name}\">{text}</pre>")
    };
    let stem = run.name.strip_suffix(".csv").unwrap_or(&run.name);
    let samples = element("samples", &format!("{stem}.csv"), &run.samples);
    samples + &element("parameters-file", &format!("{stem}.parameters.csv"), &run.parameters)
}

/// Text that stands for itself in HTML, also between quotes.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_filled_and_nothing_is_fetched() {
        let run = Run {
            samples: "time\n0\n".into(),
            parameters: "name,value,unit\n".into(),
            name: "a\"<b>.csv".into(),
        };
        let html = html("scene=packing&disks=3", Some(&run));
        assert!(!html.contains("{{") && !html.contains("}}\""), "a place is left");
        assert!(html.contains("data-start=\"scene=packing&amp;disks=3\""));
        assert!(html.contains("data-name=\"a&quot;&lt;b&gt;.parameters.csv\""));
        for address in ["http:", "https:", "src=", "<link"] {
            assert!(!html.contains(address), "{address}");
        }
    }

    #[test]
    fn every_script_that_is_imported_is_there() {
        for (name, script) in SCRIPTS {
            let imports = script
                .split("from \"jostle/")
                .skip(1)
                .filter_map(|rest| rest.split_once('"'));
            for (imported, _) in imports {
                assert!(
                    SCRIPTS.iter().any(|(known, _)| *known == imported),
                    "{name} imports {imported}"
                );
            }
        }
    }
}
