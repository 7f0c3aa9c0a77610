"""Molecular dynamics against event-driven dynamics as contacts stiffen: four disks, the same flight by both."""

import numpy as np
from matplotlib.figure import Figure

from jostle_lab.plots.style import WIDTH
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Product, Statement
from jostle_lab.statistics.estimates import Numbers
from jostle_lab.statistics.power_law import power_law
from jostle_lab.verdicts import near
from studies.examples import example

STIFFEST_FITTED = 1e9
"""Beyond, the error of the integration at its time step shows."""


def make(laboratory: Laboratory, _quick: bool, _seeds: int | None = None) -> Product:
    """One effort only; no chance, hence no error bars."""
    table = example(laboratory, "two_engines")
    stiffness, difference = table["normal_stiffness"], table["difference"]
    fitted = stiffness <= STIFFEST_FITTED
    exponent = power_law(stiffness[fitted], difference[fitted])
    offset = float(np.mean(np.log(difference[fitted]) - exponent.mean * np.log(stiffness[fitted])))
    rows = [{"normal_stiffness": float(k), "difference": float(d)} for k, d in zip(stiffness, difference, strict=True)]
    found = Statement.judged(
        "2.3",
        "instantaneous impacts are the limit of contacts much shorter than flights: the difference of the engines "
        "goes with the duration of a contact, k_n^(-1/2)",
        f"fitted exponent {exponent} from k_n = {stiffness[0]:.0e} to {STIFFEST_FITTED:.0e} N/m",
        near(exponent, -0.5, 0.05),
    )
    notes = [
        "four disks of radii 1.5 to 2.5 cm, 0.12 s, at least seven impacts, base at 60 Hz, constant e_n",
        "difference: largest distance of places, with angles by the radius",
        "no chance, hence no seeds and no error bars",
    ]
    picture = draw(stiffness, difference, exponent.mean, offset)
    return Product("The two engines converge", rows, picture, [found], notes)


def draw(stiffness: Numbers, difference: Numbers, slope: float, offset: float) -> Figure:
    """Log-log, with the fitted line."""
    figure = Figure(figsize=(0.85 * WIDTH, 3.3), layout="constrained")
    panel = figure.subplots()
    panel.loglog(stiffness, 1e3 * difference, "o", color="#1f5fa8", label="four disks after 0.12 s")
    line = np.exp(offset) * stiffness**slope
    panel.loglog(stiffness, 1e3 * line, "--", color="0.3", lw=1.0, label=rf"$k_n^{{{slope:.2f}}}$")
    panel.set(xlabel=r"$k_n$ [N/m]", ylabel="difference of the engines [mm]")
    panel.legend()
    return figure
