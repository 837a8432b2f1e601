"""An arm as a URDF file, for simulators and whatever else reads one."""

from __future__ import annotations

from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.machine import Joint, Link
from holdfast.arm.model import Arm

Array = NDArray[np.float64]

_THICK = 0.02  # radius of a link that is drawn, of the arm's length


def urdf_text(arm: Arm) -> str:
    """The arm as URDF: joints with their limits, masses where they are known, and a rod from each joint to the next.

    The rods are a drawing, no shape of the arm: visual where masses are known, else for collisions, too, so that a simulator
    that needs masses makes some. The fixed frame ``base`` is the world, ``tool`` the end effector's. Limits of speed and effort
    that are not given are 0, which :meth:`holdfast.Arm.from_urdf` reads as not given.

    Args:
        arm: Any arm; gravity, payload, rotor inertias and states have no place in the format.
    """
    ends = [*(j.origin for j in arm.joints[1:]), arm.tool]
    thick = _THICK * sum(float(np.linalg.norm(end[:3, 3])) for end in ends) or _THICK
    links = arm.links or (None,) * arm.n
    lines = ['<?xml version="1.0"?>', f"<robot name={quoteattr(arm.name)}>", '  <link name="base"/>', '  <link name="mount"/>']
    lines += _fixed("mounted", "base", "mount", arm.base)
    parent = "mount"
    for joint, link, end in zip(arm.joints, links, ends, strict=True):
        child = f"{joint.name}_link"
        lines += _joint(joint, parent, child)
        lines += [f"  <link name={quoteattr(child)}>", *_inertial(link), *_rod(end[:3, 3], thick, link is None), "  </link>"]
        parent = child
    return "\n".join([*lines, '  <link name="tool"/>', *_fixed("tip", parent, "tool", arm.tool), "</robot>", ""])


def _joint(joint: Joint, parent: str, child: str) -> list[str]:
    limited = np.isfinite([joint.lower, joint.upper]).all()
    kind = "prismatic" if joint.prismatic else "revolute" if limited else "continuous"
    low, high = (joint.lower, joint.upper) if limited else (0.0, 0.0)
    ends = f'lower="{low!r}" upper="{high!r}" ' if kind != "continuous" else ""
    speed, effort = (x if np.isfinite(x) else 0.0 for x in (joint.velocity, joint.effort))
    return [
        f"  <joint name={quoteattr(joint.name)} type={quoteattr(kind)}>",
        f"    <parent link={quoteattr(parent)}/>",
        f"    <child link={quoteattr(child)}/>",
        f"    {_origin(joint.origin)}",
        f'    <axis xyz="{_text(joint.axis)}"/>',
        f'    <limit {ends}velocity="{speed!r}" effort="{effort!r}"/>',
        *([f'    <dynamics damping="{joint.friction!r}"/>'] if joint.friction else []),
        "  </joint>",
    ]


def _fixed(name: str, parent: str, child: str, pose: Array) -> list[str]:
    return [
        f'  <joint name="{name}" type="fixed">',
        f"    <parent link={quoteattr(parent)}/>",
        f'    <child link="{child}"/>',
        f"    {_origin(pose)}",
        "  </joint>",
    ]


def _inertial(link: Link | None) -> list[str]:
    if link is None:
        return []
    upper = zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), link.inertia[np.triu_indices(3)].tolist(), strict=True)
    numbers = " ".join(f"{name}={quoteattr(repr(x))}" for name, x in upper)
    return [
        "    <inertial>",
        f'      <origin xyz="{_text(link.com)}"/>',
        f'      <mass value="{float(link.mass)!r}"/>',
        f"      <inertia {numbers}/>",
        "    </inertial>",
    ]


def _rod(end: Array, thick: float, solid: bool) -> list[str]:
    """A cylinder from the joint's frame to a point of it, or a ball where that is the frame itself."""
    length, frame = float(np.linalg.norm(end)), np.eye(4)
    shape = f'<sphere radius="{thick!r}"/>'
    if length > thick:
        along = end / length
        frame[:3, :3] = np.linalg.qr(np.column_stack([along, np.eye(3)]))[0][:, [1, 2, 0]]
        frame[:3, 2] = along
        frame[:3, 0] = np.cross(frame[:3, 1], along)
        frame[:3, 3] = end / 2
        shape = f'<cylinder radius="{thick!r}" length="{length!r}"/>'
    drawn = f"{_origin(frame)}<geometry>{shape}</geometry>"
    return [f"    <{use}>{drawn}</{use}>" for use in (("visual", "collision") if solid else ("visual",))]


def _origin(pose: Array) -> str:
    r = pose[:3, :3]
    flat = float(np.hypot(r[0, 0], r[1, 0]))
    pitch = np.arctan2(-r[2, 0], flat)
    # Looking along z only one of the two other angles counts.
    apart = flat > 1e-9
    roll = np.arctan2(r[2, 1], r[2, 2]) if apart else 0.0
    yaw = np.arctan2(r[1, 0], r[0, 0]) if apart else np.arctan2(-r[0, 1], r[1, 1])
    return f'<origin xyz="{_text(pose[:3, 3])}" rpy="{_text(np.array([roll, pitch, yaw]))}"/>'


def _text(numbers: Array) -> str:
    return " ".join(repr(float(x)) for x in numbers)
