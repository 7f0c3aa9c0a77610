"""`jostle system shaker`: an SSP archive by its schema, run by libcosim, against the same loop in Python."""

import json
import math
import subprocess
import sys
import zipfile
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from lxml import etree
from numpy.typing import NDArray

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling
from jostle_lab.demos.ratchet.controller import GammaController
from jostle_lab.fmu.packing import FmuGrains
from jostle_lab.loudspeaker import model
from jostle_lab.loudspeaker.model import Loudspeaker
from jostle_lab.sensors.accelerometer import STANDARD_GRAVITY, Accelerometer
from jostle_lab.sensors.spectral_amplitude import spectral_amplitude

RATE = 3200
STEP = 1.0 / RATE
NAMESPACES = {
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
}
# libcosim runs in a process of its own: what it logs or aborts for is no matter of the other tests.
LIBCOSIM = """
import json, sys
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver

log_output_level(CosimLogLevel.FATAL)
folder, steps, wanted = sys.argv[1], int(sys.argv[2]), json.loads(sys.argv[3])
execution = CosimExecution.from_ssp_file(folder)
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
slaves = [execution.slave_index_from_instance_name(element) for element, _ in wanted]
known = [{v.name.decode(): v.reference for v in execution.slave_variables(slave)} for slave in slaves]
columns = [(slave, [names[name]]) for slave, names, (_, name) in zip(slaves, known, wanted)]
rows = []
for _ in range(steps):
    if not execution.step():
        raise SystemExit("a step was refused")
    rows.append([observer.last_real_values(slave, references)[0] for slave, references in columns])
print(json.dumps(rows))
"""


