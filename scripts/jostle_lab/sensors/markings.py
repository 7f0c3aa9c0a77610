"""A picture in, centres and angles of the black marks out, as P 2.4.3 does with Fiji.

8-bit grey; an automatic threshold; connected dark regions within a range of sizes, not at the border ("analyze
particles"); to each the ellipse of the same second moments, whose major axis has the angle, modulo 180 degrees. The
threshold of Fiji, if no other is named, is ImageJ's "Default", a variant of IsoData (Ridler and Calvard 1978: midway
between the means of both classes); scikit-image has IsoData itself, and Otsu's.
"""

import math
from dataclasses import dataclass
from enum import StrEnum
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from jostle_lab.sensors.webcam import Image

LEAST, MOST = 0.5, 2.0
"""Sizes that count as a mark, as shares of its true one; a bolt has a quarter, the bottom and a bar far more."""


class Threshold(StrEnum):
    """How black is told from white."""

    ISODATA = "isodata"
    OTSU = "otsu"


@dataclass(frozen=True)
class Marks:
    """The marks of one picture."""

    centres: NDArray[np.float64]
    """(column, row) [pixels], shape (marks, 2)."""
    angles: NDArray[np.float64]
    """Of the major axis from the columns' direction, counter-clockwise, in [0, pi) [rad], shape (marks,)."""


def find_marks(picture: Image, mark_area: float, threshold: Threshold = Threshold.ISODATA) -> Marks:
    """Marks of about `mark_area` [pixels] in a picture."""
    filters, measure = _scikit_image("filters"), _scikit_image("measure")
    counts = np.bincount(picture.ravel(), minlength=256)
    if np.count_nonzero(counts) < 2:
        raise LabError("The picture has one shade of grey: there is no threshold. Light the packing from behind.")
    method = {Threshold.ISODATA: filters.threshold_isodata, Threshold.OTSU: filters.threshold_otsu}[threshold]
    grey = method(hist=(counts, np.arange(256)))
    regions = measure.regionprops(measure.label(picture <= grey, connectivity=2))
    found = [region for region in regions if _is_mark(region, mark_area, picture.shape)]
    centres = np.array([region.centroid[::-1] for region in found], dtype=np.float64).reshape(-1, 2)
    # scikit-image counts from the rows' direction, counter-clockwise.
    angles = np.mod(np.array([region.orientation for region in found], dtype=np.float64) + 0.5 * math.pi, math.pi)
    return Marks(centres, np.where(angles >= math.pi, 0.0, angles))


def _is_mark(region: Any, mark_area: float, shape: tuple[int, ...]) -> bool:
    if not LEAST * mark_area <= region.area <= MOST * mark_area:
        return False
    top, left, bottom, right = region.bbox
    return bool(top > 0 and left > 0 and bottom < shape[0] and right < shape[1])


def require_scikit_image() -> None:
    """Raise LabError, before any work is done, if marks could not be found."""
    _scikit_image("measure")


def _scikit_image(module: str) -> Any:
    try:
        return import_module(f"skimage.{module}")
    except ImportError:
        raise LabError("scikit-image is not installed. Install it: pip install 'jostle-lab[pictures]'.") from None
