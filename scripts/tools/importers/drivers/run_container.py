"""One case through a container FMU of fmu-manipulation-toolbox: `python run_container.py CASE.json`.

`fmucontainer` wraps the FMU in one of the same version of FMI, and fmpy runs that.
"""

import json
import subprocess
import sys
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

case = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
fmu, made = Path(case["fmu"]), Path(sys.argv[1]).with_suffix(".container.fmu")
ports = {
    "input": [[name, fmu.name, name] for name in case["inputs"]],
    "output": [[fmu.name, name, name] for name in case["outputs"]],
}
about = {"name": made.name, "fmu": [fmu.name], "step_size": case["step"], **ports}
flags = ("auto_input", "auto_output", "auto_link", "auto_local", "auto_parameter", "mt", "sequential")
description = made.with_suffix(".json")
description.write_text(json.dumps({**about, **dict.fromkeys(flags, False)}), encoding="utf-8")
version = read_model_description(str(fmu)).fmiVersion[0]
program = [str(Path(sys.executable).with_name("fmucontainer")), "-container", str(description)]
program += ["-fmu-directory", str(fmu.parent), "-fmi", version]
wrapped = subprocess.run(program, capture_output=True, text=True, check=False)
if wrapped.returncode != 0:
    sys.exit((wrapped.stdout + wrapped.stderr).strip())
if not made.exists():
    (fmu.parent / made.name).replace(made)
model = read_model_description(str(made))
reference = {variable.name: variable.valueReference for variable in model.modelVariables}
kind = {"2": FMU2Slave, "3": FMU3Slave}[version]
identifier = model.coSimulation.modelIdentifier
slave = kind(guid=model.guid, unzipDirectory=extract(str(made)), modelIdentifier=identifier, instanceName="x")
slave.instantiate()
if version == "2":
    slave.setupExperiment(startTime=0.0)
slave.enterInitializationMode()
slave.exitInitializationMode()
put, get = (slave.setReal, slave.getReal) if version == "2" else (slave.setFloat64, slave.getFloat64)
for n, row in enumerate(case["rows"]):
    if row:
        put([reference[name] for name in case["inputs"]], row)
    slave.doStep(n * case["step"], case["step"])
print(json.dumps(list(get([reference[name] for name in case["outputs"]]))))
