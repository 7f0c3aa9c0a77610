"""One case through cofmupy. Run by the interpreter of an environment that has it: `python run_cofmupy.py CASE.json`."""

import csv
import json
import sys
from pathlib import Path

from cofmupy import Coordinator

case = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
table, configuration = (Path(sys.argv[1]).with_suffix(suffix) for suffix in (".csv", ".cofmupy.json"))
with table.open("w", newline="", encoding="utf-8") as file:
    writer = csv.writer(file)
    writer.writerow(["t", *case["inputs"]])
    writer.writerows([n * case["step"], *row] for n, row in enumerate(case["rows"]))


def connection(name: str) -> dict[str, dict[str, str]]:
    """From a column of the table, held from row to row, to an input."""
    source = {"type": "csv", "path": str(table), "variable": name, "interpolation": "previous"}
    return {"source": source, "target": {"id": "x", "variable": name}}


fmus = [{"id": "x", "name": "x", "path": case["fmu"]}]
configuration.write_text(json.dumps({"fmus": fmus, "connections": list(map(connection, case["inputs"]))}))
coordinator = Coordinator()
coordinator.start(str(configuration))
for _ in case["rows"]:
    coordinator.do_step(case["step"])
print(json.dumps([float(coordinator.get_variable(("x", name))[-1]) for name in case["outputs"]]))
