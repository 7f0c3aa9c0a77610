"""The map of P 6.3 written anew, all disks at once: a check of the program, and trials of what P may have left out.

Lengths, times and velocities are in units of A omega_b and g, as in P 6.3.2; R omega stands for the angular velocity.
Arrays have shape (disks,). The collision law is integrated here too, not taken from the program.
"""

import math
from dataclasses import dataclass

import numpy as np

from jostle_lab.statistics.estimates import Estimate, Numbers

RESTITUTION, STIFFNESS_RATIO, THETA_0 = 0.9, 0.773, math.pi / 6.0
DAMPING_RATIO = 0.034265
"""c that gives e_n = 0.9 by P 4.55."""
CONTACT_STEP = 2e-3
"""Over the time sqrt(m / k_n)."""
HALVINGS, REDRAWS = 14, 6
WARM = 0.3
"""Part of the collisions that is left out at the start."""


@dataclass(frozen=True)
class Variant:
    """One friction, tilt and reading of the map."""

    friction: float
    tilt: float
    """[degrees]."""
    sideways: bool = True
    """Whether a wall that moves up has a velocity along itself, which enters u_t."""
    stiffness_ratio: float = STIFFNESS_RATIO
    """kappa; infinite: e_t = max(0, 1 - 3 mu (1 + e_n) |u_n / u_t|)."""


def tangential_law(friction: float, ratio: float) -> tuple[Numbers, Numbers]:
    """|u_t / u_n| before an impact, and u_t / |u_n| after it, of a disk on springs (P 4.5)."""
    before = np.linspace(0.0, 1.0 + 14.0 * friction / min(ratio, 1.0), 600)
    slip, stretch = before.copy(), np.zeros_like(before)
    overlap, closing = 0.0, 1.0
    while (force := overlap + 2.0 * DAMPING_RATIO * closing) > 0.0:
        most = friction * force / ratio
        stretch = np.clip(stretch + CONTACT_STEP * slip, -most, most)
        slip = slip - CONTACT_STEP * 3.0 * ratio * stretch
        closing -= CONTACT_STEP * force
        overlap += CONTACT_STEP * closing
    return before, slip


def phases(approach: Numbers, generator: np.random.Generator) -> Numbers:
    """Phase at which a ray that falls with `approach` first meets the base, of rays that come at random (P 2.3.3)."""
    grazing = np.where(approach < 1.0, math.pi - np.arccos(np.minimum(approach, 1.0)), math.pi)
    latest = np.sin(grazing) + approach * grazing
    ray = latest - generator.random(approach.shape) * math.tau * approach
    low, high = -grazing, grazing
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        early = np.sin(middle) + approach * middle < ray
        low, high = np.where(early, middle, low), np.where(early, high, middle)
    return np.asarray(0.5 * (low + high))


def wall_velocity(normal: Numbers, upright: Numbers, generator: np.random.Generator) -> Numbers:
    """Vertical velocity of the wall; drawn again while the disk would not leave the wall."""
    found, again = np.zeros_like(normal), np.ones(normal.shape, dtype=bool)
    for _ in range(REDRAWS):
        if not again.any():
            break
        drawn = np.cos(phases(-normal / upright, generator))
        found = np.where(again, drawn, found)
        again &= -RESTITUTION * normal + (1.0 + RESTITUTION) * found * upright <= 0.0
    return np.where(again, 0.0, found)


def scaled_velocity(variant: Variant, disks: int, collisions: int, seed: int) -> Estimate:
    """R omega / (A omega_b): mean over time (P 6.1), its error from disk to disk."""
    generator = np.random.default_rng(seed)
    tilt, every = math.radians(variant.tilt), np.arange(disks)
    slopes = np.array([tilt - THETA_0, tilt + THETA_0])
    normals, alongs = np.stack([-np.sin(slopes), np.cos(slopes)], 1), np.stack([np.cos(slopes), np.sin(slopes)], 1)
    law = None if math.isinf(variant.stiffness_ratio) else tangential_law(variant.friction, variant.stiffness_ratio)
    place = np.stack([np.zeros(disks), np.ones(disks)])
    velocity, spin = generator.normal(0.0, 0.5, (2, disks)), np.zeros(disks)
    turned, passed, touched = np.zeros(disks), np.zeros(disks), np.full(disks, -1)
    for number in range(collisions):
        leaving, away = normals @ velocity, np.maximum(normals @ place, 0.0)
        away[touched[touched >= 0], every[touched >= 0]] = 0.0
        fall = normals[:, 1:]
        times = (leaving + np.sqrt(leaving**2 + 2.0 * fall * away)) / fall
        touched = np.argmin(times, axis=0)
        flight = times[touched, every]
        place = place + velocity * flight
        place[1] -= 0.5 * flight**2
        velocity[1] -= flight
        if number >= WARM * collisions:
            turned += spin * flight
            passed += flight
        normal, along = normals[touched].T, alongs[touched].T
        approach = np.minimum(np.sum(normal * velocity, axis=0), -1e-9)
        tangential = np.sum(along * velocity, axis=0)
        base = wall_velocity(approach, normal[1], generator)
        impact = np.abs(approach - base * normal[1])
        slip = tangential + spin - (base * along[1] if variant.sideways else 0.0)
        change = _after(slip, impact, variant.friction, law) - slip
        spin = spin + 2.0 * change / 3.0
        left = -RESTITUTION * approach + (1.0 + RESTITUTION) * base * normal[1]
        velocity = normal * left + along * (tangential + change / 3.0)
    return Estimate.over_runs(turned / passed)


def _after(slip: Numbers, impact: Numbers, friction: float, law: tuple[Numbers, Numbers] | None) -> Numbers:
    """u_t after an impact: sliding to the end, or by the law where that is known."""
    size = np.abs(slip)
    after = np.maximum(size - 3.0 * friction * (1.0 + RESTITUTION) * impact, 0.0)
    if law is not None:
        ratio = size / impact
        after = np.where(ratio < law[0][-1], np.interp(ratio, *law) * impact, after)
    return np.asarray(after * np.sign(slip))
