"""A failure-tolerant workspace: its numbers, its words and its picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.printing import Rows
from holdfast.present.solvers.self_motions import ranges

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    from holdfast.reach.tolerance import TolerantWorkspace


def to_dict(region: TolerantWorkspace) -> dict[str, Any]:
    """Its size, its limits, and what the locks of each joint lose."""
    names, unit = region.arm.joint_names, region.unit.replace("^", "")
    return {
        **region.arm.entry(),
        "task": region.task.name,
        "exact": region.exact,
        "optimised": region.optimised,
        "limits": dict(zip(names, region.limits, strict=True)),
        f"size_{unit}": region.size,
        f"size_interval_{unit}": region.size_interval,
        "confidence": None if region.exact else region.confidence,
        f"healthy_size_{unit}": region.healthy_size,
        "fraction": region.share,
        "points": None if region.exact else len(region.points),
        "locked_values_per_joint": None if region.exact else region.angles,
        "lost_to": dict(zip(names, region.lost_to, strict=True)),
    }


def key_table(region: TolerantWorkspace) -> Rows:
    """The artificial limits, and what the locks of each joint lose."""
    each = zip(region.arm.joints, region.limits, region.lost_to, strict=True)
    return Rows(
        ["joint", "artificial limits", "lost by its lock"],
        [[j.name, ranges([limits], j), f"{lost:.1%}"] for j, limits, lost in each],
    )


def next_steps(region: TolerantWorkspace, name: str) -> list[str]:
    """What is reached at each point, and the whole report."""
    del region
    return [f"{name}.to_xarray()  # point by point", f'{name}.report("workspace.html")']


def show(region: TolerantWorkspace, out: Console) -> None:
    """A table of the artificial limits, and of what the locks of each joint lose."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    out.print(escape(region.describe()[0]), soft_wrap=True)
    table = Grid("joint", "artificial limits", "points lost by its lock")
    for joint, limits, lost in zip(region.arm.joints, region.limits, region.lost_to, strict=True):
        table.add_row(escape(joint.name), ranges([limits], joint), f"{lost:.1%}")
    out.print(table)
    if not region.exact:
        out.print("values between the tried ones, and configurations that were not found, are not in the interval")


def figures(region: TolerantWorkspace) -> dict[str, Figure]:
    """The region inside what the healthy arm reaches, seen along one or two directions, and the sizes."""
    from holdfast.present.stick_figure import views_of
    from holdfast.report.manifolds import RegionMap, region_figure

    maps = [
        RegionMap(
            view.of(region.points),
            view,
            region.healthy,
            region.within,
            region.inside,
            round(np.sqrt(len(region.points))) if region.exact else None,
        )
        for view in views_of(region.arm, region.points[None])
    ]
    each = region.healthy_size / max(int(region.healthy.sum()), 1)
    bars = [("healthy arm", region.healthy_size), ("artificial limits", each * float(region.within.sum()))]
    bars += [
        (f"after a lock of {name}", each * float(count))
        for name, count in zip(region.arm.joint_names, region.survives.sum(axis=0), strict=True)
    ]
    bars.append(("after any lock", region.size))
    error = np.abs(np.array(region.size_interval) - region.size)
    chosen = "limits optimised" if region.optimised else "limits given"
    caption = f"{region.describe()[0].replace(region.arm.title, region.arm.name, 1)}; {chosen}"
    unit = "area, m$^2$" if region.unit == "m^2" else "volume, m$^3$"
    return {"region": region_figure(maps, bars, unit, error, caption)}
