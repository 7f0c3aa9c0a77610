"""Pictures in, a file out: MP4 by ffmpeg, GIF and WebP by Pillow. The file is whole under its name, or not there."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from jostle_lab.errors import LabError, about, describe_os_error
from jostle_lab.film.recording import Numbers

if TYPE_CHECKING:
    from PIL.Image import Image

Pictures = Iterable[memoryview]
"""Red, green, blue, opacity; each of shape (height, width, 4), valid until the next one is taken."""
MOST_PIXELS = 6e8
"""Of all frames of a GIF or WebP, which is made in memory."""
QUALITY = 70
"""Of a WebP."""


def check_place(out: Path) -> None:
    """Raise LabError unless the file can be written, before anything is computed."""
    folder = out.parent
    if not folder.is_dir():
        raise LabError(f"The folder {folder} of {out} is not there. Make it, or name another file.")
    if out.is_dir():
        raise LabError(f"{out} is a folder. Name a file.")
    draft = _draft(out)
    try:
        draft.touch()
        draft.unlink()
    except OSError as error:
        raise LabError(describe_os_error(about(out, error))) from None


def _draft(out: Path) -> Path:
    return out.with_name(f"_{out.stem}.draft{out.suffix}")


@contextmanager
def whole(out: Path) -> Iterator[Path]:
    """A name beside `out` to write to; at the end it becomes `out`, after an error or Ctrl-C it is gone.

    Raises:
        LabError: it cannot be written.

    """
    draft = _draft(out)
    try:
        yield draft
        draft.replace(out)
    except OSError as error:
        raise LabError(describe_os_error(about(out, error))) from None
    finally:
        draft.unlink(missing_ok=True)


def write_mp4(path: Path, pictures: Pictures, size: tuple[int, int], fps: float) -> None:
    """H.264 in 4:2:0, which every browser and player shows."""
    ffmpeg = _ffmpeg()
    sink = ffmpeg.write_frames(
        str(path),
        size,
        pix_fmt_in="rgba",
        pix_fmt_out="yuv420p",
        fps=fps,
        codec="libx264",
        quality=None,
        macro_block_size=2,
        output_params=["-crf", "20", "-preset", "veryfast", "-movflags", "+faststart"],
        ffmpeg_log_level="error",
    )
    try:
        sink.send(None)
        for picture in pictures:
            sink.send(picture)
    except OSError as error:
        raise LabError(f"ffmpeg stopped while it wrote {path.name}: {error}. Is there room on the disk?") from None
    finally:
        sink.close()


def write_gif(path: Path, frames: "Iterator[Image]", fps: float, colours: Numbers) -> None:
    """A GIF of these colours alone, red, green, blue in [0, 1], shape (at most 256, 3); others become the nearest.

    They are chosen by meaning and not by how often they are seen: a rare colour is that of the fastest disk.
    """
    chosen = _pillow().new("P", (1, 1))
    chosen.putpalette(np.rint(255.0 * colours).astype(np.uint8).tobytes())
    indexed = (frame.quantize(palette=chosen, dither=_pillow().Dither.NONE) for frame in frames)
    lasting = round(1000.0 / fps)
    next(indexed).save(path, save_all=True, append_images=indexed, duration=lasting, loop=0, optimize=False)


def write_webp(path: Path, frames: "Iterator[Image]", fps: float, count: int, quality: int) -> None:
    """Animated WebP."""
    ends = np.rint(1000.0 / fps * np.arange(count + 1)).astype(int)
    lasting = np.diff(ends).tolist()
    # Each frame is whole: of a frame kept as a change of the last one, squares of that stay behind.
    next(frames).save(
        path, save_all=True, append_images=frames, duration=lasting, loop=0, quality=quality, method=4, kmax=1
    )


def images(pictures: Pictures, size: tuple[int, int]) -> "Iterator[Image]":
    """Copies of them, without opacity."""
    for picture in pictures:
        yield _pillow().frombuffer("RGBA", size, picture, "raw", "RGBA", 0, 1).convert("RGB")


def check_memory(count: int, size: tuple[int, int]) -> None:
    """Raise LabError if a GIF or WebP of so many frames is larger than what is kept in memory."""
    if count * size[0] * size[1] > MOST_PIXELS:
        most = int(MOST_PIXELS / (size[0] * size[1]))
        raise LabError(
            f"The film has {count} frames of {size[0]} by {size[1]} pixels; at most {most} of them fit into a GIF or "
            "WebP. Show a part of the run (start, end), choose a smaller slow, fps or height, or write .mp4."
        )


def _ffmpeg() -> Any:
    try:
        import imageio_ffmpeg  # noqa: PLC0415
    except ImportError:
        raise LabError("imageio-ffmpeg is not installed. Install it: pip install 'jostle-lab[film]'.") from None
    return imageio_ffmpeg


def _pillow() -> Any:
    from PIL import Image  # noqa: PLC0415

    return Image
