//! The page `documentation/index.html` of an FMU: that of a model with a data sheet, and that of one without.

#![allow(clippy::unwrap_used)]

mod support;

use std::io::{Cursor, Read};

use fmi_bundle::{Component, Origin, Platform, Version, pack};
use fmi_component::{ModelInfo, ModelType};
use quick_xml::Reader;
use quick_xml::events::Event;
use support::{MODEL, component, fakes};
use zip::ZipArchive;

fn page(component: &Component, version: Version) -> String {
    let mut archive = ZipArchive::new(Cursor::new(
        pack(component, version, &fakes::libraries(&[Platform::X86Linux])).unwrap(),
    ))
    .unwrap();
    let (mut entry, mut text) = (archive.by_name("documentation/index.html").unwrap(), String::new());
    entry.read_to_string(&mut text).unwrap();
    text
}

/// Reads the page as XML, which it is too, but for named entities.
fn check_well_formed(page: &str) {
    let (mut reader, mut depth) = (Reader::from_str(page), 0);
    loop {
        match reader.read_event().unwrap() {
            Event::Start(_) => depth += 1,
            Event::End(_) => depth -= 1,
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(depth, 0, "an element is not closed");
}

/// A model without a data sheet.
fn plain() -> Component {
    let model = ModelType {
        info: || ModelInfo {
            sheet: fmi_component::DataSheet::EMPTY,
            ..(MODEL.info)()
        },
        ..MODEL
    };
    Component::new(&model, &[]).unwrap()
}

#[test]
fn pages_are_well_formed_and_need_nothing_but_themselves() {
    for component in [component(), plain()] {
        for version in [Version::Two, Version::Three] {
            let page = page(&component, version);
            check_well_formed(&page);
            for source in [" src=", "<link", "<script", "@import", "url(http"] {
                assert!(!page.contains(source), "{source}");
            }
        }
    }
}

#[test]
fn the_diagram_has_all_inputs_and_the_outputs_that_the_model_names() {
    let page = page(&component(), Version::Three);
    let (begin, end) = (
        page.find("<div class=\"diagram\">").unwrap(),
        page.find("<nav>").unwrap(),
    );
    let diagram = page[begin..end].replace("<wbr/>", "");
    for shown in [
        "frame.position</code> [m]",
        "frame.velocity</code> [m/s]",
        "frame.reaction_force</code> [N]",
        "body.position[1..3]",
    ] {
        assert!(diagram.contains(shown), "{shown}: {diagram}");
    }
    assert!(
        diagram.contains("spring.stiffness</code> = 100 [N/m]") && diagram.contains("more in the"),
        "{diagram}"
    );
}

#[test]
fn purpose_limits_symbols_and_recommended_ranges_are_there_and_what_is_empty_is_not() {
    let full = page(&component(), Version::Three);
    for part in [
        "Springs &amp; masses",
        "Springs of any length",
        "The frame stands still",
        "<td><i>k</i></td>",
    ] {
        assert!(full.contains(part), "{part}");
    }
    assert!(full.contains("<th>Changes while running</th>") && full.contains("<td>between steps</td>"));
    assert!(full.contains("damping ratio: 0 to 1") && full.contains("1 &lt; c is no oscillator"));
    let plain = page(&plain(), Version::Three);
    for part in ["What it is for", "Symbols", "Without inputs", "Authors", "What is new"] {
        assert!(!plain.contains(part), "{part}");
    }
}

#[test]
fn the_origin_is_told_as_far_as_it_is_known() {
    let mut component = component();
    component.origin = Origin {
        repository: "https://example.org/a?b&c".into(),
        tools: "compiler 7".into(),
        changes: "<p>All new.</p>".into(),
        ..Origin::default()
    };
    let page = page(&component, Version::Two);
    assert!(
        page.contains("<a href=\"https://example.org/a?b&amp;c\">"),
        "an address is a link"
    );
    assert!(page.contains("compiler 7") && page.contains("<p>All new.</p>"));
    assert!(!page.contains("Contact") && page.contains("Copyright (c) 2026 A. &amp; B. Author"));
}

#[test]
fn both_versions_say_what_they_can_do() {
    let [two, three] = [Version::Two, Version::Three].map(|version| page(&component(), version));
    assert!(two.contains("Co-simulation for FMI 2.0") && !two.contains("Intermediate update"));
    assert!(three.contains("A step ends early at an event") && three.contains("each element is a scalar"));
}

/// A run whose steps are refused is shown as far as it goes, with the reason.
#[test]
fn a_run_that_ends_early_says_why() {
    let model = ModelType {
        prepare: |structure| {
            let mut simulation = (MODEL.prepare)(structure);
            let position = simulation.position("fault.refuse_time").unwrap();
            simulation.set_at(position, 0.05.into()).unwrap();
            simulation
        },
        ..MODEL
    };
    let page = page(&Component::new(&model, &[]).unwrap(), Version::Three);
    assert!(page.contains("The run ends early: oscillators: step refused"));
}

/// The curves are those of the reference trajectory where the model names no run.
#[test]
fn the_picture_has_a_point_for_each_row_of_the_reference_trajectory() {
    let page = page(&component(), Version::Three);
    let rows = fmi_bundle::reference::record(&component()).unwrap().lines().count() - 1;
    let polylines: Vec<&str> = page.split("<polyline").skip(1).collect();
    assert_eq!(polylines.len(), 4, "two inputs and two outputs");
    for polyline in polylines {
        let points = polyline.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        assert_eq!(points.split(' ').count(), rows);
    }
}
