"""A self-motion: its numbers, its words and its picture."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.printing import Rows, number
from holdfast.solvers.joint_space import turning

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    from holdfast.arm.machine import Joint
    from holdfast.solvers.self_motions import SelfMotion

_CURVES = 6  # the longest ones are drawn
_CONFIGURATIONS = 6


def to_dict(motion: SelfMotion) -> dict[str, Any]:
    """Its curves with what ends them, and where each joint may lock, if that is known."""
    names = motion.arm.joint_names
    return {
        **motion.arm.entry(),
        "task": motion.task.name,
        "status": motion.status.name.lower(),
        "redundancy": motion.redundancy,
        "spacing_rad": motion.spacing,
        "points": len(motion.q),
        "components": [
            {
                "closed": c.closed,
                "length_rad": c.length,
                "bounded_by": [None if i is None else names[i] for i in c.bounded_by],
                "points": len(c.q),
            }
            for c in motion.components
        ],
        **({} if motion.bounds is None else {"bounds": dict(zip(names, motion.bounds, strict=True))}),
    }


def key_table(motion: SelfMotion) -> Rows:
    """The curves; of a manifold of more dimensions how many points were found."""
    if not motion.components:
        return Rows(["", ""], [["configurations found", f"{len(motion.q):,}"], ["dimension", str(motion.redundancy)]])
    each = enumerate(motion.components)
    return Rows(
        ["curve", "length, rad", "points", ""], [[str(k + 1), number(c.length), str(len(c.q)), motion.ends(k)] for k, c in each]
    )


def next_steps(motion: SelfMotion, name: str) -> list[str]:
    """Where each joint may lock."""
    del motion
    return [f"hf.joint_bounds({name}.arm, {name}.pose, {name}.task)  # where each joint may lock without losing the pose"]


def show(motion: SelfMotion, out: Console) -> None:
    """A table of the curves, and one of where each joint may lock."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    out.print(escape(motion.describe()[0]), soft_wrap=True)
    if motion.components:
        table = Grid("curve", "length", "points", "")
        for k, c in enumerate(motion.components):
            table.add_row(str(k + 1), f"{number(c.length)} rad", str(len(c.q)), escape(motion.ends(k)))
        out.print(table)
    if motion.bounds is not None:
        table = Grid("joint", "may lock at", "")
        for joint, found, turns in zip(motion.arm.joints, motion.bounds, turning(motion.arm), strict=True):
            whole = list(found) in ([(joint.lower, joint.upper)], [(-np.pi, np.pi)] if turns else None)
            table.add_row(escape(joint.name), ranges(found, joint), "anywhere" if whole else "" if found else "nowhere")
        out.print(table)


def ranges(arcs: Sequence[Sequence[float]], joint: Joint) -> str:
    """Ranges of a joint with their unit."""
    if not arcs:
        return "-"
    factor, unit = joint.shown
    return ", ".join(" to ".join(_short(factor * x) for x in ends) for ends in arcs) + f" {unit}"


def _short(value: float) -> str:
    return f"{value:.2f}" if abs(value) >= 0.005 else "0.00"


def figures(motion: SelfMotion) -> dict[str, Figure]:
    """Joint values along the curves with where each joint may lock, and the arm in a few of the configurations."""
    from holdfast.reach.bounds import joint_bounds

    arcs = joint_bounds(motion.arm, motion.pose, motion.task) if motion.bounds is None else motion.bounds
    return {"self-motion": _figure(motion, arcs)}


def main_figure(motion: SelfMotion) -> dict[str, Figure]:
    """The same, and where each joint may lock only if that is known: looking for it takes longer than all the rest."""
    return {"self-motion": _figure(motion, [[]] * motion.arm.n if motion.bounds is None else motion.bounds)}


def _figure(motion: SelfMotion, arcs: Sequence[Sequence[tuple[float, float]]]) -> Figure:
    from holdfast.arm.configurations import finite_limits
    from holdfast.present.stick_figure import views_of
    from holdfast.report.manifolds import JointPanel, self_motion_figure

    arm = motion.arm
    low, high = finite_limits(arm)
    factors = np.array([j.shown[0] for j in arm.joints])
    panels = [
        JointPanel(f"{j.name}, {j.shown[1]}", [(f * a, f * b) for a, b in found], (f * x, f * y))
        for j, f, found, x, y in zip(arm.joints, factors, arcs, low, high, strict=True)
    ]
    longest = sorted(motion.components, key=lambda c: -c.length)[:_CURVES]
    curves = []
    for c in longest:
        steps = np.linalg.norm(np.diff(c.q, axis=0), axis=1)
        curves.append((np.concatenate([[0.0], np.cumsum(steps)]), factors * c.q))
    q, closed = (longest[0].q, longest[0].closed) if longest else (motion.q, False)
    some = np.linspace(0, max(len(q) - 1, 0), _CONFIGURATIONS + closed).astype(int)[:_CONFIGURATIONS]
    chains = arm.frames(q[some] if len(q) else q)[..., :3, 3]
    views = views_of(arm, chains) if len(q) else []
    drawn = f"; the {_CURVES} longest curves are drawn" if len(motion.components) > _CURVES else ""
    caption = motion.describe()[0].replace(arm.title, arm.name, 1) + drawn
    return self_motion_figure(panels, curves, chains, views, caption)
