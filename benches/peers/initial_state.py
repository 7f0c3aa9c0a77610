#!/usr/bin/env python3
"""Write a loose packing for LAMMPS: `./initial_state.py DISKS OUT.data`.

Thirds of the disks have radii of 1.5, 2.0 and 2.5 cm, in an order that a fixed generator shuffles. They stand on a
square lattice, each up to half a millimetre off its column. The box is 0.4 m sqrt(DISKS / 60) wide.
"""

import math
import sys
from collections.abc import Iterator
from pathlib import Path

RADII = (0.015, 0.020, 0.025)
SURFACE_DENSITY = 3.57
"""kg/m2; LAMMPS takes it from `set group all density/disc`, not from this column."""
PITCH = 0.0515
"""Distance of two lattice points [m], more than two of the largest radii."""


def random_numbers() -> Iterator[float]:
    """Linear congruential numbers from 0 to 1."""
    state = 12345
    while True:
        state = (1103515245 * state + 12345) & 0x7FFFFFFF
        yield state / 0x7FFFFFFF


def data_file(disks: int) -> str:
    """The text of the data file: `atom_style sphere` in two dimensions."""
    random = random_numbers()
    width = 0.4 * math.sqrt(disks / 60.0)
    radii = [RADII[i % 3] for i in range(disks)]
    for i in range(disks - 1, 0, -1):
        j = int(next(random) * (i + 1))
        radii[i], radii[j] = radii[j], radii[i]
    columns = int((width - 0.001) // PITCH)
    first = (width - columns * PITCH) / 2 + PITCH / 2
    height = (disks // columns + 3) * PITCH + 0.3
    lines = ["init", "", f"{disks} atoms", f"{len(RADII)} atom types", "", f"0.0 {width:.10f} xlo xhi"]
    lines += [f"-0.05 {height:.10f} ylo yhi", "-0.5 0.5 zlo zhi", "", "Atoms # sphere", ""]
    for i, radius in enumerate(radii):
        x = first + (i % columns) * PITCH + (next(random) - 0.5) * 0.001
        y = 0.03 + (i // columns) * PITCH
        lines.append(f"{i + 1} {RADII.index(radius) + 1} {2 * radius} {SURFACE_DENSITY} {x:.10f} {y:.10f} 0.0")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(data_file(int(sys.argv[1])))
