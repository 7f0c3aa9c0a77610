"""All frames as one page that plays them: drawn by the browser from numbers, without any network.

Places and angles are kept as whole numbers of 16 bits: a place to a small part of a pixel, an angle to 1e-4 rad.
"""

import base64
import html
import json
import math
from collections.abc import Iterable
from importlib.resources import files
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from jostle_lab.film import words
from jostle_lab.film.recording import Numbers
from jostle_lab.film.script import Frame, Script
from jostle_lab.film.stage import INK, SHADE, SOLID, Stage

STEPS = 2**16 - 1
"""Of a whole number of 16 bits."""


def write_page(script: Script, path: Path, numbers: Iterable[int]) -> None:
    """Write the page of the frames with these numbers."""
    text = files("jostle_lab.film").joinpath("player.html").read_text(encoding="utf-8")
    data = json.dumps(content(script, [script.frame(number) for number in numbers]), separators=(",", ":"))
    title = html.escape(words.title(script.recording))
    parts = {"TITLE": title, "WIDTH": str(script.layout.width), "DATA": data.replace("</", "<\\/")}
    for name, value in parts.items():
        text = text.replace(name, value, 1)
    path.write_text(text, encoding="utf-8")


def content(script: Script, frames: list[Frame]) -> dict[str, Any]:
    """What the page reads; lengths in pixels, from the lower left corner."""
    stage, layout = Stage(script), script.layout
    centres = np.array([frame.centres for frame in frames])
    segments = np.concatenate([frame.segments for frame in frames]).reshape(-1, 2, 2)
    low, high = (float(f([f(part) for part in (centres, segments) if part.size])) for f in (np.min, np.max))
    step = max(high - low, 1.0) / STEPS
    angles = np.array([frame.angles for frame in frames])
    tips = [stage.hand(frame) for frame in frames]
    panel = layout.panel
    return {
        "width": layout.width,
        "height": layout.height,
        "fps": script.pace.fps,
        "frames": len(frames),
        "background": _picture(stage.background()),
        "panel": [panel.left, panel.bottom, panel.width, panel.height],
        "cell": script.cell,
        "radii": script.radii.tolist(),
        "palette": [to_hex(colour) for colour in script.colouring.palette],
        "shade": f"rgba({', '.join(str(round(255 * part)) for part in SHADE[:3])}, {SHADE[3]})",
        "solid": SOLID,
        "ink": INK,
        "solids": [layout.pixels(solid.outline).round(3).tolist() for solid in script.scenery.solids],
        "shifts": _packed(np.array([frame.shifts for frame in frames]), "<f4"),
        "low": low,
        "step": step,
        "centres": _packed(np.rint((centres - low) / step), "<u2"),
        "angles": _packed(np.mod(np.rint(angles / math.tau * (STEPS + 1)), STEPS + 1), "<u2"),
        "shades": _packed(np.array([frame.shades for frame in frames]), "u1"),
        "ends": _packed(np.rint((segments - low) / step), "<u2"),
        "widths": _packed(np.concatenate([frame.widths for frame in frames]), "<f4"),
        "firsts": _packed(np.cumsum([0, *(len(frame.widths) for frame in frames)]), "<u4"),
        "middle": None if tips[0] is None else tips[0][0].tolist(),
        "hands": _packed(np.array([tip[1] for tip in tips if tip is not None]), "<f4"),
        "letter": stage.letter,
        "clock": list(stage.clock_place()),
        "clocks": [frame.clock for frame in frames],
    }


def _packed(values: Numbers | NDArray[np.integer[Any]] | NDArray[np.uint8], kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")


def _picture(pixels: NDArray[np.uint8]) -> str:
    """An address that holds the picture itself."""
    from PIL import Image  # noqa: PLC0415

    kept = BytesIO()
    Image.fromarray(pixels).convert("RGB").save(kept, "PNG", optimize=True)
    return "data:image/png;base64," + base64.b64encode(kept.getvalue()).decode("ascii")
