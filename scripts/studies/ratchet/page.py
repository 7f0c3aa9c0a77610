"""docs/generated/ratchet.md: every statement of F IV beside what was found, from the data kept there.

    docs/generated/ratchet.csv        velocity of every run
    docs/generated/ratchet-flow.csv   what F reads off Figs 13 and 14

The page is a function of the two files: a test makes it anew and compares.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from jostle_lab import locate, options
from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Statement, cell
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import read_table, write_table
from studies.examples import GENERATED
from studies.ratchet import experiment, frequency, layers, shape, threshold
from studies.ratchet.cases import Case, Plan, Point, Points, lean_on_each_other
from studies.ratchet.fields import Flow, flow_of
from studies.ratchet.flow import BACKWARDS, FORWARDS, FlowStudy
from studies.ratchet.observe import by_sweep, chosen, read_points, write_points
from studies.ratchet.study import Study, Table

STUDIES = (
    shape.ASYMMETRY,
    shape.HEIGHT,
    layers.NEGATIVE,
    layers.POSITIVE,
    frequency.LAYERS,
    threshold.ONSET,
    frequency.TRANSITION,
    experiment.EXPERIMENT,
)
FLOWS = (FORWARDS, BACKWARDS)
POINTS, FLOW, PAGE = "ratchet.csv", "ratchet-flow.csv", "ratchet.md"

HEAD = """# The ratchet's paper, statement by statement

F: Z. Farkas, P. Tegzes, A. Vukics, T. Vicsek, *Transitions in the horizontal transport of vertically vibrated granular
layers*, Phys. Rev. E 60, 7022 (1999). This page is generated; do not edit it. It is made of
`docs/generated/ratchet.csv`, the transport velocity of every run, and `docs/generated/ratchet-flow.csv`, what was read
off the fields.

- `python -m studies ratchet-page` makes it anew from these files; with `--compute` it first runs what is missing in
  `results/`, everything if nothing is there (about {cost} of one processor), and replaces the files.
- `python -m studies figure F6` and so on, the commands in the tables, make one figure: data, picture, statements.
- Velocities are in cm/s, positive to the right; errors are standard errors over seeds, which are 1 to the number of
  runs; where these are two to four, the scatter of a run leans on that of similar points.
- Parameters are those of F IV where it gives them: w = 6 mm, A = 2 mm, restitution 0.8, friction 0.1, radii 1.05 to
  1.155 mm, equal masses, 30 or 50 s. Left open by F: radius of the tips (0.4 mm here), start (loose rows here),
  transient (1 s unobserved here). What these change is in the tables.
- A verdict is `agrees`, `partly` (a part of the statement, or of the cases), `disagrees` or `open`. Signs count beyond
  three standard errors, numbers agree within two joint ones. A curve is monotone if chi^2 against the best monotone
  curve has p > 0.01.
"""


WHY = """
## Where ours differs, and why
- Negative transport begins at h = 4 to 5.5 mm, the later the steeper the teeth (Fig. 7 and its map): so at h = 5 mm the
  steepest teeth still push forwards, and so do they at 4 mm. It is not the tip (table of Fig. 6). "Between 4 and 16 mm"
  and "less than about 0.4" hold to within one step of our grid: near a = 0.45 the flow is weak but has not gone.
- Fig. 10: n = 4.2 reverses here too, at 29 Hz; how far F's frequencies go is not said.
- Fig. 7: at a = 0.05 and 18 mm a weak flow is left, three errors from zero; at 20 mm it has gone.
- Dissipation: F refers to earlier work and shows nothing. Less restitution does weaken the positive flow; the negative
  one is strongest near 0.8. More friction strengthens the positive flow, threefold from none to 0.5, and leaves the
  negative one as it is within the errors: it is impacts on the steep sides that turn that one.
- The exponent of Fig. 11 depends on the window more than its interval says: 0.18 to 0.30 over the table, so F's
  +- 0.05 is about right. Runs of 300 s and late starts change the point nearest to the threshold only, where beds
  freeze: this rounds the onset.
