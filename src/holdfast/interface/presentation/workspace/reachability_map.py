"""Presentation of a reachability map."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import format_number, format_percent
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Header, Presentation, TableSpec

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.figure import Figure

    from holdfast.interface.report.page import Section
    from holdfast.kinematics.workspace.reachability import ReachabilityMap

_MAX_VIEW_POINTS = 4000  # points of the 3-D view


def to_dict(reachability: ReachabilityMap) -> dict[str, Any]:
    """Return the size of the workspace, the mean reachability index, and both after a lock of each joint, as JSON data."""
    return {
        **reachability.arm.entry(),
        "cell_size_m": reachability.cell_size,
        "cells": len(reachability.centers),
        "directions": reachability.directions,
        "samples": reachability.samples,
        "size_m2" if reachability.is_planar else "size_m3": reachability.size,
        "mean_index": reachability.index.mean(),
        "locks": [
            {"joint": name, "values": values, "index": index, "cells": cells, "cells_always": always, "growth": growth}
            for name, values, index, cells, always, growth in _list_locks(reachability)
        ],
    }


def _list_locks(reachability: ReachabilityMap) -> list[tuple[Any, ...]]:
    """List joint, lock values, and fractions of the healthy arm's index, of its cells, and of its cells after every lock."""
    return list(
        zip(
            reachability.arm.joint_names,
            reachability.lock_values,
            reachability.locked_index.sum(axis=0) / reachability.index.sum(),
            reachability.harmless_locks.mean(axis=0),
            (reachability.harmless_locks == 1).mean(axis=0),
            reachability.growth,
            strict=True,
        )
    )


def present(reachability: ReachabilityMap) -> Presentation:
    """Present the size of the workspace, the reachability index, and the joint whose lock reduces the index most."""
    arm, count = reachability.arm, reachability.lock_values.shape[1]
    unit, cell = ("m²", "squares") if reachability.is_planar else ("m³", "cubes")
    locks = _list_locks(reachability)
    worst_joint, _, worst_index, *_ = min(locks, key=lambda lock: float(lock[2]))
    lock_text = "at the given values" if count == 1 else f"at {count} values of its range"
    answer = (
        f"{arm.name} reaches {format_number(reachability.size, 4)} {unit}, on average in "
        f"{format_percent(float(reachability.index.mean()))} of {reachability.directions} tool directions; a lock of "
        f"{worst_joint} ({lock_text}) leaves {format_percent(worst_index)} of these directions, the fewest of all joints."
    )
    caption = (
        "Fraction of the tool directions that are reached in each cell of one layer, for the intact arm and "
        f"after a lock of each joint {lock_text}" + ("." if count == 1 else ", as the mean over these values.")
    )
    columns = [
        Header("joint", "locked joint"),
        Header("index", "directions that remain", style="percent"),
        Header("cells", "cells that remain", style="percent"),
        Header("always", "cells that remain for all values", style="percent"),
        Header("growth", "found only by second half of samples", style="percent"),
    ]
    rows = [(name, *numbers) for name, _, *numbers in locks]
    table = TableSpec(f"Locks of each joint {lock_text}, compared with the intact arm", columns, rows)
    return Presentation(
        f"Reachability map of {arm.name}",
        answer,
        about=f"Arm {arm.title}; {len(reachability.centers):,} {cell} with edges of {1e3 * reachability.cell_size:.3g} mm",
        lines=[
            "All counts are lower bounds, because a direction counts only if a sample reached it. Self-collision is ignored."
        ],
        facts=[
            Fact("workspace", reachability.size, unit, phrase="reached by the intact arm"),
            Fact(
                "mean reachability index",
                reachability.index.mean(),
                phrase="of the tool directions, on average over the cells",
                style="percent",
            ),
            Fact("samples for the intact arm, and for each lock value", reachability.samples),
        ],
        tables=[table],
        figures={
            name: FigureSpec(partial(_draw_layer, reachability, name), "Reachability index", caption)
            for name in (["plane"] if reachability.is_planar else ["side", "top"])
        },
        sections=partial(_build_sections, reachability),
        method=[
            ("Directions", f"{reachability.directions} parts of equal size of the circle or sphere of the tool's direction"),
            ("Lock values", lock_text),
            ("Source", "reachability index of Zacharias et al. 2007, counted with samples of forward kinematics"),
        ],
        arm=arm,
        exports={"reachability.npz": reachability.to_npz},
    )


def _draw_layer(reachability: ReachabilityMap, name: str) -> Figure:
    """Draw the layer of cells with the largest number of reached cells, seen from the side or from above."""
    from holdfast.interface.presentation.arm.view import choose_views
    from holdfast.interface.report.places import Plane, panel_maps

    views = choose_views(reachability.arm, reachability.centers)
    view = views[min(["side", "top"].index(name), len(views) - 1) if name != "plane" else 0]
    points, depth = view.project(reachability.centers), reachability.centers @ np.cross(view.right, view.up)
    _, layer_of_cell, sizes = np.unique(np.round(depth, 9), return_inverse=True, return_counts=True)
    shown = layer_of_cell == sizes.argmax()
    columns_rows = np.rint((points[shown] - points[shown].min(axis=0)) / reachability.cell_size).astype(np.intp)
    axes = tuple(
        points[shown, axis].min() + reachability.cell_size * np.arange(columns_rows[:, axis].max() + 1) for axis in (0, 1)
    )
    plane = Plane(points=points[shown], labels=view.names, cells=columns_rows, axes=(axes[0], axes[1]))
    locked = {
        f"{joint} locked": column
        for joint, column in zip(reachability.arm.joint_names, reachability.locked_index.T, strict=True)
    }
    panels = {
        panel: np.where(values[shown] > 0, values[shown], np.nan)
        for panel, values in ({"intact": reachability.index} | locked).items()
    }
    part = "cells" if reachability.is_planar else "the layer with the most cells,"
    caption = (
        f"{reachability.arm.name}, {view.title.lower()}: {part} of {1e3 * reachability.cell_size:.3g} mm; "
        f"{reachability.samples:,} samples for the intact arm and each lock value; grey: not reached"
    )
    return panel_maps(plane, panels, label="reached fraction of the tool directions", caption=caption)


def _build_sections(reachability: ReachabilityMap) -> Sequence[Section]:
    """Build the interactive view of the cells behind the middle of the workspace."""
    from holdfast.interface.presentation.arm.view import build_view_section
    from holdfast.interface.report.scenes import Scale

    shown = np.flatnonzero(reachability.centers[:, 1] >= np.median(reachability.centers[:, 1]))
    shown = shown[:: -(-len(shown) // _MAX_VIEW_POINTS)]
    colors = 255 * Scale(0.0, 1.0).colors(reachability.index[shown])[:, :3]
    caption = "Cells that the intact arm reaches, cut open: bright cells are reached in more tool directions."
    return [
        build_view_section(
            "The reachable cells",
            reachability.arm,
            None,
            caption,
            name="cloud",
            points=reachability.centers[shown],
            colors=colors,
        )
    ]
