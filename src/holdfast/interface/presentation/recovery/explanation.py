"""Presentation of the explanation of a pose without a solution."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Header, Presentation, TableSpec
from holdfast.response.recovery.proofs.explanation import PoseVerdict

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.response.recovery.proofs.explanation import PoseExplanation


def to_dict(explanation: PoseExplanation) -> dict[str, Any]:
    """Return the verdict, the proof, the nearest configuration, and the conditions that prevent the pose, as JSON data."""
    names = ("pose", "q", "position_error", "rotation_error", "starts", "proof", "values_beyond_limits", "colliding_pair")
    verdict = {"task": explanation.task.name, "verdict": explanation.verdict.name.lower()}
    rest = {name: getattr(explanation, name) for name in (*names, "is_position_reached", "seconds")}
    return {**explanation.arm.entry(), **verdict, **rest}


def present(explanation: PoseExplanation) -> Presentation:
    """Present the verdict, the proof, the nearest pose, and the condition that prevents the pose."""
    arm, is_reachable = explanation.arm, explanation.verdict == PoseVerdict.REACHABLE
    columns = [Header("joint", "joint"), Header("value", "value", [joint.unit for joint in arm.joints], style="angle")]
    title = "Configuration that meets the pose" if is_reachable else "Configuration of the nearest pose found"
    table = TableSpec(title, columns, list(zip(arm.joint_names, explanation.q.tolist(), strict=True)))
    x, y, z = explanation.pose[:3, 3]
    errors = [Fact("position error", explanation.position_error, "m", digits=3)]
    if explanation.task.angular:
        errors.append(Fact("orientation error", explanation.rotation_error, "rad", style="angle", digits=3))
    return Presentation(
        f"Is the pose reachable for {arm.name}?",
        f"{capitalise_first(explanation.verdict.sentence)}.",
        about=f"Arm {arm.title}, task {explanation.task.describe()}, target ({x:.4g}, {y:.4g}, {z:.4g}) m",
        lines=_list_reasons(explanation),
        facts=errors,
        tables=[table],
        figures={"pose": FigureSpec(partial(_draw_arm, explanation), "The arm", f"{title}, and the target (cross).")},
        method=[
            ("Inverse kinematics", f"up to {explanation.starts:,} random starts, tolerance 1e-6 m and 1e-6 rad"),
            ("Interval search", f"{explanation.seconds:.2g} s" if explanation.seconds else "not used"),
        ],
        arm=arm,
    )


def _list_reasons(explanation: PoseExplanation) -> list[str]:
    """List the proof and the conditions without which the pose would be reached."""
    if explanation.verdict == PoseVerdict.REACHABLE:
        return ["A solver that found no configuration of this pose has failed."]
    reasons = [f"{capitalise_first(explanation.proof)}."]
    if not explanation.proof:
        reasons = [
            f"{explanation.starts:,} random starts found no configuration, and an interval search of "
            f"{explanation.seconds:.2g} s decided nothing."
        ]
    if explanation.colliding_pair:
        reasons.append(f"If collisions are ignored, the pose is reachable; then {explanation.colliding_pair} are too close.")
    elif explanation.values_beyond_limits:
        joints = []
        for name, value in explanation.values_beyond_limits.items():
            joint = explanation.arm.joints[explanation.arm.joint_index(name)]
            factor, unit = joint.display_unit
            limit = joint.lower if value < joint.lower else joint.upper
            joints.append(f"{name} at {factor * value:.4g} {unit} (limit {factor * limit:.4g} {unit})")
        reasons.append(f"Without joint limits, the pose is reachable with {' and '.join(joints)}.")
    else:
        reasons.append("Without joint limits, no configuration was found either.")
    if explanation.is_position_reached is not None:
        found = "is reachable in another orientation" if explanation.is_position_reached else "was not reached either"
        reasons.append(f"The position alone {found}.")
    return reasons


def _draw_arm(explanation: PoseExplanation) -> Figure:
    """Draw the arm at the found or nearest configuration, with the target."""
    from matplotlib.figure import Figure

    from holdfast.interface.presentation.arm.view import choose_views
    from holdfast.interface.report.figures import ORANGE, WIDTH_IN, settle_layout, style
    from holdfast.interface.report.motions import draw_chain, show_view

    points, target = explanation.arm.frames(explanation.q)[:, :3, 3], explanation.pose[:3, 3]
    views = choose_views(explanation.arm, np.vstack([points, target]))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 4.4))
        for axes, view in zip(np.atleast_1d(figure.subplots(1, len(views))), views, strict=True):
            draw_chain(axes, view.project(points), linewidth=2.0, node_size=4.0, tool_color=ORANGE)
            axes.plot(*view.project(target), "x", color=ORANGE, markersize=10, markeredgewidth=2)
            show_view(axes, view, 0.1)
        return settle_layout(figure)
