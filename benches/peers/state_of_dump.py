#!/usr/bin/env python3
"""Turn a LAMMPS dump of `in.vib` into a state: `./state_of_dump.py IN.dump OUT.txt`.

The dump has the columns id, radius, x, y, vx, vy, omegaz. The state has a line `count width height`, then a line
`radius x y vx vy omega` for each disk.
"""

import sys
from pathlib import Path


def state_of(dump: str) -> str:
    """The text of the state."""
    lines = dump.splitlines()
    count, width, height = int(lines[3]), float(lines[5].split()[1]), float(lines[6].split()[1])
    disks = [" ".join(line.split()[1:7]) for line in lines[9 : 9 + count]]
    return "\n".join([f"{count} {width} {height}", *disks]) + "\n"


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(state_of(Path(sys.argv[1]).read_text()))
