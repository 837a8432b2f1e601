"""Pictures of self-motion manifolds and of the failure-tolerant workspace."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import as_task, plane_normal
from holdfast.convergence.table import axis_label
from holdfast.report.manifolds import JointPanel, Projection, RegionMap, region_figure, self_motion_figure
from holdfast.solvers.self_motions import SelfMotion

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.reach.bounds import Arcs
    from holdfast.reach.tolerance import TolerantWorkspace

Array = NDArray[np.float64]

_CURVES = 6  # the longest ones are drawn
_CONFIGURATIONS = 6


def self_motion_picture(arm: Arm, motion: SelfMotion, arcs: list[Arcs]) -> Figure:
    """Joint values along the curves with the ranges of the joints, and the arm in a few of the configurations."""
    low, high = finite_limits(arm)
    factors = np.array([j.shown[0] for j in arm.joints])
    panels = [
        JointPanel(f"{j.name}, {j.shown[1]}", [(f * a, f * b) for a, b in found], (f * x, f * y))
        for j, f, found, x, y in zip(arm.joints, factors, arcs, low, high, strict=True)
    ]
    longest = sorted(motion.components, key=lambda c: -c.length)[:_CURVES]
    curves = []
    for c in longest:
        steps = np.linalg.norm(np.diff(c.q, axis=0), axis=1)
        curves.append((np.concatenate([[0.0], np.cumsum(steps)]), factors * c.q))
    chosen = motion.q[:1]
    if longest:
        q = longest[0].q
        chosen = q[np.linspace(0, len(q) - 1, _CONFIGURATIONS + longest[0].closed).astype(int)[:_CONFIGURATIONS]]
    elif len(motion.q):
        chosen = motion.q[np.linspace(0, len(motion.q) - 1, _CONFIGURATIONS).astype(int)]
    chains = arm.frames(chosen)[..., :3, 3]
    views = (
        [Projection(chains @ np.array(directions).T, labels, title) for directions, labels, title in _views(arm)]
        if len(chosen)
        else []
    )
    drawn = f"; the {_CURVES} longest curves are drawn" if len(motion.components) > _CURVES else ""
    caption = f"{arm.name}, task {motion.task.name}: {motion.describe()}{drawn}"
    return self_motion_figure(panels, curves, views, caption)


def _views(arm: Arm) -> list[tuple[Array, tuple[str, str], str]]:
    """Directions (2, 3) to the right and up, labels and title of each view."""
    if plane_normal(arm) is not None:
        rows = as_task(arm, "planar").rows[:, :3]
        return [(rows, (axis_label(rows[0]), axis_label(rows[1])), "In the plane of the arm")]
    x, y, z = np.eye(3)
    return [(np.array([x, z]), ("x, m", "z, m"), "From the side"), (np.array([x, y]), ("x, m", "y, m"), "From above")]


def region_picture(region: TolerantWorkspace) -> Figure:
    """The region inside what the healthy arm reaches, seen along one or two directions, and the sizes."""
    maps = [
        RegionMap(
            region.points @ np.array(directions).T,
            region.healthy,
            region.within,
            region.inside,
            round(np.sqrt(len(region.points))) if region.exact else None,
            labels,
            title,
        )
        for directions, labels, title in _views(region.arm)
    ]
    each = region.healthy_size / max(int(region.healthy.sum()), 1)
    bars = [("healthy arm", region.healthy_size), ("artificial limits", each * float(region.within.sum()))]
    bars += [
        (f"after a lock of {name}", each * float(count))
        for name, count in zip(region.arm.joint_names, region.survives.sum(axis=0), strict=True)
    ]
    bars.append(("after any lock", region.size))
    error = np.abs(np.array(region.size_interval) - region.size)
    chosen = "limits looked for" if region.optimised else "limits given"
    caption = f"{region.arm.name}, task {region.task.name}, {chosen}: {region.describe()}"
    unit = "area, m$^2$" if region.unit == "m^2" else "volume, m$^3$"
    return region_figure(maps, bars, unit, error, caption)
