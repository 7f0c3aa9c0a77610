"""How well the base of an FMU follows sampled inputs: error of its motion, and energy against a sine of its own.

FMUs are written with `jostle fmu` into a temporary folder and run through fmpy, as an importer does it: inputs are set
at each communication point, then the step is done. `python -m tools base-on-inputs` measures and writes the page.
"""

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated

import joblib
import numpy as np
import typer
from numpy.typing import NDArray

from jostle_lab import locate
from jostle_lab.errors import LabError
from jostle_lab.fmu.instance import FmuInstance
from jostle_lab.programs import output_of
from jostle_lab.statistics.estimates import Estimate
from jostle_lab.tables import markdown_table, read_text_rows, write_table
from tools.paths import BASE_ON_INPUTS, BASE_ON_INPUTS_PAGE
from tools.processor import processor

FREQUENCY, GRAVITY = 80.0, 9.8
OMEGA = 2 * np.pi * FREQUENCY
INPUTS = ("base.displacement", "base.velocity", "base.acceleration_input")
OUTPUTS = ("base.position", "base.acceleration")
MOTION_SAMPLES, ENERGY_SAMPLES = (8, 16, 25, 100), (8, 16, 25, 50)
"""Communication steps a period."""
GAMMAS, SEEDS, SECONDS = (1.2, 2.0, 4.0), range(1, 11), 20.0
EARLIER = {8: (0.34, 5.7), 16: (9e-2, 5.9), 25: (3.8e-2, 6.0), 100: (2.4e-3, 6.0)}
"""Errors of position and acceleration of earlier builds, which predicted `displacement + h velocity`, on the sine."""

Row = dict[str, str]
Motion = Callable[[float], NDArray[np.float64]]


def _part(amplitude: float, frequency: float, time: float) -> NDArray[np.float64]:
    """Displacement, velocity and acceleration of one sine."""
    omega = 2 * np.pi * frequency
    phase = omega * time
    return amplitude * np.array([np.sin(phase), omega * np.cos(phase), -(omega**2) * np.sin(phase)])


def sine(time: float) -> NDArray[np.float64]:
    """Unit amplitude at 80 Hz."""
    return _part(1.0, FREQUENCY, time)


def three_sines(time: float) -> NDArray[np.float64]:
    """Sines of 80, 50 and 25 Hz that together stay below the acceleration of the first alone at unit amplitude."""
    parts = ((0.5, FREQUENCY), (0.3, 50.0), (0.4, 25.0))
    first, second, third = (_part(amplitude, frequency, time) for amplitude, frequency in parts)
    return first + second + third


def chirp(time: float) -> NDArray[np.float64]:
    """Unit amplitude from 40 to 80 Hz within 0.1 s."""
    bend = np.pi * FREQUENCY / 0.1
    phase, omega = (np.pi * FREQUENCY + 0.5 * bend * time) * time, np.pi * FREQUENCY + bend * time
    return np.array([np.sin(phase), omega * np.cos(phase), bend * np.cos(phase) - omega**2 * np.sin(phase)])


MOTIONS: dict[str, Motion] = {"sine": sine, "three sines": three_sines, "chirp": chirp}


def motion_rows(folder: Path) -> Iterator[Row]:
    """Largest errors at communication points after three periods, in both versions of FMI."""
    for version in (2, 3):
        for name, motion in MOTIONS.items():
            for values in (1, 2, 3):
                for samples in MOTION_SAMPLES:
                    path = folder / f"base_fmi{version}.fmu"
                    position, acceleration = _errors(path, motion, values, samples)
                    yield {
                        "fmi": f"{version}.0",
                        "motion": name,
                        "inputs": str(values),
                        "samples": str(samples),
                        "position": f"{position:.3g}",
                        "acceleration": f"{acceleration:.3g}",
                    }


