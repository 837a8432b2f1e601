"""Presentation of a reachability map."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from holdfast.core.formatting import format_number, format_percent
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import build_view_section, choose_views
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Presentation, TableSpec
from holdfast.interface.report.page import Section
from holdfast.interface.report.views import View
from holdfast.kinematics.workspace.reachability import ReachabilityMap

_MAX_VIEW_POINTS = 4000  # points of the 3-D view
_PANELS_PER_ROW = 4


def present(reachability: ReachabilityMap) -> Presentation:
    """Present the size of the workspace, the reachability index, and the joint whose lock reduces the index most."""
    arm, count, remaining = reachability.arm, reachability.lock_values.shape[1], reachability.harmless_locks
    unit, cells = ("m²", "square cells") if reachability.is_planar else ("m³", "cubic cells")
    lock_text = "at the given values" if count == 1 else f"at {count} values of its range"
    index, remaining_index = reachability.index, reachability.locked_index.sum(axis=0) / reachability.index.sum()
    worst = int(remaining_index.argmin())
    columns: list[Column] = [
        Header("locked joint", key="joint"),
        Header("directions that remain", style="percent", key="index"),
        Header("cells that remain", style="percent", key="cells"),
        Header("cells that remain for all values", style="percent", key="cells_always"),
        Header("found only by second half of samples", style="percent", key="growth"),
    ]
    fractions = (remaining_index, remaining.mean(axis=0), (remaining == 1).mean(axis=0), reachability.growth)
    rows = list(zip(arm.joint_names, *fractions, strict=True))
    caption = (
        "Fraction of the tool directions that are reached in each cell, for the intact arm and after a lock of each joint "
        f"{lock_text}" + ("." if count == 1 else ", as the mean over these values.")
    )
    return Presentation(
        f"Reachability map of {arm.name}",
        f"{arm.name} reaches {format_number(reachability.size, 4)} {unit}, on average in {format_percent(float(index.mean()))} "
        f"of {reachability.directions} tool directions; a lock of {arm.joint_names[worst]} ({lock_text}) leaves "
        f"{format_percent(float(remaining_index[worst]))} of these directions, the fewest of all joints.",
        about=f"Arm {arm.title}; {len(index):,} {cells} with edges of {1e3 * reachability.cell_size:.3g} mm",
        lines=["All counts are lower bounds, because a direction counts only if a sample reached it. Collisions are ignored."],
        facts=[
            Fact("workspace", reachability.size, unit, phrase="reached by the intact arm", key="size"),
            Fact("mean reachability index", index.mean(), phrase="of the tool directions", style="percent", key="mean_index"),
            Fact("samples for the intact arm, and for each lock value", reachability.samples, key="samples"),
        ],
        tables=[TableSpec(f"Locks of each joint {lock_text}, compared with the intact arm", columns, rows, key="locks")],
        figures={
            ("plane" if reachability.is_planar else view.title.split()[0].lower()): FigureSpec(
                partial(_draw_layer, reachability, view), "Reachability index", caption
            )
            for view in choose_views(arm, reachability.centers)
        },
        sections=partial(_build_sections, reachability),
        method=[
            ("Directions", f"{reachability.directions} parts of equal size of the circle or sphere of the tool's direction"),
            ("Source", "reachability index of Zacharias et al. 2007, counted with samples of forward kinematics"),
        ],
        arm=arm,
        exports={"reachability.npz": reachability.to_npz},
    )


def _draw_layer(reachability: ReachabilityMap, view: View) -> report.Figure:
    """Draw the layer of cells, perpendicular to the direction of view, with the largest number of reached cells."""
    points, size = view.project(reachability.centers), reachability.cell_size
    depth = reachability.centers @ np.cross(view.right, view.up)
    _, layer_of_cell, layer_sizes = np.unique(np.round(depth, 9), return_inverse=True, return_counts=True)
    shown = layer_of_cell == layer_sizes.argmax()
    points = points[shown]
    cells = np.rint((points - points.min(axis=0)) / size).astype(np.intp)
    axes = [low + size * np.arange(count + 1) for low, count in zip(points.min(axis=0), cells.max(axis=0), strict=True)]
    values = np.column_stack([reachability.index, reachability.locked_index])[shown]
    empty = -values.shape[1] % min(_PANELS_PER_ROW, values.shape[1])
    values = np.pad(np.where(values > 0, values, np.nan), ((0, 0), (0, empty)), constant_values=np.nan)
    rows = np.split(values, range(_PANELS_PER_ROW, values.shape[1], _PANELS_PER_ROW), axis=1)
    return report.place_maps(
        report.Plane(points=points, labels=view.names, cells=cells, axes=(axes[0], axes[1])),
        {" " * row: panels for row, panels in enumerate(rows)},
        ["intact", *reachability.arm.joint_names],
        label="reached fraction of directions",
        caption=f"{reachability.arm.name}, {view.title.lower()}, layer with the most cells ({1e3 * size:.3g} mm). Titles: "
        f"locked joint. {reachability.samples:,} samples for the intact arm and for each lock value. Grey: not reached.",
        most=1.0,
    )


def _build_sections(reachability: ReachabilityMap) -> Sequence[Section]:
    """Build the interactive view of one half of the cells."""
    half = np.flatnonzero(reachability.centers[:, 1] >= np.median(reachability.centers[:, 1]))
    half = half[:: -(-len(half) // _MAX_VIEW_POINTS)]
    colors = 255 * report.Scale(0.0, 1.0).colors(reachability.index[half])[:, :3]
    caption = "Cells that the intact arm reaches, cut open: bright cells are reached in more tool directions."
    points = reachability.centers[half]
    return [build_view_section("The reachable cells", reachability.arm, None, caption, points=points, colors=colors)]
