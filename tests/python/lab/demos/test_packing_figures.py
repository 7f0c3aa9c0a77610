"""The demo fits what was measured, and calls the thesis' slopes the thesis'."""

import numpy as np
import polars as pl
import pytest

from jostle_lab.demos.packing.figures import rotation_against_gamma
from jostle_lab.demos.packing.power_laws import power_law_note, power_law_table, regression_of


class Made:
    """Results whose measured <omega^2> grows as Gamma^3 and Gamma^0.6, the true one as Gamma^5 and Gamma^1.3."""

    def __init__(self, packings=6):
        gamma = np.tile(np.geomspace(0.25, 5.0, 24), packings)
        seeds = np.repeat(np.arange(packings), 24)
        noise = 1.0 + 0.01 * np.random.default_rng(1).normal(size=gamma.size)

        def law(low, high):
            return 4.0 * np.where(gamma < 1.3, (gamma / 1.3) ** low, (gamma / 1.3) ** high) * noise

        half = np.full_like(gamma, 0.5)
        self.seeds = list(range(packings))
        self.amplitudes = pl.DataFrame(
            {
                "seed": seeds,
                "gamma_true": gamma,
                "gamma_measured": 1.1 * gamma,
                "mean_square_rpm": law(5.0, 1.3),
                "mean_square_rpm_camera": law(3.0, 0.6),
                **{f"{n}{e}": half for n in ("correlation", "adjusted_deviation") for e in ("", "_camera")},
            }
        )


def labels(figure):
    return [text.get_text() for text in figure.axes[0].get_legend().get_texts()]


def test_slopes_are_fitted_to_what_was_measured():
    curve = regression_of(Made(), measured=True)
    assert curve.slope((0.0, 1.0)).mean == pytest.approx(3.0, abs=0.05)
    assert curve.slope((1.6, 4.5)).mean == pytest.approx(0.6, abs=0.05)
    ours = [label for label in labels(rotation_against_gamma(Made())) if label.endswith("(measured)")]
    assert [float(label.split()[1]) for label in ours] == pytest.approx([3.0, 0.6], abs=0.05)


def test_slopes_of_the_thesis_are_called_its_own():
    assert [label for label in labels(rotation_against_gamma(Made())) if "thesis" in label] == [
        "slope 3.94 (thesis)",
        "slope 1.00 (thesis)",
    ]


def test_the_page_has_both_exponents_beside_the_thesis():
    rows = {row[0]: row for row in power_law_table(Made())[1]}
    assert rows["accelerometers and camera"][1].startswith("3.0")
    assert rows["truth"][1].startswith("5.0")
    assert rows["the thesis (Fig. 3.2)"][1:] == ["3.94", "1.00"]
    assert "errors need 5 packings or more" in power_law_note(Made(2))
    assert "nan" not in str(power_law_table(Made(1)))
