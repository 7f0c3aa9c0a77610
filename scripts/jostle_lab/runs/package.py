"""Runs by the Python package `jostle`: no program is needed, and nothing is written and read but the numbers.

Measured with 200 ratchets of 10 disks for 0.2 s, two at a time, on 2 virtual cores of an AMD EPYC: 346 runs a second by
the program, a process for each; 460 by threads of this process, which wait for each other's Python; 1075 by processes
that stay. For runs of a second there is no difference. Only a process can be stopped in the middle of a step.
"""

import socket
import sys
from dataclasses import dataclass

from jostle_lab import stopping
from jostle_lab.errors import LabError
from jostle_lab.runs.build import Performed
from jostle_lab.runs.child import Children
from jostle_lab.runs.run import Run

CHILDREN = Children()
"""Of this process, whichever sweep they work for."""


def installed_version() -> str:
    """Fingerprint of the package of this Python; raises LabError if there is none."""
    try:
        from jostle_lab.runs.simulated import version  # noqa: PLC0415 - sweeps by a program do without
    except ImportError as error:
        remedy = "Make it: scripts/setup, or pip install jostle; or name a program with --program."
        raise LabError(f"The package jostle is not there for {sys.executable}: {error}. {remedy}") from None
    return version()


@dataclass(frozen=True)
class Package:
    """The installed package, by the bytes of its compiled module."""

    version: str
    limit: float | None = None
    """Longest time on the clock of one run [s]."""

    def perform(self, run: Run) -> Performed:
        """See `Build.perform`."""
        with CHILDREN.lent() as child:
            if child.version != self.version:
                child.stop()
                raise LabError(
                    f"{socket.gethostname()}: the package jostle is build {child.version}, the sweep was started with "
                    f"{self.version}. Put the same package there."
                )
            done = child.perform(run, self.limit)
        stopping.check()  # one that was ended by a signal has not failed
        return done
