"""`jostle fmu --libraries`: the libraries of other systems are beside that of this one, which still runs."""

import struct
import subprocess
import zipfile
from pathlib import Path

import fmpy
import pytest

WINDOWS = struct.pack("<2s58xI4sHH12xHHH110x", b"MZ", 64, b"PE\0\0", 0x8664, 0, 112, 0x2022, 0x20B)
"""Header of a DLL for x86-64."""
ARM = struct.pack("<4s12B2HI3QI6H", b"\x7fELF", 2, 1, 1, *[0] * 9, 3, 183, 1, 0, 0, 0, 0, 64, 56, 0, 64, 0, 0)
"""Header of a shared library for Linux on 64-bit Arm."""


@pytest.fixture
def libraries(tmp_path: Path) -> Path:
    for name, header in [
        ("x86_64-windows/jostle_wedge_map.dll", WINDOWS),
        ("aarch64-linux/libjostle_wedge_map.so", ARM),
    ]:
        file = tmp_path / "libraries" / name
        file.parent.mkdir(parents=True)
        file.write_bytes(header)
    return tmp_path / "libraries"


@pytest.mark.parametrize(
    ("version", "folders", "note"),
    [
        (2, ["linux64", "win64"], "jostle: FMI 2.0 has no folder for aarch64-linux: its library is left out\n"),
        (3, ["aarch64-linux", "x86_64-linux", "x86_64-windows"], ""),
    ],
)
def test_all_libraries_with_a_folder_are_in_the_fmu(
    jostle: Path, libraries: Path, tmp_path: Path, version: int, folders: list[str], note: str
) -> None:
    fmu = tmp_path / "wedge.fmu"
    words = [jostle, "fmu", "wedge", "--engine", "map", "--fmi", str(version), "--libraries", libraries, "--out", fmu]
    done = subprocess.run(words, check=True, capture_output=True, text=True)
    assert done.stderr == note
    with zipfile.ZipFile(fmu) as archive:
        binaries = [entry for entry in archive.infolist() if entry.filename.startswith("binaries/")]
        page = archive.read("documentation/index.html").decode()
    assert sorted(entry.filename.split("/")[1] for entry in binaries) == folders
    assert all(entry.external_attr >> 16 & 0o777 == 0o755 for entry in binaries)
    assert page.count("x86_64-windows") == 1
    subprocess.run([jostle, "replay", "--exact", fmu], check=True, capture_output=True)
    assert len(fmpy.simulate_fmu(str(fmu), stop_time=0.1, output_interval=0.01)) == 11