- Fig. 3 is an experiment; disks in a plane without glass walls share its threshold, not its exponent.
"""


QUANTITIES = ("sliding_x_cm_per_s", "sliding_y_cm_per_s", "impulse_cm_per_s", "share_to_the_left")


def write_flow(path: Path, flows: dict[str, Flow]) -> None:
    """One line for each number."""
    rows = [
        {"figure": number, "quantity": name, "mean": f"{value.mean:.6g}", "error": f"{value.error:.6g}"}
        for number, flow in flows.items()
        for name, value in zip(QUANTITIES, (*flow.sliding, flow.impulse, flow.to_the_left), strict=True)
    ]
    write_table(path, rows)


def read_flow(path: Path) -> dict[str, Flow]:
    """What `write_flow` wrote."""
    flows = {}
    for (number,), rows in read_table(path).group_by("figure", maintain_order=True):
        found = {row["quantity"]: Estimate(row["mean"], row["error"]) for row in rows.to_dicts()}
        across, down, impulse, left = (found[name] for name in QUANTITIES)
        flows[str(number)] = Flow((across, down), impulse, left)
    return flows


def kept_sections(docs: Path) -> list["Section"]:
    """What is kept in a folder says, figure by figure."""
    return _sections(read_points(docs / POINTS), read_flow(docs / FLOW))


def _sections(points: dict[Case, Point], flows: dict[str, Flow]) -> list["Section"]:
    sections = [_study(study, points) for study in STUDIES] + [_flow(study, points, flows) for study in FLOWS]
    return sorted(sections, key=lambda section: int(section.number.removeprefix("F")))


def page(points: dict[Case, Point], flows: dict[str, Flow]) -> str:
    """The whole page."""
    sections = _sections(points, flows)
    statements = [s for section in sections for s in section.statements]
    counts = Counter(s.verdict for s in statements)
    total = ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
    cost = f"{_disk_seconds(points) / DISK_SECONDS / 60.0:.0f} min"
    runs = sum(p.runs for p in points.values())
    lines = [HEAD.format(cost=cost), f"{len(statements)} statements: {total}. {runs} runs of {len(points)} cases."]
    for section in sections:
        lines += ["", f"## {section.title}", section.runs, ""]
        lines += ["| where | F | ours | | command |", "|:--|:--|:--|:--|:--|"]
        lines += [_line(section.number, s) for s in section.statements]
        for table in section.tables:
            lines += ["", table.markdown()]
    return "\n".join(lines) + "\n" + WHY


def _line(number: str, s: Statement) -> str:
    return f"| {s.place} | {cell(s.printed)} | {cell(s.found)} | {s.verdict} | `figure {number}` |"


DISK_SECONDS = 6000.0
"""Disks times simulated seconds that a processor does in a second, roughly."""


@dataclass(frozen=True)
class Section:
    """What the page says of a figure."""

    number: str
    title: str
    runs: str
    """How many there are."""
    statements: list[Statement]
    tables: list[Table]
    notes: Sequence[str]
    count: int
    """Of the runs."""
    seeds: str
    seconds: float
    """Processor time, roughly."""


def _runs(points: Points, plan: Plan) -> str:
    """How many runs there are, and what is left of the plan."""
    counts = [point.runs for point in points.values()]
    left = sum(plan.values()) - sum(counts)
    text = f"{sum(counts)} runs of {len(counts)} cases, {min(counts)} to {max(counts)} each"
    return text + (f"; {left} more are planned, which `ratchet-page --compute` adds." if left else ".")


def _study(study: Study, points: dict[Case, Point]) -> Section:
    plan = study.plan(False)
    ours = lean_on_each_other(chosen(points, plan))
    runs = f"{'; '.join(study.notes)}. {_runs(ours, plan)}"
    statements, tables = study.statements(ours), study.tables(ours)
    return Section(study.number, study.title, runs, statements, tables, study.notes, *_effort(ours))


def _effort(points: Points) -> tuple[int, str, float]:
    """Runs, seeds, processor time."""
    most = max(point.runs for point in points.values())
    return sum(p.runs for p in points.values()), f"1 to {most}", _disk_seconds(points) / DISK_SECONDS


def _disk_seconds(points: Points) -> float:
    return sum(c.disks * (c.seconds + c.warm_up) * p.runs for c, p in points.items())


def _flow(study: FlowStudy, points: dict[Case, Point], flows: dict[str, Flow]) -> Section:
    plan = study.plan(False)
    ours = chosen(points, plan)
    statements = study.statements(ours, flows[study.number])
    return Section(study.number, study.title, _runs(ours, plan), statements, study.tables(ours), (), *_effort(ours))


def compute(laboratory: Laboratory, docs: Path) -> None:
    """Run what is missing and write the two files."""
    plan: dict[Case, int] = {}
    for study in (*STUDIES, *FLOWS):
        for case, seeds in study.plan(False).items():
            plan[case] = max(seeds, plan.get(case, 0))
    write_points(docs / POINTS, by_sweep(laboratory, plan, "ratchet page"))
    write_flow(docs / FLOW, {s.number: flow_of(s.case, s.observe(laboratory, False)) for s in FLOWS})


def ratchet_page(
    compute_anew: Annotated[
        bool, typer.Option("--compute", help="First run what is missing in results, and replace the data.")
    ] = False,
    docs: Annotated[Path, typer.Option(help="Folder of the page and its data.")] = GENERATED,
    results: Annotated[Path, typer.Option(help="Folder of the runs.")] = Path("results"),
    processes: options.ProcessesOption = 2,
    program: options.ProgramOption = None,
    scheduler: options.SchedulerOption = None,
    progress: options.ProgressOption = True,
) -> None:
    """Write docs/generated/ratchet.md, every statement of the ratchet's paper beside what was found, from its data."""
    if compute_anew:
        compute(Laboratory(locate.program(program), results / "runs", processes, progress, scheduler), docs)
    (docs / PAGE).write_text(page(read_points(docs / POINTS), read_flow(docs / FLOW)))
    typer.echo(docs / PAGE)
