"""Whatever is wrong is an exception that names the thing, its value, the allowed range and the remedy."""

import contextlib
import math
import pickle
import signal
import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import jostle

Call = Callable[[jostle.Simulation], Any]


def shaken() -> jostle.Simulation:
    return jostle.Simulation("packing", disks=5, **{"drive.amplitude": 1e-4})


@pytest.mark.parametrize(
    ("make", "kind", "words"),
    [
        (lambda: jostle.Simulation("sandpile"), jostle.ParameterError, ["sandpile", "packing", "Name one"]),
        (lambda: jostle.Simulation("packing", engine="map"), jostle.ParameterError, ["map", "event-driven"]),
        (lambda: jostle.Simulation("packing", drive="hammer"), jostle.ParameterError, ["hammer", "sine"]),
        (lambda: jostle.Simulation("packing", disks=0), jostle.ParameterError, ["disks = 0"]),
        (lambda: jostle.Simulation("packing", disks=-1), jostle.ParameterError, ["disks = -1", "a whole number"]),
        (lambda: jostle.Simulation("packing", disks=2.5), jostle.ParameterError, ["disks = 2.5", "whole number"]),
        (lambda: jostle.Simulation("packing", disks=10**12), jostle.ParameterError, ["disks = 1000000000000"]),
        (lambda: jostle.Simulation("packing", disks=np.array([20])), jostle.ParameterError, ["disks = array([20])"]),
        (lambda: jostle.Simulation(None), jostle.ParameterError, ["scene = None", "jostle.scenes()"]),
        (lambda: jostle.Simulation("\ud800"), jostle.ParameterError, ["scene = '\\ud800'"]),
        (lambda: jostle.Simulation("packing", engine=1), jostle.ParameterError, ["engine = 1"]),
        (lambda: jostle.Simulation("packing", **{"x" * 10**5: 1}), jostle.NoVariableError, ["xxx..."]),
        (lambda: jostle.Simulation("packing", **{"base.velocity": 1}), jostle.NoVariableError, ["drive='input'"]),
        (lambda: jostle.Simulation("packing", glue=1), jostle.NoVariableError, ["no variable 'glue'"]),
        (lambda: jostle.Simulation("packing", gravitiy=1), jostle.NoVariableError, ["gravitiy", "gravity"]),
        (lambda: jostle.Simulation("packing", seed=1.5), jostle.ParameterError, ["seed = 1.5", "whole number"]),
        (lambda: jostle.Simulation("packing", seed=-1), jostle.ParameterError, ["seed = -1", "0"]),
        (lambda: jostle.Simulation("packing", gravity="9,8"), jostle.ParameterError, ["gravity = 9,8", "number"]),
        (lambda: jostle.Simulation("packing", gravity=math.nan), jostle.ParameterError, ["gravity", "NaN"]),
        (lambda: jostle.Simulation("packing", gravity=[9.8]), jostle.ParameterError, ["gravity = [9.8]", "number"]),
        (lambda: jostle.Simulation("packing", contacts=1), jostle.JostleError, ["contacts", "computed"]),
        (lambda: jostle.Simulation("packing", **{"wall.motion": "fast"}), jostle.ParameterError, ["fast", "with_base"]),
    ],
)
def test_simulations_that_cannot_be(make: Callable[[], object], kind: type[Exception], words: list[str]) -> None:
    with pytest.raises(kind) as refusal:
        make()
    assert all(word in str(refusal.value) for word in words), refusal.value


