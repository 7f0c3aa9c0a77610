"""Sliding points of a disk on two supports: the balance of forces with saturated friction, and as printed in P 4.4.

Points are (departure, stretch) [rad] from tangential forces by P 4.17. Parameters are those of P 5.1: m = 0.1 kg,
g = 10 m/s^2, mu = 0.1, R = 1 m, k_t = 1e6 N/m, theta_0 = pi/6.
"""

import math

import numpy as np

from jostle_lab.statistics.estimates import Numbers
from studies.thesis.two_supports.runs import TANGENTIAL_STIFFNESS

MASS, GRAVITY, FRICTION, HALF_ANGLE, RADIUS = 0.1, 10.0, 0.1, math.pi / 6.0, 1.0
SIGNS = {"S1": (1, 1), "S2": (-1, -1), "T1": (-1, 1), "T2": (1, -1)}
"""Signs of tau_1 and tau_2, counter-clockwise positive."""


def plane(one: float, two: float) -> Numbers:
    """4.17: departure and stretch of two tangential forces [N]."""
    unit = 2.0 * TANGENTIAL_STIFFNESS * RADIUS
    return np.array([-(two + one) / unit, (two - one) / unit])


def saturated(tilt: float, x: float, y: float) -> dict[str, Numbers]:
    """Corners from 4.23 and 4.24 with tau_i = +-mu n_i; D_i: n_i and tau_i are zero. x, y: acceleration [m/s^2]."""
    one, two = HALF_ANGLE - tilt, HALF_ANGLE + tilt
    normal = np.array([[math.sin(one), -math.sin(two)], [math.cos(one), math.cos(two)]])
    tangential = np.array([[math.cos(one), math.cos(two)], [-math.sin(one), math.sin(two)]])
    load = MASS * np.array([x, GRAVITY + y])
    found = {}
    for name, signs in SIGNS.items():
        n = np.linalg.solve(normal + FRICTION * tangential * np.array(signs), load)
        found[name] = plane(FRICTION * signs[0] * n[0], FRICTION * signs[1] * n[1])
    for index, name in enumerate(("D1", "D2")):
        other = 1 - index
        _, tau = np.linalg.solve(np.column_stack([normal[:, other], tangential[:, other]]), load)
        found[name] = plane(tau, 0.0) if other == 0 else plane(0.0, tau)
    return found


def printed(name: str, tilt: float, x: float, y: float) -> Numbers:
    """The second lines of 4.41, 4.43, 4.47 and 4.49; 4.44 and 4.45."""
    mu, across, up = FRICTION, x / GRAVITY, y / GRAVITY
    sin0, cos0, sin, cos = math.sin(HALF_ANGLE), math.cos(HALF_ANGLE), math.sin(tilt), math.cos(tilt)
    unit = mu * MASS * GRAVITY / (2.0 * TANGENTIAL_STIFFNESS * RADIUS)
    slide = unit / (1.0 + mu**2)
    if name == "S1":
        a, b = 1.0 + mu * across + up, mu - across + mu * up
        return np.array([-slide / cos0 * (a * cos + b * sin), -slide / sin0 * (a * sin - b * cos)])
    if name == "S2":
        a, b = 1.0 - mu * across + up, mu + across + mu * up
        return np.array([slide / cos0 * (a * cos - b * sin), slide / sin0 * (a * sin + b * cos)])
    along, upright = across * cos + (1.0 + up) * sin, (1.0 + up) * cos - across * sin
    if name == "T1":
        return unit * np.array([along / (sin0 - mu * cos0), upright / (cos0 + mu * sin0)])
    if name == "T2":
        return -unit * np.array([along / (sin0 + mu * cos0), upright / (cos0 - mu * sin0)])
    one, two = HALF_ANGLE - tilt, HALF_ANGLE + tilt
    scale = RADIUS * TANGENTIAL_STIFFNESS
    if name == "D1":
        weight = MASS * (x * math.cos(two) + (GRAVITY + y) * math.sin(two)) / scale
        return np.array([-weight / 2.0, weight / 2.0])
    weight = MASS * (-x * math.cos(one) + (GRAVITY + y) * math.sin(one)) / scale
    return np.array([weight / 2.0, weight / 2.0])
