"""What ships computes sines and their kin itself: its bits depend neither on the C library nor on its choices."""

import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import RELEASE, built

ELEMENTARY = re.compile(r"(a?(sin|cos|tan)h?|sincos|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|fma)f?")
WITHOUT_FUSED = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F"
"""Lets glibc take the functions that it has for processors without fused operations, which round otherwise."""


@pytest.mark.parametrize(
    "library", ["libjostle_packing.so", "libjostle_three_disk.so", "libjostle_c.so", "lib_core.so"]
)
def test_libraries_need_no_function_of_the_c_library(library: str) -> None:
    words = ["nm", "--dynamic", "--undefined-only", str(built(RELEASE / library))]
    needed = subprocess.run(words, capture_output=True, text=True, check=True).stdout.split()
    assert "memcpy" in {name.partition("@")[0] for name in needed}
    assert [name for name in needed if ELEMENTARY.fullmatch(name.partition("@")[0])] == []


@pytest.mark.parametrize(
    "scene",
    [
        ("packing", "molecular-dynamics", "1"),
        ("packing", "event-driven", "1"),
        ("wedge", "event-driven", "20"),
        ("ratchet", "event-driven", "20"),
    ],
)
def test_other_functions_of_the_c_library_change_no_bit(
    jostle: Path, scene: tuple[str, str, str], tmp_path: Path
) -> None:
    files = []
    for tunables in ("", WITHOUT_FUSED):
        files.append(tmp_path / f"{len(files)}.csv")
        words = [
            jostle,
            "run",
            scene[0],
            "--engine",
            scene[1],
            "--seconds",
            scene[2],
            "--output",
            files[-1],
            "--no-progress",
        ]
        environment = {**os.environ, "GLIBC_TUNABLES": tunables}
        subprocess.run(list(map(str, words)), check=True, capture_output=True, env=environment)
    assert files[0].read_bytes() == files[1].read_bytes()
