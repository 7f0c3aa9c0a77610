"""What P 4.3 and 4.4 say of the region that Coulomb friction admits, its corners and its symmetry."""

import math

import numpy as np

from jostle_lab.runs.laboratory import Laboratory
from jostle_lab.statements import Statement
from jostle_lab.statistics.estimates import Estimate, Numbers
from jostle_lab.verdicts import above, exact, true
from studies.thesis.two_supports.runs import TANGENTIAL_STIFFNESS
from studies.thesis.two_supports.saturated import printed, saturated
from studies.thesis.two_supports.spring_region import QUADRILATERAL, Region, corners, distance_to_path

TILT = 0.1 * math.pi
FRICTION, HALF_ANGLE, WEIGHT = 0.1, math.pi / 6.0, 1.0
ON_OUTLINE = 0.01
"""Points nearer to an outline than this part of the size count as on it."""
PIECES = 8
"""Pieces of a record, whose scatter gives errors."""


def constant_normal_forces(tilt: float) -> Numbers:
    """Corners of the region if both normal forces stay at those without tangential forces; shape (4, 2)."""
    unit = 2.0 * TANGENTIAL_STIFFNESS
    left = WEIGHT * math.sin(HALF_ANGLE + tilt) / math.sin(2.0 * HALF_ANGLE)
    right = WEIGHT * math.sin(HALF_ANGLE - tilt) / math.sin(2.0 * HALF_ANGLE)
    signs = ((1, 1), (1, -1), (-1, -1), (-1, 1))
    forces = [(FRICTION * left * a, FRICTION * right * b) for a, b in signs]
    return np.array([(-(one + two) / unit, (two - one) / unit) for one, two in forces])


def asymmetry(outline: Numbers, signs: tuple[int, int] = (-1, -1)) -> float:
    """Largest distance of a reflected corner from a closed outline, shape (n + 1, 2), over the largest diagonal.

    With both signs reversed the reflection is that through the origin, by which P 4.4 tells the regions apart; with
    (-1, 1) it is the mirror that exchanges left and right.
    """
    size = max(float(np.linalg.norm(a - b)) for a in outline for b in outline)
    return float(np.max(distance_to_path(outline * np.array(signs), outline))) / size


def statements(
    laboratory: Laboratory, tilted: Region, upright: Region, points: Numbers, stiffer: Numbers, margin: Numbers
) -> list[Statement]:
    """All of them.

    Args:
        laboratory: for the theory.
        tilted: quasi-static region at TILT.
        upright: the same without tilt.
        points: of a disk on weakly vibrating supports, shape (n, 2) [rad].
        stiffer: the same with a hundred times the normal stiffness.
        margin: distance of `points` from slip [N].

    """
    return [
        *_symmetry(tilted, upright),
        *_corners(laboratory),
        _detachment(laboratory),
        *_simulated(tilted, points, stiffer, margin),
    ]


def _symmetry(tilted: Region, upright: Region) -> list[Statement]:
    constant = constant_normal_forces(TILT)
    closed = np.vstack([constant, constant[:1]])
    edges = np.diff(closed, axis=0)
    angles = np.degrees(np.arctan2(edges[:, 1], edges[:, 0])) % 90.0
    through = {"tilted": asymmetry(tilted.outline), "constant": asymmetry(closed)}
    mirrored = {"tilted": asymmetry(tilted.outline, (-1, 1)), "upright": asymmetry(upright.outline, (-1, 1))}
    square = constant_normal_forces(0.0)
    lengths = np.linalg.norm(np.diff(np.vstack([square, square[:1]]), axis=0), axis=1)
    return [
        Statement.judged(
            "4.4, Fig. 4.3",
            "tilted, the quasi-static region is asymmetric",
            f"reflected through the origin a corner is off by {through['tilted']:.3f} of the size, mirrored left to "
            f"right by {mirrored['tilted']:.3f}",
            true(
                min(through["tilted"], mirrored["tilted"]) > 1e-3, "both reflections off by more than 1e-3; no chance"
            ),
        ),
        Statement.judged(
            "4.4, Fig. 4.3",
            "with constant normal forces it is a parallelogram turned by 45 degrees, symmetric upon reflection through "
            "the origin",
            f"edges at {', '.join(f'{a:.1f}' for a in angles)} degrees to the axes, reflected through the "
            "origin off by "
            f"{through['constant']:.0e}",
            exact(through["constant"], 1e-12) & exact(float(np.max(np.abs(angles - 45.0))), 1e-6, "angle less 45"),
        ),
        Statement.judged(
            "4.4",
            "it becomes a square if both normal forces are equal",
            f"without tilt its edges differ by {float(np.ptp(lengths) / lengths.mean()):.0e} of their length",
            exact(float(np.ptp(lengths) / lengths.mean()), 1e-12),
        ),
        Statement.judged(
            "5",
            "without tilt the quadrilateral becomes symmetric",
            f"mirrored left to right it is off by {mirrored['upright']:.0e}; reflected through the origin by "
            f"{asymmetry(upright.outline):.3f}, since T1 and T2 differ: the mirror is the symmetry that "
            "forbids rotation",
            exact(mirrored["upright"], 1e-12),
        ),
    ]


