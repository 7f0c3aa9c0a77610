"""One case through ecospy. Run by the interpreter of an environment that has it: `python run_ecos.py CASE.json`."""

import json
import sys
from pathlib import Path

from ecospy import EcosSimulation, EcosSimulationStructure

case = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
structure = EcosSimulationStructure()
structure.add_model("x", case["fmu"])
simulation = EcosSimulation(case["step"], structure=structure)
simulation.init()
for row in case["rows"]:
    for name, value in zip(case["inputs"], row, strict=True):
        simulation.set_real(f"x::{name}", value)
    simulation.step()
print(json.dumps([simulation.get_real(f"x::{name}") for name in case["outputs"]]))
