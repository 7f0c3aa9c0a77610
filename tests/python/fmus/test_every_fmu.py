"""Every FMU that the command line can write: valid, described as it is, and the same bits in both versions."""

import csv
import re
import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from conftest import PROGRAM
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu
from fmu_client import describe, getter, in_fmpy
from lxml import etree

from tools.release.binaries import scenes

TERMINALS = Path(fmpy.__file__).parent / "schema/fmi3/fmi3TerminalsAndIcons.xsd"

COMPONENTS = [
    ("packing", "molecular-dynamics", "input"),
    ("packing", "molecular-dynamics", "sine"),
    ("packing", "molecular-dynamics", "sine-fixed-bottom"),
    ("packing", "molecular-dynamics", "random-bottom"),
    ("packing", "molecular-dynamics-located", "input"),
    ("packing", "molecular-dynamics-located", "sine"),
    ("packing", "event-driven", "input"),
    ("packing", "event-driven", "sine"),
    ("wedge", "map", "sine"),
    ("wedge", "event-driven", "input"),
    ("wedge", "event-driven", "sine"),
    ("wedge", "molecular-dynamics", "input"),
    ("wedge", "molecular-dynamics", "sine"),
    ("ratchet", "event-driven", "input"),
    ("ratchet", "event-driven", "sine"),
    ("three_disk", "molecular-dynamics", "input"),
    ("three_disk", "molecular-dynamics", "harmonic-torque"),
    ("three_disk", "molecular-dynamics", "random-supports"),
    ("three_disk", "molecular-dynamics", "sine"),
]


def test_no_component_is_forgotten() -> None:
    assert sorted(COMPONENTS) == sorted(scenes().values())


@pytest.mark.parametrize(("scene", "engine", "drive"), COMPONENTS)
def test_valid_and_equal_in_both_versions(tmp_path: Path, scene: str, engine: str, drive: str) -> None:
    """Bundled, validated, replayed, run for 0.05 s; the outputs of FMI 2.0 and FMI 3.0 are equal to the bit.

    Later, hard disks on a base at rest collapse.
    """
    results = []
    for version in ("2", "3"):
        fmu = tmp_path / f"{scene}{version}.fmu"
        command = [PROGRAM, "fmu", scene, "--engine", engine, "--drive", drive]
        subprocess.run([*command, "--fmi", version, "--out", fmu], check=True)
        assert validate_fmu(str(fmu)) == []
        subprocess.run([PROGRAM, "replay", "--exact", fmu], check=True)
        start_values_are_those_of_the_instance(fmu, tmp_path / "unpacked")
        reset_equals_a_new_instance(fmu, tmp_path / "unpacked")
        terminals_fit_the_schema(fmu, scene, drive)
        icon_is_there_twice(fmu)
        outputs = ["disk.angle[1]", "base.reaction_force", "energy.kinetic", "energy.lost"]
        results.append(simulate_fmu(str(fmu), stop_time=0.05, output_interval=1 / 2048, output=outputs))
    two, three = results
    assert len(two) > 90
    for name in two.dtype.names:
        assert np.array_equal(two[name], three[name]), name


def start_values_are_those_of_the_instance(fmu: Path, unpacked: Path) -> None:
    """Every parameter and input reads as its start value before anything is set; a seed is 64 bits in FMI 3.0."""
    description, _ = describe(fmu)
    with in_fmpy(fmu, unpacked, initialized=False) as (slave, _):
        for variable in description.modelVariables:
            if variable.causality not in ("parameter", "input"):
                continue
            if variable.type in ("Real", "Float64"):
                (value,) = getter(slave)([variable.valueReference])
                assert value == float(variable.start), variable.name
            else:
                read = slave.getInteger if description.fmiVersion == "2.0" else slave.getInt64
                assert list(read([variable.valueReference])) == [int(variable.start)], variable.name
            if variable.name == "seed":
                assert variable.type == {"2.0": "Integer", "3.0": "Int64"}[description.fmiVersion]


