"""Many packings in several processes, one seed each, with a progress bar; finished packings are not run again."""

import json
import os
import queue
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import Any

from tqdm import tqdm

from jostle_lab.errors import LabError
from jostle_lab.files import read_json, replace_text
from jostle_lab.fmu.grains import Grains, GrainsFactory
from jostle_lab.protocol.experiment import FINISHED, Setup, run_packing

_reports: Any = None  # the queue of this worker process
_grains: Grains | None = None  # those it shakes


@dataclass(frozen=True)
class Plan:
    """What to run and where to put it."""

    results: Path
    seeds: tuple[int, ...]
    setup: Setup
    processes: int = 2
    show_progress: bool = True
    labels: tuple[tuple[str, str], ...] = ()
    """What else identifies the run, such as the FMU and its parameters."""

    def packing_folder(self, seed: int) -> Path:
        """Folder of one packing."""
        return self.results / "packings" / f"seed-{seed:04d}"


def run(plan: Plan, factory: GrainsFactory, on_interval: Callable[[], None] = lambda: None) -> None:
    """Run every packing that is not there yet; `on_interval` is called when the tables of one have grown."""
    _claim(plan)
    todo = [seed for seed in plan.seeds if not (plan.packing_folder(seed) / FINISHED).exists()]
    duration = plan.setup.protocol.duration()
    finished = (len(plan.seeds) - len(todo)) * duration
    reports = get_context("spawn").Queue()
    with (
        tqdm(
            total=len(plan.seeds) * duration,
            initial=finished,
            unit="s",
            mininterval=0.5,
            desc=f"shaking {len(plan.seeds)} packing(s), simulated time",
            disable=not plan.show_progress,
        ) as bar,
        _workers(min(plan.processes, max(len(todo), 1)), reports) as pool,
    ):
        with _no_interrupt():
            jobs = [pool.submit(_work, factory, plan.setup, seed, plan.packing_folder(seed)) for seed in todo]
        _wait(jobs, reports, bar, on_interval)


def _claim(plan: Plan) -> None:
    """Write what is being run, or refuse a folder that holds something else."""
    description = {**dict(plan.labels), "setup": json.loads(json.dumps(asdict(plan.setup)))}
    file = plan.results / "run.json"
    afresh = f"Remove {plan.results} to start afresh."
    if file.exists() and read_json(file, afresh) != description:
        raise LabError(
            f"{plan.results} holds results of other settings (see {file.name}). "
            "Choose another --results folder, or remove this one to start afresh."
        )
    plan.results.mkdir(parents=True, exist_ok=True)
    replace_text(file, json.dumps(description, indent=2) + "\n")


@contextmanager
def _workers(count: int, reports: Any) -> Iterator[ProcessPoolExecutor]:
    pool = ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=_attach, initargs=(reports,))
    try:
        yield pool
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for worker in active_children():
            worker.terminate()
        raise
    pool.shutdown()


@contextmanager
def _no_interrupt() -> Iterator[None]:
    """Processes that are started here never see Ctrl-C, of which each would print a traceback: they are terminated."""
    handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)


def _attach(reports: Any) -> None:
    global _reports  # noqa: PLW0603 - a queue can only be inherited, not sent with a job
    _reports = reports
    signal.signal(signal.SIGTERM, _end)


def _end(*_: object) -> None:
    """End this process at once, but remove what its FMU was unpacked into."""
    if _grains is not None:
        _grains.close()
    os._exit(1)


def _work(factory: GrainsFactory, setup: Setup, seed: int, folder: Path) -> None:
    global _grains  # noqa: PLW0603 - what a signal must find
    _grains = grains = factory(seed, setup.exchange.parameters)
    try:
        run_packing(grains, setup, seed, folder, _reports.put)
    finally:
        _grains = None
        grains.close()


def _wait(jobs: list["Future[None]"], reports: Any, bar: Any, on_interval: Callable[[], None]) -> None:
    """Move the bar until every job is done; raise the first error."""
    while True:
        running = [job for job in jobs if not job.done()]
        for job in jobs:
            if job.done():
                job.result()
        try:
            seconds = reports.get(timeout=0.2)
            bar.update(seconds)
            if seconds == 0:
                on_interval()
        except queue.Empty:
            if not running:
                return
