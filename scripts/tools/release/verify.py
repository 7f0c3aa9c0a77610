"""Runs what scripts/release built as its users will: along its reference, in fmpy, and into a panic.

Every FMU follows its own reference trajectory to the last bit, by `jostle replay` and in fmpy, which knows nothing of
us; and a panic inside of a scene, which a small FMU made for tests provokes, stays in its instance.
"""

import multiprocessing
import re
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu

from jostle_lab.errors import LabError
from jostle_lab.fmu.instance import FmuInstance
from jostle_lab.programs import completed
from jostle_lab.tables import parse_csv
from tools.release.binaries import HOST

REFERENCE = re.compile(r"extra/[^/]+/reference\.csv")
"""Where an FMU keeps its reference trajectory: the folder has the name of the crate of the model."""

STEP = 1e-2
"""Communication step of the probe [s]."""

PANIC_TIME = 0.05
"""The probe panics in a step beyond this [s]."""


def verify(folder: Path, probes: list[Path]) -> list[str]:
    """Check every FMU in `folder` and the FMUs `probes` that panic on demand; what was done, a line each.

    Raises LabError at the first thing that is not as it should be.
    """
    done = []
    for two in sorted((folder / "fmu").glob("*.fmi2.fmu")):
        three = two.with_name(two.name.replace(".fmi2.", ".fmi3."))
        counts = []
        for fmu in (two, three):
            _replayed(folder / HOST / "jostle", fmu)
            problems = validate_fmu(str(fmu))
            _hold(not problems, f"fmpy's validator finds in {fmu}: {problems}")
            counts.append(_along_the_reference(fmu))
        compared = f"{counts[0]} outputs to the bit in fmpy" if counts[0] else "to the bit in jostle, run by fmpy"
        done.append(f"{two.name.removesuffix('.fmi2.fmu')}: {compared}, FMI 2.0 and 3.0")
    _hold(bool(done), f"there is no FMU in {folder / 'fmu'}. Run scripts/release")
    for probe in probes:
        in_a_child(_panic_stays_in_its_instance, probe)
        done.append(f"{probe.name}: a panic stayed in its instance, its neighbour went on, a reset healed it")
    return done


def _replayed(program: Path, fmu: Path) -> None:
    done = completed([program, "replay", "--exact", fmu])
    _hold(done.returncode == 0, f"{fmu} does not follow its own reference: {done.stderr.strip()}")


def _along_the_reference(fmu: Path) -> int:
    """Runs an FMU in fmpy with the inputs of its reference; how many outputs were as in the reference, to the bit."""
    with zipfile.ZipFile(fmu) as archive:
        name = next(name for name in archive.namelist() if REFERENCE.fullmatch(name))
        reference = parse_csv(archive.read(name).decode())
    description = read_model_description(str(fmu))
    inputs = [variable.name for variable in description.modelVariables if variable.causality == "input"]
    outputs = [name for name in reference if name not in ("time", *inputs)]
    columns = [reference["time"], *(reference[name] for name in inputs)]
    signals = np.rec.fromarrays(columns, dtype=[(name, float) for name in ("time", *inputs)]) if inputs else None
    time = reference["time"]
    try:
        simulated = simulate_fmu(
            str(fmu), stop_time=time[-1], output_interval=time[1] - time[0], input=signals, output=outputs
        )
    except FMICallException as error:
        raise LabError(f"{fmu} does not run in fmpy: {error}") from error
    _hold(len(simulated) == len(time), f"{fmu}: fmpy took {len(simulated)} points, the reference has {len(time)}")
    # fmpy takes equal steps. Where the points of the reference are rounded, its own differ in their last bits, and bits
    # can only be compared by `jostle replay`.
    if np.ptp(np.diff(time)) > 0.0:
        return 0
    for name in outputs:
        _hold(
            bool(np.array_equal(simulated[name], reference[name])),
            f"{fmu}: {name} in fmpy is not that of the reference",
        )
    return len(outputs)


def in_a_child(check: Callable[[Path], None], fmu: Path) -> None:
    """An uncaught panic aborts the process: it must be a process that reports it by its exit code alone."""
    child = multiprocessing.get_context("spawn").Process(target=check, args=(fmu,))
    child.start()
    child.join()
    _hold(child.exitcode == 0, f"{fmu}: a panic of the scene ended its process with exit code {child.exitcode}")


class _Probe(FmuInstance):
    """The FMU that panics on demand; all instances share one folder, and so one library."""

    scene = "probe"

    def advance(self, number: int, step: float = STEP) -> float:
        """Step from point `number`; the displacement at the end."""
        self.time = number * STEP
        self.do_step(step)
        return self.read("body.position[1]")

    def refuses(self, number: int, step: float) -> bool:
        """Whether a step is refused."""
        try:
            self.advance(number, step)
        except LabError:
            return True
        return False


def _panic_stays_in_its_instance(fmu: Path) -> None:
    never, panics = {"fault.panic_time": 1e9}, {"fault.panic_time": PANIC_TIME}
    with tempfile.TemporaryDirectory() as folder:
        directory = Path(extract(str(fmu), folder))
        with _Probe(fmu, never, directory=directory) as alone:
            expected = [alone.advance(n) for n in range(8)]
        with (
            _Probe(fmu, panics, directory=directory) as panicking,
            _Probe(fmu, never, directory=directory) as neighbour,
        ):
            before = [(panicking.advance(n), neighbour.advance(n)) for n in range(4)]
            _hold(before == [(value, value) for value in expected[:4]], f"{fmu}: runs differ before the panic")
            for _ in range(2):
                _hold(panicking.refuses(4, 3 * STEP), f"{fmu}: the step into the panic was not refused")
            after = [neighbour.advance(n) for n in range(4, 8)]
            _hold(after == expected[4:], f"{fmu}: a panic changed another instance")
            panicking.reset(never)
            again = [panicking.advance(n) for n in range(8)]
            _hold(again == expected, f"{fmu}: a reset does not heal a panic")


def _hold(condition: bool, otherwise: str) -> None:
    if not condition:
        raise LabError(otherwise)
