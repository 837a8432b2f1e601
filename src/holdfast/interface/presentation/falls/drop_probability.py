"""Presentation of the probability that a power loss stays harmless."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from scipy.stats import rankdata

from holdfast.control.falls.probability import DropProbability
from holdfast.core.formatting import format_count, format_interval, format_number
from holdfast.interface import report
from holdfast.interface.presentation.falls.motion import describe_free_joints, list_friction, name_drop
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Header, Presentation, TableSpec

_MEASURE_NAMES = {
    "released": "released energy",
    "impact_speed": "impact speed",
    "impact_energy": "impact energy",
}
_WORST_ROWS = 10
_MAP_BINS = 16


def to_dict(result: DropProbability) -> dict[str, Any]:
    """Return the fraction with its interval, and all values."""
    interval = result.interval()
    return {
        **result.fall.arm.entry(),
        "measure": result.measure,
        "of": result.fall.of,
        "below": result.below,
        "unit": result.unit,
        "fraction": interval.value,
        "interval": [interval.low, interval.high],
        "confidence": interval.confidence,
        "drawn": result.drawn,
        "used": len(result.value),
        "unreached": result.unreached,
        "values": result.value,
    }


def present(result: DropProbability) -> Presentation:
    """Present the fraction of harmless configurations, quantiles, a map over the two most important joints, and the worst."""
    arm, interval, name = result.fall.arm, result.interval(), _name_measure(result)
    limit = f"{format_number(result.below)} {result.unit}"
    known = result.value[np.isfinite(result.value)]
    quantiles = (
        [(f"{100 * level:g} %", float(np.quantile(known, level))) for level in (0.1, 0.5, 0.9, 0.99)] if known.size else []
    )
    worst = result.rank_worst(_WORST_ROWS)
    factors = [joint.display_unit for joint in arm.joints]
    joints = [f"{joint.name}, {unit}" for joint, (_, unit) in zip(arm.joints, factors, strict=True)]
    rows = [
        (int(row), result.value[row], *(q * factor for q, (factor, _) in zip(result.fall.q[row], factors, strict=True)))
        for row in worst
    ]
    return Presentation(
        f"Power loss of {arm.name} in random configurations",
        f"The {name} stays at or below {limit} in {format_interval(interval)} of {result.where}.",
        about=f"Arm {arm.title}. {describe_free_joints(result.fall)}",
        lines=[f"{format_count(len(result.value), 'fall')} simulated from rest, of {result.drawn:,} drawn configurations."],
        facts=[Fact("fraction", interval, style="percent", phrase=f"{name} at or below {limit}, estimated")],
        tables=[
            TableSpec(f"Quantiles of the {name}", ["falls", Header("at or below", result.unit)], quantiles),
            TableSpec(
                "Worst configurations",
                ["sample", Header(name, result.unit), *joints],
                rows,
                on_console=False,
            ),
        ],
        figures={
            "map": FigureSpec(
                partial(_draw_map, result),
                "Map",
                f"Mean {name} over the two joints whose values decide most about it, by rank correlation.",
            )
        },
        method=[
            ("Configurations", f"{result.drawn:,} {result.where}, without those in collision"),
            ("Interval", "Clopper and Pearson, 95 %"),
            ("Simulated", f"{result.fall.duration:g} s after each power loss"),
            *list_friction(result.fall),
        ],
        arm=arm,
    )


def _name_measure(result: DropProbability) -> str:
    return _MEASURE_NAMES.get(result.measure, name_drop(result.fall.of))


def _draw_map(result: DropProbability) -> report.Figure:
    """Draw the mean over the two joints with the largest rank correlation with the measure."""
    arm, known = result.fall.arm, np.isfinite(result.value)
    middle = (result.fall.q[known].min(axis=0) + result.fall.q[known].max(axis=0)) / 2
    ranks = rankdata(
        np.column_stack([result.value[known], np.abs(result.fall.q[known] - middle), result.fall.q[known]]), axis=0
    )
    correlations = np.abs(np.nan_to_num(np.asarray(np.corrcoef(ranks.T))[0, 1:])).reshape(2, arm.n).max(axis=0)
    first, second = np.argsort(-correlations, kind="stable")[:2] if arm.n > 1 else (0, 0)
    x, y, means = result.map(int(first), int(second), _MAP_BINS)
    labels = [f"{arm.joint_names[k]}, {arm.joints[k].display_unit[1]}" for k in (first, second)]
    with report.styled_figure(0.75 * report.WIDTH_IN, 4.4) as figure:
        axes = figure.subplots()
        mesh = axes.pcolormesh(
            x * arm.joints[first].display_unit[0], y * arm.joints[second].display_unit[0], means.T, cmap="cividis_r"
        )
        figure.colorbar(mesh, label=f"mean {_name_measure(result)}, {result.unit}")
        axes.set(xlabel=labels[0], ylabel=labels[1], title=f"{known.sum():,} falls")
    return figure
