"""Text, tables, JSON, and figure of a failure-tolerant workspace."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.interface.presentation.solvers.self_motion import format_ranges

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    from holdfast.kinematics.workspace.tolerance import TolerantWorkspace


def to_dict(region: TolerantWorkspace) -> dict[str, Any]:
    """Return the size of the workspace, its limits, and the losses by the locks of each joint."""
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


def key_table(region: TolerantWorkspace) -> TextTable:
    """Tabulate the artificial limits, and the losses by the locks of each joint."""
    joint_rows = zip(region.arm.joints, region.limits, region.lost_to, strict=True)
    return TextTable(
        ["joint", "artificial limits", "lost by its lock"],
        [[joint.name, format_ranges([limits], joint), format_percent(loss)] for joint, limits, loss in joint_rows],
    )


def story(region: TolerantWorkspace) -> PageContent:
    """Compose the report: the workspace that remains after any lock, and the lock that costs most."""
    unit, losses = region.unit.replace("^2", "²").replace("^3", "³"), np.nan_to_num(region.lost_to)
    worst_joint, names = int(losses.argmax()), region.arm.joint_names
    limits = "Under the limits that were found" if region.optimised else "Under the artificial limits"
    if not region.healthy_size:
        answer = "The healthy arm reaches none of the points that were tried, so there is nothing to compare."
    elif not region.within.any():
        answer = (
            f"{limits} the arm reaches no point even before a joint locks, of "
            f"{format_significant(region.healthy_size)} {unit} within its own."
        )
    elif not region.inside.any():
        loss_text = f"the locks of {names[worst_joint]} alone lose {format_percent(losses[worst_joint])} of the points"
        answer = f"{limits} no point is kept through every lock: {loss_text}."
    else:
        answer = (
            f"{limits} the arm keeps {format_significant(region.size)} {unit}, {format_percent(region.share)} of "
            f"its workspace, wherever any single joint locks"
        )
        answer += (
            f"; the locks of {names[worst_joint]} take most, {format_percent(losses[worst_joint])} of the points."
            if losses[worst_joint]
            else "."
        )
    facts = []
    if region.inside.any():
        lower, upper = region.size_interval
        interval_text = (
            ""
            if region.exact
            else f"; {format_significant(lower)} to {format_significant(upper)}, {100 * region.confidence:.4g} %"
        )
        facts = [
            (format_percent(region.share), "of the workspace is kept wherever a joint locks"),
            (
                f"{format_significant(region.size)} {unit}",
                f"of {format_significant(region.healthy_size)} {unit}{interval_text}",
            ),
        ]
    if losses[worst_joint] and region.within.any():
        facts.append(
            (
                format_percent(losses[worst_joint]),
                f"of the points within the artificial limits are lost to locks of {names[worst_joint]}",
            )
        )
    sampling_text = (
        f"{len(region.points):,} points, {region.angles} locked values of each joint; values between them are not tried"
    )
    return PageContent(
        f"What {region.arm.name} reaches before and after any lock",
        answer,
        about=f"Task {region.task.describe()}, limits {'optimised' if region.optimised else 'given'}",
        facts=facts,
        figures={
            "region": (
                "Where it is, and what each lock leaves",
                (
                    "Points that the healthy arm reaches, those within the artificial limits, and those "
                    "that are kept wherever any joint locks; right: the sizes, with what is left "
                    "after the locks of each joint alone."
                ),
            )
        },
        tables=[key_table(region)],
        method=[
            (
                "Kept",
                (
                    "a point that the arm reaches within the artificial limits, and still reaches "
                    "wherever in them any one joint locks"
                ),
            ),
            ("Region", "in closed form for each radius" if region.exact else sampling_text),
            ("Limits", "optimised for the largest region" if region.optimised else "given, or the arm's own"),
        ],
        arm=region.arm,
    )


def show(region: TolerantWorkspace, out: Console) -> None:
    """Print a table of the artificial limits, and of the losses by the locks of each joint."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    out.print(escape(region.describe()[0]), soft_wrap=True)
    table = BandedTable("joint", "artificial limits", "points lost by its lock")
    for joint, limits, loss in zip(region.arm.joints, region.limits, region.lost_to, strict=True):
        table.add_row(escape(joint.name), format_ranges([limits], joint), format_percent(loss))
    out.print(table)
    if not region.exact:
        out.print("values between the tried ones, and configurations that were not found, are not in the interval")


def figures(region: TolerantWorkspace) -> dict[str, Figure]:
    """Draw the region inside the workspace of the healthy arm, from one or two directions, and the sizes."""
    from holdfast.interface.presentation.stick_figure import choose_views
    from holdfast.interface.report.manifolds import RegionMap, region_figure

    maps = [
        RegionMap(
            view.project(region.points),
            view,
            region.healthy,
            region.within,
            region.inside,
            round(np.sqrt(len(region.points))) if region.exact else None,
        )
        for view in choose_views(region.arm, region.points[None])
    ]
    size_per_point = region.healthy_size / max(int(region.healthy.sum()), 1)
    bars = [("healthy arm", region.healthy_size), ("artificial limits", size_per_point * float(region.within.sum()))]
    bars += [
        (f"after a lock of {name}", size_per_point * float(count))
        for name, count in zip(region.arm.joint_names, region.survives.sum(axis=0), strict=True)
    ]
    bars.append(("after any lock", region.size))
    error = np.abs(np.array(region.size_interval) - region.size)
    limits_text = "limits optimised" if region.optimised else "limits given"
    caption = f"{region.describe()[0].replace(region.arm.title, region.arm.name, 1)}; {limits_text}"
    unit = "area, m$^2$" if region.unit == "m^2" else "volume, m$^3$"
    return {"region": region_figure(maps, bars, unit, error, caption)}
