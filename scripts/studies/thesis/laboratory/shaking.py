"""The protocol of P 2.4.2 on the loudspeaker: 25 packings and the listed amplitudes, for as long as there is time.

The thesis' intervals are 1200 s. Ours are shorter, which `--seconds-per-amplitude` of `python -m studies laboratory`
changes. A folder holds one effort; finished packings are not run again.
"""

from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from jostle_lab.coupling.master import check_landing
from jostle_lab.fmu.instance import fingerprint
from jostle_lab.fmu.packing import FmuFactory
from jostle_lab.protocol import intervals
from jostle_lab.protocol.experiment import Setup
from jostle_lab.protocol.packings import Plan, run
from jostle_lab.protocol.results import Results

LISTED = tuple(interval.amplitude for interval in intervals.thesis().intervals)
"""Fractions of the full drive in the order of the thesis' protocol (32, where P 3.1 says 37)."""
PATHS = (1.0, 0.8, 0.6, 0.4, 0.3, 0.2, 0.16, 0.1, 0.05)
"""Those of the longer records."""


@dataclass(frozen=True)
class Effort:
    """How many packings go through which amplitudes, for how long each."""

    name: str
    packings: int
    seconds: int
    """Of each amplitude [s], a quarter of it to relax."""
    amplitudes: tuple[float, ...]
    paths: bool = False
    """Whether the paths of the first packing are kept."""

    def key(self) -> str:
        """Under which the numbers are kept."""
        return f"loudspeaker, {self.packings} packings, {len(self.amplitudes)} amplitudes, {self.seconds} s each"


SCHEDULE = Effort("schedule", 25, 12, LISTED)
"""What the record holds: as many packings as in P. Finished ones are kept if the number is raised."""
LONGER = Effort("longer", 1, 120, PATHS, paths=True)
"""A record that shows what the length of a record does, and the paths of Fig. 3.1."""
QUICK = Effort("quick", 2, 8, (1.0, 0.6, 0.35, 0.2, 0.12, 0.06), paths=True)


def shake(effort: Effort, fmu: Path, folder: Path, processes: int, progress: bool) -> Results:
    """Shake what is not done yet; return all of it."""
    setup = Setup(intervals.scaled_down(effort.amplitudes, effort.seconds), keep_positions=True)
    factory = FmuFactory(str(fmu))
    with closing(factory(1, setup.exchange.parameters)) as grains:
        check_landing(setup.exchange, grains)
    seeds = tuple(range(1, effort.packings + 1))
    plan = Plan(folder, seeds, setup, processes, progress, (("FMU binary", fingerprint(fmu)),))
    run(plan, factory)
    return Results(folder)
