"""Curves of stationary points in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.equilibria.curves import Curves
from holdfast.equilibria.stability import Kind
from holdfast.present.printing import Rows, number
from holdfast.present.simulation.errors import error_text
from holdfast.present.story import Story
from holdfast.simulation.errors import error_kinds, shown_errors
from holdfast.simulation.system import tool_errors
from holdfast.words import capitalised, either, percent

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def to_dict(curves: Curves) -> dict[str, Any]:
    """The curves by what happens along them, all at values of the locked joint, rad or m."""
    arm = curves.law.arm
    return {
        **arm.entry(),
        "law": curves.law.slug,
        "task": curves.law.task.name,
        "locked": arm.joint_names[curves.joint],
        "starts": curves.starts,
        "sink_arcs": [list(arc) for arc in curves.sink_arcs],
        "degenerate_values": curves.degenerate_angles,
        "surface_points": len(curves.loose),
        "surface_attracting": np.sort(curves.loose.q[curves.loose.attracting, curves.joint]),
        "curves": [
            {
                "points": len(c.q),
                "closed": c.closed,
                "degenerate": c.degenerate,
                "segments": [{"kind": s.kind.word, "from": c.locked[s.first], "to": c.locked[s.last]} for s in c.segments],
                **{
                    name: c.locked[getattr(c, name)]
                    for name in ("folds", "branch_points", "hopf_points", "rank_losses", "solutions")
                },
            }
            for c in curves.curves
        ],
    }


def tables(curves: Curves) -> list[Rows]:
    """A row for each stretch of a curve on which the kind stays the same."""
    arm = curves.law.arm
    factor, unit = arm.joints[curves.joint].shown
    rows = []
    for k, c in enumerate(curves.curves):
        for s in c.segments:
            ends = f"{factor * c.locked[s.first]:.3f} to {factor * c.locked[s.last]:.3f}"
            spans = [errors[s.first : s.last + 1] for errors in shown_errors(curves.law, c.q, c.error, curves.target)]
            rows.append([str(k + 1), ends, s.kind.word, *(f"{number(e.min())} to {number(e.max())}" for e in spans)])
    titles = [f"{kind.text}, {kind.unit}, least to most" for kind in error_kinds(curves.law)]
    head = ["curve", f"{arm.joint_names[curves.joint]}, {unit}", "kind", *titles]
    return [Rows(head, rows)] if curves.curves else []


def story(curves: Curves) -> Story:
    """At which locked values the arm can stop off its target."""
    arm = curves.law.arm
    joint, (factor, unit) = arm.joints[curves.joint], arm.joints[curves.joint].shown
    arcs = [f"{factor * a:.4g} to {factor * b:.4g}" for a, b in curves.sink_arcs]
    sinks = [
        tool_errors(curves.law, c.q[s.first : s.last + 1], c.error[s.first : s.last + 1], curves.target)
        for c in curves.curves
        for s in c.segments
        if s.kind == Kind.SINK
    ]
    far = error_text(curves.law, *np.max([(0.0, 0.0), *(np.max(pair, axis=1) for pair in sinks)], axis=0))
    if arcs:
        whole = curves.sink_arcs == [(-np.pi, np.pi)]
        answer = (
            f"With {joint.name} locked at {'any value' if whole else f'{either(arcs)} {unit}'} "
            f"the arm can stop off its target, by up to {far}."
        )
        if not whole:
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
        inside = sum(b - a for a, b in curves.sink_arcs)
        whole_range = float(np.nan_to_num(joint.upper - joint.lower, posinf=np.inf)) if joint.prismatic else 2 * np.pi
        if np.isfinite(whole_range):
            facts.append(
                (
                    percent(min(inside / whole_range, 1.0)),
                    f"of {'the range' if joint.prismatic else 'a turn'} of {joint.name} has a sink",
                )
            )
        facts.append((far, "off the target, at the farthest sinks"))
    facts += [(f"{len(curves):,}", "curves of stationary points"), (f"{curves.starts:,}", "random starts that looked for them")]
    return Story(
        f"Where {arm.name} can stop, over the value at which {joint.name} locks",
        answer,
        about=f"{arm.name}, {curves.law.describe()}",
        facts=facts,
        lines=[f"{capitalised(line)}." for line in curves.describe()[2:]],
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


def next_steps(curves: Curves, name: str) -> list[str]:
    """The points at one locked value."""
    locked = {curves.joint: 0.0 if not curves.sink_arcs else round(float(np.mean(curves.sink_arcs[0])), 3)}
    return [f"hf.stationary_points({name}.law, {name}.target, {locked!r})  # at one value"]


def figures(curves: Curves) -> dict[str, Figure]:
    """``curves``: the error, and the other joints if they are few, over the locked value."""
    from holdfast.present.equilibria.figures import curves_figure

    return {"curves": curves_figure(curves)}
