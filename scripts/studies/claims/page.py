"""docs/generated/claims.md: every claim of both papers, one row each, with its verdict and the rule of it."""

import re
from collections import Counter
from collections.abc import Sequence

from jostle_lab.statements import Statement, cell
from jostle_lab.tables import markdown_table
from jostle_lab.verdicts import Verdict
from studies.claims.sections import Section

ROUNDING = re.compile(r"\b\d(?:\.\d+)?e-(?:1[3-9]|[2-9]\d)\b")
"""Numbers that are rounding: processors differ in their last bits, and so would the page."""

HEAD = """# Both papers, claim by claim

F: Z. Farkas, P. Tegzes, A. Vukics, T. Vicsek, *Transitions in the horizontal transport of vertically vibrated granular
layers*, Phys. Rev. E 60, 7022 (1999). P: G. G. Peraza Mues, *Spontaneous rotation in vibrated disk packings*, doctoral
thesis, Cinvestav Mérida, 2018. This page is generated from the records in `docs/generated/`; do not edit it.

- `python -m jostle_lab claims` makes it anew from the records, without a run; `--compute 3.6` first does the runs
  that the record of a figure lacks, `--compute all` those of every figure, `--scheduler` on any Dask scheduler.
- A row is a number, a figure or a quantitative statement as it is printed, what was found with its standard error,
  the verdict, and the rule that gave the verdict. `partly`: a part of the statement, or of the cases.
  `open`: the errors do not tell.
- Runs, seeds and processor time stand above each table.
"""


def page(sections: Sequence[Section], missing: Sequence[str]) -> str:
    """The whole page; `missing` are the figures that have no record yet."""
    thesis = [s for s in sections if not s.figure.startswith("F")]
    ratchet = [s for s in sections if s.figure.startswith("F")]
    lines = [HEAD, _counts((("F", ratchet), ("P", thesis))), ""]
    lines += _differences("Where ours differs, and why", sections, (Verdict.DISAGREES,))
    lines += _differences("What holds in part", sections, (Verdict.PARTLY,))
    lines += _differences("What is open, and what it would take", sections, (Verdict.OPEN,))
    if missing:
        lines += ["", "## Not computed yet", "", *(f"- `claims --compute {figure}`" for figure in missing)]
    for name, part in (("F: the ratchet", ratchet), ("P: spontaneous rotation", thesis)):
        lines += ["", f"## {name}"]
        for section in part:
            lines += ["", *_section(section)]
    return ROUNDING.sub("below 1e-12", "\n".join(lines) + "\n")


def _counts(papers: Sequence[tuple[str, Sequence[Section]]]) -> str:
    every = [section for _, sections in papers for section in sections]
    rows = [_count_row(name, sections) for name, sections in (*papers, ("both", every))]
    return markdown_table(["paper", "claims", *Verdict, "processor time [h]"], rows)


def _count_row(name: str, sections: Sequence[Section]) -> list[str]:
    counts = Counter(s.verdict for section in sections for s in section.statements)
    claims = sum(counts.values())
    shares = [f"{counts[v]} ({100.0 * counts[v] / max(claims, 1):.0f} %)" for v in Verdict]
    return [name, str(claims), *shares, f"{sum(s.seconds for s in sections) / 3600.0:.1f}"]


def _differences(title: str, sections: Sequence[Section], verdicts: Sequence[Verdict]) -> list[str]:
    chosen = [
        f"- {name} ({s.place}), {s.printed}: {s.cause}"
        for section in sections
        for name, s in zip(section.row_names(), section.statements, strict=True)
        if s.verdict in verdicts and s.cause
    ]
    return ["", f"## {title}", *chosen] if chosen else []


def _section(section: Section) -> list[str]:
    kind = f" Seeds: {section.seeds}."
    effort = (
        f"`claims --compute {section.figure}`: {len(section.runs)} runs, {_time(section.seconds)} of one processor."
    )
    rows = [_row(name, s) for name, s in zip(section.row_names(), section.statements, strict=True)]
    return [
        f"### {section.title}",
        effort + kind,
        "",
        *(f"- {note}" for note in section.notes),
        "",
        "| row | where | printed | ours | verdict | rule |",
        "|:--|:--|:--|:--|:--|:--|",
        *rows,
        *_folded(section.tables),
    ]


def _folded(tables: Sequence[str]) -> list[str]:
    """Tables of what the answers depend on, folded away: a reader of the claims opens those that matter."""
    if not tables:
        return []
    lines = ["", "<details><summary>What the answers depend on</summary>", ""]
    return [*lines, *(line for table in tables for line in (*table.splitlines(), "")), "</details>"]


def _row(name: str, s: Statement) -> str:
    return f"| {name} | {s.place} | {cell(s.printed)} | {cell(s.found)} | {s.verdict} | {cell(s.rule)} |"


def _time(seconds: float) -> str:
    if seconds < 100.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 6000.0 else f"{seconds / 3600.0:.1f} h"
