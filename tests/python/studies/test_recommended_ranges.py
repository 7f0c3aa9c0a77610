"""The runs behind the pages of the papers stay inside of what the scenes recommend."""

import re
import warnings
from pathlib import Path

import polars as pl

from jostle import JostleWarning, Simulation

RECORDS = Path(__file__).resolve().parents[3] / "docs" / "generated" / "claims"
SAME_FOR_RANGES = re.compile(r"(.*\.)?seed|measure\..*|base\.profile|support\.noise|drive\.phase|initial\..*")
"""Parameters that no recommended range depends on."""


def recorded() -> set[tuple[str, str, str, tuple[str, ...]]]:
    """Scene, engine, drive and parameters of every run of the command line whose results are kept."""
    lines = {line for file in RECORDS.glob("*.parquet") for line in pl.read_parquet(file, columns=["run"])["run"]}
    runs = set()
    for line in lines:
        if not line.startswith("run "):
            continue
        options = dict(re.findall(r"--(engine|drive) (\S+)", line))
        given = [one for one in re.findall(r"--set (\S+)", line) if not SAME_FOR_RANGES.fullmatch(one.split("=")[0])]
        runs.add((line.split()[1], options["engine"], options["drive"], tuple(sorted(given))))
    return runs


def test_no_run_of_the_papers_is_outside_of_a_recommended_range() -> None:
    runs = recorded()
    assert len(runs) > 100
    told = set()
    for scene, engine, drive, given in runs:
        parameters = dict(one.split("=") for one in given)
        few = {} if scene in ("wedge", "three_disk") else {"disks": 3}
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", JostleWarning)
            Simulation(scene, engine=engine, drive=drive, **few, **parameters)
        told |= {(scene, engine, str(one.message)) for one in caught if "recommended range" in str(one.message)}
    assert not told, "\n".join(map(str, sorted(told)))
