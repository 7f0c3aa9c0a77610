"""Samples of a run as an `xarray.Dataset` with units and descriptions."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from jostle.variables import Variable

if TYPE_CHECKING:
    import xarray as xr


def dimension(variable: Variable) -> str:
    """Name of the second dimension of an array: `disk` for `disk.angle`."""
    return variable.name.partition(".")[0]


def labels(variable: Variable) -> dict[str, Any]:
    """Attributes of a variable, by the names of the Climate and Forecast conventions."""
    return {"units": variable.unit, "long_name": variable.description}


def dataset(
    times: NDArray[np.float64],
    columns: NDArray[np.float64],
    sampled: list[Variable],
    fixed: dict[str, tuple[Variable, Any]],
    attributes: dict[str, Any],
) -> "xr.Dataset":
    """Name what was sampled.

    Args:
        times: [s], shape (times,).
        columns: shape (times, elements of all sampled variables).
        sampled: whose elements follow one another in `columns`.
        fixed: arrays that do not change with time, by name: they become coordinates.
        attributes: of the whole.

    """
    import xarray as xr  # noqa: PLC0415 - as in `simulation`

    data: dict[str, Any] = {}
    coordinates: dict[str, Any] = {"time": ("time", times, {"units": "s", "long_name": "Simulated time"})}
    for variable in (*sampled, *(v for v, _ in fixed.values())):
        if variable.is_array:
            name, numbers = dimension(variable), np.arange(1, len(variable.elements) + 1)
            coordinates[name] = (name, numbers, {"long_name": f"Number of the {name}"})
    at = 0
    for variable in sampled:
        width = len(variable.positions)
        values = columns[:, at : at + width] if variable.is_array else columns[:, at]
        if variable.kind != "real":
            values = values.astype(np.int64)
        data[variable.name] = (("time", dimension(variable))[: values.ndim], values, labels(variable))
        at += width
    coordinates |= {name: (dimension(variable), values, labels(variable)) for name, (variable, values) in fixed.items()}
    return xr.Dataset(data, coordinates, attributes)
