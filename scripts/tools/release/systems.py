"""Sizes and needs of the libraries that `scripts/release` built for systems other than this one."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from jostle_lab.errors import LabError
from jostle_lab.programs import output_of
from tools.release.binaries import OLDEST_GLIBC, Row, needs, title

COLUMNS = ("platform", "name", "bytes", "needs")
"""Of the rows of other systems."""


@dataclass(frozen=True)
class System:
    """What a library for a system may ask for, and how it was checked."""

    title: str
    suffix: str
    needs: Callable[[Path], list[str]]
    allowed: str
    """Pattern of the names that every system of this kind has."""
    oldest: str
    checked: str


def _of_linux(library: Path) -> list[str]:
    found = needs(library)
    if found.glibc > OLDEST_GLIBC:
        raise LabError(f"{library} needs glibc {found.version}. Build it with scripts/release")
    return sorted(found.libraries)


def _of_windows(library: Path) -> list[str]:
    text = output_of(["objdump", "-p", library])
    stamp = re.search(r"^Time/Date\s+(.*)$", text, re.MULTILINE)
    if stamp is None or "1970" not in stamp[1]:
        raise LabError(f"{library} holds the time of its build. Link it with --no-insert-timestamp")
    return sorted({name.lower() for name in re.findall(r"DLL Name: (\S+)", text)})


def _of_macos(library: Path) -> list[str]:
    text = output_of(["llvm-objdump", "--macho", "--dylibs-used", library])
    return sorted(re.findall(r"^\s+(\S+) \(compatibility", text, re.MULTILINE))


_WINDOWS = r"(kernel32|ntdll|msvcrt|ucrtbase|bcryptprimitives|api-ms-win-[a-z0-9-]+)\.dll"
_MACOS = r"/usr/lib/libSystem\.B\.dylib|@rpath/\S+"

SYSTEMS = {
    "aarch64-linux": System(
        "Linux on 64-bit Arm",
        ".so",
        _of_linux,
        r"(libc|libm|libpthread|libdl|ld-linux-aarch64)\.so\.\d+",
        "glibc 2.17",
        "run by qemu",
    ),
    "x86_64-windows": System("Windows on x86-64", ".dll", _of_windows, _WINDOWS, "Windows 10", "run by wine"),
    "aarch64-darwin": System("macOS on 64-bit Arm", ".dylib", _of_macos, _MACOS, "macOS 11", "linked, not run"),
    "x86_64-darwin": System("macOS on x86-64", ".dylib", _of_macos, _MACOS, "macOS 10.13", "linked, not run"),
}
"""By the names that FMI 3.0 has for them."""

BESIDES = r"(userenv|ws2_32|advapi32|bcrypt|shell32|ole32|user32)\.dll|/System/Library/Frameworks/\S+"
BESIDES += r"|/usr/lib/lib(iconv|charset)\S+"
"""Other parts of every such system, which the C library and the command line need: all of Rust's `std` is in them."""


def system_rows(folder: Path) -> list[Row]:
    """Rows of each system whose folder is in `folder`; raises LabError if a library asks for more than it may."""
    return [
        _row(platform, system, file)
        for platform, system in SYSTEMS.items()
        for file in sorted((folder / platform).glob("*"))
        if not file.is_symlink()
        and file.suffix != ".a"
        and (file.name.removesuffix(".exe") == "jostle" or system.suffix in file.suffixes)
    ]


def _row(platform: str, system: System, file: Path) -> Row:
    name = file.name.split(".")[0].removeprefix("lib")
    asked = [other for other in system.needs(file) if f"/{file.name}" not in other and other != "@rpath/fmu.dylib"]
    allowed = f"{system.allowed}|{BESIDES}" if name in ("jostle", "jostle_c") else system.allowed
    if foreign := [other for other in asked if not re.fullmatch(allowed, other)]:
        raise LabError(f"{file} needs {foreign}, which not every {system.title} has. Build it with scripts/release")
    return {"platform": platform, "name": title(name), "bytes": str(file.stat().st_size), "needs": " ".join(asked)}
