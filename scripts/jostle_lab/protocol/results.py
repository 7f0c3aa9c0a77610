"""A results folder, read back: what pictures and the page of numbers are made of."""

from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from jostle_lab.files import read_json
from jostle_lab.protocol.experiment import FINISHED, UNFINISHED
from jostle_lab.tables import Row, read_table


class Results:
    """The finished packings of a folder, or those that have at least one interval.

    Raises LabError if there are none.
    """

    def __init__(self, folder: Path, unfinished: bool = False) -> None:
        self.folder = folder
        names = (FINISHED, UNFINISHED) if unfinished else (FINISHED,)
        files = sorted(file for name in names for file in folder.glob(f"packings/seed-*/{name}"))
        if not files:
            raise LabError(f"{folder} holds no finished packing. Run `jostle-lab demo --results {folder}`.")
        again = f"Remove it and run `jostle-lab demo --results {folder}` again."
        self.run: dict[str, Any] = read_json(folder / "run.json", again)
        self.setup: dict[str, Any] = self.run["setup"]
        self.summaries: list[dict[str, Any]] = [read_json(file, again) for file in files]
        self._folders = {s["seed"]: file.parent for s, file in zip(self.summaries, files, strict=True)}
        self.seeds: list[int] = list(self._folders)

    @cached_property
    def amplitudes(self) -> pl.DataFrame:
        """One row for each packing and amplitude."""
        return self._all("amplitudes.csv")

    @cached_property
    def disks(self) -> pl.DataFrame:
        """One row for each packing, amplitude and disk."""
        return self._all("disks.csv")

    def _all(self, file: str) -> pl.DataFrame:
        return pl.concat([read_table(folder / file) for folder in self._folders.values()], how="vertical_relaxed")

    def amplitudes_of(self, seed: int) -> list[Row]:
        """Rows of one packing."""
        return self.amplitudes.filter(pl.col("seed") == seed).to_dicts()

    def disks_of(self, seed: int, amplitude: float) -> list[Row]:
        """Rows of one packing at one amplitude, in the order of the disks."""
        return self.disks.filter(pl.col("seed") == seed, pl.col("amplitude") == amplitude).to_dicts()

    def angles(self, seed: int, amplitude: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Time [s], shape (frames,), and unwrapped angles [rad], shape (frames, disks)."""
        rows = self._record("angles.csv", seed, amplitude)
        return rows[:, 0], rows[:, 1:]

    def positions(self, seed: int, amplitude: float) -> NDArray[np.float64]:
        """Centres of the disks at each frame [m], shape (frames, disks, 2); only if they were kept."""
        rows = self._record("positions.csv", seed, amplitude)[:, 1:]
        return rows.reshape(len(rows), -1, 2)

    def radii(self, seed: int) -> NDArray[np.float64]:
        """Of the disks [m], shape (disks,)."""
        first = self.amplitudes_of(seed)[0]["amplitude"]
        return np.array([disk["radius"] for disk in self.disks_of(seed, first)])

    def folder_of(self, seed: int) -> Path:
        """Folder of a packing."""
        return self._folders[seed]

    def readings(self, seed: int, amplitude: float) -> NDArray[np.float64]:
        """Kept accelerometer readings [g], shape (samples, sensors)."""
        return self._record("accelerometers.csv", seed, amplitude)[:, 1:]

    def _record(self, file: str, seed: int, amplitude: float) -> NDArray[np.float64]:
        """Time, then what was recorded."""
        table = read_table(self._folders[seed] / file).filter(pl.col("amplitude") == amplitude)
        return table.drop("amplitude").to_numpy()

    def box_width(self) -> float:
        """Inner width of the box [m]."""
        return float(self.summaries[0]["box_width"])
