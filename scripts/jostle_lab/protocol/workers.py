"""Packings in worker processes: jobs in, seconds of progress out; no worker outlives the process that started it.

A worker ends by SIGTERM, or when its parent is gone, however that ended. Ctrl-C reaches the parent alone.
"""

import os
import queue
import shutil
import signal
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, contextmanager
from multiprocessing import active_children, get_context, parent_process
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any

from jostle_lab import stopping
from jostle_lab.errors import LabError
from jostle_lab.fmu.grains import GrainsFactory
from jostle_lab.protocol.experiment import Progress, Setup, run_packing

ENDING = 1.0
"""What a worker may take to end before it is killed [s]."""
OF_A_TERMINAL = sorted(set(stopping.SIGNALS) - {signal.SIGTERM})
TICK = 0.2
"""Longest time between two calls of `on_tick` while nothing comes [s]."""

_reports: Any = None  # the queue of this worker process
_room: tempfile.TemporaryDirectory[str] | None = None  # for its temporary files


def shake_all(
    jobs: list[tuple[int, Path]],
    setup: Setup,
    factory: GrainsFactory,
    processes: int,
    on_report: Progress,
    on_tick: Callable[[], None],
) -> None:
    """Shake the packing of each seed into its folder.

    `on_report` is called with what they report, `on_tick` every `TICK` or more often. Raises the first error of a
    worker.
    """
    with _no_interrupt():
        reports = get_context("spawn").Queue()
    with _pool(min(processes, max(len(jobs), 1)), reports) as pool:
        with _no_interrupt():
            futures = [pool.submit(_work, factory, setup, seed, folder) for seed, folder in jobs]
        _wait(futures, reports, on_report, on_tick)


@contextmanager
def _pool(count: int, reports: Any) -> Iterator[ProcessPoolExecutor]:
    pool = ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=_attach, initargs=(reports,))
    try:
        yield pool
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        _end_workers()
        raise
    pool.shutdown()


def _end_workers() -> None:
    """End all worker processes, and see them gone."""
    workers = active_children()
    for worker in workers:
        worker.terminate()
    deadline = time.monotonic() + ENDING
    for worker in workers:
        worker.join(max(0.0, deadline - time.monotonic()))
        if worker.is_alive():
            worker.kill()
            worker.join()


@contextmanager
def _no_interrupt() -> Iterator[None]:
    """Processes that are started here never see what reaches all of a terminal; each would print a traceback.

    Those that shake are terminated. The one that multiprocessing starts to clean up ends with the last of them.
    """
    handlers = {number: signal.signal(number, signal.SIG_IGN) for number in OF_A_TERMINAL}
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


def _attach(reports: Any) -> None:
    global _reports, _room  # noqa: PLW0603 - a queue can only be inherited, not sent with a job
    _reports = reports
    _room = tempfile.TemporaryDirectory(prefix="jostle-worker-")
    tempfile.tempdir = _room.name
    signal.signal(signal.SIGTERM, _end)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """A parent that was killed ended nobody: end this process then."""
    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os.kill(os.getpid(), signal.SIGTERM)


def _end(*_: object) -> None:
    """End this process at once, but remove what its FMU is unpacked into, however far that is."""
    if _room is not None:
        shutil.rmtree(_room.name, ignore_errors=True)
    os._exit(1)


def _work(factory: GrainsFactory, setup: Setup, seed: int, folder: Path) -> None:
    with closing(factory(seed, setup.exchange.parameters)) as grains:
        run_packing(grains, setup, seed, folder, _reports.put)


def _wait(futures: list["Future[None]"], reports: Any, on_report: Progress, on_tick: Callable[[], None]) -> None:
    while True:
        running = [future for future in futures if not future.done()]
        for future in futures:
            if future.done():
                _raise_error_of(future)
        try:
            on_report(reports.get(timeout=TICK))
        except queue.Empty:
            if not running:
                return
        on_tick()


def _raise_error_of(future: "Future[None]") -> None:
    try:
        future.result()
    except BrokenProcessPool:
        stopping.check_ended_by(-signal.SIGTERM)
        raise LabError(
            "A worker process was ended from outside. Is the memory full? Amplitudes that are finished are kept; the "
            "same command goes on from there, with --processes 1 in less memory."
        ) from None