def _errors(path: Path, motion: Motion, values: int, samples: int) -> tuple[float, float]:
    """Of position and acceleration over their amplitudes."""
    amplitude = 2.0 * GRAVITY / OMEGA**2
    step, worst = 1.0 / (FREQUENCY * samples), np.zeros(2)
    with FmuInstance(path) as grains:
        inputs, outputs = grains.group(INPUTS[:values]), grains.group(OUTPUTS)
        for number in range(8 * samples):
            inputs.values[:] = amplitude * motion(number * step)[:values]
            grains.write_group(inputs, "setting the base")
            grains.do_step(step)
            grains.time = (number + 1) * step
            if number > 3 * samples:
                exact = amplitude * motion(grains.time)[[0, 2]]
                worst = np.maximum(worst, np.abs(grains.read_group(outputs) - exact))
    return float(worst[0]) / amplitude, float(worst[1]) / (amplitude * OMEGA**2)


def dissipation(folder: Path, gamma: float, samples: int, seed: int) -> float:
    """Energy [J] that 60 disks lose within SECONDS; on the FMU with a sine of its own if `samples` is 0."""
    amplitude = gamma * GRAVITY / OMEGA**2
    settled = {"seed": seed, "initial.settled": 1}
    if samples == 0:
        with FmuInstance(
            folder / "sine.fmu", {**settled, "drive.amplitude": amplitude, "drive.frequency": 80.0}
        ) as grains:
            for number in range(1, round(SECONDS) + 1):
                grains.step_to(float(number))
            return grains.read("energy.lost")
    step = 1.0 / (FREQUENCY * samples)
    with FmuInstance(folder / "grains.fmu", {**settled, INPUTS[1]: amplitude * OMEGA}) as grains:
        inputs = grains.group(INPUTS[:2])
        for number in range(round(SECONDS / step)):
            inputs.values[:] = amplitude * sine(number * step)[:2]
            grains.write_group(inputs, "setting the base")
            grains.do_step(step)
            grains.time = (number + 1) * step
        return grains.read("energy.lost")


def energy_rows(folder: Path, jobs: int) -> list[Row]:
    """Dissipated energy over that of the sine FMU, mean of all seeds, with its standard error."""
    cases = [(gamma, samples) for gamma in GAMMAS for samples in (0, *ENERGY_SAMPLES)]
    work = [(gamma, samples, seed) for gamma, samples in cases for seed in SEEDS]
    lost = joblib.Parallel(n_jobs=jobs)(joblib.delayed(dissipation)(folder, *of) for of in work)
    table = dict(zip(work, map(float, lost), strict=True))
    rows = []
    for gamma, samples in cases:
        energies = np.array([table[gamma, samples, seed] for seed in SEEDS])
        own = np.array([table[gamma, 0, seed] for seed in SEEDS])
        ratio = energies.mean() / own.mean()
        # Of the same seeds: what differs from packing to packing cancels.
        difference = Estimate.over_runs(energies - ratio * own)
        rows.append(
            {
                "gamma": f"{gamma:g}",
                "samples": str(samples),
                "energy": f"{energies.mean():.6g}",
                "ratio": f"{ratio:.4f}",
                "error": f"{difference.error / own.mean():.2g}",
            }
        )
    return rows


def bundle(program: Path, folder: Path) -> None:
    """Writes the FMUs that are measured."""
    fmus = {
        "base_fmi2.fmu": ["--drive", "input", "--disks", "1", "--fmi", "2"],
        "base_fmi3.fmu": ["--drive", "input", "--disks", "1", "--fmi", "3"],
        "grains.fmu": ["--drive", "input", "--fmi", "3"],
        "sine.fmu": ["--drive", "sine", "--fmi", "3"],
    }
    for name, options in fmus.items():
        output_of([program, "fmu", "packing", *options, "--out", folder / name])


