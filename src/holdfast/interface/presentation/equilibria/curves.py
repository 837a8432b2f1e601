"""Presentation of curves of stationary points."""

from __future__ import annotations

from functools import partial
from itertools import product
from typing import Any

import numpy as np

from holdfast.control.equilibria.curves import SAMPLE_RADIUS, Curves, EquilibriumCurve, merge_arcs
from holdfast.control.equilibria.points import StationaryPoints
from holdfast.control.equilibria.stability import Kind
from holdfast.control.equilibria.system import wrap_angles
from holdfast.control.simulation.errors import display_errors, error_kinds
from holdfast.control.simulation.system import position_and_angle_errors
from holdfast.core.formatting import list_alternatives
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Presentation, TableSpec
from holdfast.interface.presentation.simulation.errors import format_errors
from holdfast.model.arm.model import Arm

# Number of cells of the locked value, and of samples per cell, that show where the target is within reach
_REACH_CELLS = 360
_SAMPLES_PER_CELL = 16
_MAX_SHOWN_JOINTS = 3
_REACHABLE_COLOR = "#e3f1ec"


def to_dict(curves: Curves) -> dict[str, Any]:
    """Return the segments of the curves by kind, with the values of the locked joint, rad or m."""
    arm = curves.law.arm
    return {
        **arm.entry(),
        "law": curves.law.slug,
        "task": curves.law.task.name,
        "locked": arm.joint_names[curves.joint],
        "starts": curves.starts,
        "sink_arcs": [list(sink_arc) for sink_arc in curves.sink_arcs],
        "degenerate_values": curves.degenerate_angles,
        "surface_points": len(curves.loose),
        "surface_attracting": np.sort(curves.loose.q[curves.loose.attracting, curves.joint]),
        "curves": [
            {
                "points": len(curve.q),
                "closed": curve.closed,
                "degenerate": curve.degenerate,
                "segments": [
                    {
                        "kind": segment.kind.word,
                        "from": curve.locked_values[segment.first],
                        "to": curve.locked_values[segment.last],
                    }
                    for segment in curve.segments
                ],
                **{
                    name: curve.locked_values[getattr(curve, name)]
                    for name in ("folds", "branch_points", "hopf_points", "rank_losses", "solutions")
                },
            }
            for curve in curves.curves
        ],
    }


def present(curves: Curves) -> Presentation:
    """Present the locked values at which the arm can stop away from its target."""
    arm = curves.law.arm
    joint, (factor, unit) = arm.joints[curves.joint], arm.joints[curves.joint].display_unit
    arcs = [f"{factor * begin:.4g} to {factor * end:.4g}" for begin, end in curves.sink_arcs]
    sinks = [
        position_and_angle_errors(
            curves.law, curve.q[segment.first : segment.last + 1], curve.error[segment.first : segment.last + 1], curves.target
        )
        for curve in curves.curves
        for segment in curve.segments
        if segment.kind == Kind.SINK
    ]
    largest_error = format_errors(curves.law, *np.max([(0.0, 0.0), *(np.max(pair, axis=1) for pair in sinks)], axis=0))
    if arcs:
        all_angles = curves.sink_arcs == [(-np.pi, np.pi)]
        answer = (
            f"With {joint.name} locked at {'any value' if all_angles else f'{list_alternatives(arcs)} {unit}'}, "
            f"the arm can stop up to {largest_error} from its target."
        )
        if not all_angles:
            answer += " At other values, no sink was found."
    elif curves.degenerate_angles or curves.loose.attracting.any():
        answer = (
            f"No isolated sink was found at any value of {joint.name}, but there are whole curves or surfaces of stationary "
            "points on which the arm can stop."
        )
    else:
        answer = f"No value of {joint.name} was found at which the arm stops away from its target."
    facts = [
        Fact("curves of stationary points", len(curves), phrase="curves of stationary points"),
        Fact("random starts", curves.starts, phrase="random starts of the search"),
    ]
    if arcs:
        sink_length = sum(end - begin for begin, end in curves.sink_arcs)
        whole_range = float(np.nan_to_num(joint.upper - joint.lower, posinf=np.inf)) if joint.prismatic else 2 * np.pi
        facts.insert(0, Fact("", largest_error, phrase="from the target, at the farthest sinks"))
        if np.isfinite(whole_range):
            phrase = f"of {'the range' if joint.prismatic else 'one revolution'} of {joint.name} has a sink"
            facts.insert(0, Fact("", min(sink_length / whole_range, 1.0), phrase=phrase, style="percent"))
    caption = "The arm stops at sinks, but not at saddles or sources. In the shaded ranges, the target is within reach."
    return Presentation(
        f"Stationary points of {arm.name} over the value at which {joint.name} locks",
        answer,
        about=f"{arm.title}, {curves.law.describe()}",
        facts=facts,
        lines=_compose_remarks(curves),
        tables=[_tabulate_segments(curves)] if curves.curves else [],
        figures={"curves": FigureSpec(partial(_draw_curves, curves), "Stationary points over the locked value", caption)},
        method=[
            (
                "Search",
                f"{curves.starts:,} random starts, each followed along its curve; a curve that no start converges to is missed",
            ),
            ("Law", curves.law.describe()),
            ("Not excluded", "limit cycles, and slow motion close to degenerate values"),
        ],
        arm=arm,
    )


