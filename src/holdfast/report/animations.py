"""A stick figure that moves, for a page: inline SVG with a few lines of JavaScript, without network.

Without JavaScript, and on paper, the first, middle and last positions are seen.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from holdfast.notice import another
from holdfast.report.page import environment
from holdfast.report.scales import round_numbers
from holdfast.report.views import View

Array = NDArray[np.float64]

_WIDE = 460.0  # pixels of a view beside another
_ALONE = 560.0
_MARGIN = (46.0, 30.0, 14.0, 38.0)  # pixels left, above, right and below


@dataclass(frozen=True)
class Motion:
    """A chain of links over time.

    Attributes:
        time: (F,) s, evenly spaced.
        chain: (F, K, 3) corners of the chain, base first and tool last, m.
        square: (K,) corners drawn as squares.
        path: (P, 3) where the tool was to be, m.
        readings: (F,) a short text for each frame.
        marked: (F, K) corners between base and tool that are drawn filled, or None.
        goal: (3,) a place marked by a ring, m, or None.
    """

    time: Array
    chain: Array
    square: NDArray[np.bool_]
    path: Array
    readings: Sequence[str]
    marked: NDArray[np.bool_] | None = None
    goal: Array | None = None


def animation(motion: Motion, views: Sequence[View], name: str, about: str) -> Markup:
    """The motion as HTML: views side by side, a button, a slider and a reading.

    Args:
        motion: What moves.
        views: One drawing each, all to one scale.
        name: Unique in the page; ids begin with it.
        about: What it shows, for people who cannot see it.
    """
    width = _WIDE if len(views) > 1 else _ALONE
    goal = np.zeros((0, 3)) if motion.goal is None else motion.goal[None]
    everything = np.concatenate([motion.chain.reshape(-1, 3), motion.path, goal])
    flat = [view.of(everything).T for view in views]
    span = max(float(np.ptp(x)) for x, _ in flat) * 1.1 or 1.0
    tall = max(float(np.ptp(y)) for _, y in flat) * 1.1
    left, above, right, below = _MARGIN
    # Drawings are never taller than wide.
    scale = min((width - left - right) / span, (width - above - below) / max(tall, 1e-9))
    height = above + below + max(tall * scale, 120.0)
    panels = []
    for view, (x, y) in zip(views, flat, strict=True):
        middle = np.array([(x.min() + x.max()) / 2, (y.min() + y.max()) / 2])
        center = np.array([left + (width - left - right) / 2, above + (height - above - below) / 2])

        def place(points: Array, view: View = view, middle: Array = middle, center: Array = center) -> Array:
            return np.asarray(np.round(center + (view.of(points) - middle) * [scale, -scale], 1))

        frames = place(motion.chain)
        panels.append(
            {
                "title": view.title,
                "names": view.names,
                "frames": frames,
                "path": _points(place(motion.path)),
                "goal": place(goal).tolist(),
                "ghosts": [_points(frames[k]) for k in (len(frames) // 2, -1)],
                "first": _points(frames[0]),
                "nodes": frames[0].tolist(),
                "across": round_numbers(middle[0] - (center[0] - left) / scale, middle[0] + (center[0] - left) / scale, 6),
                "upward": round_numbers(middle[1] - (center[1] - above) / scale, middle[1] + (center[1] - above) / scale, 5),
                "x": lambda t, middle=middle, center=center: round(float(center[0] + (t - middle[0]) * scale), 1),
                "y": lambda t, middle=middle, center=center: round(float(center[1] - (t - middle[1]) * scale), 1),
            }
        )
    marked = np.zeros(motion.chain.shape[:2], dtype=bool) if motion.marked is None else motion.marked
    data = {
        "seconds": shown_seconds(motion.time),
        "frames": [p["frames"].tolist() for p in panels],
        "readings": list(motion.readings),
        "marked": [np.flatnonzero(row).tolist() for row in marked],
    }
    another("figure")
    return Markup(
        environment()
        .get_template("animation.html")
        .render(
            panels=panels,
            name=name,
            about=about,
            width=width,
            height=round(height, 1),
            frame=(left, above, width - right, round(height - below, 1)),
            square=motion.square.tolist(),
            marked=marked[0].tolist(),
            readings=motion.readings,
            last=len(motion.time) - 1,
            # Inside a script nothing is escaped, so nothing may end it.
            data=Markup(json.dumps(data, separators=(",", ":")).replace("</", "<\\/")),
        )
    )


def shown_seconds(time: Array) -> float:
    """Seconds in which a motion is played: as it is, but not shorter than can be followed or longer than one will wait."""
    return float(np.clip(time[-1] - time[0], 3.0, 20.0))


def _points(flat: Array) -> str:
    return " ".join(f"{x:g},{y:g}" for x, y in flat)
