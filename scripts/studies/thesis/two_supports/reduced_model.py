"""One disk on two supports, integrated here step by step, with a friction limit that follows the normal forces or not.

Small motions about the rest: the centre moves by (x, y) on two normal springs with dashpots, the disk turns on two
tangential springs whose force is held at mu n_i. With `constant` normal forces the limit is mu times the n_i of the
disk at rest (P 4.4, P 5); everything else stays. Parameters are those of P 5.1, SI units, all disks at once: arrays of
shape (disks,). The supports' noise is the exact Gaussian step of P 5.10 over a time step.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from jostle_lab.statistics.estimates import Numbers

MASS, GRAVITY, RADIUS, FRICTION = 0.1, 10.0, 1.0, 0.1
HALF_ANGLE = math.pi / 6.0
NORMAL, TANGENTIAL, DAMPING = 1e3, 1e6, 10.0
"""k_n, k_t [N/m], gamma_n [kg/s]."""
INERTIA = 0.5 * MASS * RADIUS**2
SUPPORT_FREQUENCY, SUPPORT_DAMPING = 20.0 * math.pi, 0.5
"""omega_b [1/s] and c of P 5.3.1."""
STEP = 5e-5
"""[s]: a third of a radian of the fastest mode."""


@dataclass(frozen=True)
class Excitation:
    """What drives the disk: a harmonic torque, or supports that vibrate randomly."""

    torque: float = 0.0
    """A_e [N m]."""
    torque_frequency: float = 1.0
    """omega_e [rad/s]."""
    supports: float = 0.0
    """A_b [m]; a negative number reverses every displacement of the same noise."""


def resting_forces(tilt: float) -> tuple[float, float]:
    """Normal forces at rest without tangential ones [N]."""
    weight = MASS * GRAVITY / math.sin(2.0 * HALF_ANGLE)
    return weight * math.sin(HALF_ANGLE + tilt), weight * math.sin(HALF_ANGLE - tilt)


def support_step(step: float) -> tuple[Numbers, Numbers]:
    """Matrix of x, v over a step of 5.10, and the Cholesky factor of the noise for unit rms displacement."""
    w, c = SUPPORT_FREQUENCY, SUPPORT_DAMPING
    drift = np.array([[0.0, 1.0], [-(w**2), -2.0 * c * w]])
    forward = expm(drift * step)
    stationary = np.diag([1.0, w**2])
    return forward, np.linalg.cholesky(stationary - forward @ stationary @ forward.T)


def turned(
    tilt: float, excitation: Excitation, constant: bool, seconds: float, settle: float, disks: int, seed: int
) -> Numbers:
    """Mean angular velocity of each disk after `settle` [rad/s]."""
    generator = np.random.default_rng(seed)
    angles = np.array([HALF_ANGLE - tilt, HALF_ANGLE + tilt])
    # Unit vectors from the contacts to the centre, and along them, counter-clockwise about the disk at the bottom.
    normal = np.array([[math.sin(angles[0]), math.cos(angles[0])], [-math.sin(angles[1]), math.cos(angles[1])]])
    along = np.array([[math.cos(angles[0]), -math.sin(angles[0])], [math.cos(angles[1]), math.sin(angles[1])]])
    rest = np.array(resting_forces(tilt))[:, None]
    place, speed = np.zeros((2, disks)), np.zeros((2, disks))
    angle, spin = np.zeros(disks), np.zeros(disks)
    stretch = np.zeros((2, disks))
    forward, noise = support_step(STEP)
    noise = noise * excitation.supports
    # Displacement and velocity of x, y and R angle of both supports: shape (2, 2, 3, disks).
    supports = np.zeros((2, 6, disks))
    if excitation.supports != 0.0:
        supports[0] = excitation.supports * generator.normal(size=(6, disks))
        supports[1] = excitation.supports * SUPPORT_FREQUENCY * generator.normal(size=(6, disks))
    begun = np.zeros(disks)
    count, first = round(seconds / STEP), round(settle / STEP)
    for n in range(count):
        if n == first:
            begun = angle.copy()
        if excitation.supports != 0.0:
            kicks = np.einsum("ij,jkd->ikd", noise, generator.normal(size=(2, 6, disks)))
            supports = np.einsum("ij,jkd->ikd", forward, supports) + kicks
        moved, moving = supports[0].reshape(2, 3, disks), supports[1].reshape(2, 3, disks)
        overlap = np.einsum("ij,ijd->id", normal, moved[:, :2]) - normal @ place
        closing = np.einsum("ij,ijd->id", normal, moving[:, :2]) - normal @ speed
        force = np.maximum(rest + NORMAL * overlap + DAMPING * closing, 0.0)
        slip = along @ speed - np.einsum("ij,ijd->id", along, moving[:, :2]) + RADIUS * spin + moving[:, 2]
        stretch = stretch + STEP * slip
        limit = FRICTION * (rest if constant else force) / TANGENTIAL
        stretch = np.clip(stretch, -limit, limit)
        tangential = -TANGENTIAL * stretch
        pull = normal.T @ (force - rest) + along.T @ tangential
        torque = excitation.torque * math.sin(excitation.torque_frequency * n * STEP)
        speed = speed + STEP * pull / MASS
        spin = spin + STEP * (RADIUS * tangential.sum(axis=0) + torque) / INERTIA
        place = place + STEP * speed
        angle = angle + STEP * spin
    return (angle - begun) / (seconds - settle)
