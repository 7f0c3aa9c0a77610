"""Tables of exchanges and of controlled steps: reduced effort, with a lump in place of the grains."""

import pytest
from fake_grains import SpringLump, make_turning_lump

from jostle_lab.coupling.exchange import Exchange
from jostle_lab.demos.packing import held_loop, stepping


def cells(table):
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()[2:]]


def make_soft_lump(seed, extra=None):
    del seed, extra
    return SpringLump(stiffness=3e4, damping=20.0)


def test_the_controller_holds_gamma_at_any_rate():
    for rate in (640, 960, 2560):
        loop = held_loop.HeldLoop(make_turning_lump(1), Exchange.PLANNED, rate, 0.5)
        loop.run(rate)
        assert loop.controller.measured == pytest.approx(0.5, rel=0.01)


def test_order_and_longest_steps_of_every_exchange_are_a_table(monkeypatch):
    monkeypatch.setattr(held_loop, "RATES", (1280, 2560))
    monkeypatch.setattr(held_loop, "ORDER_RATES", (1280, 2560, 5120))
    monkeypatch.setattr(held_loop, "REFERENCE_RATE", 20_480)
    rows = cells(held_loop.table(make_soft_lump, 1))
    assert [row[0] for row in rows] == [exchange.value for exchange in Exchange]
    orders = {row[0]: float(row[-1]) for row in rows}
    assert 0.8 < orders["jacobi"] < 1.3
    assert all(orders[name] > 1.7 for name in ("grains-first", "planned", "iterated"))


def test_controlled_steps_stand_beside_fixed_ones(monkeypatch):
    monkeypatch.setattr(stepping, "RATES", (800, 3200))
    monkeypatch.setattr(stepping, "TOLERANCES", (1e-3, 1e-5))
    monkeypatch.setattr(stepping, "REFERENCE_RATE", 25_600)
    rows = cells(stepping.table(make_soft_lump))
    errors = [float(row[1]) for row in rows]
    assert errors[1] < errors[0] and errors[3] < errors[2] < 0.1
    assert [int(row[2]) for row in rows[:2]] == [80, 320]
    assert all(int(row[2]) == 3 * (int(row[6]) + int(row[7])) for row in rows[2:])
