"""Which instants are shown, and that nothing is invented between samples."""

import numpy as np
import pytest
from film.made import WEDGE, run_of, turning

from jostle_lab.film import FilmWarning
from jostle_lab.film.make import write_script
from jostle_lab.film.pace import down_to_nice, pace
from jostle_lab.film.recording import record


def moving(time: list[float], x: list[float], **attributes: object) -> object:
    """A disk of radius 0.02 m at these places."""
    here = np.array(x)[:, None]
    return run_of(WEDGE | attributes, time, here, 0.03 + 0.0 * here, 0.0 * here, [0.02])


def test_a_period_of_the_drive_takes_some_six_tenths_of_a_second() -> None:
    chosen = pace(record(turning()), None, None, None, 30.0)
    assert chosen.slow == 6.0  # 10 Hz
    assert chosen.frames == 73
    assert np.diff(chosen.times) == pytest.approx(1 / 180, rel=1e-9)


def test_long_runs_are_slowed_down_less() -> None:
    chosen = pace(record(turning(seconds=20.0, samples=3201)), None, None, None, 30.0)
    assert chosen.slow == 3.0  # a minute; 8 frames a period would be 2.7
    assert chosen.frames == 1801


def test_between_two_samples_a_disk_moves_on_a_line() -> None:
    run = record(moving([0.0, 0.01, 0.02], [0.0, 0.01, 0.015]))
    chosen = pace(run, 1.0, 0.005, 0.015, 200.0)
    assert [chosen.between(run.x, k)[0] for k in range(3)] == pytest.approx([0.005, 0.01, 0.0125])


def test_nothing_moves_across_a_jump_or_a_gap() -> None:
    far = record(moving([0.0, 0.01, 0.02, 0.03], [0.0, 0.03, 0.035, 0.04]))
    chosen = pace(far, 1.0, None, None, 200.0)
    assert [chosen.between(far.x, k)[0] for k in range(4)] == pytest.approx([0.0, 0.0, 0.03, 0.0325])
    gap = record(moving([0.0, 0.01, 0.02, 0.09], [0.0, 0.001, 0.002, 0.003]))
    chosen = pace(gap, 1.0, 0.02, None, 50.0)
    assert {chosen.between(gap.x, k)[0] for k in range(4)} == {0.002}


def test_a_turn_by_more_than_a_quarter_is_a_jump() -> None:
    run = record(turning(rate=200.0))
    chosen = pace(run, 1.0, None, None, 240.0)
    assert {float(chosen.between(run.angle, k)[0]) for k in range(10)} <= set(run.angle[:, 0])


def test_samples_too_far_apart_for_the_drive_are_told_with_the_remedy() -> None:
    coarse = turning(samples=21, seconds=1.0)
    with pytest.warns(FilmWarning, match=r"2 samples a period of the drive \(10 Hz\) .* every=0\.006") as told:
        script = write_script(coarse, contacts=False)
    assert len(told) == 1
    assert script.pace.stroboscopic
    shown = {float(script.frame(k).angles[0]) for k in range(script.pace.frames)}
    assert shown <= set(coarse["disk.angle"].values[:, 0])
    assert len(shown) == 21


def test_eight_samples_a_period_are_enough() -> None:
    assert not pace(record(turning(samples=33)), None, None, None, 30.0).stroboscopic


@pytest.mark.parametrize(("value", "nice"), [(7.57, 6.0), (48.0, 40.0), (1.0, 1.0), (0.019, 0.015), (99.0, 80.0)])
def test_slow_motion_is_a_round_number(value: float, nice: float) -> None:
    assert down_to_nice(value) == pytest.approx(nice)
