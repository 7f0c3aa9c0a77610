"""A results folder in, a page of numbers out."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from jostle_lab.camera import Camera
from jostle_lab.results import Results


def write_report(results: Results) -> Path:
    """Write `numbers.md`; return its path."""
    sections = [
        "# Numbers",
        _setting(results),
        "## Drive: true, measured, bias",
        _drive_table(results),
        "True: Fourier component of the base acceleration at the drive frequency. Peak: largest sample of the base "
        "acceleration, shocks included. Measured: sqrt(2) SD in a 10 Hz window, mean of two sensors. Corrected: the "
        "noise floor of the side bands removed. Coupling error: work done by the plate less work received by the "
        "grains, over the latter.",
        "## Rotation",
        _rotation_table(results),
        f"Camera: one frame in {1.0 / results.setup['camera']['frame_rate']:g} s; it cannot tell more than "
        f"{_alias_limit_rpm(results):g} RPM. Aliased: disks whose excursion by camera is not the true one. A driftless "
        "random walk has rho^2 = 0.43 on average. Largest move: of the centre of a disk while recording.",
        _aliased_disks(results),
        "## Cost of the loop",
        _cost_table(results),
    ]
    path = results.folder / "numbers.md"
    path.write_text("\n\n".join(sections) + "\n")
    return path


def markdown_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table with all columns but the first aligned right."""
    lines = ["| " + " | ".join(header) + " |", "|" + "|".join([":--", *["--:"] * (len(header) - 1)]) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines)


def _setting(results: Results) -> str:
    summary, setup = results.summaries[0], results.setup
    driver: dict[str, Any] = summary["driver"]
    sensor: dict[str, Any] = setup["accelerometer"]
    bandwidth = "none" if sensor["bandwidth"] is None else f"{sensor['bandwidth']:g} Hz"
    seeds = results.seeds
    seeds_text = f"{seeds[0]} to {seeds[-1]}" if len(seeds) > 2 else ", ".join(map(str, seeds))
    rows = [
        ("packings", f"{len(seeds)} (seeds {seeds_text}), {summary['simulated_seconds']} s simulated each"),
        ("drive", f"{setup['drive_frequency']:g} Hz, {summary['full_drive_voltage']:.2f} V peak at A = 1"),
        ("exchange", f"{setup['exchange']}, {setup['steps_per_second']} steps a second"),
        ("loudspeaker", driver["name"]),
        ("moving mass", f"{summary['moving_mass']:.3f} kg, of which {driver['moving_mass']:g} kg cone and coil"),
        ("weight of the grains", f"{summary['grains_weight']:.3f} N"),
        (
            "accelerometers",
            f"{sensor['data_rate']:g} Hz, +-{sensor['measuring_range']:g} g, resolution {sensor['resolution']:g} g, "
            f"noise density {1e6 * sensor['noise_density']:g} ug/sqrt(Hz), low-pass {bandwidth}",
        ),
    ]
    rows += [(name, str(value)) for name, value in results.run.items() if name != "setup"]
    return "\n".join(f"- {name}: {value}" for name, value in rows)


def _by_amplitude(results: Results) -> list[tuple[float, dict[str, float], dict[str, float]]]:
    """(A, mean, standard deviation over packings) from strong to weak."""
    groups: dict[float, list[dict[str, float]]] = {}
    for row in results.amplitudes:
        groups.setdefault(row["amplitude"], []).append(row)
    table = []
    for amplitude in sorted(groups, reverse=True):
        rows = groups[amplitude]
        mean = {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}
        spread = {name: float(np.std([row[name] for row in rows])) for name in rows[0]}
        table.append((amplitude, mean, spread))
    return table


