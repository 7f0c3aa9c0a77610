"""Power laws of <omega^2> against Gamma of a results folder: as measured, and in truth."""

import math

import polars as pl

from jostle_lab.protocol.results import Results
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.statistics.regression import THESIS_SLOPES, Regression

ENOUGH = 5
"""Packings from which on drawing them tells an error."""


def regression_of(results: Results, measured: bool) -> Regression:
    """<omega^2> [RPM^2] against Gamma, by accelerometers and camera or in truth."""
    gamma, square = ("gamma_measured", "mean_square_rpm_camera") if measured else ("gamma_true", "mean_square_rpm")
    table = results.amplitudes
    return Regression(*(table[name].cast(pl.Float64).to_numpy() for name in (gamma, square, "seed")))


def slope_of(curve: Regression, range_: tuple[float, float]) -> Estimate:
    """Exponent in a range of Gamma; its error is not a number if there are too few packings to draw from."""
    slope = curve.slope(range_)
    return slope if curve.neighbours >= ENOUGH else Estimate(slope.mean, math.nan)


def slope_text(slope: Estimate) -> str:
    """Slope with its error, if there is one."""
    return f"{slope.mean:.2f}" if math.isnan(slope.error) else str(slope)


def power_law_table(results: Results) -> tuple[list[str], list[list[str]]]:
    """Exponents by least squares through the nearest-neighbours regression, beside P's: header and rows."""
    curves = {"accelerometers and camera": regression_of(results, True), "truth": regression_of(results, False)}
    rows = []
    for name, curve in curves.items():
        rows.append([name, *(_cell(slope_of(curve, range_)) for range_ in THESIS_SLOPES)])
    rows.append(["the thesis (Fig. 3.2)", *(f"{printed:.2f}" for printed in THESIS_SLOPES.values())])
    heads = [f"{low:g} < Gamma < {high:g}" for low, high in THESIS_SLOPES]
    return ["exponent of <omega^2>", *heads], rows


def power_law_note(results: Results) -> str:
    """How the exponents are found."""
    count = len(results.seeds)
    errors = f"errors need {ENOUGH} packings or more" if count < ENOUGH else "errors by drawing packings"
    return f"Least squares on log axes through the mean of the nearest {count} points in Gamma; {errors}."


def _cell(slope: Estimate) -> str:
    return "too few points" if math.isnan(slope.mean) else slope_text(slope)
