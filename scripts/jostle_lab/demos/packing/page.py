"""A results folder in, `index.html` out: pictures with captions, numbers, parameters; no network, no server."""

import os
import shlex
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from datetime import datetime
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import jinja2
import numpy as np
import polars as pl

from jostle_lab.demos.packing import figures, numbers
from jostle_lab.demos.packing.captions import CAPTIONS, NOW
from jostle_lab.demos.packing.power_laws import power_law_note, power_law_table, regression_of, slope_of, slope_text
from jostle_lab.demos.packing.schedules import FULL, QUICK, STANDARD
from jostle_lab.errors import LabError
from jostle_lab.files import read_json, replace_text
from jostle_lab.protocol.intervals import Protocol
from jostle_lab.protocol.results import Results
from jostle_lab.sensors.camera import Camera
from jostle_lab.statistics.regression import THESIS_SLOPES
from jostle_lab.statistics.rotation import RPM

PAGE = "index.html"
TITLE = "Disks that turn when they are shaken"
CHECKOUT = Path(__file__).resolve().parents[4]
"""If this package is in one."""
SYMBOLS = {
    "<omega^2>": "⟨ω²⟩",
    "<rho^2>": "⟨ρ²⟩",
    "<sigma_a>": "⟨σₐ⟩",
    "rho^2": "ρ²",
    "RPM^2": "RPM²",
    "Gamma": "Γ",
    "+-": "±",
    "us per": "µs per",
    "ug/sqrt(Hz)": "µg/√Hz",
}
READING = (
    ("physicist", "curves, fields, statistics and sweeps of your own"),
    ("figures", "every figure of the papers, computed anew"),
    ("physics", "the contact laws and the engines"),
    ("control-engineer", "the FMU of the packing in a loop of your own"),
)


@dataclass(frozen=True)
class Status:
    """How far the run is."""

    name: str = "finished"
    """running, stopped or finished."""
    share: float = 1.0
    """Of the simulated time that is done."""
    left: str = ""
    """Time on the clock that it still takes, in words; empty: not known yet."""
    said: str = ""
    """Of a run that was stopped: what is kept, or what failed."""


class Link(NamedTuple):
    """A page to read on."""

    href: str
    text: str
    what: str


def write(folder: Path, status: Status = Status()) -> Path:
    """Write the page of a folder that holds `run.json`; return its path.

    A run that is not finished shows what there is.
    """
    path = folder / PAGE
    replace_text(path, _environment().get_template("page.html").render(_context(folder, status)))
    return path


