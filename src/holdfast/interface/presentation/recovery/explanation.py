"""Presentation of the explanation of a pose without a solution."""

from __future__ import annotations

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.presentation import Column, Fact, Header, Presentation, TableSpec
from holdfast.response.recovery.proofs.explanation import PoseExplanation, PoseVerdict


def present(explanation: PoseExplanation) -> Presentation:
    """Present the verdict, the proof, the nearest pose, and the condition that prevents the pose."""
    arm, is_reachable = explanation.arm, explanation.verdict == PoseVerdict.REACHABLE
    columns: list[Column] = ["joint", Header("value", [joint.unit for joint in arm.joints], style="angle")]
    title = "Configuration that meets the pose" if is_reachable else "Configuration of the nearest pose found"
    return Presentation(
        f"Is the pose reachable for {arm.name}?",
        f"{capitalise_first(explanation.verdict.sentence)}.",
        about=f"Arm {arm.title}, task {explanation.task.describe()}, "
        f"target ({', '.join(f'{x:.4g}' for x in explanation.pose[:3, 3])}) m",
        lines=_list_reasons(explanation),
        facts=[
            Fact("position error", explanation.position_error, "m", digits=3, key="position_error_m"),
            Fact("orientation error", explanation.rotation_error, "rad", style="angle", digits=3, key="rotation_error_rad"),
            Fact("", explanation.verdict.name.lower(), key="verdict"),
            Fact("", explanation.proof, key="proof"),
            Fact("", explanation.values_beyond_limits, key="values_beyond_limits"),
            Fact("", explanation.colliding_pair, key="colliding_pair"),
        ],
        tables=[TableSpec(title, columns, list(zip(arm.joint_names, explanation.q.tolist(), strict=True)), key="q")],
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
    search = f"{explanation.starts:,} random starts found no configuration"
    reasons = [f"{capitalise_first(explanation.proof or search)}."]
    if explanation.colliding_pair:
        return [*reasons, f"If collisions are ignored, it is reachable, but then {explanation.colliding_pair} are too close."]
    if not explanation.values_beyond_limits:
        return [*reasons, "Without joint limits, no configuration was found either."]
    joints = []
    for name, value in explanation.values_beyond_limits.items():
        joint = explanation.arm.joints[explanation.arm.joint_index(name)]
        factor, unit = joint.display_unit
        value_text, limit_text = (f"{factor * x:.4g} {unit}" for x in (value, np.clip(value, joint.lower, joint.upper)))
        joints.append(f"{name} at {value_text} (limit {limit_text})")
    return [*reasons, f"Without joint limits, it is reachable with {' and '.join(joints)}."]