def _drive_table(results: Results) -> str:
    header = [
        "A",
        "true Gamma",
        "spread",
        "peak",
        "measured",
        "bias",
        "corrected",
        "bias",
        "clipped",
        "work received [W]",
        "coupling error",
    ]
    seconds = {i["amplitude"]: i["recording"] for i in results.setup["protocol"]["intervals"]}
    rows = [
        [
            f"{amplitude:.2f}",
            f"{mean['gamma_true']:.4f}",
            f"{spread['gamma_true']:.4f}",
            f"{mean['gamma_peak']:.3f}",
            f"{mean['gamma_measured']:.4f}",
            f"{100 * mean['bias']:+.2f} %",
            f"{mean['gamma_corrected']:.4f}",
            f"{100 * mean['bias_corrected']:+.2f} %",
            f"{mean['clipped_readings']:.0f}",
            f"{mean['work_received'] / seconds[amplitude]:.3g}",
            f"{100 * mean['coupling_error']:+.2g} %",
        ]
        for amplitude, mean, spread in _by_amplitude(results)
    ]
    return markdown_table(header, rows)


def _rotation_table(results: Results) -> str:
    header = [
        "A",
        "true Gamma",
        "<omega^2> [RPM^2]",
        "by camera",
        "<rho^2>",
        "by camera",
        "<sigma_a>",
        "by camera",
        "fastest disk [RPM]",
        "aliased disks",
        "largest move [mm]",
    ]
    rows = []
    for amplitude, mean, _ in _by_amplitude(results):
        fastest = max(abs(d["mean_velocity"]) for d in results.disks if d["amplitude"] == amplitude) * 30.0 / math.pi
        rows.append(
            [
                f"{amplitude:.2f}",
                f"{mean['gamma_true']:.3f}",
                f"{mean['mean_square_rpm']:.4g}",
                f"{mean['mean_square_rpm_camera']:.4g}",
                f"{mean['correlation']:.3f}",
                f"{mean['correlation_camera']:.3f}",
                f"{mean['adjusted_deviation']:.3f}",
                f"{mean['adjusted_deviation_camera']:.3f}",
                f"{fastest:.2f}",
                f"{mean['aliased_disks']:.1f}",
                f"{1000 * mean['largest_move']:.1f}",
            ]
        )
    return markdown_table(header, rows)


def _aliased_disks(results: Results, shown: int = 12) -> str:
    """Which disks the camera has wrong, and by how much."""
    wrong = [disk for disk in results.disks if disk["aliased"]]
    if not wrong:
        return "The camera sees every disk right."
    rpm = 30.0 / math.pi
    header = ["seed", "A", "disk", "true [RPM]", "by camera [RPM]"]
    rows = [
        [
            f"{disk['seed']:.0f}",
            f"{disk['amplitude']:.2f}",
            f"{disk['disk']:.0f}",
            f"{disk['mean_velocity'] * rpm:+.2f}",
            f"{disk['camera_velocity'] * rpm:+.2f}",
        ]
        for disk in sorted(wrong, key=lambda d: -abs(d["mean_velocity"]))[:shown]
    ]
    title = f"The camera has {len(wrong)} of {len(results.disks)} excursions wrong; the fastest:"
    return f"{title}\n\n{markdown_table(header, rows)}"


def _alias_limit_rpm(results: Results) -> float:
    return Camera(results.setup["camera"]["frame_rate"]).alias_limit() * 30.0 / math.pi


def _cost_table(results: Results) -> str:
    simulated = sum(s["simulated_seconds"] for s in results.summaries)
    steps = sum(s["communication_steps"] for s in results.summaries)
    wall = sum(s["wall_seconds"] for s in results.summaries)
    costs: dict[str, float] = {}
    for summary in results.summaries:
        for name, value in summary["costs"].items():
            costs[name] = costs.get(name, 0.0) + value
    costs["loop and the rest"] = wall - sum(costs.values())
    rows = [
        [name, f"{1e3 * value / simulated:.2f}", f"{1e6 * value / steps:.2f}", f"{100 * value / wall:.1f} %"]
        for name, value in [*costs.items(), ("all", wall)]
    ]
    table = markdown_table(["part", "ms per simulated second", "us per step", "share"], rows)
    return f"{table}\n\nOne process simulates {simulated / wall:.2f} s in a second."
