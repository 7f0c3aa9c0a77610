"""`python -m tools notebooks`: the notebooks of docs/notebooks, executed anew, with their outputs stored in them.

A test executes them and compares what they print with what is stored. Pictures are not compared: their bytes depend on
fonts and on the drawing library.
"""

from pathlib import Path
from typing import Annotated, Any

import nbformat
import typer
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError

from jostle_lab.errors import LabError
from tools.paths import NOTEBOOKS

LIMIT = 120
"""Longest time of a cell [s]."""
LARGEST = 250_000
"""Of a file [bytes]: they are read on the web, and every change of a picture stays in the history."""


def executed(file: Path) -> Any:
    """The notebook with the outputs of this execution, as `nbformat` has it; raises LabError for a cell that fails."""
    notebook = nbformat.read(file, as_version=4)
    # Nothing of this machine or moment: no times, no history of commands in the home folder, no version of Python.
    client = NotebookClient(
        notebook,
        timeout=LIMIT,
        kernel_name="python3",
        record_timing=False,
        coalesce_streams=True,
        extra_arguments=["--HistoryManager.enabled=False", "--IPKernelApp.log_level=40"],
        resources={"metadata": {"path": str(file.parent)}},
    )
    try:
        client.execute()
    except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
        raise LabError(f"{file.name} cannot be executed: {error}") from None
    notebook.metadata.language_info = {"name": "python"}
    return notebook


def texts(notebook: Any) -> dict[str, list[str]]:
    """What the cells print, by the cell's name: warnings and results too, of a picture only its size in words."""
    return {cell.id: [_text(output) for output in cell.outputs] for cell in notebook.cells if cell.cell_type == "code"}


def _text(output: Any) -> str:
    if output.output_type == "stream":
        return f"{output.name}: {output.text}"
    return str(output.get("data", {}).get("text/plain", output.output_type))


def notebooks(
    names: Annotated[
        list[str] | None, typer.Argument(help="Names without ending, such as transport; all unless given.")
    ] = None,
) -> None:
    """Execute the notebooks of docs/notebooks and store what they print and draw; half a minute."""
    for name in names or sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb")):
        file = NOTEBOOKS / f"{name}.ipynb"
        if not file.is_file():
            raise LabError(f"There is no notebook {file}. Name one of {NOTEBOOKS}.")
        text = nbformat.writes(executed(file)) + "\n"
        if len(text) > LARGEST:
            raise LabError(f"{file.name} has {len(text)} bytes, allowed are {LARGEST}. Draw smaller, or less.")
        file.write_text(text)
        typer.echo(f"{file}: {len(text) / 1e3:.0f} kB")
