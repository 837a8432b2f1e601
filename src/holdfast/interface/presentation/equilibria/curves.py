"""Text, tables, and JSON of curves of stationary points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.equilibria.curves import Curves
from holdfast.control.equilibria.stability import Kind
from holdfast.control.simulation.errors import display_errors, error_kinds
from holdfast.control.simulation.system import position_and_angle_errors
from holdfast.core.formatting import capitalise_first, format_percent, list_alternatives
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.interface.presentation.simulation.errors import format_errors

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def to_dict(curves: Curves) -> dict[str, Any]:
    """Return the segments of the curves by kind, all at values of the locked joint, rad or m."""
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


def tables(curves: Curves) -> list[TextTable]:
    """Tabulate the segments of the curves on which the kind is constant, one row for each."""
    arm = curves.law.arm
    factor, unit = arm.joints[curves.joint].display_unit
    rows = []
    for index, curve in enumerate(curves.curves):
        for segment in curve.segments:
            range_text = (
                f"{factor * curve.locked_values[segment.first]:.3f} to {factor * curve.locked_values[segment.last]:.3f}"
            )
            spans = [
                errors[segment.first : segment.last + 1]
                for errors in display_errors(curves.law, curve.q, curve.error, curves.target)
            ]
            rows.append(
                [
                    str(index + 1),
                    range_text,
                    segment.kind.word,
                    *(f"{format_significant(span.min())} to {format_significant(span.max())}" for span in spans),
                ]
            )
    titles = [f"{kind.text}, {kind.unit}, least to most" for kind in error_kinds(curves.law)]
    header = ["curve", f"{arm.joint_names[curves.joint]}, {unit}", "kind", *titles]
    return [TextTable(header, rows)] if curves.curves else []


def story(curves: Curves) -> PageContent:
    """Compose the report: the locked values at which the arm can stop off its target."""
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
            f"With {joint.name} locked at {'any value' if all_angles else f'{list_alternatives(arcs)} {unit}'} "
            f"the arm can stop off its target, by up to {largest_error}."
        )
        if not all_angles:
            answer += " At other values no sink was found."
    elif curves.degenerate_angles or curves.loose.attracting.any():
        answer = (
            f"No isolated sink was found at any value of {joint.name}, but whole curves or "
            f"surfaces of stationary points, on which the arm can stop."
        )
    else:
        answer = f"No value of {joint.name} was found at which the arm stops off its target."
    facts = []
    if arcs:
        sink_length = sum(end - begin for begin, end in curves.sink_arcs)
        whole_range = float(np.nan_to_num(joint.upper - joint.lower, posinf=np.inf)) if joint.prismatic else 2 * np.pi
        if np.isfinite(whole_range):
            facts.append(
                (
                    format_percent(min(sink_length / whole_range, 1.0)),
                    f"of {'the range' if joint.prismatic else 'a turn'} of {joint.name} has a sink",
                )
            )
        facts.append((largest_error, "off the target, at the farthest sinks"))
    facts += [(f"{len(curves):,}", "curves of stationary points"), (f"{curves.starts:,}", "random starts that looked for them")]
    return PageContent(
        f"Where {arm.name} can stop, over the value at which {joint.name} locks",
        answer,
        about=f"{arm.name}, {curves.law.describe()}",
        facts=facts,
        lines=[f"{capitalise_first(sentence)}." for sentence in curves.describe()[2:]],
        figures={
            "curves": (
                "Stationary points over the locked value",
                "Off the target: sinks hold the arm, saddles and sources do not. Shaded: the target is within reach.",
            )
        },
        method=[
            (
                "Search",
                f"{curves.starts:,} random starts, each followed along its curve; curves that none converges to are missed",
            ),
            ("Law", curves.law.describe()),
            ("Not excluded", "limit cycles, and slow motion beside degenerate values"),
        ],
        arm=arm,
    )


def figures(curves: Curves) -> dict[str, Figure]:
    """Draw ``curves``: the error, and the other joints if they are few, over the locked value."""
    from holdfast.interface.presentation.equilibria.figures import draw_curves

    return {"curves": draw_curves(curves)}
