"""Files that are whole or absent, and JSON that a reader can trust."""

import json
from pathlib import Path
from typing import Any

from jostle_lab.errors import LabError


def replace_text(path: Path, text: str) -> None:
    """Write a file beside its place and rename it: whoever reads, or kills us, meets the old one or the new one."""
    draft = path.with_name(f"_{path.name}.draft")
    try:
        draft.write_text(text)
        draft.replace(path)
    except OSError:
        draft.unlink(missing_ok=True)
        raise


def read_json(path: Path, remedy: str) -> dict[str, Any]:
    """An object of JSON; raises LabError with `remedy` if the file is damaged."""
    try:
        found = json.loads(path.read_text())
    except ValueError as error:
        raise LabError(f"{path} is damaged: {error}. {remedy}") from None
    if not isinstance(found, dict):
        raise LabError(f"{path} is damaged: it holds no object of JSON. {remedy}")
    return found
