"""Work-precision diagrams: points measured by `jostle-bench report` and by `peer_points` in, a page with plots out.

A folder holds `points*.csv` (case, quantity, method, setting, error, error_bar, cpu_seconds, evaluations, trouble),
`cases*.csv` (what these words mean) and `machine.csv`. The page is a function of these files alone: nothing is measured
here.
"""

import math
from dataclasses import dataclass
from io import BytesIO
from itertools import pairwise
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from PIL import Image

from jostle_lab.errors import LabError
from jostle_lab.tables import markdown_table, read_text_rows
from tools import instruction_counts
from tools.work_precision import step_lengths

COLOURS = ("#1f5fa8", "#d07a1f", "#2e7d4f", "#a23b72", "#6b6b6b", "#8a6d1f", "#3b9a9c", "#b03a2e", "#111111")
MANY = 6
"""Curves beyond which the legend stands beside the diagram."""
COMMUNICATION_STEP = "communication step [s]"
"""Setting of diagrams that get a table of steps."""
EARLIER = "earlier builds"
"""In the names of methods that are no longer there: their curves are dotted."""
CROWDED = 12
"""Curves from which on a diagram is larger."""
MARKERS = "osv^DPX*"
ROUNDING = 1e-14
"""Errors below this are rounding: no order is fitted through them."""
ABOVE_FLOOR = 10.0
"""Nor through errors within this factor of that at which a curve ends."""
FLOOR = 1e-16
"""Where an error of zero is drawn."""


@dataclass(frozen=True)
class Point:
    """One setting of one method."""

    setting: float
    error: float
    error_bar: float
    cpu_seconds: float
    evaluations: float


@dataclass(frozen=True)
class Diagram:
    """One quantity of one case: a curve for each method, and what the words mean."""

    case: str
    quantity: str
    error: str
    setting: str
    reference: str
    problem: str
    curves: dict[str, list[Point]]
    troubles: tuple[str, ...]

    @property
    def is_statistical(self) -> bool:
        """Whether the errors are means over an ensemble."""
        return any(p.error_bar > 0.0 for points in self.curves.values() for p in points)


def diagrams(folder: Path) -> list[Diagram]:
    """Diagrams of a folder in the order of its case files."""
    cases = read_text_rows(sorted(folder.glob("cases*.csv")))
    if not cases:
        raise LabError(f"{folder} has no cases.csv. Measure first: jostle-bench report --out {folder}")
    points = read_text_rows(sorted(folder.glob("points*.csv")))
    known: dict[tuple[str, str], dict[str, str]] = {}
    for row in cases:
        known.setdefault((row["case"], row["quantity"]), row)
    return [_diagram(row, points) for row in known.values()]


def _diagram(case: dict[str, str], rows: list[dict[str, str]]) -> Diagram:
    curves: dict[str, list[Point]] = {}
    troubles: list[str] = []
    for row in rows:
        if (row["case"], row["quantity"]) != (case["case"], case["quantity"]):
            continue
        if row.get("trouble"):
            troubles.append(f"{row['method']} at {row['setting']}: {row['trouble']}")
            continue
        numbers = (float(row[name] or 0.0) for name in ("setting", "error", "error_bar", "cpu_seconds", "evaluations"))
        curves.setdefault(row["method"], []).append(Point(*numbers))
    return Diagram(
        case["case"],
        case["quantity"],
        case["error"],
        case["setting"],
        case["reference"],
        case["problem"],
        curves,
        tuple(troubles),
    )


def _floor(points: list[Point]) -> float:
    """The error that the two dearest points share within a factor of 1.5, or 0 where the curve still falls."""
    by_work = sorted(points, key=lambda p: p.evaluations)
    if len(by_work) < 2 or by_work[-1].evaluations < 1.5 * by_work[-2].evaluations:
        return 0.0
    last, before = by_work[-1].error, by_work[-2].error
    return min(last, before) if max(last, before) <= 1.5 * min(last, before) else 0.0


def order(points: list[Point]) -> float | None:
    """Order: minus the slope of log error against log evaluations, or None where the points do not determine it.

    Points at rounding are left out, and those near the error at which a curve stays however much it works, which is
    that of the reference or of summed rounding; and whole curves that are means over an ensemble.
    """
    if any(p.error_bar > 0.0 for p in points):
        return None
    least = max(ROUNDING, ABOVE_FLOOR * _floor(points))
    used = [p for p in points if p.error > least and p.evaluations > 0.0]
    if len(used) < 3:
        return None
    work, error = (np.log([getattr(p, name) for p in used]) for name in ("evaluations", "error"))
    if np.ptp(work) < math.log(3.0):
        return None
    return float(-np.polyfit(work, error, 1)[0])


