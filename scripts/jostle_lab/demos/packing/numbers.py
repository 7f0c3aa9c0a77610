"""A results folder in, tables of numbers out, and a page of them in Markdown; `page` has them in HTML."""

from pathlib import Path
from typing import Any, NamedTuple

import polars as pl

from jostle_lab.demos.packing.power_laws import power_law_note, power_law_table
from jostle_lab.files import replace_text
from jostle_lab.protocol.pictures import TABLE
from jostle_lab.protocol.results import Results
from jostle_lab.sensors.camera import Camera
from jostle_lab.statistics.rotation import RPM
from jostle_lab.tables import Row, markdown_table, read_table


class Sheet(NamedTuple):
    """A table of texts."""

    header: list[str]
    rows: list[list[str]]

    def markdown(self) -> str:
        """In Markdown."""
        return markdown_table(self.header, self.rows)


def write_report(results: Results) -> Path:
    """Write `numbers.md`; return its path."""
    frame_rate = results.setup["camera"]["frame_rate"]
    sections = [
        "# Numbers",
        "\n".join(f"- {name}: {value}" for name, value in setting(results)),
        "## Drive: true, measured, bias",
        drive_table(results).markdown(),
        "True: Fourier component of the base acceleration at the drive frequency. Peak: largest sample of the base "
        "acceleration, shocks included. Measured: sqrt(2) SD in a 10 Hz window, mean of two sensors. Corrected: the "
        "noise floor of the side bands removed. Coupling error: work done by the plate less work received by the "
        "grains, over the latter.",
        "## Rotation",
        rotation_table(results).markdown(),
        f"Camera: one frame in {1.0 / frame_rate:g} s; it cannot resolve more than "
        f"{Camera(frame_rate).alias_limit() / RPM:g} RPM. Aliased: disks whose excursion by camera is not the true "
        "one. A driftless random walk has rho^2 = 0.43 on average. Largest move: of the centre of a disk while "
        "recording.",
        *_aliased_text(results),
        "## Power laws",
        _power_law_text(results),
        *_pictures_text(results),
        "## Cost of the loop",
        _cost_text(results),
    ]
    path = results.folder / "numbers.md"
    replace_text(path, "\n\n".join(sections) + "\n")
    return path


def setting(results: Results) -> list[tuple[str, str]]:
    """What was shaken, by what, watched by what: names and texts."""
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
    return rows + labels(results.run)


def labels(run: dict[str, Any]) -> list[tuple[str, str]]:
    """What else identifies a run."""
    return [(name, str(value)) for name, value in run.items() if name != "setup"]


def _by_amplitude(results: Results) -> list[Row]:
    """Mean over packings of each column, from strong to weak, and the standard deviation of the true Gamma."""
    spread = pl.col("gamma_true").std(ddof=0).alias("spread")
    groups = results.amplitudes.group_by("amplitude").agg(pl.exclude("amplitude").mean(), spread)
    return groups.sort("amplitude", descending=True).to_dicts()


def drive_table(results: Results) -> Sheet:
    """Gamma, true and measured, by amplitude."""
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
            f"{mean['amplitude']:.2f}",
            f"{mean['gamma_true']:.4f}",
            f"{mean['spread']:.4f}",
            f"{mean['gamma_peak']:.3f}",
            f"{mean['gamma_measured']:.4f}",
            f"{100 * mean['bias']:+.2f} %",
            f"{mean['gamma_corrected']:.4f}",
            f"{100 * mean['bias_corrected']:+.2f} %",
            f"{mean['clipped_readings']:.0f}",
            f"{mean['work_received'] / seconds[mean['amplitude']]:.3g}",
            f"{100 * mean['coupling_error']:+.2g} %",
        ]
        for mean in _by_amplitude(results)
    ]
    return Sheet(header, rows)


