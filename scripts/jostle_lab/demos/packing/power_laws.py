"""Power laws of <omega^2> against Gamma of a results folder: as measured, and in truth."""

import math

import polars as pl

from jostle_lab.protocol.results import Results
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.statistics.regression import THESIS_SLOPES, Regression
from jostle_lab.tables import markdown_table

ENOUGH = 5
"""Packings from which on drawing them tells an error."""


def regression_of(results: Results, measured: bool) -> Regression:
    """<omega^2> [RPM^2] against Gamma, by accelerometers and camera or in truth."""
    gamma, square = ("gamma_measured", "mean_square_rpm_camera") if measured else ("gamma_true", "mean_square_rpm")
    table = results.amplitudes
    return Regression(*(table[name].cast(pl.Float64).to_numpy() for name in (gamma, square, "seed")))


def slope_text(slope: Estimate) -> str:
    """Slope with its error, if there is one."""
    return f"{slope.mean:.2f}" if math.isnan(slope.error) else str(slope)


def power_law_table(results: Results) -> str:
    """Exponents by least squares through the nearest-neighbours regression, beside P's."""
    curves = {"accelerometers and camera": regression_of(results, True), "truth": regression_of(results, False)}
    rows = []
    for name, curve in curves.items():
        slopes = [curve.slope(range_) for range_ in THESIS_SLOPES]
        few = curve.neighbours < ENOUGH
        rows.append([name, *(_cell(Estimate(s.mean, math.nan) if few else s) for s in slopes)])
    rows.append(["the thesis (Fig. 3.2)", *(f"{printed:.2f}" for printed in THESIS_SLOPES.values())])
    heads = [f"{low:g} < Gamma < {high:g}" for low, high in THESIS_SLOPES]
    count = len(results.seeds)
    errors = "errors by drawing packings" if count >= ENOUGH else f"no errors, {count} packing(s) are too few for them"
    return (
        f"{markdown_table(['exponent of <omega^2>', *heads], rows)}\n\nLeast squares on log axes through the mean "
        "of the "
        f"{count} nearest packings in Gamma; {errors}."
    )


def _cell(slope: Estimate) -> str:
    return "too few points" if math.isnan(slope.mean) else slope_text(slope)