def _corners(laboratory: Laboratory) -> list[Statement]:
    """Printed positions beside the balance of forces solved with saturated friction, and beside the theory."""
    cases = [(tilt, x, y) for tilt in (0.0, 0.1, 0.3) for x, y in ((0.0, 0.0), (1.5, -0.7))]
    solved = {case: saturated(*case) for case in cases}
    rows = []
    for place, names in (
        ("4.40, 4.41", ("S1",)),
        ("4.42, 4.43", ("S2",)),
        ("4.44, 4.45", ("D1", "D2")),
        ("4.46, 4.47", ("T1",)),
        ("4.48, 4.49", ("T2",)),
    ):
        ours, prints = 0.0, 0.0
        for case in cases:
            found = corners(laboratory, case[0], acceleration=case[1:])
            size = float(np.linalg.norm(solved[case]["S2"] - solved[case]["S1"]))
            for name in names:
                ours = max(ours, float(np.linalg.norm(found[name] - solved[case][name])) / size)
                prints = max(prints, float(np.linalg.norm(printed(name, *case) - solved[case][name])) / size)
        rows.append(
            Statement.judged(
                place,
                f"position of {' and '.join(names)} in departure and stretch",
                f"from the balance of forces with saturated friction, in units of the size: printed {prints:.0e}, "
                f"theory of the program {ours:.0e}; three tilts, with and without acceleration",
                exact(max(prints, ours), 1e-9, "distance over size"),
            )
        )
    return rows


def _detachment(laboratory: Laboratory) -> Statement:
    most = float(laboratory.theory("three_disk", "limits", tilt=0.0)["detachment_tilt"][0])
    inside = []
    for share in (0.98, 1.02):
        found = saturated(share * most, 0.0, 0.0)
        inside.append(bool(found["S1"][0] > found["D1"][0] and found["S2"][0] < found["D2"][0]))
    expected = HALF_ANGLE - math.atan(FRICTION)
    return Statement.judged(
        "4.50, 4.51, 5.2.1",
        "contacts stay closed, D1 and D2 are out of reach, while mu < tan(theta_0 - theta_T): up to "
        "theta_T^D = theta_0 - arctan mu",
        f"theta_T^D = {most:.6f} rad, formula {expected:.6f}; the condition on S and D holds at 0.98 theta_T^D: "
        f"{inside[0]}, at 1.02 theta_T^D: {inside[1]}",
        exact(most - expected, 1e-12) & true(inside == [True, False], "the condition changes there; no chance"),
    )


def _simulated(tilted: Region, points: Numbers, stiffer: Numbers, margin: Numbers) -> list[Statement]:
    constant = constant_normal_forces(TILT)
    closed = np.vstack([constant, constant[:1]])

    def nearest(named: dict[str, Numbers]) -> dict[str, float]:
        return {n: float(np.min(np.linalg.norm(points - c, axis=1)) / tilted.size) for n, c in named.items()}

    near = nearest({name: tilted.corners[name] for name in QUADRILATERAL})
    near_constant = nearest(dict(zip(QUADRILATERAL, constant, strict=True)))
    beyond = tilted.outside(points) / tilted.size
    follow, follow_stiffer = (
        share_of_first(distance_to_path(p, tilted.outline) / tilted.size, distance_to_path(p, closed) / tilted.size)
        for p in (points, stiffer)
    )
    outside = pieces((beyond > 1e-3).astype(np.float64))
    reached = max(min(near[name], near_constant[name]) for name in QUADRILATERAL)
    return [
        Statement.judged(
            "4.4, 5.3.3",
            "vibrating supports reach S1, S2, T1 and T2",
            "nearest point, over the size: "
            + ", ".join(f"{name} {d:.3f}" for name, d in near.items())
            + "; from the corners with constant normal forces "
            + ", ".join(f"{name} {d:.3f}" for name, d in near_constant.items()),
            true(reached < 0.05, "a point within 5 % of the size of each corner, of either region"),
        ),
        Statement.judged(
            "5.3.3",
            "normal forces at the sliding points are near those of equilibrium",
            f"of the points on either outline a share of {follow} is on the quasi-static one, the others on that of "
            "constant normal forces",
            above(follow, 0.5),
            "the tangential springs load within sqrt(m / k_t) = 0.3 ms, the centre moves within sqrt(m / k_n) = 10 ms: "
            "normal forces have no time to follow (k_t / k_n = 1000). Trial: with k_n a hundred times larger "
            "the share is "
            f"{follow_stiffer}",
        ),
        Statement.judged(
            "4.4, 7",
            "accelerations of the centre move the region, Amontons' condition holds",
            f"a share of {outside} of the points is outside the quasi-static region, at most {beyond.max():.2f} of its "
            f"size; smallest mu n - |tau| {min(float(margin.min()), 0.0):.0e} N",
            above(outside, 0.0) & exact(min(float(margin.min()), 0.0), 1e-9, "smallest mu n - |tau| [N]"),
        ),
    ]


def pieces(values: Numbers) -> Estimate:
    """Mean of a record, with the error from the scatter of its pieces."""
    return Estimate.over_runs(np.array([float(np.mean(piece)) for piece in np.array_split(values, PIECES)]))


def share_of_first(first: Numbers, second: Numbers) -> Estimate:
    """How many of the points on either outline are on the first, by pieces; distances over the size."""
    near = (first < ON_OUTLINE) | (second < ON_OUTLINE)
    return pieces((first[near] < ON_OUTLINE).astype(np.float64))
