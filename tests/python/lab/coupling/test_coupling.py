"""The orders of exchange with a lump whose motion is exact: stability limits, coupling error, true solution."""

import copy

import numpy as np
import pytest
from fake_grains import SpringLump
from scipy.integrate import solve_ivp

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.coupling.master import Coupling, Motion
from jostle_lab.errors import LabError
from jostle_lab.loudspeaker.model import Loudspeaker


def growth(exchange, step, **lump):
    """Spectral radius of one coupled step: the map of (i, x, v, lump, base, force) is linear without weight."""
    columns = []
    grains = SpringLump(**lump)
    grains.weight = 0.0
    coupling = Coupling(Loudspeaker(step), grains, exchange)
    at_start = coupling.loudspeaker.save()
    for unit in np.eye(9):
        coupling.loudspeaker.restore((unit[:3], *at_start[1:]))
        grains.lump, grains.base, coupling.reaction_force = unit[3:5].copy(), Motion(*unit[5:8]), unit[8]
        coupling.advance()
        state = coupling.loudspeaker.save()[0]
        columns.append([*state, *grains.lump, *grains.base, coupling.reaction_force])
    return np.abs(np.linalg.eigvals(np.array(columns).T)).max()


def stability_limit(exchange, **lump):
    """Largest step [s] up to which every smaller one of a fine scan is stable."""
    limit = 0.0
    for step in np.geomspace(2e-5, 1e-2, 50):
        if growth(exchange, step, **lump) > 1.0 + 1e-12:
            return limit
        limit = step
    return limit


@pytest.mark.parametrize(
    ("lump", "ratio"),
    [
        ({"mass": 0.28, "stiffness": 1e5, "damping": 1.0}, 7.0),
        ({"mass": 0.28, "stiffness": 1e6, "damping": 10.0}, 5.0),
        ({"mass": 100.0, "stiffness": 1e5, "damping": 1.0}, 5.0),
    ],
    ids=["packing on ten contacts", "stiff", "heavy"],
)
def test_grains_first_is_stable_to_several_times_the_step_of_jacobi(lump, ratio):
    limits = {exchange: stability_limit(exchange, **lump) for exchange in Exchange}
    print({exchange.value: f"{limit:.2e} s" for exchange, limit in limits.items()})
    assert limits[Exchange.GRAINS_FIRST] > ratio * limits[Exchange.JACOBI]
    assert limits[Exchange.ITERATED] > 1.5 * limits[Exchange.GRAINS_FIRST]


def shaken(exchange, rate, seconds=0.5):
    grains = SpringLump(stiffness=3e4, damping=20.0)
    speaker = Loudspeaker(1.0 / rate, grains_weight=grains.weight)
    speaker.voltage_amplitude = 10.0
    coupling = Coupling(speaker, grains, exchange)
    coupling.run(round(rate * seconds))
    return coupling


@pytest.mark.parametrize("exchange", list(Exchange))
def test_coupling_error_shrinks_with_the_step(exchange):
    errors = []
    for rate in (2400, 4800, 9600, 19200):
        coupling = shaken(exchange, rate)
        errors.append(abs(coupling.work_by_plate / coupling.grains.energy_input() - 1.0))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    print(exchange.value, [f"{e:.2e}" for e in errors], orders.round(2))
    assert orders[-1] > 0.9
    assert errors[-1] < 0.1


@pytest.mark.parametrize("exchange", list(Exchange))
def test_approaches_the_solution_of_the_joined_equations(exchange):
    def slope(t, s):
        i, x, v, y, w = s
        force = k * (y - x) + c * (w - v)
        u = 10.0 * np.sin(2.0 * np.pi * 80.0 * t)
        push = d.force_factor * i - d.suspension_damping * v - d.suspension_stiffness * x
        return [
            (u - d.coil_resistance * i - d.force_factor * v) / d.coil_inductance,
            v,
            (push + force) / mass,
            w,
            -force / m,
        ]

    reference = shaken(exchange, 2400)
    d, mass = reference.loudspeaker.driver, reference.loudspeaker.mass
    k, c, m = reference.grains.stiffness, reference.grains.damping, reference.grains.mass
    true = solve_ivp(slope, (0.0, 0.5), np.zeros(5), method="DOP853", rtol=1e-11, atol=1e-14).y[:, -1]
    errors = [abs(shaken(exchange, rate).loudspeaker.velocity / true[2] - 1.0) for rate in (4800, 19200, 76800)]
    print(exchange.value, [f"{e:.2e}" for e in errors])
    assert errors[2] < errors[1] < errors[0]
    assert errors[2] < 2e-3
    assert np.log(errors[1] / errors[2]) / np.log(4.0) == pytest.approx(exchange.order, abs=0.3)


@pytest.mark.parametrize("exchange", list(Exchange))
def test_base_of_the_grains_follows_the_loudspeaker_without_drift(exchange):
    for seconds in (0.5, 3.0):
        coupling = shaken(exchange, 4800, seconds)
        gap = coupling.grains.base[0] - coupling.loudspeaker.displacement
        # one step of acceleration at most: h^2 a / 2, a about 2 g here
        assert abs(gap) < 0.5 * 25.0 / 4800**2


def test_momentum_mean_force_is_minus_the_weight():
    coupling = shaken(Exchange.GRAINS_FIRST, 2400, 2.0)
    forces = []
    for _ in range(2400):
        coupling.advance()
        forces.append(coupling.reaction_force)
    assert np.mean(forces) == pytest.approx(-coupling.grains.weight, rel=1e-3)


def test_unstable_exchange_is_reported_with_the_remedy():
    with pytest.raises(LabError, match=r"jacobi exchange: the base is at .* smaller step \(now 0.000417 s\)"):
        Coupling(Loudspeaker(1.0 / 2400), SpringLump(), Exchange.JACOBI).run(24_000)


def test_iterated_lands_the_base_on_the_motion_of_the_loudspeaker_before_the_correction():
    grains = SpringLump(stiffness=3e4, damping=20.0)
    speaker = Loudspeaker(1.0 / 1600, grains_weight=grains.weight)
    speaker.voltage_amplitude = 10.0
    coupling = Coupling(speaker, grains, Exchange.ITERATED)
    coupling.run(100)
    first_pass = Coupling(copy.deepcopy(speaker), copy.deepcopy(grains), Exchange.GRAINS_FIRST)
    first_pass.reaction_force = coupling.reaction_force
    coupling.advance()
    first_pass.advance()
    np.testing.assert_allclose(grains.base, first_pass.motion(), rtol=1e-9)


@pytest.mark.parametrize("exchange", [Exchange.PLANNED, Exchange.ITERATED])
def test_an_exchange_that_leads_the_base_asks_for_grains_that_can_land(exchange):
    grains = SpringLump()
    grains.extrapolation_degree = -1
    with pytest.raises(LabError, match=r"needs grains with base\.extrapolation_degree = 2, not -1"):
        Coupling(Loudspeaker(1e-3), grains, exchange)


def test_iterated_saves_and_frees_one_state_a_step():
    class Counting(SpringLump):
        saved = freed = 0

        def save(self):
            self.saved += 1
            return super().save() | {"saved": self.saved}

        def restore(self, saved):
            super().restore({name: value for name, value in saved.items() if name not in {"saved", "freed"}})

        def discard(self, saved):
            self.freed += 1

    grains = Counting()
    coupling = Coupling(Loudspeaker(1e-4, grains_weight=grains.weight), grains, Exchange.ITERATED)
    coupling.run(10)
    assert (grains.saved, grains.freed, round(grains.time * 1e4)) == (10, 10, 10)
