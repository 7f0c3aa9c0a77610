"""Workers of a Dask scheduler for joblib."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from joblib import parallel_config

from jostle_lab.errors import LabError


def distributed() -> Any:
    """Dask, when it is needed: its import takes longer than most commands."""
    try:
        return import_module("distributed")
    except ImportError:
        raise LabError("Dask is not installed. Install it: pip install 'jostle-lab[cluster]'.") from None


@contextmanager
def client(scheduler: str, patience: float) -> Iterator[Any]:
    """A client of the scheduler, which has workers; `patience` [s] for its answer."""
    dask = distributed()
    logging.getLogger("distributed").setLevel(logging.ERROR)
    try:
        connected = dask.Client(scheduler, timeout=patience)
    except (OSError, ValueError) as error:
        raise LabError(f"No Dask scheduler answers at {scheduler}: {error}. Start one: dask scheduler") from None
    with connected:
        if not connected.nthreads():
            raise LabError(f"{scheduler} has no workers. Start one: dask worker {scheduler}")
        yield connected


@contextmanager
def dask_backend(scheduler: str | None, patience: float = 10.0) -> Iterator[None]:
    """While it is open, joblib's parallel runs go to the workers of `scheduler`; None: they stay here."""
    if scheduler is None:
        yield
        return
    with client(scheduler, patience), parallel_config("dask"):
        yield
