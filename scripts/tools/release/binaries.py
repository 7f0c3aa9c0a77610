"""What a shipped library asks of the machine, how large it is, and what is in it that its scene does not need."""

import re
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from zipfile import ZipFile

from fmpy import read_model_description

from jostle_lab.errors import LabError
from jostle_lab.programs import output_of
from tools.paths import MODEL_DESCRIPTIONS

OLDEST_GLIBC = (2, 17)
"""What anything that ships may need at most: what zig links against in scripts/release, of the year 2012."""

HOST = "x86_64-linux"
"""Folder of what runs on this machine, in that of a release."""

COLUMNS = (
    "name",
    "bytes",
    "fmi2_bytes",
    "fmi3_bytes",
    "variables",
    "glibc",
    "libraries",
    "native_bytes",
    "native_glibc",
    "native_libraries",
)
"""Of the rows of sizes and needs."""

Row = dict[str, str]

SYSTEM = frozenset({"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "ld-linux-x86-64.so.2"})
"""All parts of glibc; nothing else may be asked for."""

NEEDED = (
    ("jostle_packing_event_driven", ("engine::event_driven", "engine::dem::verlet", "scene::packing")),
    ("jostle_packing_located", ("engine::dem::event_located", "engine::dem::verlet", "scene::packing")),
    ("jostle_packing", ("engine::dem::verlet", "scene::packing")),
    ("jostle_ratchet", ("engine::event_driven", "scene::ratchet")),
    ("jostle_wedge_molecular_dynamics", ("engine::dem::verlet", "scene::wedge")),
    ("jostle_wedge", ("engine::wedge::DiskInWedge", "scene::wedge")),
    ("jostle_three_disk", ("engine::disk_on_two_supports", "scene::disk_on_two_supports")),
)
"""Modules and types of the crate jostle in a library, by the beginning of its name; the first that fits counts.
Disks of every packing settle at the start by velocity Verlet."""

MODULES = frozenset(module for _, modules in NEEDED for module in modules)
"""A library holds those of them that it needs and no other."""

NOWHERE = ("quick_xml::", "clap", "scene::catalogue", "toml", "fmi_bundle::")
"""Words that no FMU's library may have: the command line, the writing of FMUs, the table of all scenes."""

INPUTS = "FollowsInput"
"""Type that a library of a drive without inputs does not need, but for settling on a base at rest."""


@dataclass(frozen=True)
class Needs:
    """What the dynamic linker must find."""

    glibc: tuple[int, ...]
    libraries: frozenset[str]

    @property
    def version(self) -> str:
        """Version of glibc as people write it."""
        return ".".join(map(str, self.glibc))


def needs(library: Path) -> Needs:
    """Newest symbol version and libraries that `library` asks for."""
    versions = re.findall(r"GLIBC_([\d.]+)", output_of(["objdump", "-T", library]))
    asked = re.findall(r"NEEDED\s+(\S+)", output_of(["objdump", "-p", library]))
    return Needs(max(tuple(map(int, version.split("."))) for version in versions), frozenset(asked))


def strangers(library: Path) -> list[str]:
    """Symbols of an unstripped library that its scene does not need."""
    name = library.stem.removeprefix("lib")
    needed = next((modules for start, modules in NEEDED if name.startswith(start)), ())
    words = [*NOWHERE, *sorted(MODULES.difference(needed))]
    if not name.endswith("_input") and "scene::packing" not in needed and _has_twin(library):
        words.append(INPUTS)
    return [symbol for symbol in symbols(library) if any(word in symbol for word in words)]


def unknown(folder: Path) -> list[str]:
    """Words that neither the command line nor the C library in `folder` has, though they hold everything.

    A word that is not the name of a module any more would check nothing.
    """
    found = [*symbols(folder / "jostle"), *symbols(folder / "libjostle_c.so")]
    return [word for word in (*sorted(MODULES), *NOWHERE, INPUTS) if not any(word in symbol for symbol in found)]


def symbols(library: Path) -> list[str]:
    """Names of all functions and objects of an unstripped library, as paths of Rust."""
    lines = output_of(["nm", "--demangle", library]).splitlines()
    if len(lines) < 100:
        raise LabError(f"{library} has no symbol table. Build it with CARGO_PROFILE_SHIPPED_STRIP=none")
    return [line[19:] for line in lines]


def _has_twin(library: Path) -> bool:
    """Whether this is the library of a drive without inputs."""
    return library.stem.endswith("_sine") or library.stem in {"libjostle_wedge_map", "libjostle_wedge_event_driven"}


def scenes() -> dict[str, tuple[str, str, str]]:
    """Scene, engine and drive of each FMU library, by its name such as `jostle_wedge_map`."""
    found = {}
    for file in sorted(MODEL_DESCRIPTIONS.glob("*.fmi3.xml")):
        token = re.search(r'instantiationToken="jostle:([^:]+):([^:]+):([^:]+):', file.read_text(encoding="utf-8"))
        if token is None:
            raise LabError(f"{file} has no instantiation token of jostle's. Write it anew: see CONTRIBUTING.md")
        found[file.name.removesuffix(".fmi3.xml")] = (token[1], token[2], token[3])
    return found


LABORATORY = ("accelerometer", "camera", "gamma_controller", "loudspeaker", "spectral_amplitude")
"""Components of the shaker laboratory, as `jostle fmu` knows them; each library has the name after `jostle_`."""


def components() -> dict[str, tuple[str, list[str]]]:
    """Name of the files of the FMUs, and arguments of `jostle fmu`, of each library, by its name."""
    of_scenes = {
        identifier: (f"{scene}-{engine}-{drive}", [scene, "--engine", engine, "--drive", drive])
        for identifier, (scene, engine, drive) in scenes().items()
    }
    return of_scenes | {f"jostle_{name}": (name, [name]) for name in LABORATORY}


def bundle(folder: Path, program: Path) -> list[tuple[str, list[Path]]]:
    """Have `program` write an FMU of each version for every library of this machine in `folder`.

    The FMUs hold the libraries of all systems. Returns the name of each library, such as `jostle_wedge_map`, and its
    two FMUs in `folder/fmu`. Raises LabError if one is not written.
    """
    made = []
    out = folder / "fmu"
    out.mkdir(exist_ok=True)
    for identifier, (name, chosen) in components().items():
        if not (folder / HOST / f"lib{identifier}.so").is_file():  # --only
            continue
        files = [out / f"{name}.fmi{version}.fmu" for version in (2, 3)]
        for version, file in zip((2, 3), files, strict=True):
            options = ["--fmi", str(version), "--out", str(file), "--libraries", str(folder)]
            output_of([program, "fmu", *chosen, *options])
        made.append((identifier, files))
    return made


def release_rows(folder: Path, native: Path) -> list[Row]:
    """Bundles all FMUs of a release; their sizes and needs under Linux, beside those of a plain build in `native`.

    Raises LabError if something asks for more than it may.
    """
    rows = []
    own = folder / HOST
    for identifier, files in bundle(folder, own / "jostle"):
        row = _row(title(identifier), own / f"lib{identifier}.so", native)
        row["fmi2_bytes"], row["fmi3_bytes"] = (str(_size_for_this_system(file)) for file in files)
        row["variables"] = str(len(read_model_description(str(files[1])).modelVariables))
        rows.append(row)
    rows.append(_row(title("jostle_c"), own / "libjostle_c.so", native))
    rows.append(_row(title("jostle"), own / "jostle", native))
    return rows


def title(name: str) -> str:
    """What people call a library or program."""
    other = {"jostle_c": "C library", "jostle": "command line"}
    other |= {f"jostle_{component}": f"laboratory, {component.replace('_', ' ')}" for component in LABORATORY}
    return other[name] if name in other else ", ".join(scenes()[name])


def tools() -> list[Row]:
    """What the libraries are built with."""
    rust = output_of(["rustc", "--version"]).split()[1]
    packages = [{"tool": name, "version": metadata.version(name)} for name in ("cargo-zigbuild", "ziglang")]
    return [{"tool": "rustc", "version": rust}, *packages]


def _row(name: str, file: Path, native: Path) -> Row:
    found = needs(file)
    foreign = found.libraries - SYSTEM
    if found.glibc > OLDEST_GLIBC or foreign:
        raise LabError(f"{file} needs glibc {found.version} and {sorted(foreign)}. Build it with scripts/release")
    row = dict.fromkeys(COLUMNS, "")
    row |= {"name": name, "bytes": str(file.stat().st_size), "glibc": found.version, "libraries": _short(found)}
    twin = native / file.name
    if twin.is_file():
        plain = needs(twin)
        row |= {"native_bytes": str(twin.stat().st_size), "native_glibc": plain.version}
        row["native_libraries"] = _short(plain)
    return row


def _size_for_this_system(fmu: Path) -> int:
    """Bytes of an FMU without the libraries of other systems."""
    own = ("binaries/linux64/", f"binaries/{HOST}/")
    with ZipFile(fmu) as archive:
        members = archive.infolist()
    others = (
        entry for entry in members if entry.filename.startswith("binaries/") and not entry.filename.startswith(own)
    )
    return fmu.stat().st_size - sum(entry.compress_size for entry in others)


def _short(found: Needs) -> str:
    return " ".join(sorted(name.split(".")[0] for name in found.libraries if not name.startswith("ld-")))
