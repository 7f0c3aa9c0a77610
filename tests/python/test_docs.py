"""The pages name tests that there are."""

import re

from conftest import ROOT

PAGE = (ROOT / "docs/importers.md").read_text()
SOURCES = {path.name: path.read_text() for path in (ROOT / "tests").rglob("*") if path.suffix in (".py", ".rs")}


def test_every_test_that_the_page_of_importers_names_exists() -> None:
    everything = "\n".join(SOURCES.values())
    tests = [match[1] for match in re.finditer(r"`(?:\w+\.py::)?(test_\w+)`", PAGE)]
    tests += re.findall(r"`tests/\w+/\w+\.rs` \(`(\w+)`\)", PAGE)
    files = re.findall(r"`(?:tests/(?:\w+/)?)?(\w+\.(?:py|rs))(?:::\w+)?`", PAGE)
    assert len(tests) > 10
    assert len(files) > 10
    assert [name for name in files if name not in SOURCES] == []
    assert [name for name in tests if not re.search(rf"\b(?:def|fn) {name}\(", everything)] == []
    # `test_fmuloader_2`, `_3`: what follows a comma is another ending of the same name.
    for first, rest in re.findall(r"`\w+\.py::(test_[a-z]+)\w*`((?:, `_\w+`)+)", PAGE):
        for end in re.findall(r"`(_\w+)`", rest):
            assert f"def {first}{end}(" in everything, f"{first}{end}"