def _compose_remarks(curves: Curves) -> list[str]:
    """Compose sentences about the sinks, whole curves, and surfaces of stationary points."""
    name, (factor, unit) = curves.law.arm.joint_names[curves.joint], curves.law.arm.joints[curves.joint].display_unit
    arcs = ", ".join(f"{factor * lower:.3f} to {factor * upper:.3f}" for lower, upper in curves.sink_arcs)
    remarks = [f"Sinks with {name} at {arcs} {unit}."] if arcs else []
    values = ", ".join(f"{factor * angle:.4f}" for angle in curves.degenerate_angles)
    remarks += [f"Whole curves of stationary points with {name} at {values} {unit}."] if values else []
    if len(curves.loose):
        attracting = curves.loose.attracting
        angles = [float(angle) for angle in curves.loose.q[attracting, curves.joint]]
        arcs = ", ".join(
            f"{factor * (lower + SAMPLE_RADIUS):.0f} to {factor * (upper - SAMPLE_RADIUS):.0f}"
            for lower, upper in merge_arcs([(angle - SAMPLE_RADIUS, angle + SAMPLE_RADIUS) for angle in angles], unit == "deg")
        )
        remarks.append(
            f"{len(curves.loose)} samples of surfaces of stationary points, of which {int(attracting.sum())} are attracting"
            f"{arcs and f', about {arcs} {unit}'}."
        )
    return remarks


def _tabulate_segments(curves: Curves) -> TableSpec:
    """Tabulate the segments of the curves on which the kind is constant, one row for each."""
    arm = curves.law.arm
    factor, unit = arm.joints[curves.joint].display_unit
    rows: list[tuple[Any, ...]] = []
    for index, curve in enumerate(curves.curves, 1):
        for segment in curve.segments:
            first, last = (factor * curve.locked_values[end] for end in (segment.first, segment.last))
            errors = display_errors(curves.law, curve.q, curve.error, curves.target)
            spans = [values[segment.first : segment.last + 1] for values in errors]
            rows.append((index, f"{first:.3f} to {last:.3f}", segment.kind.word, *((s.min(), s.max()) for s in spans)))
    columns: list[Column] = ["curve", f"{arm.joint_names[curves.joint]}, {unit}", "kind"]
    columns += [Header(f"{kind.text}, {kind.unit}, smallest to largest", aligned=False) for kind in error_kinds(curves.law)]
    return TableSpec("Segments of one kind", columns, rows)


# ---- figures -------------------------------------------------------------------------------------------------------------