HEAD = """# Base on inputs

Written by `python -m tools base-on-inputs` from `docs/generated/base-on-inputs/*.csv`, which `--compute` measures on
the packing FMU through fmpy: inputs are set at each communication point, then the step is done. Between them the base
follows a quintic to where an extrapolation of the inputs leads ([how](../physics.md)).
"""
MOTION = """## Error of the motion

Largest error of `base.position` over the amplitude, in brackets that of `base.acceleration` over its amplitude, at
communication points after three periods. Sine: 80 Hz, Gamma = 2. Three sines: 80, 50 and 25 Hz. Chirp: 40 to 80 Hz
within 0.1 s. Samples are communication steps in a period of 80 Hz. Inputs: x is `base.displacement`, v `base.velocity`,
a `base.acceleration_input`. Earlier builds moved the base to x + h v; their errors on the sine are in the last
column.
"""
ENERGY = """## Dissipated energy

Energy that 60 disks lose in 20 s on sampled inputs x and v, over that on the FMU that moves as a sine by itself; mean
of ten seeds, with the standard error of the paired differences. Earlier builds: 1.35 at 8 samples a period, 1.1 at 16.
"""


def page(folder: Path) -> str:
    """The page as Markdown."""
    motion, energy = read_text_rows([folder / "motion.csv"]), read_text_rows([folder / "energy.csv"])
    processor = (folder / "processor.txt").read_text().strip()
    parts = [HEAD.rstrip(), f"Processor: {processor}.", MOTION.rstrip()]
    same = _of_version(motion, "2.0") == _of_version(motion, "3.0")
    parts.append(f"FMI 2.0 and FMI 3.0 give {'the same numbers' if same else 'different numbers; below is FMI 3.0'}.")
    rows = [row for row in motion if row["fmi"] == "3.0"]
    cells = {
        (row["motion"], row["samples"], row["inputs"]): f"{row['position']} ({row['acceleration']})" for row in rows
    }
    table = [
        [name, str(samples), *(cells[name, str(samples), str(values)] for values in (1, 2, 3)), _earlier(name, samples)]
        for name in MOTIONS
        for samples in MOTION_SAMPLES
    ]
    parts.append(markdown_table(["motion", "samples", "x", "x, v", "x, v, a", "x, v, earlier builds"], table))
    parts += [ENERGY.rstrip()]
    ratios = {(row["gamma"], row["samples"]): f"{row['ratio']} +- {row['error']}" for row in energy}
    lines = [[str(samples), *(ratios[f"{gamma:g}", str(samples)] for gamma in GAMMAS)] for samples in ENERGY_SAMPLES]
    parts.append(markdown_table(["samples", *(f"Gamma = {gamma:g}" for gamma in GAMMAS)], lines))
    return "\n\n".join(parts) + "\n"


def _of_version(rows: list[Row], version: str) -> list[Row]:
    return [{**row, "fmi": ""} for row in rows if row["fmi"] == version]


def _earlier(name: str, samples: int) -> str:
    if name != "sine":
        return ""
    position, acceleration = EARLIER[samples]
    return f"{position:g} ({acceleration:g})"


def base_on_inputs(
    compute: Annotated[bool, typer.Option(help="Measure anew; without it the page is written from the files.")] = False,
    program: Annotated[Path | None, typer.Option(help="The program `jostle`.")] = None,
    jobs: Annotated[int, typer.Option(min=1, max=1024, help="Runs at once.")] = 2,
    data: Annotated[Path, typer.Option(help="Folder of the measurements.")] = BASE_ON_INPUTS,
    out: Annotated[Path, typer.Option(help="Markdown page.")] = BASE_ON_INPUTS_PAGE,
) -> None:
    """Write the page of how well the base of an FMU follows sampled inputs."""
    if compute:
        data.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            bundle(locate.program(program), folder)
            write_table(data / "motion.csv", list(motion_rows(folder)))
            write_table(data / "energy.csv", energy_rows(folder, jobs))
        (data / "processor.txt").write_text(f"{processor()}\n")
    elif not (data / "motion.csv").is_file():
        raise LabError(f"{data} has no motion.csv. Measure first: python -m tools base-on-inputs --compute")
    out.write_text(page(data))
    typer.echo(out)