@pytest.mark.parametrize(
    ("call", "kind", "words"),
    [
        (lambda sim: sim["disk.angel"], jostle.NoVariableError, ["disk.angel", "disk.angle"]),
        (lambda sim: sim["disk.angle[6]"], jostle.NoVariableError, ["disk.angle[6]", "disk.angle[5]"]),
        (lambda sim: sim["disk.angle[0]"], jostle.NoVariableError, ["disk.angle[1]"]),
        (
            lambda sim: sim.__setitem__("disk.surface_density", 3.7),
            jostle.CallError,
            ["disk.surface_density", "frozen"],
        ),
        (lambda sim: sim.__setitem__("contacts", 3), jostle.CallError, ["contacts", "computed"]),
        (lambda sim: sim[3], jostle.NoVariableError, ["no variable 3", "texts"]),
        (lambda sim: sim[["disk.x"]], jostle.NoVariableError, ["['disk.x']", "texts"]),
        (lambda sim: sim["time"], jostle.NoVariableError, ["attribute `time`"]),
        (lambda sim: setattr(sim, "gravity", 3.0), AttributeError, ["gravity"]),
        (lambda sim: sim.step("1"), jostle.ParameterError, ["step = '1'"]),
        (lambda sim: sim.step(None), jostle.ParameterError, ["step = None"]),
        (lambda sim: sim.step(10**400), jostle.ParameterError, ["step = 1000"]),
        (lambda sim: sim.run(None), jostle.ParameterError, ["seconds = None"]),
        (lambda sim: sim.run(1.0, every="x"), jostle.ParameterError, ["every = 'x'"]),
        (lambda sim: sim.run(1.0, outputs=3), jostle.ParameterError, ["outputs = 3"]),
        (lambda sim: sim.advance_to(None), jostle.ParameterError, ["time = None"]),
        (lambda sim: sim.limit_work(-1), jostle.ParameterError, ["most = -1", "from 1"]),
        (lambda sim: sim.limit_work(1.5), jostle.ParameterError, ["most = 1.5"]),
        (lambda sim: sim.restore(None), jostle.StateError, ["None is no state"]),
        (lambda sim: sim.restore(10**15), jostle.StateError, ["is no state"]),
        (lambda sim: sim.restore(sim), jostle.StateError, ["is no state"]),
        (lambda sim: sim.read("disk.x", np.empty(10)[::2]), jostle.ParameterError, ["contiguous"]),
        (iter, TypeError, ["not iterable"]),
        (lambda sim: sim.step(0.0), jostle.ParameterError, ["step = 0.0", "above 0"]),
        (lambda sim: sim.step(-1.0), jostle.ParameterError, ["step = -1.0"]),
        (lambda sim: sim.step(math.nan), jostle.ParameterError, ["step = nan"]),
        (lambda sim: sim.step(1e-3, nonsense=1.0), jostle.NoVariableError, ["nonsense"]),
        (lambda sim: sim.advance_to(0.0), jostle.ParameterError, ["end of the step", "after"]),
        (lambda sim: sim.run(0.0), jostle.ParameterError, ["seconds = 0.0"]),
        (lambda sim: sim.run(1.0, every=-1.0), jostle.ParameterError, ["every = -1.0"]),
        (lambda sim: sim.run(1.0, every=1e-12), jostle.ParameterError, ["every", "at most"]),
        (lambda sim: sim.run(1e4, every=1e-4), jostle.ParameterError, ["every", "at most", "in parts"]),
        (lambda sim: sim.run(1.0, outputs=["disk.spin"]), jostle.NoVariableError, ["disk.spin"]),
        (lambda sim: sim.run(1.0, outputs=["disk.angle[2]"]), jostle.ParameterError, ["disk.angle", "[:, 1]"]),
        (lambda sim: sim.read("gravity"), jostle.ParameterError, ["array of reals"]),
        (lambda sim: sim.read("disk.x", np.empty(4)), jostle.ParameterError, ["(4,)", "(5,)"]),
        (lambda sim: sim.read("disk.x", np.empty(5, np.float32)), jostle.ParameterError, ["float32", "float64"]),
        (lambda sim: sim.read("disk.x", [0.0] * 5), jostle.ParameterError, ["list", "float64"]),
        (lambda sim: sim.restore(b"nonsense"), jostle.StateError, ["state refused"]),
        (lambda sim: sim.restore(jostle.Simulation("wedge").to_bytes()), jostle.StateError, ["state refused"]),
        (lambda sim: sim.restore(jostle.Simulation("wedge").save()), jostle.StateError, ["another model"]),
    ],
)
def test_calls_that_are_refused_change_nothing(call: Call, kind: type[Exception], words: list[str]) -> None:
    sim = shaken()
    sim.step(0.1)
    before = sim.to_bytes()
    with pytest.raises(kind) as refusal:
        call(sim)
    assert all(word in str(refusal.value) for word in words), refusal.value
    assert sim.to_bytes() == before
    sim.step(0.1)


def test_inputs_are_set_all_or_none() -> None:
    sim = jostle.Simulation("packing", disks=5, drive="input")
    with pytest.raises(jostle.ParameterError, match=r"base\.velocity"):
        sim.step(1e-3, **{"base.displacement": 1e-3, "base.velocity": math.inf})
    assert sim["base.displacement"] == 0.0 and sim.time == 0.0
    sim.step(1e-3, **{"base.displacement": 1e-6})
    with pytest.raises(jostle.StepError):
        sim.step(1e-3, **{"base.displacement": 1e3})
    assert sim["base.displacement"] == 1e-6 and sim.time == 1e-3


def test_a_refused_step_keeps_what_was_sampled() -> None:
    sim = shaken()
    sim.limit_work(2000)
    with pytest.raises(jostle.StepError) as refusal:
        sim.run(100.0, every=50.0)
    assert refusal.value.partial.sizes["time"] == 1 and sim.time == 0.0 and "partial" in refusal.value.__notes__[0]


def test_a_run_that_another_thread_disturbs_keeps_what_was_sampled() -> None:
    sim = shaken()
    stopped: list[jostle.JostleError] = []

    def disturbed() -> None:
        try:
            sim.run(1e3, every=0.01, outputs=["disk.angle"])
        except jostle.JostleError as error:
            stopped.append(error)

    worker = threading.Thread(target=disturbed)
    worker.start()
    while sim.time == 0.0:
        pass
    while worker.is_alive():
        with contextlib.suppress(jostle.JostleError):
            sim.advance_to(sim.time + 0.003)
    assert stopped[0].partial["disk.angle"].sizes["time"] > 0


def test_an_interrupted_run_keeps_what_was_sampled() -> None:
    sim = shaken()
    threading.Timer(1.0, signal.raise_signal, (signal.SIGINT,)).start()
    with pytest.raises(KeyboardInterrupt) as interrupt:
        sim.run(2e3, every=0.01, outputs=["disk.angle"])
    partial = interrupt.value.partial  # type: ignore[attr-defined]
    assert partial["time"].values[-1] == sim.time > 0.0
    assert partial["disk.angle"].values[-1].tolist() == sim["disk.angle"].tolist()


def test_parts_of_a_refusal_are_attributes_and_are_pickled() -> None:
    with pytest.raises(jostle.ParameterError) as refusal:
        jostle.Simulation("packing", gravity=-1.0)
    error = pickle.loads(pickle.dumps(refusal.value))
    assert (error.name, str(error)) == ("gravity", str(refusal.value))
    assert error.value and error.allowed and error.remedy and isinstance(error, ValueError)


def test_what_is_doubtful_is_warned_of() -> None:
    equal = {f"disk.radius_{size}": 0.02 for size in ("small", "medium", "large")}
    with pytest.warns(jostle.JostleWarning, match="the seed decides nothing"):
        jostle.Simulation("packing", disks=5, **equal)
