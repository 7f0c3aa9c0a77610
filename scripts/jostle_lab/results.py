"""A results folder, read back: what pictures and the page of numbers are made of."""

import json
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from jostle_lab.tables import read_array, read_table


class Results:
    """The finished packings of a folder; raises LabError if there are none."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        files = sorted(folder.glob("packings/seed-*/packing.json"))
        if not files:
            raise LabError(f"{folder} holds no finished packing. Run `python -m jostle_lab demo --results {folder}`.")
        self.run: dict[str, Any] = json.loads((folder / "run.json").read_text())
        self.setup: dict[str, Any] = self.run["setup"]
        self.summaries: list[dict[str, Any]] = [json.loads(file.read_text()) for file in files]
        self._folders = {s["seed"]: file.parent for s, file in zip(self.summaries, files, strict=True)}
        self.seeds: list[int] = list(self._folders)

    @cached_property
    def amplitudes(self) -> list[dict[str, float]]:
        """One row for each packing and amplitude."""
        return [row for folder in self._folders.values() for row in read_table(folder / "amplitudes.csv")]

    @cached_property
    def disks(self) -> list[dict[str, float]]:
        """One row for each packing, amplitude and disk."""
        return [row for folder in self._folders.values() for row in read_table(folder / "disks.csv")]

    @cached_property
    def _angles(self) -> dict[int, NDArray[np.float64]]:
        return {seed: read_array(folder / "angles.csv") for seed, folder in self._folders.items()}

    def amplitudes_of(self, seed: int) -> list[dict[str, float]]:
        """Rows of one packing."""
        return [row for row in self.amplitudes if row["seed"] == seed]

    def disks_of(self, seed: int, amplitude: float) -> list[dict[str, float]]:
        """Rows of one packing at one amplitude, in the order of the disks."""
        return [row for row in self.disks if row["seed"] == seed and row["amplitude"] == amplitude]

    def angles(self, seed: int, amplitude: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Time [s], shape (frames,), and unwrapped angles [rad], shape (frames, disks)."""
        rows = self._angles[seed]
        rows = rows[rows[:, 0] == amplitude]
        return rows[:, 1], rows[:, 2:]

    def readings(self, seed: int, amplitude: float) -> NDArray[np.float64]:
        """Kept accelerometer readings [g], shape (samples, sensors)."""
        rows = read_array(self._folders[seed] / "accelerometers.csv")
        return np.asarray(rows[rows[:, 0] == amplitude][:, 2:])

    def box_width(self) -> float:
        """Inner width of the box [m]."""
        return float(self.summaries[0]["box_width"])
