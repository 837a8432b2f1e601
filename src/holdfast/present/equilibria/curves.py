"""Curves of stationary points in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.equilibria.curves import Curves
from holdfast.present.equilibria.points import error_head
from holdfast.present.printing import Rows, number

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
            error = c.error[s.first : s.last + 1]
            ends = f"{factor * c.locked[s.first]:.3f} to {factor * c.locked[s.last]:.3f}"
            rows.append([str(k + 1), ends, s.kind.word, f"{number(error.min())} to {number(error.max())}"])
    head = ["curve", f"{arm.joint_names[curves.joint]}, {unit}", "kind", f"{error_head(curves.law)}, least to most"]
    return [Rows(head, rows)] if curves.curves else []


def next_steps(curves: Curves, name: str) -> list[str]:
    """The points at one locked value."""
    locked = {curves.joint: 0.0 if not curves.sink_arcs else round(float(np.mean(curves.sink_arcs[0])), 3)}
    return [f"hf.stationary_points({name}.law, {name}.target, {locked!r})  # at one value"]


def figures(curves: Curves) -> dict[str, Figure]:
    """``curves``: the error, and the other joints if they are few, over the locked value."""
    from holdfast.present.equilibria.figures import curves_figure

    return {"curves": curves_figure(curves)}
