"""Presentation of basins of attraction."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import cycle
from typing import Any

import numpy as np

from holdfast.control.equilibria.attraction import Basins
from holdfast.control.equilibria.stability import Kind
from holdfast.core.formatting import format_count, format_percent
from holdfast.interface import report
from holdfast.interface.presentation.equilibria import points as points_of
from holdfast.interface.presentation.equilibria.curves import break_at_angle_wraps, display_values, label_axis
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation, TableSpec

# Pale colours of basins, which differ in hue and lightness.
_SOLUTION_COLORS = ("#bfe3d6", "#7fb8a8", "#d9edf9", "#93c4e3", "#f3e3b3", "#dcc46f")
_STUCK_COLORS = ("#f4c7ab", "#e39a6f", "#f7dccb", "#c98058")
_OUTCOME_COLORS = {"moving": "#c9a3bb", "undecided": "#d4d9de", "target": "#bfe3d6", "stuck": "#f4c7ab"}


def to_dict(basins: Basins) -> dict[str, Any]:
    """Return the stationary points, and the fraction of the initial configurations that end at each."""
    return {
        **points_of.to_dict(basins.points),
        "starts": len(basins.end),
        "fractions": [
            {"end": name, "fraction": interval.value, "low": interval.low, "high": interval.high}
            for name, interval in basins.shares
        ],
        "converged": {"fraction": basins.convergence.value, "low": basins.convergence.low, "high": basins.convergence.high},
        "confidence": basins.confidence,
    }


def present(basins: Basins) -> Presentation:
    """Present the fraction of the initial configurations that reach the target, and the outcomes of the others."""
    converged, points = basins.convergence, basins.points
    start_count = format_count(len(basins.end), "start")
    largest_miss = max(
        (outcome for outcome in basins.shares if not outcome[0].startswith(("target", "solution"))),
        key=lambda outcome: outcome[1].value,
        default=None,
    )
    lock_text = points_of.describe_locks(points)
    confidence_text = f"{100 * converged.confidence:.4g} %"
    if converged.value == 0:
        reach_note = "" if (points.kind == Kind.SOLUTION).any() else ", which is out of reach"
        answer = (
            f"With {lock_text}, none of {start_count} reaches the target{reach_note} (upper end of the {confidence_text} "
            f"interval: {format_percent(converged.high)})."
        )
    else:
        answer = (
            f"With {lock_text}, {format_percent(converged.value)} of {start_count} reach the target "
            f"({format_percent(converged.low)} to {format_percent(converged.high)}, {confidence_text})."
        )
    error_by_name = _target_errors(basins)
    if largest_miss is not None and largest_miss[1].value:
        answer = (
            answer[:-1] + f"; {format_percent(largest_miss[1].value)} end "
            f"{_outcome_phrase(largest_miss[0])}{error_by_name.get(largest_miss[0], '')}."
        )
    facts = [
        Fact("", fraction.value, phrase=f"end {_outcome_phrase(name)}{error_by_name.get(name, '')}", style="percent")
        for name, fraction in basins.shares
        if fraction.value
    ][:4]
    if converged.value:
        phrase = f"of the starts reach the target; {format_percent(converged.low)} to {format_percent(converged.high)}"
        facts.insert(0, Fact("", converged.value, phrase=phrase, style="percent"))
    sampling_text = (
        f"a grid of {basins.shape[0]} by {basins.shape[1]}" if basins.shape else "sampled uniformly within the joint limits"
    )
    errors = dict(zip(map(basins.name, range(len(points))), points_of.format_target_errors(points).tolist(), strict=True))
    columns = ["ends at", "fraction of starts", "distance from the target"]
    rows = [(name, fraction, errors.get(name, "")) for name, fraction in basins.shares]
    return Presentation(
        f"Starts from which {points.law.arm.name} still reaches its target",
        answer,
        about=f"{points.law.arm.title}, {points.law.describe()}; stationary points from {points.starts:,} random starts",
        facts=facts,
        tables=[TableSpec("Outcomes of the starts", columns, rows)],
        figures={
            "basins": FigureSpec(
                partial(_draw_basins, basins), "Basins of attraction", f"{start_count} by outcome; {sampling_text}."
            )
        },
        sections=partial(points_of.draw_stationary_arms, points),
        method=[
            ("Starts", f"{start_count}, {sampling_text}; each is simulated until it stops or reaches the time limit"),
            (
                "Intervals",
                f"{100 * converged.confidence:.4g} %, exact (Clopper-Pearson); for a grid, computed as for the same number of "
                "random starts",
            ),
            *points_of.list_methods(points),
        ],
        arm=points.law.arm,
    )


def _outcome_phrase(name: str) -> str:
    """Return the outcome of an initial configuration as a phrase after the verb end."""
    return {"moving": "nowhere, because they keep moving", "undecided": "undecided", "target": "at the target"}.get(
        name, name if name.startswith("stuck") else f"at {name}"
    )


def _target_errors(basins: Basins) -> dict[str, str]:
    return {
        basins.name(point): f" ({error} from the target)"
        for point, error in enumerate(points_of.format_target_errors(basins.points))
        if basins.points.kind[point] != Kind.SOLUTION
    }


def _draw_basins(basins: Basins) -> report.Figure:
    """Draw a map of the basins where the initial configurations are a grid over two joints, else bars."""
    points = basins.points
    caption = f"{points.law.arm.name}, {points.law.name}; {points_of.describe_locks(points)}; {len(basins.end)} starts"
    return _draw_bars(basins, caption) if basins.shape is None else _draw_map(basins, basins.shape, caption)


def _draw_bars(basins: Basins, caption: str) -> report.Figure:
    names, intervals = zip(*basins.shares, strict=True)
    with report.styled_figure(report.WIDTH_IN * 0.8, 1.2 + 0.32 * len(names)) as figure:
        axes = figure.add_subplot()
        ends = ([getattr(interval, end) for interval in intervals] for end in ("value", "low", "high"))
        percentages, lower, upper = 100 * np.array(list(ends))
        axes.barh(range(len(names)), percentages, height=0.6, color=_choose_colors(names), edgecolor=report.FAINT)
        errors = [percentages - lower, upper - percentages]
        style = {"fmt": "none", "ecolor": report.INK, "elinewidth": 1.0, "capsize": 3}
        axes.errorbar(percentages, range(len(names)), xerr=errors, **style)
        report.label_bars(axes, names, upper, texts=[f"{percentage:.1f} %" for percentage in percentages])
        axes.set(xlabel="fraction of start configurations, %", xlim=(0, 112))
        text = f"{caption}; lines: {100 * basins.confidence:.4g} % intervals"
        figure.supxlabel(report.format_label(text, 200), fontsize=9, color=report.SOFT)
    return figure


def _draw_map(basins: Basins, shape: tuple[int, ...], caption: str) -> report.Figure:
    """Draw the outcome of a motion that starts at the centre of each cell over two joints (Fig. 8 of Goel et al. 2005)."""
    points, arm, joints = basins.points, basins.points.law.arm, list(basins.healthy)
    codes, cells = np.unique(basins.end, return_inverse=True)
    names = [basins.name(int(code)) for code in codes]
    colors = _choose_colors(names)
    lower, upper = basins.starts[:, joints].min(axis=0), basins.starts[:, joints].max(axis=0)
    half_cells = (upper - lower) / (np.array(shape) - 1) / 2
    scale = np.array([arm.joints[joint].display_unit[0] for joint in joints])
    left, right, below, above = np.stack([(lower - half_cells) * scale, (upper + half_cells) * scale]).T.ravel().tolist()
    with report.styled_figure(7.4, 6.6) as figure:
        axes = figure.add_subplot()
        image = np.array([report.to_rgb(color) for color in colors])[cells.reshape(shape).T]
        axes.imshow(image, origin="lower", extent=(left, right, below, above), aspect="auto", interpolation="nearest")
        for q in basins.boundaries:
            boundary = [display_values(arm, q, joint) for joint in joints]
            axes.plot(*break_at_angle_wraps(boundary[0], boundary[1], right - left), color=report.INK, linewidth=0.9)
        unnamed = set()
        positions = np.stack([display_values(arm, points.q, joint) for joint in joints], axis=1)
        for index in np.flatnonzero(~points.continuum):
            kind, position, name = points.kinds[index], positions[index], f"{points.kinds[index]} {index + 1}"
            color, _, _, marker = report.KIND_STYLES[kind]
            axes.plot(*position, marker, color=color, markersize=8, markeredgecolor="white", markeredgewidth=1.0)
            if name in names:
                axes.annotate(name, position.tolist(), (7, 6), textcoords="offset points", fontsize=9, color=report.INK)
            else:
                unnamed.add(kind)
        axes.grid(visible=False)
        labels = [label_axis(arm, joint) for joint in joints]
        axes.set(xlabel=labels[0], ylabel=labels[1], xlim=(left, right), ylim=(below, above))
        handles: list[report.Line2D | report.Patch] = [
            report.Patch(color=color, label=report.format_label(name)) for color, name in zip(colors, names, strict=True)
        ]
        for kind in sorted(unnamed):
            color, _, _, marker = report.KIND_STYLES[kind]
            handles.append(report.Line2D([], [], marker=marker, color=color, linestyle="none", label=kind))
        if len(basins.boundaries):
            handles.append(report.Line2D([], [], color=report.INK, linewidth=0.9, label="basin boundary (into a saddle)"))
        figure.legend(handles=handles, loc="outside upper center", ncols=min(len(handles), 5))
        for axis, label in zip((axes.xaxis, axes.yaxis), labels, strict=True):
            if label.endswith("deg"):
                axis.set_major_locator(report.MultipleLocator(60))
        figure.supxlabel(report.format_label(caption, 200), fontsize=9, color=report.SOFT)
    return figure


def _choose_colors(names: Sequence[str]) -> list[str]:
    """Choose the colour of each outcome, for example of ``solution 1`` or ``stuck``."""
    solution_colors, stuck_colors = cycle(_SOLUTION_COLORS), cycle(_STUCK_COLORS)
    outcomes = [name.split()[0] for name in names]
    return [
        _OUTCOME_COLORS.get(outcome) or next(solution_colors if outcome == "solution" else stuck_colors) for outcome in outcomes
    ]
