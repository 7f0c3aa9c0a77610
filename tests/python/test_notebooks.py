"""The notebooks run from top to bottom, and print what is stored in them."""

import re
from typing import Any

import nbformat
import pytest
from conftest import ROOT

from jostle_lab.errors import LabError
from tools.notebooks import LARGEST, executed, texts
from tools.paths import NOTEBOOKS

NAMES = sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb"))
REMEDY = "Make them anew: python -m tools notebooks"


def stored(name: str) -> Any:
    return nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)


def test_there_are_three_and_the_guide_names_them():
    assert len(NAMES) == 3
    guide = (ROOT / "docs/python.md").read_text()
    assert all(f"(notebooks/{name}.ipynb)" in guide for name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_prints_what_is_stored(name: str):
    assert texts(executed(NOTEBOOKS / f"{name}.ipynb")) == texts(stored(name)), REMEDY


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_is_small_and_tells_nothing_of_the_machine_that_made_it(name: str):
    text = (NOTEBOOKS / f"{name}.ipynb").read_text()
    assert len(text) <= LARGEST, REMEDY
    notebook = stored(name)
    assert notebook.metadata.language_info == {"name": "python"}
    printed = [output for outputs in texts(notebook).values() for output in outputs]
    assert printed and not any(output.startswith("stderr") or "Warning" in output for output in printed)
    assert not any(re.search(r"(^|[\s'\"])/\w+/|[A-Z]:\\", output) for output in printed)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1)), REMEDY
    assert sum("image/png" in output.get("data", {}) for cell in code for output in cell.outputs) >= 2


@pytest.mark.parametrize("name", NAMES)
def test_links_of_a_notebook_lead_to_files(name: str):
    links = [
        link
        for cell in stored(name).cells
        if cell.cell_type == "markdown"
        for link in re.findall(r"\]\(([^)#]+)", cell.source)
    ]
    assert len(links) >= 3
    assert [link for link in links if not (NOTEBOOKS / link).is_file()] == []


def test_a_cell_that_fails_is_an_error_with_the_cell(tmp_path):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("1 / 0")])
    (tmp_path / "wrong.ipynb").write_text(nbformat.writes(notebook))
    with pytest.raises(LabError, match=r"(?s)wrong\.ipynb cannot be executed.*1 / 0.*ZeroDivisionError"):
        executed(tmp_path / "wrong.ipynb")
