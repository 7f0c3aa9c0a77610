"""Files that are whole or absent, and JSON that a reader can trust."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from jostle_lab.errors import LabError, about


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A name beside `path` to write to, which becomes `path`: whoever reads, or kills us, meets the old or the new.

    What is no regular file, such as /dev/stdout, is written itself. An OSError names `path`.
    """
    written_itself = path.exists() and not path.is_file()
    draft = path if written_itself else path.with_name(f"_{path.name}.draft")
    try:
        yield draft
        if not written_itself:
            draft.replace(path)
    except BaseException as error:
        if not written_itself:
            draft.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise about(path, error) from None
        raise


def replace_text(path: Path, text: str) -> None:
    """Write a file whole."""
    with replacing(path) as draft:
        draft.write_text(text)


def read_json(path: Path, remedy: str) -> dict[str, Any]:
    """An object of JSON; raises LabError with `remedy` if the file is damaged."""
    try:
        found = json.loads(path.read_text())
    except ValueError as error:
        raise LabError(f"{path} is damaged: {error}. {remedy}") from None
    if not isinstance(found, dict):
        raise LabError(f"{path} is damaged: it holds no object of JSON. {remedy}")
    return found