@cache
def _environment() -> jinja2.Environment:
    loader = jinja2.FileSystemLoader(Path(__file__).parent)
    made = jinja2.Environment(
        loader=loader, autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    made.filters["pretty"] = pretty
    return made


def pretty(text: str) -> str:
    """A text of the tables with the symbols of the field."""
    for plain, symbol in SYMBOLS.items():
        text = text.replace(plain, symbol)
    return f"−{text[1:]}" if text.startswith("-") else text


def _context(folder: Path, status: Status) -> dict[str, Any]:
    run = read_json(folder / "run.json", f"Remove {folder} to start afresh.")
    setup = run["setup"]
    kind = _kind(setup["protocol"])
    results = _results(folder, unfinished=status.name != "finished")
    camera = Camera(setup["camera"]["frame_rate"])
    pictures = [caption for caption in CAPTIONS if status.name == "finished" and (folder / caption.file).exists()]
    if status.name != "finished" and (now := folder / NOW.file).exists():
        pictures = [NOW._replace(version=f"?{now.stat().st_mtime_ns}")]
    return {
        "title": TITLE,
        "status": status.name,
        "percent": f"{100.0 * status.share:.0f}",
        "left": status.left,
        "said": status.said,
        "written": datetime.now().astimezone().strftime("%H:%M:%S on %d %B %Y"),
        "kind": kind,
        "packings": len(results.seeds) if results and status.name == "finished" else 2,
        "amplitudes": len(setup["protocol"]["intervals"]),
        "seconds": _seconds(setup),
        "disks": len(results.radii(results.seeds[0])) if results else 60,
        "frequency": f"{setup['drive_frequency']:g}",
        "frame_interval": f"{1.0 / camera.frame_rate:g}",
        "alias_limit": f"{camera.alias_limit() / RPM:g}",
        "pictures": pictures,
        "commands": _commands(kind, folder),
        "links": _links(folder),
        "findings": _findings(results) if results and status.name == "finished" else [],
        **_tables(results, status.name == "finished"),
        "setting": [*_schedule(setup), *(numbers.setting(results) if results else numbers.labels(run))],
    }


def _results(folder: Path, unfinished: bool) -> Results | None:
    """What there is; None if there is nothing yet."""
    try:
        return Results(folder, unfinished)
    except (LabError, FileNotFoundError):
        # A packing may be finished, and its files renamed, while they are looked for: the next page has it.
        if not unfinished:
            raise
        return None


def _tables(results: Results | None, finished: bool) -> dict[str, Any]:
    whole = results if finished else None
    return {
        "drive": numbers.drive_table(results) if results else None,
        "rotation": numbers.rotation_table(results) if results else None,
        "power_laws": numbers.Sheet(*power_law_table(whole)) if whole else None,
        "power_law_note": power_law_note(whole) if whole else "",
        "aliased": numbers.aliased_table(whole) if whole else None,
        "aliased_count": numbers.aliased_count(whole) if whole else "",
        "by_pictures": numbers.pictures_table(whole) if whole else None,
        "pictures_note": numbers.PICTURES_NOTE,
        "cost": numbers.cost_table(whole) if whole else None,
        "speed": numbers.speed(whole) if whole else "",
    }


def _kind(protocol: dict[str, Any]) -> str:
    """quick, standard, full, or own for one that somebody chose."""
    known: dict[str, Protocol] = {"quick": QUICK, "standard": STANDARD, "full": FULL}
    return next((name for name, schedule in known.items() if protocol == _plain(schedule)), "own")


def _plain(protocol: Protocol) -> dict[str, Any]:
    """As JSON has it."""
    return {**asdict(protocol), "intervals": [asdict(interval) for interval in protocol.intervals]}


def _schedule(setup: dict[str, Any]) -> list[tuple[str, str]]:
    """How hard and how long."""
    every = [interval["amplitude"] for interval in setup["protocol"]["intervals"]]
    listed = ", ".join(f"{amplitude:g}" for amplitude in every)
    if len(every) > 12:
        listed = f"{len(every)} from {every[0]:g} to {every[-1]:g}"
    first = setup["protocol"]["intervals"][0]
    return [
        ("amplitudes A", listed),
        ("time at each", f"{first['relaxation']} s unobserved, then {first['recording']} s recorded"),
        ("before the first", f"{setup['protocol']['settling']} s at A = 1"),
    ]


def _seconds(setup: dict[str, Any]) -> int:
    first = setup["protocol"]["intervals"][0]
    return int(first["relaxation"] + first["recording"])


def _findings(results: Results) -> list[str]:
    """What came out, in sentences."""
    drawn = figures.packing_drawn(results)
    velocities = np.array([d["mean_velocity"] for d in results.disks_of(results.seeds[0], drawn["amplitude"])]) / RPM
    table = results.amplitudes.sort("gamma_true")
    weak, strong = (table.group_by("amplitude").mean().sort("amplitude").row(i, named=True) for i in (0, -1))
    worst = 100.0 * float(table.select(pl.col("bias").abs().max()).item())
    sentences = [
        f"Disks turn. At Γ = {drawn['gamma_true']:.2f}, {int(np.sum(velocities > 0.0))} disks of the first packing "
        f"turn counter-clockwise and {int(np.sum(velocities < 0.0))} clockwise, the fastest at "
        f"{np.max(np.abs(velocities)):.1f} RPM.",
        f"They turn steadily. There the angles follow straight lines with ⟨ρ²⟩ = {drawn['correlation']:.2f}; a random "
        "to and fro gives 0.43.",
        f"More shaking, more rotation. From Γ = {weak['gamma_true']:.2f} to {strong['gamma_true']:.2f}, ⟨ω²⟩ grows "
        f"from {weak['mean_square_rpm']:.2g} to {strong['mean_square_rpm']:.3g} RPM².",
        *_slopes(results),
        f"The accelerometers measure Γ well: they are wrong by {worst:.2g} % at most.",
    ]
    if int(table["aliased_disks"].sum()):
        sentences.append(
            f"The camera is too slow at strong shaking. At Γ = {strong['gamma_true']:.2f} it sees ⟨ω²⟩ = "
            f"{strong['mean_square_rpm_camera']:.3g} RPM² where {strong['mean_square_rpm']:.3g} is true."
        )
    return sentences


def _slopes(results: Results) -> list[str]:
    """The power laws that there are points for, beside those of the thesis."""
    curve = regression_of(results, measured=True)
    sentences = []
    for (low, high), printed in THESIS_SLOPES.items():
        exponent = slope_of(curve, (low, high))
        if np.isfinite(exponent.mean):
            where = f"Γ from {low:g} to {high:g}" if low else f"Γ below {high:g}"
            sentences.append(
                f"For {where}, ⟨ω²⟩ as measured grows as Γ to the power {slope_text(exponent)}; the thesis has "
                f"{printed:.2f}."
            )
    return sentences


def _commands(kind: str, folder: Path) -> Sequence[tuple[str, str]]:
    """Lines for a terminal, and what they do."""
    demo = "scripts/demo" if _in_checkout() else "jostle-lab demo"
    same = {"quick": f"{demo} --quick", "standard": demo, "full": f"{demo} --full"}
    usual = CHECKOUT / "results" / ("quick" if kind == "quick" else "")
    place = "" if folder.resolve() == usual else f" --results {shlex.quote(str(folder.resolve()))}"
    lines = [(f"{same[kind]}{place}", "this run: does what is left of it, draws it again")] if kind in same else []
    lines += [(demo, "two packings, nine amplitudes: a minute or two")] if kind == "quick" else []
    return [
        *lines,
        (f"{demo} --first-seed 3 --results results/other", "other packings"),
        (f"{demo} --set contact.friction=0.2 --results results/friction", "another friction"),
        *([(f"{demo} --full --results results/full", "the protocol of the thesis: days")] if kind != "full" else []),
        (f"{demo} --help", "everything that can be changed"),
    ]


def _in_checkout() -> bool:
    return (CHECKOUT / "docs" / "physicist.md").is_file() and (CHECKOUT / "scripts" / "demo").is_file()


def _links(folder: Path) -> list[Link]:
    """Pages of the checkout around this package, as a book if it is made; none if there is no checkout."""
    if not _in_checkout():
        return []
    book = CHECKOUT / "build" / "book"
    found = []
    for name, what in READING:
        page = book / f"{name}.html"
        path = page if page.is_file() else CHECKOUT / "docs" / f"{name}.md"
        if path.is_file():
            href = os.path.relpath(path, folder.resolve()).replace(os.sep, "/")
            found.append(Link(href, f"docs/{name}", what))
    return found
