"""A motion in MuJoCo on which a joint fails, and two ways in which it ends, side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

import holdfast as hf
from holdfast.interface.report.palette import BLUE, INK, ORANGE
from holdfast.interface.report.views import View
from tools.loops.film import Shot, caption, figure, picture
from tools.loops.solid import Triangles, arm_bodies, cell_bodies, draw, moved

Array = NDArray[np.float64]

BARE, WOOD, HELD = "#c9d1d8", "#dccba4", "#4a90c4"
FRAMES = 8.3  # pictures a second, at the speed of the motion
PAUSE, END = 1800, 3000  # ms


def seen_from(around: float, above: float) -> View:
    """From a direction in degrees: about z from x, and up from the level."""
    a, e = np.deg2rad([around, above])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    toward = np.array([np.cos(a) * np.cos(e), np.sin(a) * np.cos(e), np.sin(e)])
    return View(right, np.cross(toward, right), "from the front")


@dataclass(frozen=True)
class Side:
    """What one half of the picture shows.

    Attributes:
        runs: One after the other, of :class:`holdfast.Execution` or :class:`holdfast.FaultRun`.
        name: What is said above it from the lock on.
        state: What is said below that, of a row of a run.
    """

    runs: Sequence[Any]
    name: str
    state: Callable[[Any, int], str]

    @property
    def duration(self) -> float:
        """S."""
        return sum(float(run.time[-1]) for run in self.runs)

    def at(self, t: float) -> tuple[int, int]:
        """Which run, and which of its rows, is on at a time, s."""
        for k, run in enumerate(self.runs[:-1]):
            if t < run.time[-1]:
                return k, int(np.searchsorted(run.time, t))
            t -= float(run.time[-1])
        last = self.runs[-1]
        return len(self.runs) - 1, min(int(np.searchsorted(last.time, t)), len(last.time) - 1)


@dataclass(frozen=True)
class Stage:
    """Everything that stands still.

    Attributes:
        view: From where it is seen.
        limits: Left, right, bottom and top of what is seen, m.
        cell: The objects; the first lies under all others.
        joint: The joint that fails, by name.
        carried: What the tool carries, triangles in the frame of the tool.
        goal: (3,) where the tool point should get to, m.
        label: Right end of the words that name the joint, as fractions of the half.
        fault: What these words say of it.
    """

    view: View
    limits: tuple[float, float, float, float]
    cell: hf.Cell
    joint: str
    carried: Triangles
    goal: Array
    label: tuple[float, float] = (0.98, 0.72)
    fault: str = "locked"

    def shots(self, sides: Sequence[Side], said: Callable[[float], str], *, fails: float | None = None) -> Iterator[Shot]:
        """Both sides at the same instants; a pause when the joint fails, and one at the end.

        Args:
            sides: The halves.
            said: Below, at each time, s.
            fails: When the joint fails, s; of an execution that locks it then if not given.
        """
        arm = sides[0].runs[0].arm
        k = arm.joint_index(self.joint)
        lock = float(sides[0].runs[0].lock_time[k]) if fails is None else fails
        bodies, around = arm_bodies(arm), cell_bodies(self.cell)
        end = max(side.duration for side in sides)
        instants = np.unique(np.r_[np.arange(0, end, 1 / FRAMES), lock, end])
        drawn = figure()
        for t in instants:
            drawn.clear()
            for n, side in enumerate(sides):
                axes = drawn.add_axes((0.005 + 0.5 * n, 0.14, 0.49, 0.72))
                which, row = side.at(float(t))
                run = side.runs[which]
                frames = arm.frames(run.q[row])
                failed = t >= lock
                solids = [(moved(body, frames[j]), ORANGE if failed and j == k + 1 else BARE) for j, body in bodies]
                solids += [(body, WOOD) for body in around[1:]]
                solids += [(moved(self.carried, frames[-1]), HELD)]
                draw(axes, self.view, [(around[0], WOOD)])
                draw(axes, self.view, solids)
                self._marks(axes, [*(r.poses[:, :3, 3] for r in side.runs[:which]), run.poses[: row + 1, :3, 3]])
                if failed:
                    shown = next(moved(body, frames[j]) for j, body in bodies if j == k + 1)
                    line = {"arrowstyle": "-", "color": ORANGE, "linewidth": 2, "relpos": (0.2, 0.0)}
                    options = {"xytext": self.label, "textcoords": "axes fraction", "ha": "right", "arrowprops": line}
                    words = {"fontsize": 16, "color": ORANGE, "weight": "bold"}
                    axes.annotate(f"joint {k + 1} {self.fault}", self.view.project(shown.mean(axis=(0, 1))), **options, **words)
                axes.set(xlim=self.limits[:2], ylim=self.limits[2:], aspect="equal")
                axes.axis("off")
                name = side.name if failed else "healthy"
                axes.set_title(f"{name}\n{side.state(run, row)}", fontsize=17, weight="bold", color=INK)
            ms = END if t == end else PAUSE if t == lock else round(1000 / FRAMES)
            yield caption(picture(drawn), said(float(t)), size=20), ms

    def _marks(self, axes: Axes, ways: Sequence[Array]) -> None:
        """The way of the tool so far, and where it should get to."""
        for way in ways:
            axes.plot(*self.view.project(way).T, color=BLUE, linewidth=3)
        ring = self.view.project(self.goal)
        axes.plot(*ring, "o", fillstyle="none", color=INK, markersize=24, markeredgewidth=3)
        axes.plot(*self.view.project(ways[-1][-1]), "D", color=BLUE, markersize=9, markeredgecolor="white")
