"""The function whose results joblib keeps. It stands alone, and should stay as it is.

Joblib throws away all that it has kept of a function when it finds the text of the function changed, or moved to
another line while a process runs.
"""

import tempfile
from pathlib import Path

from jostle_lab.errors import LabError
from jostle_lab.programs import timed
from jostle_lab.tables import Table, parse_csv


def perform(program: Path, version: str, arguments: list[str]) -> tuple[Table, float]:
    """Table of a run and its processor time [s]; `version` is there for joblib: another program, another run."""
    del version
    with tempfile.TemporaryDirectory(prefix="jostle-") as folder:
        output, messages = Path(folder) / "run.csv", Path(folder) / "messages"
        words = [str(program), *arguments, "--output", str(output)]
        ended = timed(words, messages)
        if ended.code != 0:
            raise LabError(f"{' '.join(words)} failed:\n{messages.read_text(errors='replace').strip()}")
        return parse_csv(output.read_text()), ended.processor_seconds
