"""Where this source tree keeps what the tools read and write."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TARGET = ROOT / os.environ.get("CARGO_TARGET_DIR", "target")
"""Of cargo."""
BUILD = ROOT / "build"
"""FMUs of `scripts/setup`; `release` in it is that of `scripts/release`."""
DOCS = ROOT / "docs"
WORK_PRECISION, WORK_PRECISION_PAGE = DOCS / "report", DOCS / "report.md"
STABILITY, STABILITY_PAGE = DOCS / "stability", DOCS / "stability.md"
BINARIES, BINARIES_PAGE = DOCS / "binaries", DOCS / "binaries.md"
INSTRUCTION_COUNTS = DOCS / "leave_out"
MODEL_DESCRIPTIONS = ROOT / "modelDescription"
NOTICES = ROOT / "LICENSE-THIRD-PARTY.txt"
