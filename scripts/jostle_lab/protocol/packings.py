"""Many packings in several processes, one seed each, with a progress bar.

What is finished is not run again, and a packing that was stopped goes on after its last finished amplitude.
"""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from jostle_lab.errors import LabError
from jostle_lab.files import read_json, replace_text
from jostle_lab.fmu.grains import GrainsFactory
from jostle_lab.locks import held
from jostle_lab.progress import progress
from jostle_lab.protocol import checkpoint
from jostle_lab.protocol.experiment import FINISHED, Setup
from jostle_lab.protocol.now import Now
from jostle_lab.protocol.workers import shake_all
from jostle_lab.stopping import telling


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

    def is_finished(self, seed: int) -> bool:
        """Whether a packing has gone through the protocol."""
        return (self.packing_folder(seed) / FINISHED).exists()

    def seconds(self) -> int:
        """Simulated time of all packings [s]."""
        return len(self.seeds) * self.setup.protocol.duration()

    def seconds_kept(self) -> int:
        """Of these, what a run need not do again [s].

        Raises LabError for a damaged checkpoint.
        """
        return sum(self._seconds_kept(seed) for seed in self.seeds)

    def _seconds_kept(self, seed: int) -> int:
        if self.is_finished(seed):
            return self.setup.protocol.duration()
        found = checkpoint.plain(self.packing_folder(seed))
        return int(found["seconds"]) if found else 0

    def kept(self) -> str:
        """What is kept, and how to go on: a sentence for who stopped it."""
        intervals, done = len(self.setup.protocol.intervals), 0
        for seed in self.seeds:
            found = None if self.is_finished(seed) else checkpoint.plain(self.packing_folder(seed))
            done += intervals if self.is_finished(seed) else len(found["amplitudes"]) if found else 0
        each = f"{intervals} for each of {len(self.seeds)} packings" if len(self.seeds) > 1 else "of one packing"
        whole = f"{done} of {intervals * len(self.seeds)} amplitudes ({each})"
        return f"{whole} are kept in {self.results}. The same command goes on from there."


class Watcher:
    """Told of what happens while packings are shaken; this one does nothing."""

    def interval_done(self) -> None:
        """The tables of a packing have grown."""

    def now(self, now: Now) -> None:
        """What the disks of a packing do."""

    def tick(self, share: float) -> None:
        """Some time has passed; `share` of the simulated time is done."""


NOBODY = Watcher()


def run(plan: Plan, factory: GrainsFactory, watcher: Watcher = NOBODY) -> None:
    """Run every packing that is not there yet, or the rest of it.

    Raises LabError for a folder in which another command runs, or which holds something else.
    """
    plan.results.mkdir(parents=True, exist_ok=True)
    with held(plan.results, "run of packings"):
        claim(plan)
        run_in_held_folder(plan, factory, watcher)


def run_in_held_folder(plan: Plan, factory: GrainsFactory, watcher: Watcher = NOBODY) -> None:
    """As `run`, for a caller that holds the folder and has claimed it."""
    jobs = [(seed, plan.packing_folder(seed)) for seed in plan.seeds if not plan.is_finished(seed)]
    done, total = plan.seconds_kept(), plan.seconds()
    if not jobs:
        return
    bar = progress(
        total=total,
        done=done,
        unit="s of simulated time",
        what=f"shaking {len(plan.seeds)} packings" if len(plan.seeds) > 1 else "shaking a packing",
        show=plan.show_progress,
    )

    def report(what: int | Now) -> None:
        nonlocal done
        if isinstance(what, Now):
            watcher.now(what)
        elif what == 0:
            watcher.interval_done()
        else:
            done += what
            bar.update(what)

    with telling(plan.kept), bar:
        shake_all(jobs, plan.setup, factory, plan.processes, report, lambda: watcher.tick(done / total))


def claim(plan: Plan) -> None:
    """Write what is being run, or refuse a folder that holds something else."""
    description = {**dict(plan.labels), "setup": json.loads(json.dumps(asdict(plan.setup)))}
    file = plan.results / "run.json"
    afresh = f"Remove {plan.results} to start afresh."
    if file.exists() and read_json(file, afresh) != description:
        raise LabError(
            f"{plan.results} holds results of other settings (see {file.name}). "
            "Choose another --results folder, or remove this one to start afresh."
        )
    replace_text(file, json.dumps(description, indent=2) + "\n")
