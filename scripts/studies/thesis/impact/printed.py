"""Formulas of P 4.5 as they are printed, with u_n < 0 on approach. SI units."""

import math

import numpy as np

from jostle_lab.statistics.estimates import Numbers
from studies.thesis.impact.equations import Contact


def rates(contact: Contact) -> tuple[float, float, float]:
    """beta, omega_0 and omega_n, below 4.54 [1/s]."""
    beta = contact.damping / (2.0 * contact.mass)
    natural = contact.frequency
    return beta, natural, math.sqrt(abs(natural**2 - beta**2))


def overlap(contact: Contact, u_n: float, t: Numbers) -> Numbers:
    """4.54."""
    beta, natural, omega = rates(contact)
    wave = np.sin(omega * t) if beta < natural else np.sinh(omega * t)
    return np.asarray(-u_n / omega * np.exp(-beta * t) * wave)


def duration(contact: Contact) -> float:
    """4.55."""
    beta, natural, omega = rates(contact)
    if beta > natural:
        return math.log((beta + omega) / (beta - omega)) / omega
    angle = math.atan(2.0 * beta * omega / (omega**2 - beta**2))
    return (math.pi - angle) / omega if beta < natural / math.sqrt(2.0) else -angle / omega


def restitution(c: float) -> float:
    """4.56."""
    if c > 1.0:
        root = math.sqrt(c * c - 1.0)
        return math.exp(-c / root * math.log((c + root) / (c - root)))
    root = math.sqrt(1.0 - c * c)
    angle = math.atan(2.0 * c * root / (1.0 - 2.0 * c * c))
    return math.exp(-c / root * (math.pi - angle)) if c < 1.0 / math.sqrt(2.0) else math.exp(c / root * angle)


def normal_force(contact: Contact, u_n: float, t: Numbers) -> Numbers:
    """4.57."""
    beta, _, omega = rates(contact)
    inner = contact.damping * omega * np.cos(omega * t) + (
        contact.stiffness - contact.damping**2 / (2.0 * contact.mass)
    ) * np.sin(omega * t)
    return np.asarray(-np.exp(-beta * t) / omega * u_n * inner)


def sticking(contact: Contact, stretch: float, slip: float, t: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """4.62, 4.63, 4.64: stretch [m], slip [m/s], tangential force [N] a time t after the start of the phase."""
    omega = math.sqrt(3.0 * contact.tangential / contact.mass)
    cos, sin = np.cos(omega * t), np.sin(omega * t)
    return (
        stretch * cos + slip / omega * sin,
        -omega * stretch * sin + slip * cos,
        -contact.tangential * stretch * cos - contact.tangential * slip / omega * sin,
    )


def sliding_slip(contact: Contact, u_n: float, sign: float, start: float, slip: float, t: Numbers) -> Numbers:
    """4.66."""
    beta, _, omega = rates(contact)

    def wave(at: Numbers | float) -> Numbers:
        return np.asarray(np.cos(omega * at) - beta / omega * np.sin(omega * at))

    inner = np.exp(-beta * (t - start)) * wave(t) - wave(start)
    return np.asarray(slip - 3.0 * sign * contact.friction * u_n * math.exp(-beta * start) * inner)


def sliding_force(contact: Contact, u_n: float, sign: float, t: Numbers) -> Numbers:
    """4.67."""
    beta, _, omega = rates(contact)
    inner = contact.damping * omega * np.cos(omega * t) + (contact.stiffness - beta * contact.damping) * np.sin(
        omega * t
    )
    return np.asarray(sign * np.exp(-beta * t) * contact.friction * u_n / omega * inner)


def normal_rate(contact: Contact, u_n: float, t: Numbers) -> Numbers:
    """4.72."""
    beta, _, omega = rates(contact)
    first = (contact.stiffness - 2.0 * beta * contact.damping) * omega * np.cos(omega * t)
    second = (contact.stiffness * beta + (omega**2 - beta**2) * contact.damping) * np.sin(omega * t)
    return np.asarray(-u_n * np.exp(-beta * t) / omega * (first - second))


def full_sliding(contact: Contact, normal: float, ratio: float) -> float:
    """4.75; ratio |u_t / u_n|."""
    return 1.0 - 3.0 * contact.friction * (1.0 + normal) / ratio


def first_switch(contact: Contact, ratio: float) -> float:
    """4.77, from sliding to sticking without damping [s]."""
    mu = contact.friction
    return math.acos((ratio - 3.0 * mu) / (mu / contact.ratio - 3.0 * mu)) / contact.frequency
