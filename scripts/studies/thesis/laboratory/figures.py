"""Makers of the figures of P 3.1 and of the page on P 2.4: all from the same packings on the loudspeaker."""

from collections.abc import Callable
from dataclasses import replace

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product
from studies.thesis.laboratory import apparatus, histograms, regression, steadiness
from studies.thesis.laboratory import paths as angular
from studies.thesis.laboratory.camera_trial import trial
from studies.thesis.laboratory.data import Data, data
from studies.thesis.laboratory.shaking import LONGER, QUICK, SCHEDULE, Effort

Drawn = Callable[[Data, Data], Product]


def _both(laboratory: Laboratory, quick: bool, packings: int | None) -> tuple[Data, Data]:
    """The schedule and the longer records."""
    if quick:
        found = data(laboratory, QUICK)
        return found, found
    schedule = replace(SCHEDULE, packings=packings or SCHEDULE.packings)
    return data(laboratory, schedule), data(laboratory, LONGER)


def paths(laboratory: Laboratory, quick: bool, packings: int | None = None) -> Product:
    """Fig. 3.1."""
    return angular.product(*_both(laboratory, quick, packings))


def squares(laboratory: Laboratory, quick: bool, packings: int | None = None) -> Product:
    """Fig. 3.2."""
    return regression.product(*_both(laboratory, quick, packings))


def steady(laboratory: Laboratory, quick: bool, packings: int | None = None) -> Product:
    """Fig. 3.3."""
    return steadiness.product(*_both(laboratory, quick, packings))


def distributions(laboratory: Laboratory, quick: bool, packings: int | None = None) -> Product:
    """Fig. 3.4."""
    return histograms.product(*_both(laboratory, quick, packings))


def sensors(laboratory: Laboratory, quick: bool, packings: int | None = None) -> Product:
    """P 2.4."""
    schedule, longer = _both(laboratory, quick, packings)
    return apparatus.product(schedule, longer, trial(laboratory, longer.effort))


def products(laboratory: Laboratory, effort: Effort) -> dict[str, Product]:
    """All of them at one effort, by figure."""
    found = data(laboratory, effort)
    drawn: dict[str, Drawn] = {
        "3.1": angular.product,
        "3.2": regression.product,
        "3.3": steadiness.product,
        "3.4": histograms.product,
    }
    made = {number: draw(found, found) for number, draw in drawn.items()}
    return {**made, "camera": apparatus.product(found, found, trial(laboratory, effort))}
