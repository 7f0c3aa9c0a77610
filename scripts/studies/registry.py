"""Figures of both papers and the modules that make them."""

from collections.abc import Callable
from importlib import import_module

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product

Maker = Callable[[Laboratory, bool, int | None], Product]

MODULES = {
    "1.3": "packing.bottom",
    "2.2": "methods.parameters",
    "2.3": "methods.formulas",
    "2.3.3": "methods.base_sampling",
    "camera": "laboratory.figures:sensors",
    "3.1": "laboratory.figures:paths",
    "3.2": "laboratory.figures:squares",
    "3.3": "laboratory.figures:steady",
    "3.4": "laboratory.figures:distributions",
    "3.5": "packing.paths:molecular_dynamics",
    "3.6": "packing.mean_square",
    "3.7": "packing.steadiness",
    "3.8": "packing.steadiness:histograms",
    "3.9": "packing.stiffness",
    "3.10": "packing.paths:event_driven",
    "3.11": "packing.comparison",
    "4.3": "two_supports.region",
    "4.4": "impact.forces",
    "4.5": "restitution",
    "constant-forces": "two_supports.constant_forces",
    "5.1": "two_supports.regimes",
    "5.2": "two_supports.amplitude:linear",
    "5.3": "two_supports.amplitude:logarithmic",
    "5.4": "two_supports.tilt:linear",
    "5.5": "two_supports.tilt:logarithmic",
    "5.6": "two_supports.path",
    "5.7": "two_supports.amplitude:closed_form",
    "5.8": "two_supports.random_supports:against_amplitude",
    "5.9": "two_supports.random_supports:against_tilt",
    "6.2": "wedge.paths",
    "three-disks": "wedge.three_disks",
    "6.3": "wedge.dynamics",
    "6.3.1": "wedge.map_equations",
    "6.4": "wedge.collapse",
    "6.5": "wedge.engines",
    "6.6": "wedge.friction",
    "6.7": "wedge.aperture",
    "6.8": "wedge.restitution",
    "6.9": "wedge.stiffness_ratio",
    "engines": "engines",
    "closed-form": "two_supports.closed_form",
    "supports": "two_supports.noise",
}
"""Figure of the thesis and the module of `studies.thesis` that makes it, with its function if that is not `make`."""
STUDIES = {
    "F2": "depth:DEPTH",
    "F3": "experiment:EXPERIMENT",
    "F6": "shape:ASYMMETRY",
    "F7": "shape:HEIGHT",
    "F8": "layers:NEGATIVE",
    "F9": "layers:POSITIVE",
    "F10": "frequency:LAYERS",
    "F11": "threshold:ONSET",
    "F12": "frequency:TRANSITION",
    "F13": "flow:FORWARDS",
    "F14": "flow:BACKWARDS",
    "FV": "single",
    "FA": "appendix",
    "FT": "text:TEXT",
}
"""Figure or section of F and the study in `studies.ratchet` that makes it; a module without one has `make`."""
RECORDS = dict.fromkeys(("3.6", "3.7", "3.8", "3.9", "3.11"), "packing")
"""Figures that share a record, and its name; others have that of their module."""
PRECISE = frozenset({"4.4", "5.1", "5.2", "5.3", "5.4", "5.5", "5.6", "5.7", "closed-form", "engines"})
"""Figures without chance, whose runs are kept in double precision."""
NUMBERS = (*MODULES, *STUDIES)
ON_THE_PAGE = (*STUDIES, *MODULES)
"""Figures in the order of the page of claims."""
GROUPS = {"all": tuple(MODULES), "F": tuple(STUDIES)}
"""Names for many figures."""


def maker(number: str) -> Maker:
    """The function that makes a figure."""
    if number in STUDIES:
        module, _, name = STUDIES[number].partition(":")
        loaded = import_module(f"studies.ratchet.{module}")
        made: Maker = (getattr(loaded, name) if name else loaded).make
        return made
    module, _, function = MODULES[number].partition(":")
    found: Maker = getattr(import_module(f"studies.thesis.{module}"), function or "make")
    return found
