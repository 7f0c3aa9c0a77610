"""The three schedules of the demo: short, standard, and that of the thesis."""

from jostle_lab.protocol.intervals import scaled_down, thesis

AMPLITUDES = "1,0.7,0.5,0.35,0.25,0.18,0.12,0.08,0.05"
QUICK_AMPLITUDES = "1,0.5,0.35,0.18,0.1,0.06"
SECONDS, QUICK_SECONDS = 40, 12
"""For each amplitude, in simulated time."""


def numbers(text: str) -> tuple[float, ...]:
    """Of a list with commas; raises ValueError for anything else."""
    return tuple(float(part) for part in text.split(","))


STANDARD = scaled_down(numbers(AMPLITUDES), SECONDS)
QUICK = scaled_down(numbers(QUICK_AMPLITUDES), QUICK_SECONDS)
FULL = thesis()
