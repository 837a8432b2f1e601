"""Write an arm as a URDF file, for example for simulators."""

from __future__ import annotations

from xml.sax.saxutils import quoteattr

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.machine import ArmData, Joint, Link

_ROD_RADIUS_FRACTION = 0.02  # radius of a drawn link, relative to the arm's length


def urdf_text(arm: ArmData) -> str:
    """Return the arm as URDF: joints with their limits, masses if they are known, and a rod from each joint to the next.

    The rods are only a drawing. They are visual elements if masses are known, and otherwise collision elements as well, so that
    a simulator that needs masses can derive some. The fixed frame ``base`` is the world, ``tool`` that of the end effector.
    Limits of speed and effort that are not given are 0, which :meth:`holdfast.Arm.from_urdf` reads as not given.

    Args:
        arm: ArmData model; the format cannot store gravity, payload, rotor inertias, stiction, and states.
    """
    next_origins = [*(joint_after.origin for joint_after in arm.joints[1:]), arm.tool]
    radius = _ROD_RADIUS_FRACTION * sum(float(np.linalg.norm(origin[:3, 3])) for origin in next_origins) or _ROD_RADIUS_FRACTION
    links = arm.links or (None,) * arm.n
    lines = ['<?xml version="1.0"?>', f"<robot name={quoteattr(arm.name)}>", '  <link name="base"/>', '  <link name="mount"/>']
    lines += _fixed_joint_lines("mounted", "base", "mount", arm.base)
    parent = "mount"
    for joint, link, next_origin in zip(arm.joints, links, next_origins, strict=True):
        child = f"{joint.name}_link"
        lines += _joint_lines(joint, parent, child)
        lines += [
            f"  <link name={quoteattr(child)}>",
            *_inertial_lines(link),
            *_rod_lines(next_origin[:3, 3], radius, link is None),
            "  </link>",
        ]
        parent = child
    return "\n".join([*lines, '  <link name="tool"/>', *_fixed_joint_lines("tip", parent, "tool", arm.tool), "</robot>", ""])


def _joint_lines(joint: Joint, parent: str, child: str) -> list[str]:
    limited = np.isfinite([joint.lower, joint.upper]).all()
    joint_type = "prismatic" if joint.prismatic else "revolute" if limited else "continuous"
    lower, upper = (joint.lower, joint.upper) if limited else (0.0, 0.0)
    limit_attributes = f'lower="{lower!r}" upper="{upper!r}" ' if joint_type != "continuous" else ""
    speed, effort = (limit if np.isfinite(limit) else 0.0 for limit in (joint.velocity, joint.effort))
    return [
        f"  <joint name={quoteattr(joint.name)} type={quoteattr(joint_type)}>",
        f"    <parent link={quoteattr(parent)}/>",
        f"    <child link={quoteattr(child)}/>",
        f"    {_origin_element(joint.origin)}",
        f'    <axis xyz="{_join_numbers(joint.axis)}"/>',
        f'    <limit {limit_attributes}velocity="{speed!r}" effort="{effort!r}"/>',
        *_dynamics_lines(joint),
        "  </joint>",
    ]


def _dynamics_lines(joint: Joint) -> list[str]:
    numbers = {"damping": joint.friction, "friction": joint.coulomb_friction}
    attributes = " ".join(f'{name}="{value!r}"' for name, value in numbers.items() if value)
    return [f"    <dynamics {attributes}/>"] if attributes else []


def _fixed_joint_lines(name: str, parent: str, child: str, pose: FloatArray) -> list[str]:
    return [
        f'  <joint name="{name}" type="fixed">',
        f"    <parent link={quoteattr(parent)}/>",
        f'    <child link="{child}"/>',
        f"    {_origin_element(pose)}",
        "  </joint>",
    ]


def _inertial_lines(link: Link | None) -> list[str]:
    if link is None:
        return []
    entries = zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), link.inertia[np.triu_indices(3)].tolist(), strict=True)
    numbers = " ".join(f"{name}={quoteattr(repr(entry))}" for name, entry in entries)
    return [
        "    <inertial>",
        f'      <origin xyz="{_join_numbers(link.com)}"/>',
        f'      <mass value="{float(link.mass)!r}"/>',
        f"      <inertia {numbers}/>",
        "    </inertial>",
    ]


def _rod_lines(end: FloatArray, radius: float, solid: bool) -> list[str]:
    """Return a cylinder from the joint's frame to a point in that frame, or a sphere if the point is its origin."""
    length, frame = float(np.linalg.norm(end)), np.eye(4)
    shape = f'<sphere radius="{radius!r}"/>'
    if length > radius:
        direction = end / length
        frame[:3, :3] = np.linalg.qr(np.column_stack([direction, np.eye(3)]))[0][:, [1, 2, 0]]
        frame[:3, 2] = direction
        frame[:3, 0] = np.cross(frame[:3, 1], direction)
        frame[:3, 3] = end / 2
        shape = f'<cylinder radius="{radius!r}" length="{length!r}"/>'
    geometry = f"{_origin_element(frame)}<geometry>{shape}</geometry>"
    return [f"    <{element}>{geometry}</{element}>" for element in (("visual", "collision") if solid else ("visual",))]


def _origin_element(pose: FloatArray) -> str:
    rotation = pose[:3, :3]
    cosine_of_pitch = float(np.hypot(rotation[0, 0], rotation[1, 0]))
    pitch = np.arctan2(-rotation[2, 0], cosine_of_pitch)
    # At a pitch of +-90 degrees only one of the two other angles counts.
    is_regular = cosine_of_pitch > 1e-9
    roll = np.arctan2(rotation[2, 1], rotation[2, 2]) if is_regular else 0.0
    yaw = np.arctan2(rotation[1, 0], rotation[0, 0]) if is_regular else np.arctan2(-rotation[0, 1], rotation[1, 1])
    return f'<origin xyz="{_join_numbers(pose[:3, 3])}" rpy="{_join_numbers(np.array([roll, pitch, yaw]))}"/>'


def _join_numbers(numbers: FloatArray) -> str:
    return " ".join(repr(float(number)) for number in numbers)
