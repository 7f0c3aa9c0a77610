"""What is done to a packing: how hard it is shaken, for how long, and when it is photographed (P 2.4.2)."""

from dataclasses import dataclass

from jostle_lab.errors import LabError, repeated, require


@dataclass(frozen=True)
class Interval:
    """One amplitude: relax unobserved, then record."""

    amplitude: float
    """A in (0, 1], the fraction of the full drive voltage."""
    relaxation: int
    """[s]."""
    recording: int
    """[s]."""


@dataclass(frozen=True)
class Protocol:
    """Settle at full drive, then one interval after the other."""

    settling: int
    """[s] at A = 1 before the first interval."""
    intervals: tuple[Interval, ...]

    def duration(self) -> int:
        """Simulated time [s]."""
        return self.settling + sum(i.relaxation + i.recording for i in self.intervals)


def thesis() -> Protocol:
    """5 min at A = 1; then 20 min each, 5 of them unobserved, A from 1 by 0.05 to 0.2 and by 0.01 to 0.05.

    That is 32 amplitudes, where the thesis says 37.
    """
    hundredths = [*range(100, 19, -5), *range(19, 4, -1)]
    return Protocol(300, tuple(Interval(n / 100.0, 300, 900) for n in hundredths))


def scaled_down(amplitudes: tuple[float, ...], seconds_per_amplitude: int) -> Protocol:
    """The thesis' protocol in small: the same fractions of relaxation (1/4) and settling (1/4 of an interval)."""
    require("seconds per amplitude [s]", seconds_per_amplitude, 8, 1200, "Choose 20 to 60 for a demonstration.")
    if not amplitudes:
        raise LabError("No amplitudes. Give decreasing fractions of the full drive, such as 1,0.5,0.2.")
    for amplitude in amplitudes:
        require("amplitude", amplitude, 1e-3, 1.0, "Amplitudes are fractions of the full drive.")
    if twice := repeated(amplitudes):
        raise LabError(f"amplitude {twice[0]:g} is given twice, and tables are found again by it. Give each once.")
    relaxation = seconds_per_amplitude // 4
    recording = seconds_per_amplitude - relaxation
    return Protocol(relaxation, tuple(Interval(a, relaxation, recording) for a in sorted(amplitudes, reverse=True)))
