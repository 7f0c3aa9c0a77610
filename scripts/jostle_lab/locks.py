"""One command at a time in a folder of results.

Guarantees: a lock goes with the process that holds it, however that ends; a file that is left behind blocks nobody.
Needs: a local file system that knows flock.
"""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from jostle_lab.errors import LabError, about

LOCK = "_lock"
"""In the folder; it holds the number of the process that writes there. Readers of a folder of Parquet pass it over."""


@contextmanager
def held(folder: Path, what: str) -> Iterator[None]:
    """Hold a folder, which is there, against other commands; `what` says in their errors which command holds it.

    Raises LabError with the process that holds it.
    """
    with (folder / LOCK).open("a+") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.seek(0)
            raise LabError(_refusal(folder, lock.read().strip())) from None
        except OSError as error:
            raise about(folder / LOCK, error) from None
        _write(lock.fileno(), f"{os.getpid()} {what}\n")
        try:
            yield
        finally:
            _write(lock.fileno(), "")


def _write(file: int, text: str) -> None:
    """The whole content; the text is there or not, but never an error of a full disk, since only errors need it."""
    try:
        os.ftruncate(file, 0)
        os.write(file, text.encode())
    except OSError:
        return


def _refusal(folder: Path, holder: str) -> str:
    number, _, what = holder.partition(" ")
    another = f"Another {what or 'command'}"
    if not number.isdigit():
        return f"{another} writes to {folder}. Wait for it, or name another folder with --results."
    return (
        f"{another} writes to {folder}: process {number}. Wait for it, end it (kill {number}), or name another folder "
        "with --results."
    )