def rotation_table(results: Results) -> Sheet:
    """Rotation, true and by camera, by amplitude."""
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
    speeds = results.disks.group_by("amplitude").agg(pl.col("mean_velocity").abs().max() / RPM)
    fastest = dict(speeds.iter_rows())
    for mean in _by_amplitude(results):
        rows.append(
            [
                f"{mean['amplitude']:.2f}",
                f"{mean['gamma_true']:.3f}",
                f"{mean['mean_square_rpm']:.4g}",
                f"{mean['mean_square_rpm_camera']:.4g}",
                f"{mean['correlation']:.3f}",
                f"{mean['correlation_camera']:.3f}",
                f"{mean['adjusted_deviation']:.3f}",
                f"{mean['adjusted_deviation_camera']:.3f}",
                f"{fastest[mean['amplitude']]:.2f}",
                f"{mean['aliased_disks']:.1f}",
                f"{1000 * mean['largest_move']:.1f}",
            ]
        )
    return Sheet(header, rows)


def aliased_table(results: Results, shown: int = 12) -> Sheet:
    """Which disks the camera has wrong, and by how much: the fastest of them."""
    rows = [
        [
            f"{disk['seed']}",
            f"{disk['amplitude']:.2f}",
            f"{disk['disk']}",
            f"{disk['mean_velocity'] / RPM:+.2f}",
            f"{disk['camera_velocity'] / RPM:+.2f}",
        ]
        for disk in _aliased(results).head(shown).to_dicts()
    ]
    return Sheet(["seed", "A", "disk", "true [RPM]", "by camera [RPM]"], rows)


def _aliased(results: Results) -> pl.DataFrame:
    return results.disks.filter(pl.col("aliased") == 1).sort(pl.col("mean_velocity").abs(), descending=True)


def aliased_count(results: Results) -> str:
    """How many excursions the camera has wrong."""
    wrong = len(_aliased(results))
    if not wrong:
        return "The camera measures the excursion of every disk correctly."
    return f"The camera has {wrong} of {len(results.disks)} excursions wrong; the fastest:"


def _aliased_text(results: Results) -> list[str]:
    table = aliased_table(results)
    return [aliased_count(results), *([table.markdown()] if table.rows else [])]


def _power_law_text(results: Results) -> str:
    return f"{Sheet(*power_law_table(results)).markdown()}\n\n{power_law_note(results)}"


def pictures_table(results: Results) -> Sheet | None:
    """What the pictures gave, if there are any."""
    files = [results.folder_of(seed) / TABLE for seed in results.seeds]
    if not all(file.exists() for file in files):
        return None
    frame = pl.concat([read_table(file) for file in files]).group_by("amplitude").mean()
    rows = [
        [
            f"{row['amplitude']:.2f}",
            f"{row['mean_square_rpm_pictures']:.4g}",
            f"{row['correlation_pictures']:.3f}",
            f"{row['adjusted_deviation_pictures']:.3f}",
            f"{row['angle_error_degrees']:.2f}",
            f"{100 * row['swapped']:.1f} %",
            f"{row['lost']:.1f}",
        ]
        for row in frame.sort("amplitude", descending=True).to_dicts()
    ]
    header = ["A", "<omega^2> [RPM^2]", "<rho^2>", "<sigma_a>", "error of the angle [degrees]", "swapped", "lost"]
    return Sheet(header, rows)


PICTURES_NOTE = (
    "Marks found in pictures of the packing, by threshold and ellipse, and followed by nearest neighbour. Swapped: "
    "disks that are taken for another one. Lost: marks that were not found, for each packing."
)


def _pictures_text(results: Results) -> list[str]:
    table = pictures_table(results)
    return ["## By pictures", table.markdown(), PICTURES_NOTE] if table else []


def cost_table(results: Results) -> Sheet:
    """Where the time of a worker goes."""
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
    return Sheet(["part", "ms per simulated second", "us per step", "share"], rows)


def speed(results: Results) -> str:
    """Of one worker."""
    simulated, wall = (sum(s[name] for s in results.summaries) for name in ("simulated_seconds", "wall_seconds"))
    return f"One process simulates {simulated / wall:.2f} s in a second."


def _cost_text(results: Results) -> str:
    return f"{cost_table(results).markdown()}\n\n{speed(results)}"
