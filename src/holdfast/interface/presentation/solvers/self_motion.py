"""Presentation of a self-motion."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import format_count, format_percent, list_alternatives
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import build_view_section, choose_views
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Presentation, TableSpec
from holdfast.interface.report.page import Section
from holdfast.kinematics.solvers.joint_space import is_unlimited
from holdfast.kinematics.solvers.self_motions import SelfMotion
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.machine import Joint
from holdfast.model.arm.model import Arm

_MAX_DRAWN_CURVES = 6  # only the longest curves are drawn
_DRAWN_CONFIGURATIONS = 6
_CURVE_GAP_FRACTION = 0.04  # gap between two curves, as a fraction of the total length


def to_dict(motion: SelfMotion) -> dict[str, Any]:
    """Return the curves with the causes of their ends, and the allowed lock ranges of each joint, if known."""
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
                "closed": component.closed,
                "length_rad": component.length,
                "winding": dict(zip(names, component.winding, strict=True)),
                "ranges": dict(zip(names, component.ranges, strict=True)),
                "bounded_by": [None if limit_joint is None else names[limit_joint] for limit_joint in component.bounded_by],
                "barred_by": [body_pair or None for body_pair in component.barred_by],
                "points": len(component.q),
            }
            for component in motion.components
        ],
        "size_rad": motion.size if motion.redundancy == 1 else None,
        "clearance": None if motion.clearance is None else summarize_shape(motion.clearance, motion.margin),
        **({} if motion.bounds is None else {"bounds": dict(zip(names, motion.bounds, strict=True))}),
    }


def present(motion: SelfMotion) -> Presentation:
    """Present the self-motion curves of the target, and the lock positions that keep the target within reach."""
    arm, count = motion.arm, len(motion.components)
    facts: list[Fact] = []
    if not len(motion.q):
        is_proved = motion.status != Status.NOT_FOUND
        reason = f": {motion.summary}" if is_proved else ", which does not prove that none exists"
        answer = f"No configuration of the target was found{reason}"
    elif count:
        closed_count = sum(component.closed for component in motion.components)
        collision_text = "" if motion.clearance is None else f", collisions with {motion.clearance.others}"
        curves_text = format_count(count, "closed curve" if closed_count == count else "curve")
        if not closed_count:
            curves_text += f", bounded by joint limits{collision_text} or singular configurations"
        elif closed_count < count:
            curves_text += f", {closed_count} of them closed"
        answer = f"The configurations found for the target form {curves_text}"
    else:
        answer = (
            f"The configurations of the target form a manifold of dimension {motion.redundancy}, of which "
            f"{len(motion.q):,} were found, {motion.spacing:.3g} rad apart"
        )
    if len(motion.q) and motion.bounds is not None:
        free, restricted = _classify_joints(motion)
        answer += f"; {_describe_surviving_locks(free, restricted)}"
        if restricted:
            worst = min(restricted, key=lambda joint_name: restricted[joint_name])
            phrase = f"of the range of {worst}, the most restricted joint, keeps the target within reach after a lock"
            facts.append(Fact("", restricted[worst], phrase=phrase, style="percent"))
        if free:
            facts.append(Fact("", f"{len(free)} of {arm.n}", phrase="joints may lock at any position in their range"))
    if count:
        longest = max(component.length for component in motion.components)
        phrase = "curve" if count == 1 else "separate curves; the arm must leave the target to change from one to another"
        facts += [Fact("", count, phrase=phrase), Fact("", longest, "rad", phrase="length of the longest curve in joint space")]
        if not arm.prismatic.all():
            turns = f"{motion.size / (2 * np.pi):.2f} of {np.count_nonzero(~arm.prismatic)}"
            facts.append(Fact("full revolutions of the joints on one curve", turns))
    target = ", ".join(f"{coordinate:.4g}" for coordinate in motion.pose[:3, 3])
    return Presentation(
        f"All configurations of {arm.name} for one target",
        f"{answer}.",
        about=f"Arm {arm.title}, task {motion.task.describe()}, target ({target}) m",
        facts=facts,
        tables=_build_tables(motion),
        figures={"self-motion": _describe_figure(motion)},
        sections=partial(_animate_self_motion, motion),
        method=[
            ("Task", motion.task.describe()),
            (
                "Points",
                f"{len(motion.q):,}, {motion.spacing:.3g} rad apart; a curve to which no random start converges is not found",
            ),
            ("Allowed lock positions", "the values that each joint takes over all configurations found"),
            ("Clearance", "not checked" if motion.clearance is None else describe_shape(motion.clearance, motion.margin)),
        ],
        arm=arm,
    )


def _classify_joints(motion: SelfMotion) -> tuple[list[str], dict[str, float]]:
    """Return the joints that may lock at any position, and the allowed fraction of the range of each other joint."""
    free: list[str] = []
    restricted: dict[str, float] = {}
    lower, upper = sampling_limits(motion.arm)
    for index, (joint, lock_ranges) in enumerate(zip(motion.arm.joints, motion.bounds or [], strict=True)):
        if _may_lock_anywhere(motion, index):
            free.append(joint.name)
        else:
            restricted[joint.name] = float(
                min(sum(end - begin for begin, end in lock_ranges) / max(upper[index] - lower[index], 1e-12), 1.0)
            )
    return free, restricted


def _may_lock_anywhere(motion: SelfMotion, joint_index: int) -> bool:
    joint, lock_ranges = motion.arm.joints[joint_index], list((motion.bounds or [])[joint_index])
    return lock_ranges in ([(joint.lower, joint.upper)], [(-np.pi, np.pi)] if is_unlimited(motion.arm)[joint_index] else None)


def _describe_surviving_locks(free: list[str], restricted: dict[str, float]) -> str:
    critical_joints = [name for name, fraction in restricted.items() if not fraction]
    if critical_joints:
        return f"the target is lost after every lock of {list_alternatives(critical_joints)}"
    if not restricted:
        return "the target stays within reach wherever a single joint locks"
    worst = min(restricted, key=lambda joint_name: restricted[joint_name])
    anywhere = f"the target stays within reach wherever {list_alternatives(free)} locks; " if free else ""
    return (
        f"{anywhere}the most restricted joint is {worst}, whose locks keep the target within reach in "
        f"{format_percent(restricted[worst])} of its range"
    )


def _build_tables(motion: SelfMotion) -> list[TableSpec]:
    """Tabulate the curves, and the allowed lock positions of each joint."""
    columns: list[Column] = ["curve", Header("length, rad", aligned=False), "points", ""]
    rows = [(i + 1, curve.length, len(curve.q), motion.ends(i)) for i, curve in enumerate(motion.components)]
    specs = [TableSpec("Self-motions", columns, rows)] if rows else []
    if motion.bounds is not None:
        lock_rows = [
            (
                joint.name,
                "anywhere" if _may_lock_anywhere(motion, index) else format_ranges(ranges, joint) if ranges else "nowhere",
            )
            for index, (joint, ranges) in enumerate(zip(motion.arm.joints, motion.bounds, strict=True))
        ]
        title = "After a lock of one joint, the target stays within reach if and only if the joint locks in these ranges"
        specs.append(TableSpec(title, ["joint", "allowed lock positions"], lock_rows))
    return specs


def _animate_self_motion(motion: SelfMotion) -> list[Section]:
    """Animate the arm on its longest self-motion curve; draw a few configurations if there are no curves."""
    if not len(motion.q):
        return []
    if not motion.components:
        configurations = motion.q[np.linspace(0, len(motion.q) - 1, min(4, len(motion.q))).astype(int)]
        caption = "The arm in some of the configurations found, each with the tool at the target."
        return [build_view_section("The arm at the target", motion.arm, configurations, caption, cell=motion.cell)]
    q = max(motion.components, key=lambda component: component.length).q
    if len(q) < 2:
        return []
    caption = (
        f"The arm on its {'only' if len(motion.components) == 1 else 'longest'} self-motion; the tool stays at the target."
    )
    options: dict[str, Any] = {"time": np.linspace(0.0, 8.0, len(q)), "targets": [motion.pose], "cell": motion.cell}
    return [build_view_section("The self-motion", motion.arm, q, caption, **options)]


def format_ranges(intervals: Sequence[Sequence[float]], joint: Joint) -> str:
    """Format ranges of a joint with their unit."""
    if not intervals:
        return "-"
    factor, unit = joint.display_unit
    return ", ".join(" to ".join(_format_bound(factor * bound) for bound in ends) for ends in intervals) + f" {unit}"


def _format_bound(value: float) -> str:
    return f"{value:.2f}" if abs(value) >= 0.005 else "0.00"


def _describe_figure(motion: SelfMotion) -> FigureSpec:
    """Return the figure of the curves; its preview omits lock ranges that are not known, which take long to compute."""
    known_ranges: Any = [[]] * motion.arm.n if motion.bounds is None else motion.bounds

    def draw() -> report.Figure:
        from holdfast.kinematics.workspace.bounds import joint_bounds

        lock_ranges = known_ranges
        if motion.bounds is None and motion.clearance is None:
            lock_ranges = joint_bounds(motion.arm, motion.pose, motion.task)
        elif motion.bounds is None and motion.redundancy == 1:
            lock_ranges = motion.arcs()
        return _draw_self_motion(motion, lock_ranges)

    caption = (
        "Shaded: positions at which a joint may lock so that the target stays within reach. The curves are the self-motions, "
        "and the arm is drawn in some of their configurations."
    )
    return FigureSpec(draw, "Allowed lock positions", caption, preview=partial(_draw_self_motion, motion, known_ranges))


def _draw_self_motion(motion: SelfMotion, lock_ranges: Sequence[Sequence[tuple[float, float]]]) -> report.Figure:
    """Draw for each joint its values along consecutive curves, with its lock ranges as bands, and the arm."""
    arm, curves = motion.arm, sorted(motion.components, key=lambda curve: -curve.length)[:_MAX_DRAWN_CURVES]
    q, closed = (curves[0].q, curves[0].closed) if curves else (motion.q, False)
    chosen = np.linspace(0, max(len(q) - 1, 0), _DRAWN_CONFIGURATIONS + closed).astype(int)[:_DRAWN_CONFIGURATIONS]
    chains = arm.frames(q[chosen] if len(q) else q)[..., :3, 3]
    views = choose_views(arm, chains) if len(q) else []
    height = max(0.86 * arm.n + 0.9, 3.4 * len(views) if len(views) > 1 else 3.9)
    with report.styled_figure(report.WIDTH_IN, height) as figure:
        joint_figure, arm_figure = np.asarray(figure.subfigures(1, 2, width_ratios=(1.25, 1.0)))
        joint_axes = np.atleast_1d(joint_figure.subplots(arm.n, 1, sharex=True))
        for index, axes in enumerate(joint_axes):
            _draw_joint(axes, arm, index, lock_ranges[index], [curve.q for curve in curves])
        if not curves:
            joint_axes[-1].set_xticks([])
        joint_axes[-1].set_xlabel("length along the curves, one after the other, rad" if curves else "")
        joint_axes[0].set_title("Along the self-motion manifold" if curves else "Values that keep the target within reach")
        panels = np.atleast_1d(arm_figure.subplots(len(views), 1)) if views else ()
        for axes, view in zip(panels, views, strict=True):
            for index, shade in enumerate(np.linspace(0.25, 1.0, len(chains))):
                tool_color = report.ORANGE if index == len(chains) - 1 else ""
                style = {"linewidth": 1.2 + 0.9 * shade, "alpha": 0.25 + 0.55 * shade, "node_size": 4.0}
                report.motions.draw_chain(axes, view.project(chains[index]), tool_color=tool_color, **style)
            report.motions.show_view(axes, view, 0.1)
        band = report.Patch(facecolor=report.SKY, alpha=0.55, label="lock keeps the target within reach")
        line = report.Line2D([], [], color=report.BLUE, linewidth=1.6, label="on the curve")
        handles = [*[band] * any(map(len, lock_ranges)), *[line] * bool(curves)]
        figure.legend(handles=handles, loc="outside upper right", ncols=2)
        omission_note = f"; the {len(curves)} longest curves are drawn" if len(motion.components) > len(curves) else ""
        caption = f"{arm.name}, task {motion.task.name}: {motion.summary}{omission_note}"
        figure.supxlabel(report.format_label(caption, 220), fontsize=9, color=report.SOFT)
    return figure


def _draw_joint(
    axes: report.Axes, arm: Arm, joint: int, lock_ranges: Sequence[tuple[float, float]], curves: Sequence[FloatArray]
) -> None:
    """Draw the values of a joint along curves (K, n), one after the other, above bands of its lock ranges."""
    factor, unit = arm.joints[joint].display_unit
    lower, upper = (factor * limits[joint] for limits in sampling_limits(arm))
    period = upper - lower
    for begin, end in lock_ranges:
        # A range that exceeds the upper limit of an unlimited joint continues at the lower limit.
        for shift in (0.0, -period):
            band_top, band_bottom = min(factor * end + shift, upper), max(factor * begin + shift, lower)
            if band_top >= band_bottom:
                axes.axhspan(band_bottom - 0.004 * period, band_top + 0.004 * period, color=report.SKY, alpha=0.55, linewidth=0)
    arc_lengths = [np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1))] for q in curves]
    total_length = sum(float(lengths[-1]) for lengths in arc_lengths) or 1.0
    curve_start = 0.0
    for q, lengths in zip(curves, arc_lengths, strict=True):
        values = factor * q[:, joint]
        if (values < lower - 1e-6 * period).any() or (values > upper + 1e-6 * period).any():
            values = (values - lower) % period + lower
        jumps = np.flatnonzero(np.abs(np.diff(values)) > period / 2) + 1
        for piece in np.split(np.arange(lengths.size), jumps):
            axes.plot(curve_start + lengths[piece], values[piece], color=report.BLUE, linewidth=1.6)
        curve_start += float(lengths[-1]) + _CURVE_GAP_FRACTION * total_length
    axes.set_ylim(lower - 0.03 * period, upper + 0.03 * period)
    axes.set_ylabel(report.format_label(f"{arm.joint_names[joint]}, {unit}", 26), rotation=0, ha="right", va="center")
    axes.yaxis.set_major_locator(report.MaxNLocator(3, steps=[1, 3, 6, 9, 10] if period > 100 else None))
    axes.grid(axis="x", visible=False)
    if curves:
        axes.set_xlim(-0.01 * total_length, curve_start - _CURVE_GAP_FRACTION * total_length + 0.01 * total_length)