def _draw_curves(curves: Curves) -> report.Figure:
    """Draw curves of stationary points over the locked value: the error, and the other joints if they are few.

    Ranges in which the target can be reached are shaded; inverse kinematics finds them in steps of 1 degree, or 1/360 of the
    range of a prismatic joint.
    """
    arm, joint, system = curves.law.arm, curves.joint, curves._system
    other_joints = [k for k in np.flatnonzero(system.healthy) if np.flatnonzero(system.healthy).size <= _MAX_SHOWN_JOINTS]
    labels = [
        *(f"{kind.text}, {kind.unit}" for kind in error_kinds(curves.law)),
        *(label_axis(arm, index) for index in other_joints),
    ]

    def list_panel_values(stationary: EquilibriumCurve | StationaryPoints, chosen: slice | BoolArray) -> list[FloatArray]:
        errors = display_errors(curves.law, stationary.q[chosen], stationary.error[chosen], curves.target)
        return [*errors, *(display_values(arm, stationary.q[chosen], index) for index in other_joints)]

    values, reached = _reachable_ranges(curves)
    surface_points, drawn_kinds = curves.loose, set()
    with report.styled_figure(report.WIDTH_IN, 0.9 + 2.5 * len(labels)) as figure:
        panels = np.atleast_1d(figure.subplots(len(labels), 1, sharex=True))
        for axes, (lower, upper) in product(panels, reached):
            axes.axvspan(lower, upper, color=_REACHABLE_COLOR, linewidth=0, zorder=0)
        for curve in curves.curves:
            for segment in curve.segments:
                span, line_style = slice(segment.first, segment.last + 1), get_line_style(segment.kind.word)
                locked_values = display_values(arm, curve.q[span], joint)
                drawn_kinds.add(segment.kind.word)
                for axes, panel_values in zip(panels, list_panel_values(curve, span), strict=True):
                    axes.plot(*break_at_angle_wraps(locked_values, panel_values), **line_style)
        for kind, chosen in (("degenerate", ~surface_points.attracting), ("sink", surface_points.attracting)):
            if chosen.any():
                locked_values = display_values(arm, surface_points.q[chosen], joint)
                drawn_kinds.add(kind)
                color, _, _, marker = report.KIND_STYLES[kind]
                for axes, panel_values in zip(panels, list_panel_values(surface_points, chosen), strict=True):
                    axes.plot(locked_values, panel_values, marker, color=color, markersize=2.5, linestyle="none", alpha=0.7)
        for panel, (axes, label) in enumerate(zip(panels, labels, strict=True)):
            axes.set(ylabel=label, xlim=(values[0], values[-1]))
            if panel and label.endswith("deg"):
                axes.set_ylim(-180, 180)
                axes.yaxis.set_major_locator(report.MultipleLocator(60))
        panels[-1].set_xlabel(label_axis(arm, joint))
        if panels[-1].get_xlabel().endswith("deg"):
            panels[-1].xaxis.set_major_locator(report.MultipleLocator(30))
        handles: list[report.Line2D | report.Patch] = [
            report.Line2D([], [], **get_line_style(kind), label=kind) for kind in report.KIND_STYLES if kind in drawn_kinds
        ]
        handles += [report.Patch(color=_REACHABLE_COLOR, label="target within reach")] * bool(reached)
        figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
        caption = (
            f"{arm.name}, {curves.law.name}; undetected lock of {arm.joint_names[joint]}; "
            f"{len(curves)} curves from {curves.starts} starts"
            + (f", dots: {len(surface_points)} points sampled from surfaces" if len(surface_points) else "")
        )
        figure.supxlabel(report.format_label(caption, 200), fontsize=9, color=report.SOFT)
    return figure


def _reachable_ranges(curves: Curves) -> tuple[FloatArray, list[tuple[float, float]]]:
    """Return the locked values to show, in degrees or m, and their ranges in which the target is reached."""
    arm, joint = curves.law.arm, curves.joint
    lower, upper = (arm.lower[joint], arm.upper[joint]) if arm.joints[joint].prismatic else (-np.pi, np.pi)
    lower, upper = (lower if np.isfinite(lower) else -1.0), (upper if np.isfinite(upper) else 1.0)
    edges = np.linspace(lower, upper, _REACH_CELLS + 1)
    samples = np.repeat((edges[1:] + edges[:-1]) / 2, _SAMPLES_PER_CELL)
    is_reached = (
        curves._system.can_reach(samples, np.random.default_rng(0)).reshape(_REACH_CELLS, _SAMPLES_PER_CELL).any(axis=1)
    )
    changes = np.flatnonzero(np.diff(np.r_[0, is_reached.astype(int), 0]))
    displayed_edges = edges * arm.joints[joint].display_unit[0]
    return displayed_edges, [
        (float(displayed_edges[start]), float(displayed_edges[stop]))
        for start, stop in zip(changes[::2], changes[1::2], strict=True)
    ]


def get_line_style(kind: str) -> dict[str, Any]:
    """Return the style of the line of a kind."""
    color, width, dashes, _ = report.KIND_STYLES[kind]
    return {"color": color, "linewidth": width, "linestyle": dashes}


def break_at_angle_wraps(x: FloatArray, y: FloatArray, period: float = 360.0) -> tuple[FloatArray, FloatArray]:
    """Insert NaN where a value wraps around, so that no line crosses the figure."""
    jumps = np.flatnonzero((np.abs(np.diff(x)) > 0.5 * period) | (np.abs(np.diff(y)) > 0.5 * period)) + 1
    return np.insert(x, jumps, np.nan), np.insert(y, jumps, np.nan)


def display_values(arm: Arm, q: FloatArray, joint: int | np.intp) -> FloatArray:
    """Return the values of one joint, in degrees from -180 to 180, or m."""
    return np.asarray(wrap_angles(arm, q)[:, joint] * arm.joints[joint].display_unit[0])


def label_axis(arm: Arm, joint: int | np.intp) -> str:
    """Return the label of an axis of values of one joint, with the unit."""
    return f"{arm.joint_names[joint]}, {arm.joints[joint].display_unit[1]}"
