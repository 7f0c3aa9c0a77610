"""The checks of fmutool on the FMU of one case: `python check_fmutool.py CASE.json`. Fails with what it found."""

import json
import subprocess
import sys
from pathlib import Path

case = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
program = [str(Path(sys.executable).with_name("fmutool")), "-input", case["fmu"], "-check"]
done = subprocess.run(program, capture_output=True, text=True, check=True)
said = done.stdout + done.stderr
if "seems to be compliant" not in said or "No semantic error" not in said or "ERROR" in said:
    sys.exit(said)
print(json.dumps("nothing found"))
