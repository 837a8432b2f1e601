"""What the loops share: a canvas of one size, a caption inside the picture, and a file that says what made it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import font_manager
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image, ImageDraw, ImageFont

import holdfast
from holdfast.interface.report.palette import INK

OUT = Path(__file__).parents[2] / "docs" / "_static" / "loops"
SIZE = (960, 540)
QUALITY = 70
TICK = 80  # ms: pictures that move; those that stand say for how long
Shot = tuple[Image.Image, int]  # a picture, and how long it is shown, ms


def figure(**options: Any) -> Figure:
    """An empty figure of the size of a loop, with letters that can be read at half of it."""
    drawn = Figure(figsize=(SIZE[0] / 100, SIZE[1] / 100), dpi=100, **options)
    drawn.set_facecolor("white")
    return drawn


def picture(drawn: Figure) -> Image.Image:
    """A figure as it stands."""
    canvas = FigureCanvasAgg(drawn)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3].copy())


def caption(shown: Image.Image, text: str, size: int = 24, color: str = INK) -> Image.Image:
    """The picture with text in its lower left corner; the first line is bold."""
    out = shown.copy()
    pen = ImageDraw.Draw(out, "RGBA")
    lines = text.split("\n")
    fonts = [ImageFont.truetype(font_manager.findfont(f"DejaVu Sans:{w}"), size) for w in ("bold", "normal")]
    height = int(1.4 * size)
    top = out.height - 12 - height * len(lines)
    wide = max(fonts[min(k, 1)].getlength(line) for k, line in enumerate(lines))
    pen.rectangle((0, top - 8, 16 + wide + 12, out.height), fill=(255, 255, 255, 248))
    for k, line in enumerate(lines):
        pen.text((16, top + k * height), line, fill=color if k == 0 else INK, font=fonts[min(k, 1)])
    return out


def write(name: str, shots: Iterator[Shot] | Sequence[Shot], seed: int | None = None) -> Path:
    """Write a loop, and beside it what made it.

    It begins with the picture that is shown longest: some viewers show no other.
    """
    taken = list(shots)
    first = max(range(len(taken)), key=lambda k: (taken[k][1], -k))
    pictures, times = zip(*taken[first:], *taken[:first], strict=True)
    OUT.mkdir(parents=True, exist_ok=True)
    file = OUT / f"{name}.webp"
    pictures[0].save(file, save_all=True, append_images=pictures[1:], duration=list(times), loop=0, quality=QUALITY, method=3)
    drawn = "" if seed is None else f", seed {seed}"
    made = f"python -m tools.loops {name}, holdfast {holdfast.__version__}{drawn}, {sum(times) / 1000:.1f} s\n"
    file.with_suffix(".txt").write_text(made, encoding="utf-8")
    return file
