"""Vibrated granular disks.

>>> import jostle
>>> sim = jostle.Simulation("ratchet", disks=50, seed=1, **{"drive.frequency": 25.0})
>>> data = sim.run(1.0, every=0.01)
>>> data["disk.x"].dims
('time', 'disk')
"""

from typing import TYPE_CHECKING

from jostle._core import VERSION, State
from jostle._core import scenes as _scenes
from jostle.errors import (
    CallError,
    DefectError,
    JostleError,
    JostleWarning,
    NoVariableError,
    ParameterError,
    StateError,
    StepError,
)
from jostle.installed import fmu, program
from jostle.simulation import Simulation

if TYPE_CHECKING:
    import pandas as pd

__version__ = VERSION

__all__ = [
    "CallError",
    "DefectError",
    "JostleError",
    "JostleWarning",
    "NoVariableError",
    "ParameterError",
    "Simulation",
    "State",
    "StateError",
    "StepError",
    "__version__",
    "fmu",
    "program",
    "scenes",
]


def scenes() -> "pd.DataFrame":
    """Table of what can be simulated: scene, engine, drive, description, smallest and largest number of disks."""
    import pandas as pd  # noqa: PLC0415 - takes longer than all else, and loops do without

    return pd.DataFrame(_scenes(), columns=["scene", "engine", "drive", "description", "fewest_disks", "most_disks"])
