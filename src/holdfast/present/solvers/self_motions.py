"""A self-motion: its numbers, its words and its picture."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.clearance.shape import shape_summary, shape_text
from holdfast.present.printing import Rows, number, print_rows
from holdfast.present.story import Story
from holdfast.solvers.joint_space import turning
from holdfast.status import Status
from holdfast.words import counted, either, percent

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    from holdfast.arm.machine import Joint
    from holdfast.present.results import Drawings
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
                "winding": dict(zip(names, c.winding, strict=True)),
                "ranges": dict(zip(names, c.ranges, strict=True)),
                "bounded_by": [None if i is None else names[i] for i in c.bounded_by],
                "barred_by": [pair or None for pair in c.barred_by],
                "points": len(c.q),
            }
            for c in motion.components
        ],
        "size_rad": motion.size if motion.redundancy == 1 else None,
        "clearance": None if motion.clearance is None else shape_summary(motion.clearance, motion.margin),
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


def story(motion: SelfMotion) -> Story:
    """In how many ways the target is reached, and which locks it survives."""
    arm, count = motion.arm, len(motion.components)
    if not len(motion.q):
        proof = (
            ", which does not prove that there is none" if motion.status == Status.NOT_FOUND else f": {motion.status.sentence}"
        )
        answer = f"No configuration of the target was found{proof}."
    elif count:
        closed = sum(c.closed for c in motion.components)
        barred = "" if motion.clearance is None else f", by {motion.clearance.others}"
        ends = (
            "closed"
            if closed == count
            else f"ended by limits{barred} or singular configurations"
            if not closed
            else f"{closed} closed"
        )
        answer = f"The target is reached on {counted(count, 'curve')} of configurations, {ends}"
    else:
        answer = (
            f"The target is reached on a manifold of {motion.redundancy} dimensions, of which "
            f"{len(motion.q):,} configurations were found"
        )
    facts = []
    if len(motion.q) and motion.bounds is not None:
        free, held = _allowed(motion)
        answer += f"; {_kept(free, held)}."
        if held:
            facts.append(
                (
                    percent(min(held.values())),
                    f"of the range of {min(held, key=lambda x: held[x])} keeps the target, the joint that is most bound",
                )
            )
        if free:
            facts.append((f"{len(free)} of {arm.n}", "joints may lock anywhere in their range"))
    elif len(motion.q):
        answer += "."
    if count:
        facts += [(f"{count}", f"separate {'curve' if count == 1 else 'curves'}; from one to another the target must be left")]
        facts += [(f"{number(max(c.length for c in motion.components))} rad", "length of the longest in joint space")]
    return Story(
        f"All configurations of {arm.name} for one target",
        answer,
        about=f"Task {motion.task.describe()}, target {_place(motion)}",
        facts=facts,
        views=_moving(motion),
        figures={
            "self-motion": (
                "Where each joint may lock",
                "Shaded: values at which a joint may lock and the target stays within reach; the curves are the "
                "self-motions, and the arm is drawn in a few of their configurations.",
            )
        },
        tables=_tables(motion),
        method=[
            ("Task", motion.task.describe()),
            (
                "Points",
                f"{len(motion.q):,}, {motion.spacing:.3g} rad apart; curves that no random start converges to are missed",
            ),
            ("Where joints may lock", "the values that each joint takes over all configurations found"),
            ("Clearance", "not looked at" if motion.clearance is None else shape_text(motion.clearance, motion.margin)),
        ],
        arm=arm,
    )


def _place(motion: SelfMotion) -> str:
    return f"({', '.join(f'{x:.4g}' for x in motion.pose[:3, 3])}) m"


def _allowed(motion: SelfMotion) -> tuple[list[str], dict[str, float]]:
    """The joints that may lock anywhere, and of the others the fraction of the range in which they may."""
    from holdfast.arm.configurations import finite_limits

    free: list[str] = []
    held: dict[str, float] = {}
    low, high = finite_limits(motion.arm)
    for k, (joint, arcs) in enumerate(zip(motion.arm.joints, motion.bounds or [], strict=True)):
        if _whole(motion, k):
            free.append(joint.name)
        else:
            held[joint.name] = float(min(sum(b - a for a, b in arcs) / max(high[k] - low[k], 1e-12), 1.0))
    return free, held


def _whole(motion: SelfMotion, k: int) -> bool:
    joint, arcs = motion.arm.joints[k], list((motion.bounds or [])[k])
    return arcs in ([(joint.lower, joint.upper)], [(-np.pi, np.pi)] if turning(motion.arm)[k] else None)


def _kept(free: list[str], held: dict[str, float]) -> str:
    lost = [name for name, fraction in held.items() if not fraction]
    if lost:
        return f"it is lost wherever {either(lost)} locks"
    if not held:
        return "it stays within reach wherever a single joint locks"
    worst = min(held, key=lambda x: held[x])
    anywhere = f"anywhere of {either(free)}, but " if free else ""
    return f"it survives a lock {anywhere}in only {percent(held[worst])} of the range of {worst}, the joint that is most bound"


def _tables(motion: SelfMotion) -> list[Rows]:
    found = [key_table(motion)._replace(title="Self-motions")]
    if motion.bounds is not None:
        each = enumerate(zip(motion.arm.joints, motion.bounds, strict=True))
        rows = [[j.name, "anywhere" if _whole(motion, k) else ranges(arcs, j) if arcs else "nowhere"] for k, (j, arcs) in each]
        found.append(Rows(["joint", "may lock at"], rows, "A lock keeps the target within reach if and only if it lies there"))
    return found


def _moving(motion: SelfMotion) -> list[tuple[str, list[Any]]]:
    """The arm on its longest self-motion; of a sample, in a few configurations."""
    if not len(motion.q):
        return []
    from holdfast.present.arm.view import scene
    from holdfast.report.page import Picture

    if not motion.components:
        few = motion.q[np.linspace(0, len(motion.q) - 1, min(4, len(motion.q))).astype(int)]
        words = "The arm in a few of the configurations; the tool is at the target in each."
        return [("The arm at the target", [Picture(scene(motion.arm, few, cell=motion.cell).html("motion", words), words)])]
    longest = max(motion.components, key=lambda c: c.length)
    time = np.linspace(0.0, 8.0, len(longest.q))
    words = f"The arm on its {'only' if len(motion.components) == 1 else 'longest'} self-motion: the tool keeps its target."
    if len(time) < 2:
        return []
    shown = scene(motion.arm, longest.q, time=time, targets=[motion.pose], cell=motion.cell)
    return [("The self-motion", [Picture(shown.html("motion", words), words)])]


def show(motion: SelfMotion, out: Console) -> None:
    """The tables of its page; how many configurations were found the first line says."""
    from rich.markup import escape

    out.print(escape(motion.describe()[0]), soft_wrap=True)
    for table in _tables(motion)[0 if motion.components else 1 :]:
        print_rows(out, table)


def ranges(arcs: Sequence[Sequence[float]], joint: Joint) -> str:
    """Ranges of a joint with their unit."""
    if not arcs:
        return "-"
    factor, unit = joint.shown
    return ", ".join(" to ".join(_short(factor * x) for x in ends) for ends in arcs) + f" {unit}"


def _short(value: float) -> str:
    return f"{value:.2f}" if abs(value) >= 0.005 else "0.00"


def drawings(motion: SelfMotion) -> Drawings:
    """Joint values along the curves with where each joint may lock, and the arm in a few of the configurations."""
    from holdfast.reach.bounds import joint_bounds

    if motion.bounds is not None or (motion.clearance is not None and motion.redundancy > 1):
        return main_figure(motion)
    kept = motion.clearance is not None
    arcs = motion.arcs() if kept else joint_bounds(motion.arm, motion.pose, motion.task)
    return {"self-motion": partial(_figure, motion, arcs)}


def main_figure(motion: SelfMotion) -> Drawings:
    """The same, and where each joint may lock only if that is known: looking for it takes longer than all the rest."""
    return {"self-motion": partial(_figure, motion, [[]] * motion.arm.n if motion.bounds is None else motion.bounds)}


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
