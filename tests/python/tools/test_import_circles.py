"""Circles of imports are found, and only those."""

from pathlib import Path

from tools.import_circles import circle


def crate(folder: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        path = folder / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder / "src"


def test_a_circle_through_three_files_is_found(tmp_path: Path) -> None:
    files = {
        "lib.rs": "",
        "a.rs": "use crate::b::{B, inner::{C}};",
        "b.rs": "use super::c;",
        "c.rs": "fn f() { crate::a::g() }",
    }
    found = circle(crate(tmp_path, files))
    assert {module[0] for module in found} == {"a", "b", "c"}


def test_a_module_may_name_what_is_inside_it_and_around_it(tmp_path: Path) -> None:
    files = {"lib.rs": "use a::A;", "a.rs": "mod b; use b::B;", "a/b.rs": "use super::A;"}
    assert circle(crate(tmp_path, files)) == []


def test_tests_comments_and_words_of_messages_do_not_count(tmp_path: Path) -> None:
    files = {
        "c.rs": 'const A: &str = "use {";',
        "a.rs": "use crate::b::B;",
        "b.rs": "// use crate::a::A;\n#[cfg(test)]\nmod tests { use crate::a::A; }",
    }
    assert circle(crate(tmp_path, files)) == []
