"""Figures of curves of stationary points and of basins. Imports matplotlib: import it where a figure is made."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.equilibria.attraction import Basins
from holdfast.equilibria.curves import Curve, Curves
from holdfast.equilibria.points import StationaryPoints
from holdfast.equilibria.system import wrapped
from holdfast.report.curves import RestLine, basin_map, curves_over, share_bars
from holdfast.simulation.errors import error_kinds, shown_errors

Array = NDArray[np.float64]

_CELLS, _TRIES = 360, 16  # of the locked value, to see where the target is within reach
_MOST_JOINTS = 3


def curves_figure(curves: Curves) -> Figure:
    """Curves of stationary points over the locked value: the error, and the other joints if they are few.

    Where the target can be reached is shaded, found by inverse kinematics in steps of a degree (or a 360th of the range).
    """
    arm, joint, system = curves.law.arm, curves.joint, curves._system
    others = [k for k in np.flatnonzero(system.healthy) if np.flatnonzero(system.healthy).size <= _MOST_JOINTS]
    shown = [*(f"{kind.text}, {kind.unit}" for kind in error_kinds(curves.law)), *(_axis(arm, k) for k in others)]

    def rows(of: Curve | StationaryPoints, some: slice | NDArray[np.bool_]) -> list[Array]:
        errors = shown_errors(curves.law, of.q[some], of.error[some], curves.target)
        return [*errors, *(_values(arm, of.q[some], k) for k in others)]

    lines = [
        RestLine(s.kind.word, _values(arm, c.q[points], joint), rows(c, points))
        for c in curves.curves
        for s in c.segments
        for points in [slice(s.first, s.last + 1)]
    ]
    loose = curves.loose
    dots = [
        RestLine(word, _values(arm, loose.q[some], joint), rows(loose, some))
        for word, some in (("degenerate", ~loose.attracting), ("sink", loose.attracting))
        if some.any()
    ]
    values, reached = _within_reach(curves)
    caption = (
        f"{arm.name}, {curves.law.name}; {arm.joint_names[joint]} locked, the controller does not know; "
        f"{len(curves)} curves from {curves.starts} starts"
        + (f", dots: {len(loose)} points sampled of surfaces" if len(loose) else "")
    )
    return curves_over(lines, dots, shown, _axis(arm, joint), (values[0], values[-1]), reached, caption)


def basins_figure(basins: Basins) -> Figure:
    """A map of the basins where the starts are a grid over two joints (Fig. 8 of Goel et al. 2005), else bars of the shares."""
    points, arm = basins.points, basins.points.law.arm
    where = ", ".join(
        f"{arm.joint_names[k]} locked at {x * arm.joints[k].shown[0]:.4g} {arm.joints[k].shown[1]}"
        for k, x in zip(points.locked, points.at, strict=True)
    )
    caption = f"{arm.name}, {points.law.name}; {where}; {len(basins.end)} starts"
    shares = basins.shares
    if basins.shape is None:
        sure = f"{caption}; lines: {100 * basins.confidence:.4g} % intervals"
        return share_bars([n for n, _ in shares], [(i.value, i.low, i.high) for _, i in shares], sure)
    first, second = basins.healthy
    codes, cells = np.unique(basins.end, return_inverse=True)
    names = [basins.name(int(c)) for c in codes]
    low, high = (f(basins.starts[:, [first, second]], axis=0) for f in (np.min, np.max))
    half = (high - low) / (np.array(basins.shape) - 1) / 2
    low, high = low - half, high + half
    scale = np.array([arm.joints[first].shown[0], arm.joints[second].shown[0]])
    left, right = low * scale, high * scale
    alone = np.flatnonzero(~points.continuum)
    x, y = (_values(arm, points.q, k).tolist() for k in (first, second))
    marks = [(points.kinds[k], x[k], y[k], f"{points.kinds[k]} {k + 1}") for k in alone]
    lines = [(_values(arm, q, first), _values(arm, q, second)) for q in basins.boundaries]
    extent = (float(left[0]), float(right[0]), float(left[1]), float(right[1]))
    return basin_map(cells.reshape(basins.shape), names, extent, marks, lines, (_axis(arm, first), _axis(arm, second)), caption)


def _within_reach(curves: Curves) -> tuple[Array, list[tuple[float, float]]]:
    """The locked values to show, in degrees or m, and the ranges of them at which the target is reached."""
    arm, joint = curves.law.arm, curves.joint
    low, high = (arm.lower[joint], arm.upper[joint]) if arm.joints[joint].prismatic else (-np.pi, np.pi)
    low, high = (low if np.isfinite(low) else -1.0), (high if np.isfinite(high) else 1.0)
    edges = np.linspace(low, high, _CELLS + 1)
    middle = np.repeat((edges[1:] + edges[:-1]) / 2, _TRIES)
    found = curves._system.reaches(middle, np.random.default_rng(0)).reshape(_CELLS, _TRIES).any(axis=1)
    changes = np.flatnonzero(np.diff(np.r_[0, found.astype(int), 0]))
    shown = edges * arm.joints[joint].shown[0]
    return shown, [(float(shown[a]), float(shown[b])) for a, b in zip(changes[::2], changes[1::2], strict=True)]


def _values(arm: Arm, q: Array, k: int | np.intp) -> Array:
    """Values of one joint, in degrees from -180 to 180, or m."""
    return np.asarray(wrapped(arm, q)[:, k] * arm.joints[k].shown[0])


def _axis(arm: Arm, k: int | np.intp) -> str:
    return f"{arm.joint_names[k]}, {arm.joints[k].shown[1]}"