def time_at(points: list[Point], error: float) -> float | None:
    """CPU seconds at which a curve reaches `error`, along straight lines between its points; None if it never does.

    The first crossing is taken from which on every dearer point is at least as exact.
    """
    path = sorted(points, key=lambda p: p.cpu_seconds)
    best: float | None = None
    for first, second in pairwise(path):
        if first.error > error >= second.error:
            lowest = max(second.error, ROUNDING)
            share = math.log(first.error / error) / math.log(first.error / lowest)
            best = first.cpu_seconds * (second.cpu_seconds / first.cpu_seconds) ** min(share, 1.0)
        elif second.error > error:
            best = None
    if best is None and path and all(p.error <= error for p in path):
        best = path[0].cpu_seconds
    return best


def draw(diagram: Diagram, axes: Axes, colours: dict[str, tuple[str, str]]) -> None:
    """Error against CPU time, both logarithmic; the order stands in the legend. Dashed: the statistical error alone.

    Exchanges between models: error against the communication step.
    """
    by_step = diagram.setting == COMMUNICATION_STEP
    for method, points in diagram.curves.items():
        colour, marker = colours[method]
        path = sorted(points, key=lambda p: p.setting if by_step else p.cpu_seconds)
        x, y = [p.setting if by_step else p.cpu_seconds for p in path], [max(p.error, FLOOR) for p in path]
        style = ":" if EARLIER in method else "-"
        axes.plot(x, y, marker=marker, color=colour, ms=3.2, lw=1.0, ls=style, label=_label(method, points))
        if diagram.is_statistical:
            bars = [p.error_bar for p in path]
            low = [min(bar, 0.9 * error) for bar, error in zip(bars, y, strict=True)]
            axes.errorbar(x, y, yerr=[low, bars], fmt="none", ecolor=colour, elinewidth=0.7, capsize=1.5)
            axes.plot(x, bars, ls="--", color=colour, lw=0.7)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_title(f"{diagram.case}: {diagram.quantity}", fontsize=8)
    axes.set_xlabel(diagram.setting if by_step else "CPU time of one solution [s]", fontsize=7)
    axes.set_ylabel("bias; dashed: statistical error" if diagram.is_statistical else "error", fontsize=7)
    axes.tick_params(labelsize=6)
    axes.grid(lw=0.3, color="0.85")
    if axes.get_legend_handles_labels()[0]:
        legend = axes.legend(fontsize=5.5, framealpha=0.6)
        if len(legend.get_texts()) > MANY:
            legend.set(loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _label(method: str, points: list[Point]) -> str:
    fitted = order(points)
    return method if fitted is None else f"{method}: order {fitted:.1f}"


def draw_all(found: list[Diagram], folder: Path) -> list[Path]:
    """One picture for all quantities of a case."""
    pictures = []
    for case in dict.fromkeys(diagram.case for diagram in found if diagram.curves):
        chosen = [diagram for diagram in found if diagram.case == case]
        methods = list(dict.fromkeys(method for diagram in chosen for method in diagram.curves))
        colours = {method: (COLOURS[i % len(COLOURS)], MARKERS[i % len(MARKERS)]) for i, method in enumerate(methods)}
        size = (3.6 * len(chosen) if len(chosen) > 1 else 4.4, 3.0) if len(methods) < CROWDED else (8.6, 4.0)
        figure = Figure(figsize=size, layout="constrained")
        for index, diagram in enumerate(chosen):
            draw(diagram, figure.add_subplot(1, len(chosen), index + 1), colours)
        path = folder / f"{case}.png"
        _save_small(figure, path)
        pictures.append(path)
    return pictures


def _save_small(figure: Figure, path: Path) -> None:
    """PNG of few colours: a third of the size, and nothing of a line drawing is lost."""
    buffer = BytesIO()
    figure.savefig(buffer, dpi=90, format="png")
    Image.open(buffer).convert("RGB").quantize(32).save(path, optimize=True)


def page(folder: Path, pictures: str, counts: Path) -> str:
    """The page as Markdown: a section for each case with its picture and its numbers.

    `pictures` is the folder of the pictures, relative to the page, `counts` the folder of the instruction counts.
    """
    found = diagrams(folder)
    machine = {row["name"]: row["value"] for row in read_text_rows([folder / "machine.csv"])}
    parts = [_head(machine), _summary(found)]
    if (counts / "instructions.csv").is_file():
        parts.append(instruction_counts.section(counts))
    notes = read_text_rows(sorted(folder.glob("notes*.csv")))
    for case in dict.fromkeys(diagram.case for diagram in found):
        parts.append(_section([diagram for diagram in found if diagram.case == case], pictures))
        parts.extend(row["note"] for row in notes if row["case"] == case)
    return "\n\n".join(parts) + "\n"


def _head(machine: dict[str, str]) -> str:
    return (
        "# Error against run time\n\n"
        "Written by `python -m tools work-precision`; what is measured here is in `docs/generated/report/*.csv`. Each "
        "point is one setting of one method; CPU time is that of one solution without its set-up, the median of "
        f"{machine['rounds']} rounds in which all points of a case take turns. The order is minus the slope of the "
        "straight line through error against evaluations on log axes, which is that against CPU time without what does "
        "not grow with the work. Points at rounding are left out of it, and those within ten times the error at which "
        "a curve stays; curves of ensemble means have none.\n\n"
        f"Machine: {machine['processor']}, {machine['cores']} cores, shared. Target: {machine['target']}. "
        f"Version {machine['version']}. Take ratios, not times."
    )


def _summary(found: list[Diagram]) -> str:
    """Which method is first at which error, and by how much."""
    rows = []
    first = {diagram.case: diagram for diagram in reversed(found)}
    for diagram in reversed(first.values()):
        for level in (1e-2, 1e-4, 1e-6, 1e-8):
            times = {m: t for m, p in diagram.curves.items() if (t := time_at(p, level)) is not None}
            if len(times) < 2 or diagram.is_statistical:
                continue
            ranked = sorted(times.items(), key=lambda pair: pair[1])
            best = ranked[0][1]
            others = ", ".join(f"{method} {time / best:.3g}" for method, time in ranked[1:])
            rows.append([diagram.case, diagram.quantity, f"{level:.0e}", ranked[0][0], f"{best:.2e}", others])
    header = ["case", "quantity", "error", "fastest", "CPU time [s]", "times slower"]
    text = (
        "CPU time at equal error of the first quantity of each case, read from the curves. Methods that do not reach "
        "the error are not named."
    )
    return f"## At equal error\n\n{text}\n\n{markdown_table(header, rows)}"


def _section(chosen: list[Diagram], pictures: str) -> str:
    first = chosen[0]
    parts = [f"## {first.case}", first.problem]
    if not any(diagram.curves or diagram.troubles for diagram in chosen):
        return "\n\n".join([*parts, f"Not measured here: `jostle-bench report --only {first.case}`."])
    against = "communication step" if first.setting == COMMUNICATION_STEP else "CPU time"
    parts.append(f"![Error against {against}: {first.case}]({pictures}/{first.case}.png)")
    parts.append(f"Setting: {first.setting}. Reference: {first.reference}.")
    parts.extend(_numbers(diagram) for diagram in chosen)
    parts.extend(_steps(diagram) for diagram in chosen if diagram.setting == COMMUNICATION_STEP)
    troubles = dict.fromkeys(trouble for diagram in chosen for trouble in diagram.troubles)
    if troubles:
        parts.append("Not done:\n" + "\n".join(f"- {trouble}" for trouble in troubles))
    return "\n\n".join(parts)


def _steps(diagram: Diagram) -> str:
    return step_lengths.section(
        [
            step_lengths.Curve(method, order(points), [(point.setting, max(point.error, FLOOR)) for point in points])
            for method, points in diagram.curves.items()
        ]
    )


def _numbers(diagram: Diagram) -> str:
    with_bars = diagram.is_statistical
    rows = []
    for method, points in diagram.curves.items():
        fitted = order(points)
        for point in (min(points, key=lambda p: p.cpu_seconds), max(points, key=lambda p: p.cpu_seconds)):
            error = f"{point.error:.2e}" + (f" +- {point.error_bar:.1e}" if with_bars else "")
            row = [method, f"{point.setting:g}", error, f"{point.cpu_seconds:.2e}", f"{point.evaluations:.4g}"]
            row.append("" if fitted is None else f"{fitted:.2f}")
            if row not in rows:
                rows.append(row)
    table = markdown_table(["method", "setting", "error", "CPU time [s]", "evaluations", "order"], rows)
    return f"`{diagram.quantity}`: {diagram.error}; cheapest and dearest point of each curve.\n\n{table}"