def reset_equals_a_new_instance(fmu: Path, unpacked: Path) -> None:
    """Run, reset and run again gives the bits of the first run, with the parameters back at their start values."""
    description, _ = describe(fmu)
    outputs = [v.valueReference for v in description.modelVariables if v.causality in ("output", "calculatedParameter")]
    outputs = [reference for reference in outputs if reference]
    with in_fmpy(fmu, unpacked) as (slave, references):
        real = slave.setReal if description.fmiVersion == "2.0" else slave.setFloat64
        runs = []
        for _ in range(2):
            for n in range(5):
                slave.doStep(n * 0.01, 0.01)
            runs.append(list(getter(slave)(outputs)))
            slave.terminate()
            slave.reset()
            real([references["gravity"]], [3.0])
            slave.reset()
            if description.fmiVersion == "2.0":
                slave.setupExperiment(startTime=0.0)
            slave.enterInitializationMode()
            slave.exitInitializationMode()
    assert runs[0] == runs[1]


def terminals_fit_the_schema(fmu: Path, scene: str, drive: str) -> None:
    """The flange is a terminal where inputs drive the scene, of variables that there are."""
    with zipfile.ZipFile(fmu) as archive:
        document = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
        date = re.search(rb'generationDateAndTime="([^"]*)"', archive.read("modelDescription.xml"))
    assert date is not None
    assert re.fullmatch(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", date[1])
    etree.XMLSchema(etree.parse(TERMINALS)).assertValid(document)
    members = {element.get("variableName") for element in document.iter("TerminalMemberVariable")}
    _, references = describe(fmu)
    assert members <= set(references)
    base = {"base.displacement", "base.velocity", "base.reaction_force"}
    flange = {"torque", "torque.rate", "disk.angle[1]", "disk.angular_velocity[1]"} if scene == "three_disk" else base
    assert (flange <= members) == (drive == "input")
    assert drive == "input" or not members


def icon_is_there_twice(fmu: Path) -> None:
    """As PNG and, square as that is, as SVG."""
    with zipfile.ZipFile(fmu) as archive:
        assert archive.read("terminalsAndIcons/icon.png").startswith(b"\x89PNG")
        svg = etree.fromstring(archive.read("terminalsAndIcons/icon.svg"))
    assert svg.tag == "{http://www.w3.org/2000/svg}svg"
    assert svg.get("viewBox") == "0 0 128 128"
    assert len(svg.findall("{*}circle")) > 0


LAYERED = "extra/org.fmi-standard.fmi-ls-ref"
MANIFEST = "{http://fmi-standard.org/fmi-ls-manifest}"


@pytest.mark.parametrize("version", ["2", "3"])
@pytest.mark.parametrize(("scene", "drive"), [("packing", "input"), ("wedge", "sine"), ("three_disk", "input")])
def test_experiment_of_the_layered_standard(tmp_path: Path, scene: str, drive: str, version: str) -> None:
    """fmpy runs what the folder of FMI-LS-REF describes, from that alone, and gets the results that are in it."""
    fmu = tmp_path / "it.fmu"
    subprocess.run([PROGRAM, "fmu", scene, "--drive", drive, "--fmi", version, "--out", fmu], check=True)
    folder = Path(fmpy.extract(str(fmu), str(tmp_path / "unpacked"))) / LAYERED
    manifest = etree.parse(folder / "fmi-ls-manifest.xml").getroot()
    assert manifest.tag == "fmiReferences"
    assert manifest.get(f"{MANIFEST}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    related = {element.get("role"): folder / str(element.get("source")) for element in manifest.findall("Related")}
    assert all(path.is_file() for path in related.values())
    (experiment,) = etree.parse(related["experiment/smoke-test"]).getroot().findall("Experiment")
    times = {name: float(value) for name, value in experiment[0].items()}
    results = table(folder / experiment.find("References").get("source"))
    stimuli = experiment.find("Stimuli")
    assert (stimuli is not None) == (drive == "input")
    inputs = [] if stimuli is None else table(folder / stimuli.get("source")).dtype.names
    seen = simulate_fmu(
        str(fmu),
        start_time=times["startTime"],
        stop_time=times["stopTime"],
        step_size=times["stepSize"],
        output_interval=times["stepSize"],
        input=None if stimuli is None else table(folder / stimuli.get("source")),
        output=[name for name in results.dtype.names if name not in ("time", *inputs)],
    )
    assert len(seen) == len(results) > 15
    for name in seen.dtype.names:
        scale = np.abs(results[name]).max() + 1e-12
        assert np.abs(seen[name] - results[name]).max() < 1e-6 * scale, name


def table(path: Path) -> np.ndarray:
    """A CSV file with a row of names, as fmpy takes it."""
    with path.open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    types = np.dtype([(name, np.float64) for name in rows[0]])
    return np.array([tuple(map(float, row)) for row in rows[1:]], dtype=types)


def test_the_same_bytes_under_a_given_date(tmp_path: Path) -> None:
    """SOURCE_DATE_EPOCH is all that an FMU takes from its surroundings."""
    made = []
    for name in ("one.fmu", "two.fmu"):
        command = [PROGRAM, "fmu", "wedge", "--out", tmp_path / name]
        subprocess.run(command, env={"SOURCE_DATE_EPOCH": "1700000000"}, check=True)
        made.append((tmp_path / name).read_bytes())
    assert made[0] == made[1]
    description, _ = describe(tmp_path / "one.fmu")
    assert description.generationDateAndTime == "2023-11-14T22:13:20Z"
    refused = subprocess.run(command, env={"SOURCE_DATE_EPOCH": "soon"}, capture_output=True, text=True, check=False)
    assert refused.returncode == 2
    assert "SOURCE_DATE_EPOCH = soon" in refused.stderr


def test_replay_tells_a_wrong_reference(tmp_path: Path) -> None:
    """An angle that is off in its third digit is found, with its name and time; so is a file that is no FMU."""
    good, bad = tmp_path / "good.fmu", tmp_path / "bad.fmu"
    subprocess.run([PROGRAM, "fmu", "wedge", "--engine", "event-driven", "--out", good], check=True)
    with zipfile.ZipFile(good) as archive, zipfile.ZipFile(bad, "w") as altered:
        for member in archive.infolist():
            content = archive.read(member)
            if member.filename == "extra/jostle/reference.csv":
                lines = content.decode().splitlines()
                column = lines[0].split(",").index("disk.angle[1]")
                cells = lines[9].split(",")
                time, cells[column] = cells[0], repr(float(cells[column]) * 1.001 + 0.01)
                lines[9] = ",".join(cells)
                content = "\n".join(lines).encode()
            altered.writestr(member, content)
    refused = subprocess.run([PROGRAM, "replay", bad], capture_output=True, text=True, check=False)
    assert refused.returncode == 1
    assert "disk.angle[1] differs" in refused.stderr
    assert f"t = {time} s" in refused.stderr
    bad.write_text("nothing")
    refused = subprocess.run([PROGRAM, "replay", bad], capture_output=True, text=True, check=False)
    assert refused.returncode == 1
    assert "bad.fmu" in refused.stderr


@pytest.mark.parametrize("version", ["2", "3"])
def test_ratchet_runs_alike_in_and_out_of_a_component(tmp_path: Path, version: str) -> None:
    """`jostle run` and the FMU give the same bits at the same communication points, averages and all."""
    fmu, table = tmp_path / "ratchet.fmu", tmp_path / "run.csv"
    choice = ["ratchet", "--drive", "sine"]
    subprocess.run([PROGRAM, "fmu", *choice, "--fmi", version, "--out", fmu], check=True)
    run = [PROGRAM, "run", *choice, "--seconds", "2", "--sample", str(1 / 128), "--set", "measure.start=0.3"]
    subprocess.run([*run, "--output", table], check=True)
    with table.open(encoding="utf-8") as file:
        native = list(csv.DictReader(file))
    outputs = [name for name in native[0] if name != "time"]
    start_values = {"measure.start": 0.3}
    result = simulate_fmu(
        str(fmu), stop_time=2.0, step_size=1 / 128, output_interval=1 / 128, start_values=start_values, output=outputs
    )
    assert len(result) == len(native) == 257
    assert float(native[-1]["transport_velocity.standard_error"]) > 0.0
    for name in ["time", *outputs]:
        assert np.array_equal(result[name], [float(row[name]) for row in native]), name
