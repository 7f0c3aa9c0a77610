//! The part of the change log that belongs to a version, as HTML for the data sheet of an FMU.

use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};

/// Part that tells maintainers of pinned values, and users nothing.
const FOR_MAINTAINERS: &str = "Goldens";

/// The chapter of `version` in a change log of the format Keep a Changelog, or that of what is not released yet. Without links,
/// which lead to files that are not in an FMU.
pub fn of_version(log: &str, version: &str) -> String {
    let events: Vec<Event> = Parser::new_ext(log, Options::ENABLE_TABLES).collect();
    let of = |wanted: &str| {
        chapter(&events, HeadingLevel::H2, |title| {
            title.trim_start_matches('[').starts_with(wanted)
        })
    };
    let found = of(version).or_else(|| of("Unreleased")).unwrap_or_default();
    let mut text = String::new();
    html::push_html(&mut text, shown(found).into_iter());
    text
}

/// What is below the first heading of this level whose title is `wanted`.
fn chapter<'a, 'b>(
    events: &'b [Event<'a>],
    level: HeadingLevel,
    wanted: impl Fn(&str) -> bool,
) -> Option<&'b [Event<'a>]> {
    let starts = |event: &Event| matches!(event, Event::Start(Tag::Heading { level: of, .. }) if *of == level);
    let ends = |event: &Event| *event == Event::End(TagEnd::Heading(level));
    let mut rest = events;
    loop {
        rest = &rest[rest.iter().position(starts)? + 1..];
        let (title, below) = rest.split_at(rest.iter().position(ends)? + 1);
        if wanted(&plain(title)) {
            let end = below.iter().position(starts).unwrap_or(below.len());
            return Some(&below[..end]);
        }
    }
}

/// The text of `events` alone.
fn plain(events: &[Event]) -> String {
    let text = |event: &Event| match event {
        Event::Text(text) | Event::Code(text) => Some(text.to_string()),
        _ => None,
    };
    events.iter().filter_map(text).collect()
}

/// `events` without links and without the part for maintainers, headings two levels down.
fn shown<'a>(events: &[Event<'a>]) -> Vec<Event<'a>> {
    let (mut shown, mut rest) = (Vec::new(), events);
    while let Some((first, behind)) = rest.split_first() {
        rest = behind;
        match first {
            Event::Start(Tag::Heading { .. }) => {
                let end = rest
                    .iter()
                    .position(|event| matches!(event, Event::End(TagEnd::Heading(_))));
                let (title, below) = rest.split_at(end.unwrap_or(rest.len()));
                rest = below.get(1..).unwrap_or_default();
                if plain(title) == FOR_MAINTAINERS {
                    let next = rest
                        .iter()
                        .position(|event| matches!(event, Event::Start(Tag::Heading { .. })));
                    rest = &rest[next.unwrap_or(rest.len())..];
                    continue;
                }
                shown.push(Event::Start(Tag::Paragraph));
                shown.push(Event::Start(Tag::Strong));
                shown.extend_from_slice(title);
                shown.push(Event::End(TagEnd::Strong));
                shown.push(Event::End(TagEnd::Paragraph));
            }
            Event::Start(Tag::Link { .. }) | Event::End(TagEnd::Link) => {}
            other => shown.push(other.clone()),
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::of_version;

    const LOG: &str = "# Changelog\n\nAll.\n\n## Unreleased\n\n### Added\n- A `b` & [c](d.md).\n\n### Goldens\n- Pinned.\n\n### Fixed\n- E.\n\n\
                       ## [1.2.0] - 2026-01-02\n\n- Old.\n\n## 1.1.0\n\n- Older.\n";

    #[test]
    fn the_chapter_of_the_version_is_taken() {
        assert_eq!(of_version(LOG, "1.2.0").trim(), "<ul>\n<li>Old.</li>\n</ul>");
        assert_eq!(of_version(LOG, "1.1.0").trim(), "<ul>\n<li>Older.</li>\n</ul>");
    }

    #[test]
    fn a_version_that_is_not_released_has_the_chapter_of_what_is_to_come() {
        let text = of_version(LOG, "2.0.0");
        assert!(
            text.contains("<strong>Added</strong>") && text.contains("A <code>b</code> &amp; c."),
            "{text}"
        );
        assert!(
            text.contains("E.") && !text.contains("Pinned") && !text.contains("Old"),
            "{text}"
        );
    }

    #[test]
    fn a_log_without_chapters_gives_nothing() {
        assert_eq!(of_version("# Changelog\n", "1.0.0"), "");
    }
}
