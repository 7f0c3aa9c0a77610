"""The model description of one case through fmureader (pydantic): `python read_fmureader.py CASE.json`."""

import json
import sys
from pathlib import Path

from fmureader.fmi import read_model_description

case = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
read = read_model_description(case["fmu"])
scalars = [name for name in case["inputs"] + case["outputs"] if "[" not in name]
missing = [name for name in scalars if f"{name!r}" not in repr(read)]
if missing:
    sys.exit(f"not among its variables: {missing}")
print(json.dumps("read"))
