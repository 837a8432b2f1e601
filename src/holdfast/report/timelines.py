"""Figures of quantities over the time of a motion: panels below each other, and small ones side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from holdfast.notice import another
from holdfast.report.page import environment
from holdfast.report.palette import BLUE, INK, ORANGE, SOFT
from holdfast.report.scales import AxisScale, Kind
from holdfast.words import on_one_line

Array = NDArray[np.float64]
Look = Literal["first", "second", "third", "compared", "level"]

# After Okabe and Ito, darkened for thin lines; dashes tell apart what prints alike.
COLORS = (BLUE, ORANGE, "#1b7f5c", "#8a3d82", "#8f6a00", "#2a93c0", SOFT, "#a32638", INK)
_DASHES: tuple[tuple[float, ...], ...] = ((), (5, 1.5), (1.5, 1.2))  # in widths of the line
_LOOKS: dict[Look, tuple[str, float, tuple[float, ...]]] = {
    "first": (BLUE, 2.1, ()),
    "second": (ORANGE, 1.9, (5, 1.5)),
    "third": ("#1b7f5c", 1.9, (1.5, 1.2)),
    "compared": (INK, 1.6, (4.5, 2)),
    "level": (SOFT, 1.5, (1.2, 1.6)),
}
_MOMENT = {"color": ORANGE, "width": 1.3, "dashes": "", "label": "algorithmic singularity"}
_WIDE = 960  # pixels of a page
_LETTER = 7.2  # pixels at most of an ordinary letter, on average
_ENTRY = 17  # pixels of a line of a legend


@dataclass(frozen=True)
class Line:
    """One quantity over time: values (T,), what it is, and how it looks; without a look it has a colour of its own."""

    values: Array
    label: str
    look: Look | None = None


@dataclass(frozen=True)
class Timeline:
    """Lines over one axis of time.

    Attributes:
        lines: What is drawn.
        ylabel: What it is, with its unit.
        title: One line.
        moments: Times, s, that are marked by a line across.
        scale: Of the values: ``linear``, ``log``, or ``symlog`` with what is below ``small`` in size drawn linearly.
        small: See scale.
    """

    lines: Sequence[Line]
    ylabel: str
    title: str
    moments: Sequence[float] = ()
    scale: Kind = "linear"
    small: float = 1.0


def stacked_panels(time: Array, panels: Sequence[Timeline], about: str) -> Markup:
    """Panels below each other over one time (T,), s, each with a legend to its right if it has several lines.

    Args:
        time: Of all lines.
        panels: From the top.
        about: What they show, for people who cannot see it.
    """
    drawn = [_Panel(time, p, 190, 8) for p in panels]
    named = [d.legend if len(p.lines) > 1 or p.moments else [] for d, p in zip(drawn, panels, strict=True)]
    beside = max((_written([e["label"] for e in entries]) + 60 for entries in named), default=0)
    left = 28 + max(d.ticks_wide for d in drawn)
    wide, y, placed = _WIDE - left - 12 - beside, 0.0, []
    for k, (panel, d, entries) in enumerate(zip(panels, drawn, named, strict=True)):
        y += 26
        legend = [{**e, "x": left + wide + 14, "y": y + 12 + _ENTRY * i} for i, e in enumerate(entries)]
        xlabel = "time, s" if k == len(panels) - 1 else ""
        placed.append({**d.at(left, y, wide), "left": 14, "ylabel": panel.ylabel, "xlabel": xlabel, "legend": legend})
        y += max(190, _ENTRY * len(legend)) + 12
    return _page(placed, y + 28, [], about)


def small_multiples(time: Array, panels: Sequence[Timeline], about: str, xlabel: str = "time, s") -> Markup:
    """Small panels, three in a row, over one time (T,); the lines of the one with most are named below.

    Args:
        time: Of all lines.
        panels: In the order they are read.
        about: What they show, for people who cannot see it.
        xlabel: What time it is.
    """
    across = min(3, len(panels))
    drawn = [_Panel(time, p, 132, 4) for p in panels]
    units = [p.ylabel if k % across == 0 or p.ylabel != panels[k - 1].ylabel else "" for k, p in enumerate(panels)]
    columns = [range(k, len(panels), across) for k in range(across)]
    left = [10 + max(drawn[k].ticks_wide for k in c) + (18 if any(units[k] for k in c) else 0) for c in columns]
    wide = (_WIDE - sum(left) - 14 * across) / across
    y, placed = 0.0, []
    for first in range(0, len(panels), across):
        row = range(first, min(first + across, len(panels)))
        named = [k >= len(panels) - across for k in row]  # the last of its column
        y += 28
        for k, last in zip(row, named, strict=True):
            x = sum(left[: k - first + 1]) + (wide + 14) * (k - first)
            edge, said = x - left[k - first] + 14, xlabel if last else ""
            placed.append({**drawn[k].at(x, y, wide), "left": edge, "ylabel": units[k], "xlabel": said, "legend": []})
        y += 132 + (40 if any(named) else 8)
    entries = max((d.legend for d in drawn), key=len)
    each = _written([e["label"] for e in entries]) + 60
    fit = max(1, min(len(entries), 5, int(_WIDE / each)))
    begin = (_WIDE - each * fit) / 2
    below = [{**e, "x": begin + each * (i % fit), "y": y + 18 + _ENTRY * (i // fit)} for i, e in enumerate(entries)]
    return _page(placed, y + 26 + _ENTRY * (-(-len(entries) // fit) - 1), below, about)


def _page(panels: list[dict[str, Any]], height: float, below: list[dict[str, Any]], about: str) -> Markup:
    another("figure")
    template = environment().get_template("timelines.html")
    return Markup(
        template.render(panels=panels, below=below, about=about, width=_WIDE, height=round(height), ink=INK, soft=SOFT)
    )


def _written(labels: Sequence[str]) -> float:
    """Pixels that the longest of the labels takes."""
    return _LETTER * max((len(text) for text in labels), default=0)


class _Panel:
    """A panel before it has its place: ``tall`` pixels, with about ``most`` ticks along time."""

    def __init__(self, time: Array, panel: Timeline, tall: float, most: int) -> None:
        self._time, self._panel, self._tall = time, panel, tall
        every = np.concatenate([line.values for line in panel.lines])
        self._y = AxisScale(every, panel.scale, panel.small, 0.1 if panel.scale == "linear" else 0.05, int(tall / 24))
        self._x = AxisScale(time[[0, -1]], most=most)
        self.ticks_wide = _written([text for _, text in self._y.ticks])
        self._looks = [_look(k, line) for k, line in enumerate(panel.lines)]
        self.legend = self._looks + ([_MOMENT] if panel.moments else [])

    def at(self, x: float, y: float, wide: float) -> dict[str, Any]:
        """What the template draws, with the axes' upper left corner at x, y."""
        moments = self._x.place(np.array(self._panel.moments, dtype=float))
        ways = [
            (look, _way(x + wide * self._x.place(self._time), y + self._tall * (1 - self._y.place(line.values))))
            for look, line in zip(self._looks, self._panel.lines, strict=True)
        ]
        ways += [(_MOMENT, f"M{x + wide * t:.2f} {y:g}v{self._tall:g}") for t in moments]
        return {
            "x": round(x, 2),
            "y": y,
            "wide": round(wide, 2),
            "tall": self._tall,
            "title": on_one_line(self._panel.title, 90),
            "across": [(round(x + wide * t, 2), text) for t, text in self._x.ticks],
            "upward": [(round(y + self._tall * (1 - t), 2), text) for t, text in self._y.ticks],
            "curves": [{**look, "way": way} for look, way in ways],
        }


def _look(k: int, line: Line) -> dict[str, Any]:
    """Colour, width and dashes of the k-th line of a panel, and its name."""
    own = (COLORS[k % len(COLORS)], 1.9, _DASHES[(k // 3) % len(_DASHES)])
    color, width, dashes = own if line.look is None else _LOOKS[line.look]
    scaled = " ".join(f"{width * part:.3g}" for part in dashes)
    return {"color": color, "width": width, "dashes": scaled, "label": on_one_line(line.label)}


def _way(x: Array, y: Array) -> str:
    """A line through points (T,), broken where one has no place."""
    there = np.isfinite(y)
    begins = there & ~np.r_[False, there[:-1]]
    points = np.round(np.stack([x, y], axis=1)[there], 1).tolist()
    return "".join(f"{'M' if new else 'L'}{a:g} {b:g}" for new, (a, b) in zip(begins[there].tolist(), points, strict=True))
