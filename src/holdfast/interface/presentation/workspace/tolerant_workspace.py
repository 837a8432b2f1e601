"""Presentation of a failure-tolerant workspace."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import format_number, format_percent
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import choose_views
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Presentation, TableSpec
from holdfast.interface.presentation.solvers.self_motion import format_ranges
from holdfast.interface.report.palette import BLUE, EMPTY_COLOR, INK, SKY
from holdfast.interface.report.views import View
from holdfast.kinematics.workspace.tolerance import TolerantWorkspace


def to_dict(region: TolerantWorkspace) -> dict[str, Any]:
    """Return the size of the workspace, the joint limits, and the loss by the locks of each joint, as JSON data."""
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


def present(region: TolerantWorkspace) -> Presentation:
    """Present the workspace that remains reachable after any single lock, and the joint whose locks lose most."""
    unit, losses = region.unit.replace("^2", "²").replace("^3", "³"), np.nan_to_num(region.lost_to)
    worst_joint, is_kept = int(losses.argmax()), bool(region.inside.any())
    facts = [
        Fact("failure-tolerant workspace", region.size, unit, phrase="stay reachable wherever a joint locks" * is_kept),
        Fact("healthy workspace", region.healthy_size, unit, phrase="workspace of the healthy arm" * is_kept),
    ]
    if is_kept:
        facts.insert(
            0, Fact("", region.share, phrase="of the workspace stays reachable wherever a joint locks", style="percent")
        )
    sampling_text = f"{len(region.points):,} points, {region.angles} locked values per joint"
    facts.append(Fact("computation", "in closed form for each radius" if region.exact else sampling_text))
    if not region.exact:
        label = f"{100 * region.confidence:.4g} % interval of the size"
        facts.append(Fact(label, tuple(map(float, region.size_interval)), unit))
    if losses[worst_joint] and region.within.any():
        phrase = (
            f"of the points reached within the artificial limits are lost by locks of {region.arm.joint_names[worst_joint]}"
        )
        facts.append(Fact("", losses[worst_joint], phrase=phrase, style="percent"))
    caption = (
        "Points that the healthy arm reaches, points that it reaches within the artificial limits, and points that stay "
        "reachable wherever a joint locks. Right: their sizes, and the size that remains after the locks of each joint alone."
    )
    columns: list[Column] = ["joint", "artificial limits", Header("points lost by its locks", style="percent")]
    joint_rows = zip(region.arm.joints, region.limits, region.lost_to, strict=True)
    return Presentation(
        f"Failure-tolerant workspace of {region.arm.name}",
        _compose_answer(region),
        about=f"Arm {region.arm.title}, task {region.task.describe()}, limits {'optimised' if region.optimised else 'given'}",
        lines=[]
        if region.exact
        else ["The interval does not account for lock values between the tested ones, nor for configurations not found."],
        facts=facts,
        tables=[
            TableSpec(
                "Artificial joint limits, and points lost by the locks of each joint",
                columns,
                [(joint.name, format_ranges([limits], joint), loss) for joint, limits, loss in joint_rows],
            )
        ],
        figures={"region": FigureSpec(partial(_draw_figure, region), "Region, and remaining size after each lock", caption)},
        method=[
            (
                "Failure-tolerant",
                "a point that the arm reaches within the artificial limits, and still reaches after a lock of any one joint at "
                "any position within its limits",
            ),
            ("Limits", "optimised for the largest region" if region.optimised else "given, or those of the arm"),
        ],
        arm=region.arm,
    )


def _compose_answer(region: TolerantWorkspace) -> str:
    unit, losses = region.unit.replace("^2", "²").replace("^3", "³"), np.nan_to_num(region.lost_to)
    worst_joint, names = int(losses.argmax()), region.arm.joint_names
    limits = "With the optimised joint limits" if region.optimised else "With the artificial joint limits"
    if not region.healthy_size:
        return "The healthy arm reaches none of the sampled points."
    if not region.within.any():
        return (
            f"{limits} the arm reaches no point even before a joint locks; with its own limits it reaches "
            f"{format_number(region.healthy_size, 4)} {unit}."
        )
    if not region.inside.any():
        loss_text = f"locks of {names[worst_joint]} alone lose {format_percent(losses[worst_joint])} of the points"
        return f"{limits} no point found stays reachable after every lock; {loss_text}."
    answer = (
        f"{limits}, {format_number(region.size, 4)} {unit} of {format_number(region.healthy_size, 4)} {unit}, "
        f"{format_percent(region.share)} of the workspace, stay reachable wherever any single joint locks"
    )
    if losses[worst_joint]:
        answer += f"; locks of {names[worst_joint]} lose most, {format_percent(losses[worst_joint])} of the points"
    return f"{answer}."


def _draw_figure(region: TolerantWorkspace) -> report.Figure:
    """Draw the region inside the workspace of the healthy arm, from one or two directions, and the sizes."""
    views = choose_views(region.arm, region.points[None])
    size_per_point = region.healthy_size / max(int(region.healthy.sum()), 1)
    sizes = {"healthy arm": region.healthy_size, "artificial limits": size_per_point * float(region.within.sum())}
    for name, count in zip(region.arm.joint_names, region.survives.sum(axis=0), strict=True):
        sizes[f"after a lock of {name}"] = size_per_point * float(count)
    sizes["after any lock"] = region.size
    lower, upper = region.size_interval
    entries = ((EMPTY_COLOR, "healthy, own limits"), (SKY, "healthy, artificial limits"), (BLUE, "after any single lock"))
    with report.styled_figure(report.WIDTH_IN, 4.6) as figure:
        panels = figure.subplots(1, len(views) + 1, width_ratios=[1.0] * len(views) + [0.9 if len(views) > 1 else 1.1])
        for axes, view in zip(panels, views, strict=False):
            _draw_map(axes, region, view)
        axes, last = panels[-1], len(sizes) - 1
        axes.barh(range(len(sizes)), list(sizes.values()), height=0.64, color=[EMPTY_COLOR, *[SKY] * (last - 1), BLUE])
        errors = np.abs(np.array([[lower], [upper]]) - region.size)
        axes.errorbar(region.size, last, xerr=errors, color=INK, capsize=3, linewidth=1)
        ends = [*list(sizes.values())[:-1], region.size + float(errors[1, 0])]
        report.label_bars(axes, list(sizes), ends, texts=[f"{size:.3g}" for size in sizes.values()], max_letters=30)
        unit = "area, m$^2$" if region.unit == "m^2" else "volume, m$^3$"
        axes.set(xlabel=unit, xlim=(0, max(sizes.values()) * 1.2 or 1.0), title="Size")
        handles = [report.Patch(facecolor=color, label=label) for color, label in entries]
        figure.legend(handles=handles, loc="outside upper left", ncols=3)
        method = "in closed form for each radius"
        if not region.exact:
            method = f"{len(region.points)} points, {region.angles} locked values per joint, {region.confidence:.0%} interval "
            method += f"{lower:.3g} to {upper:.3g}"
        caption = (
            f"{region.arm.name}, task {region.task.name}: {region.size:.4g} {region.unit} of {region.healthy_size:.4g} "
            f"{region.unit} ({method}); limits {'optimised' if region.optimised else 'given'}"
        )
        figure.supxlabel(report.format_label(caption, 220), fontsize=9, color=report.SOFT)
    return figure


def _draw_map(axes: report.Axes, region: TolerantWorkspace, view: View) -> None:
    """Draw the points of the three nested sets: areas if the points are a square grid, otherwise dots."""
    x, y = view.project(region.points).T
    edge = round(np.sqrt(len(region.points)))
    for chosen, color in ((region.healthy, EMPTY_COLOR), (region.within, SKY), (region.inside, BLUE)):
        if not region.exact:
            axes.scatter(x[chosen], y[chosen], s=9, c=color, linewidths=0)
        elif chosen.any():
            grids = [values.reshape(edge, edge).astype(float) for values in (x, y, chosen)]
            axes.contourf(*grids, levels=[0.5, 1.5], colors=[color])
    axes.plot(0, 0, marker="s", color=INK, markersize=6)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel=view.names[0], ylabel=view.names[1], title=view.title)
