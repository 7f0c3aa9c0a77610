"""Where this source tree keeps what the tools read and write."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TARGET = ROOT / os.environ.get("CARGO_TARGET_DIR", "target")
"""Of cargo."""
BUILD = ROOT / "build"
"""FMUs of `scripts/setup`; `release` in it is that of `scripts/release`."""
GENERATED = ROOT / "docs" / "generated"
"""Pages that tools write, and their data."""
WORK_PRECISION, WORK_PRECISION_PAGE = GENERATED / "report", GENERATED / "report.md"
STABILITY, STABILITY_PAGE = GENERATED / "stability", GENERATED / "stability.md"
BASE_ON_INPUTS, BASE_ON_INPUTS_PAGE = GENERATED / "base-on-inputs", GENERATED / "base-on-inputs.md"
REAL_TIME, REAL_TIME_PAGE = GENERATED / "real-time", GENERATED / "real-time.md"
BINARIES, BINARIES_PAGE = GENERATED / "binaries", GENERATED / "binaries.md"
INSTRUCTION_COUNTS = GENERATED / "instruction_counts"
README_FILM = ROOT / "docs" / "packing.webp"
README_PICTURE = ROOT / "docs" / "packing.png"
MODEL_DESCRIPTIONS = ROOT / "modelDescription"
NOTICES = ROOT / "LICENSE-THIRD-PARTY.txt"
NOTEBOOKS = ROOT / "docs" / "notebooks"
