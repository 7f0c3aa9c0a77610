"""The programs of README.md, run as they stand there: same motion, same bits, and a force that is the weight."""

import math
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
from conftest import PROGRAM, RELEASE, ROOT

README = (ROOT / "README.md").read_text()
WEIGHT = 3.57 * math.pi * 20 * (0.015**2 + 0.020**2 + 0.025**2) * 9.8


def block(marker: str) -> str:
    """The one fenced block whose opening line is ```marker."""
    found = re.findall(rf"^```{re.escape(marker)}\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)
    assert len(found) == 1, f"README.md has {len(found)} blocks ```{marker}, not one"
    return found[0]


def run(*command: str) -> str:
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command[0]} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return done.stdout


def python(program: str) -> str:
    return run(sys.executable, "-c", program)


def shell(marker: str) -> str:
    return run("bash", "-euo", "pipefail", "-c", block(marker))


@dataclass(frozen=True)
class Printed:
    angle: float
    force: float


def printed(output: str) -> Printed:
    found = re.search(r"^angle of disk 1: (\S+) rad\nmean force on the base: (\S+) N$", output, re.MULTILINE)
    assert found, f"printed something else:\n{output}"
    return Printed(float(found[1]), float(found[2]))


def check(output: str, reference: Printed) -> None:
    """To the last bit; but each host adds the forces up in its own order."""
    seen = printed(output)
    assert seen.angle == reference.angle
    assert seen.force == pytest.approx(reference.force, rel=1e-12)


@pytest.fixture(scope="module")
def reference(fmu3: Path) -> Printed:
    """What fmpy prints with the FMI 3.0 FMU."""
    assert fmu3.is_file()
    return printed(python(block("python fmpy")))


def test_force_is_minus_the_weight_and_disks_turn(reference: Printed):
    assert reference.force == pytest.approx(-WEIGHT, rel=0.01)
    assert f"weight of the grains, {WEIGHT:.3f} N," in README.replace("\n", " ")
    assert 0.01 < abs(reference.angle) < 100.0


def test_fmpy_prints_the_same_with_the_other_version(fmu2: Path, reference: Printed):
    program = block("python fmpy").replace('"build/packing.fmu"', f'"build/{fmu2.name}"')
    assert program != block("python fmpy")
    check(python(program), reference)


def test_libcosim(fmu2: Path, reference: Printed):
    assert f"build/{fmu2.name}" in block("python libcosim")
    check(python(block("python libcosim")), reference)


def test_c(reference: Printed):
    (ROOT / "build" / "shake.c").write_text(block("c"))
    check(shell("sh c"), reference)


def test_c_library(reference: Printed):
    assert (ROOT / "capi" / "examples" / "shaken_packing.c").read_text() == block("c library")
    program = block("sh c library").replace("target/release", str(RELEASE))
    check(run("bash", "-euo", "pipefail", "-c", program), reference)


def test_c_library_from_toml():
    program = f"""#include <stdio.h>
#include "jostle.h"
int main(void) {{
    char error[1024] = "";
    double angle = 0;
    {block("c toml")}
    if (!wedge || jostle_advance_to(wedge, 1) || jostle_get_by_name(wedge, "disk.angle[1]", &angle)) {{
        fprintf(stderr, "%s\\n", error);
        return 1;
    }}
    printf("%g\\n", angle);
    jostle_free(wedge);
    return 0;
}}
"""
    (ROOT / "build" / "toml.c").write_text(program)
    library = RELEASE / "libjostle_c.a"
    warnings = ["-Wall", "-Wextra", "-Werror"]
    run("cc", "-std=c11", *warnings, "-I", "include", "build/toml.c", "-o", "build/toml", str(library), "-lm")
    assert abs(float(run("build/toml"))) > 0.0


def test_rust(reference: Printed):
    assert (ROOT / "examples" / "shaken_packing.rs").read_text() == block("rust")
    check(shell("sh rust"), reference)


def test_command_line():
    program = block("sh command-line").replace("target/release/jostle", str(PROGRAM))
    output = run("bash", "-euo", "pipefail", "-c", program)
    assert "base.displacement" in output
    assert len((ROOT / "build" / "run.csv").read_text().splitlines()) == 1002
    for name in ("packing_200.fmu", "packing_sine.fmu"):
        assert (ROOT / "build" / name).stat().st_size > 100_000


def test_links_lead_somewhere():
    targets = [target for target in re.findall(r"\]\(([^)]+)\)", README) if not target.startswith("https:")]
    assert targets
    assert [target for target in targets if not (ROOT / target).is_file()] == []
    assert (ROOT / "docs" / "packing.png").stat().st_size < 300 * 1024
