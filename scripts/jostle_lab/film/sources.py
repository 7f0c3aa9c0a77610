"""Where a film's data come from: a file of a run, or a run done now."""

import math
import re
import warnings
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import polars as pl

from jostle_lab.errors import LabError, about
from jostle_lab.film.recording import SCENES

if TYPE_CHECKING:
    import xarray as xr

ENDINGS = (".nc", ".csv", ".parquet")
"""Of files that hold a run."""
ELEMENT = re.compile(r"^(?P<before>[^\[]+)\[(?P<number>\d+)\](?P<after>.*)$")
"""`disk.angle[3]`, `contact[1].overlap`."""
PERIODS, SAMPLES, WITHOUT_PERIOD = 10, 32, 2.0
"""Of a scene that is run now: periods, samples of a period, seconds without a period."""


def is_file(run: str) -> bool:
    """Whether RUN names a file rather than a scene."""
    return Path(run).suffix != "" or Path(run).is_file()


def read(path: Path) -> "xr.Dataset":
    """The dataset of a file: NetCDF, or a table of `jostle run` with its parameters.

    Raises:
        LabError: a file that is missing, damaged, or of another kind.

    """
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        found = f"ends with {ending}" if ending else "has no ending"
        allowed = f"allowed are {', '.join(ENDINGS)}: a file of a run"
        raise LabError(f"{path} {found}, {allowed}. The command takes scenes, too.")
    if path.is_dir():
        raise LabError(f"{path} is a folder. Name a file of a run.")
    if not path.is_file():
        raise LabError(f"{path} is not there. Name a file of a run, or a scene: {', '.join(SCENES)}.")
    try:
        return _read_netcdf(path) if ending == ".nc" else _read_table(path, ending)
    except pl.exceptions.PolarsError as error:
        raise LabError(f"{path} is not a table as it should be: {error}. Make it again.") from None
    except OSError as error:
        raise about(path, error) from None


def _read_netcdf(path: Path) -> "xr.Dataset":
    xarray = _xarray()
    try:
        found: xr.Dataset = xarray.load_dataset(path, engine="scipy")
    except (TypeError, ValueError, KeyError, IndexError) as error:
        raise LabError(
            f"{path} is not a NetCDF file as it should be: {error}. "
            'Write it by data.to_netcdf("run.nc", engine="scipy"), or by jostle run.'
        ) from None
    return found


def _read_table(path: Path, ending: str) -> "xr.Dataset":
    if ending == ".csv":
        frame, attributes = pl.read_csv(path, infer_schema_length=None), {}
    else:
        frame, attributes = pl.read_parquet(path), _metadata(path)
    beside = path.with_suffix(".parameters.csv")
    if beside.is_file():
        rows = pl.read_csv(beside, infer_schema=False)
        attributes |= dict(zip(rows["name"].to_list(), rows["value"].to_list(), strict=True))
    if "scene" not in attributes:
        raise LabError(
            f"{path} does not say which scene it is, and {beside} is not there. jostle run writes it beside the "
            "table: copy both."
        )
    return dataset_of(frame, attributes)


def _metadata(path: Path) -> dict[str, Any]:
    """Parameters in the metadata of a Parquet file, each under its name, numbers as texts."""
    found: dict[str, Any] = {}
    for name, value in pl.read_parquet_metadata(path).items():
        if "/" in name or name == "ARROW:schema":
            continue  # units and descriptions
        found[name] = value
    return found


def dataset_of(frame: pl.DataFrame, parameters: Mapping[str, Any]) -> "xr.Dataset":
    """A table of `jostle run` as the dataset that Python's `run` returns: elements joined into arrays."""
    if "time" not in frame.columns:
        raise LabError(f"The table has no column time; its first are {', '.join(frame.columns[:4])}. Make it again.")
    single, arrays = _grouped([name for name in frame.columns if name != "time"], parameters)
    data: dict[str, Any] = {name: ("time", frame[name].to_numpy()) for name in single}
    for name, columns in arrays.items():
        data[name] = (("time", name.partition(".")[0]), frame.select(columns).to_numpy())
    attributes, fixed = _grouped(list(parameters), ())
    coordinates: dict[str, Any] = {"time": frame["time"].cast(pl.Float64).to_numpy()}
    for name, elements in fixed.items():
        values = np.array([_number(parameters[element]) for element in elements], dtype=np.float64)
        coordinates[name] = (name.partition(".")[0], values)
    kept = {name: _number(parameters[name]) for name in attributes}
    try:
        built: xr.Dataset = _xarray().Dataset(data, coordinates, kept)
    except ValueError as error:
        remedy = "It is cut off, or not of one run with its parameters: record it again."
        raise LabError(f"The columns of the table do not belong together: {error}. {remedy}") from None
    return built


def _grouped(names: list[str], taken: Collection[str]) -> tuple[list[str], dict[str, list[str]]]:
    """Single names, and those of elements by their numbers under the name of their array, unless that is `taken`."""
    single, arrays = [], dict[str, dict[int, str]]()
    for name in names:
        match = ELEMENT.match(name)
        if match is None or match["before"] + match["after"] in taken:
            single.append(name)
        else:
            arrays.setdefault(match["before"] + match["after"], {})[int(match["number"])] = name
    return single, {array: [names[number] for number in sorted(names)] for array, names in arrays.items()}


def _number(value: Any) -> Any:
    """A number where a text is one."""
    try:
        return int(value)
    except (TypeError, ValueError):
        pass
    try:
        return float(value)
    except (TypeError, ValueError):
        return value


def run_scene(
    scene: str,
    seconds: float | None,
    every: float | None,
    start: float,
    engine: str | None,
    drive: str | None,
    disks: int | None,
    values: Mapping[str, float],
) -> "xr.Dataset":
    """Run a scene in this process from time 0; samples begin at `start` [s] and go on for `seconds`.

    None: `seconds` are ten periods of the drive, or 2 s without one; `every` is a 32nd of the period, or of 0.1 s.

    Raises:
        LabError: what the package refuses, in its words.

    """
    jostle = package()
    with warnings.catch_warnings():
        warnings.simplefilter("always", jostle.JostleWarning)
        try:
            simulation = jostle.Simulation(scene, engine=engine, drive=drive, disks=disks, **values)
            if simulation.drive == "input":
                raise LabError(
                    f"--drive input: {scene} follows inputs, which this command does not have. Take another drive, or "
                    "record the run in Python and film its dataset."
                )
            if start > 0.0:
                simulation.advance_to(start)
            period = _period(simulation)
            span = seconds if seconds is not None else (PERIODS * period if period else WITHOUT_PERIOD)
            found: xr.Dataset = simulation.run(span, every=every if every is not None else (period or 0.1) / SAMPLES)
        except jostle.JostleError as error:
            raise LabError(str(error)) from None
    return found


def _period(simulation: Any) -> float | None:
    """Of the drive [s], None if it has none."""
    for name, turn in (("drive.frequency", 1.0), ("torque.angular_frequency", math.tau)):
        if name in simulation and simulation[name] > 0.0:
            return turn / float(simulation[name])
    return None


def package() -> Any:
    """The package `jostle`."""
    try:
        import jostle  # noqa: PLC0415
    except ImportError:
        raise LabError("The package jostle is not installed. scripts/setup puts it into .venv.") from None
    return jostle


def _xarray() -> Any:
    try:
        import xarray  # noqa: PLC0415
    except ImportError:
        raise LabError("xarray is not installed. Install it: pip install 'jostle-lab[film]'.") from None
    return xarray
