"""The model description of one case through classes that xsdata makes from the schema: `python read_strictly.py CASE`.

Elements and attributes that the schema does not know are refused, as are values that do not fit their type.
"""

import importlib
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
from xsdata.formats.dataclass.parsers import XmlParser
from xsdata.formats.dataclass.parsers.config import ParserConfig

case = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
folder, programs = Path(sys.argv[1]).parent, Path(sys.executable).parent
with zipfile.ZipFile(case["fmu"]) as archive:
    text = archive.read("modelDescription.xml")
version = "3" if b'fmiVersion="3.0"' in text else "2"
schema = Path(fmpy.__file__).parent / f"schema/fmi{version}/fmi{version}ModelDescription.xsd"
path = f"{programs}{os.pathsep}{os.environ['PATH']}"
command = [str(programs / "xsdata"), "generate", str(schema), "--package", f"strict{version}"]
# The files of FMI 2.0's schema include each other in a circle.
command += ["--structure-style", "single-package"]
made = subprocess.run(
    command, cwd=folder, capture_output=True, text=True, check=False, env={**os.environ, "PATH": path}
)
if made.returncode != 0:
    sys.exit((made.stdout + made.stderr).strip())
sys.path.insert(0, str(folder))
root = importlib.import_module(f"strict{version}").FmiModelDescription
strict = ParserConfig(fail_on_unknown_properties=True, fail_on_unknown_attributes=True, fail_on_converter_warnings=True)
XmlParser(config=strict).from_bytes(text, root)
print(json.dumps("read"))