@pytest.fixture(scope="module")
def archive(jostle: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("system") / "shaker.ssp"
    subprocess.run([jostle, "system", "shaker", "--out", out], check=True)
    return out


@pytest.fixture(scope="module")
def folder(archive: Path) -> Path:
    """The archive unpacked: libcosim reads folders."""
    folder = archive.with_suffix("")
    with zipfile.ZipFile(archive) as members:
        members.extractall(folder)
    return folder


@pytest.fixture(scope="module")
def structure(folder: Path) -> etree._Element:
    return etree.parse(folder / "SystemStructure.ssd").getroot()


def set_parameters(folder: Path, element: str, parameters: Mapping[str, float]) -> None:
    """Write real parameters of an element into its parameter set."""
    path = folder / "resources" / f"{element}.ssv"
    tree = etree.parse(path)
    (held,) = tree.getroot().findall("ssv:Parameters", NAMESPACES)
    for name, value in parameters.items():
        for old in held.findall(f"ssv:Parameter[@name='{name}']", NAMESPACES):
            held.remove(old)
        parameter = etree.SubElement(held, f"{{{NAMESPACES['ssv']}}}Parameter", name=name)
        etree.SubElement(parameter, f"{{{NAMESPACES['ssv']}}}Real", value=repr(value))
    tree.write(path, xml_declaration=True, encoding="UTF-8")


def in_libcosim(folder: Path, steps: int, wanted: list[tuple[str, str]]) -> NDArray[np.float64]:
    """Variables at the end of each step, shape (steps, variables)."""
    command = [sys.executable, "-c", LIBCOSIM, str(folder), str(steps), json.dumps(wanted)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr[-2000:]
    return np.array(json.loads(done.stdout.splitlines()[-1]))


def packing(folder: Path, parameters: Mapping[str, float]) -> FmuGrains:
    """The packing of the archive with the parameters of its parameter set."""
    common = {**Exchange.JACOBI.parameters, "seed": 1}
    return FmuGrains(folder / "resources/jostle_packing.fmu", {**common, **parameters})


@pytest.fixture(scope="module")
def weight(folder: Path) -> float:
    """Of the disks [N]."""
    with packing(folder, {}) as grains:
        return grains.weight


def test_the_archive_holds_each_fmu_once_and_follows_the_schemas(archive: Path, structure: etree._Element) -> None:
    package = find_spec("pyssp_standard")
    if package is None or package.origin is None:
        pytest.skip("the package pyssp_standard, which carries the schemas of SSP, is not installed")
    schemas = Path(package.origin).parent / "resources"
    with zipfile.ZipFile(archive) as members:
        names = members.namelist()
        assert len(names) == len(set(names)) and names[0] == "SystemStructure.ssd"
        assert sum(name.endswith(".fmu") for name in names) == 5
        for name in names:
            kind = {".ssd": "Description", ".ssv": "ParameterValues"}.get(Path(name).suffix)
            if kind is not None:
                schema = etree.XMLSchema(etree.parse(schemas / f"SystemStructure{kind}.xsd"))
                schema.assertValid(etree.fromstring(members.read(name)))


def test_what_is_connected_has_one_unit_and_lies_in_the_diagram(folder: Path, structure: etree._Element) -> None:
    components = {c.get("name"): c for c in structure.iterfind(".//ssd:Component", NAMESPACES)}
    assert set(components) == {
        "controller",
        "loudspeaker",
        "packing",
        "accelerometer_1",
        "accelerometer_2",
        "spectral_amplitude",
    }
    declared = {unit.get("name") for unit in structure.iterfind(".//ssd:Units/ssc:Unit", NAMESPACES)}
    connections = structure.findall(".//ssd:Connection", NAMESPACES)
    assert len(connections) == 10

    def end(connection: etree._Element, which: str) -> tuple[str | None, str | None]:
        component = components[connection.get(f"{which}Element")]
        connector = component.find(f"*/ssd:Connector[@name='{connection.get(f'{which}Connector')}']", NAMESPACES)
        assert connector.find("ssd:ConnectorGeometry", NAMESPACES) is not None
        return connector.get("kind"), connector.find("ssc:Real", NAMESPACES).get("unit")

    for connection in connections:
        (start, unit), (stop, same) = end(connection, "start"), end(connection, "end")
        assert (start, stop) == ("output", "input") and unit == same and unit in declared
    for component in components.values():
        assert (folder / component.get("source")).is_file()
        assert component.find("ssd:ElementGeometry", NAMESPACES) is not None


def test_libcosim_runs_the_loop_that_the_laboratory_runs(
    folder: Path, weight: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """libcosim steps all components from the outputs at t (Jacobi). So does the loop here."""
    # The laboratory rounds its matrix so that processors agree; here it is to be as exact as it can.
    monkeypatch.setattr(model, "DIGITS", 17)
    set_parameters(folder, "accelerometer_1", {"noise.density": 0.0})
    set_parameters(folder, "accelerometer_2", {"noise.density": 0.0})
    set_parameters(folder, "controller", {"gain": 0.3})
    wanted = [("loudspeaker", name) for name in ("displacement", "velocity", "acceleration")]
    wanted += [("controller", "voltage"), ("controller", "gamma"), ("accelerometer_2", "reading")]
    steps = 200
    found = in_libcosim(folder, steps, wanted)

    speaker = Loudspeaker(STEP, 80.0, weight)
    # The runner connects before the initialisation ends: the base starts with the acceleration of the loudspeaker.
    grains = packing(folder, {"base.acceleration_input": speaker.acceleration(0.0)})
    controller = GammaController(2.0, 10.0, 60.0, grains.gravity)
    sensor = Accelerometer(data_rate=RATE, resolution=0.0039, noise_density=0.0, gravity=grains.gravity)
    generator = np.random.default_rng(0)

    def reading(acceleration: float) -> float:
        return float(sensor.read(np.array([acceleration]), RATE, generator)[0])

    force, acceleration = 0.0, speaker.acceleration(0.0)
    measured = reading(acceleration)
    expected = np.empty_like(found)
    for n in range(steps):
        voltage, turns = controller.voltage, math.fmod(speaker.drive_turns + 1e-9, 1.0)
        controller.update(STANDARD_GRAVITY * measured, turns)
        measured = reading(acceleration)
        next_force = grains.step(speaker.displacement, speaker.velocity, acceleration, STEP)
        speaker.voltage_amplitude = voltage
        speaker.advance(force)
        acceleration = speaker.acceleration(force)
        force = next_force
        motion = speaker.displacement, speaker.velocity, acceleration
        expected[n] = *motion, controller.voltage, controller.measured, measured
    worst = np.max(np.abs(found - expected), axis=0) / np.max(np.abs(expected), axis=0)
    print("libcosim against Python, of the largest value:", worst)
    assert np.all(worst < 1e-7), worst


def test_libcosim_agrees_with_the_laboratory_within_the_error_of_the_exchange(folder: Path) -> None:
    """A constant voltage at which the disks stay on the base, so that errors do not grow by themselves."""
    volts, seconds, samples = 3.0, 0.25, 20
    set_parameters(folder, "controller", {"gain": 1e-6, "voltage.start": volts})
    found = in_libcosim(folder, round(seconds * RATE), [("loudspeaker", "displacement")])[:, 0]
    found = found[RATE // (80 * samples // 10) - 1 :: RATE // (80 * samples // 10)]

    def path(exchange: Exchange, rate: int) -> NDArray[np.float64]:
        with packing(folder, exchange.parameters) as grains:
            speaker = Loudspeaker(1.0 / rate, 80.0, grains.weight)
            speaker.voltage_amplitude = volts
            coupling, displacements = Coupling(speaker, grains, exchange), []
            # A runner knows no force before the first step: the packing says 0.
            coupling.reaction_force = 0.0
            for _ in range(round(seconds * rate)):
                coupling.advance()
                displacements.append(speaker.displacement)
        each = rate // (80 * samples // 10)
        return np.array(displacements)[each - 1 :: each]

    exact, ours = path(Exchange.ITERATED, 16 * RATE), path(Exchange.JACOBI, RATE)

    def error(values: NDArray[np.float64]) -> float:
        return float(np.sqrt(np.mean((values - exact) ** 2) / np.mean(exact**2)))

    print(f"error of the exchange: libcosim {error(found):.2e}, laboratory {error(ours):.2e} of the rms displacement")
    apart = float(np.sqrt(np.mean((found - ours) ** 2) / np.mean(exact**2)))
    print(f"apart by {apart:.2e}")
    assert error(ours) < 0.1
    assert apart < error(ours)
    assert error(found) < 1.5 * error(ours)


def test_the_spectral_amplitude_says_what_the_controller_holds(folder: Path) -> None:
    """Two seconds, the first record whole: Gamma 2, once in units of g = 9.8 m/s2, once of standard gravity."""
    set_parameters(folder, "controller", {"gain": 0.3, "voltage.start": 10.0})
    wanted = [("accelerometer_1", "reading"), ("spectral_amplitude", "amplitude"), ("controller", "gamma")]
    found = in_libcosim(folder, 2 * RATE, wanted)
    # A reading at t is out at t + h, and recorded at the next instant of the sensor.
    record = np.concatenate([[found[0, 0]], found[0::16, 0]])[:400]
    expected = spectral_amplitude(record, 200.0, 80.0).amplitude
    assert found[-1, 1] == pytest.approx(expected, rel=0.02)
    assert found[-400:, 2].mean() == pytest.approx(2.0, abs=0.05)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["fmu", "camera", "--disks", "5", "--out", "camera.fmu"], "--disks = 5 is not allowed"),
        (["describe", "loudspeaker", "--engine", "map"], "a component of the shaker laboratory"),
        (["system", "shaker", "--gamma", "-1", "--out", "shaker.ssp"], "--gamma = -1 is not allowed"),
        (["system", "shaker", "--disks", "0", "--out", "shaker.ssp"], "from 1 to"),
        (["system", "shaker", "--out", "shaker.zip"], "ends in .ssp"),
    ],
)
def test_what_cannot_be_written_is_refused_in_the_words_of_the_options(
    jostle: Path, tmp_path: Path, arguments: list[str], said: str
) -> None:
    done = subprocess.run([jostle, *arguments], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 2
    assert said in done.stderr
    assert list(tmp_path.iterdir()) == []
