"""Read arms from robots of the Robotics Toolbox for Python."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from holdfast.core.errors import ArmError
from holdfast.core.typing import FloatArray
from holdfast.model.arm.formats.tree import LinkTree, TreeJoint, build_chain, fixed_joint
from holdfast.model.arm.machine import Link
from holdfast.model.arm.model import Arm

WORLD_LINK = "world"


def read_toolbox_robot(
    robot: Any,
    base: str | None = None,
    tip: str | None = None,
    hold: Mapping[str, float] | None = None,
    name: str | None = None,
) -> Arm:
    """Return the serial arm from link ``base`` to link ``tip`` of a ``DHRobot`` or ``Robot`` of the Robotics Toolbox.

    The base and tool of the robot are part of the arm. Rotor inertia and viscous friction of the motors are referred to the
    joints by the square of the gear ratio; Coulomb friction is left out.

    Args:
        robot: The robot.
        base: Link on which the arm is mounted; default: the world.
        tip: Link whose frame is the tool; optional as for a URDF file.
        hold: Values, rad or m, of held joints.
        name: Name of the arm; default: that of the robot.

    Raises:
        ArmError: The robot has no single serial chain from base to tip.
    """
    if not hasattr(robot, "gravload"):
        raise ArmError(f"no arm can be made of a roboticstoolbox.{type(robot).__name__}; give a robot")
    label = f"roboticstoolbox robot '{robot.name}'"
    try:
        tree = _read_tree(robot)
        gravity = [float(component) for component in robot.gravity]
        data = build_chain(tree, base, tip, hold or {}, name or robot.name or "arm", gravity, label, in_world=True)
    except ArmError as error:
        raise ArmError(f"{label}: {error}", tip=error.tip) from error
    return Arm(**replace(data, tool=data.tool @ robot.tool.A).__getstate__())


def _read_tree(robot: Any) -> LinkTree:
    is_table = any(hasattr(link, "mdh") for link in robot.links)  # a DHRobot, whose links name no parents
    has_masses = any(link.m for link in robot.links)
    bodies: dict[str, Link | None] = {WORLD_LINK: None}
    joints: dict[str, TreeJoint] = {}
    link_names = {id(link): link.name or f"link{number}" for number, link in enumerate(robot.links, start=1)}
    after_joint = {WORLD_LINK: np.asarray(robot.base.A)}  # pose of a link's own frame in its joint's moving frame
    previous = WORLD_LINK
    for link in robot.links:
        name = link_names[id(link)]
        parent = previous if is_table else link_names[id(link.parent)] if link.parent is not None else WORLD_LINK
        before, variable, after = _split_transforms(link)
        origin = after_joint[parent] @ before
        joint = fixed_joint(name, parent, origin) if variable is None else _read_joint(link, variable, parent, name, origin)
        joints[joint.name] = joint
        after_joint[name] = after
        body = Link(float(link.m), np.array(link.r), np.array(link.I), name=name) if has_masses else None
        bodies[name] = None if body is None else body.in_frame(after)
        previous = name
    if not np.array_equal(after_joint[previous], np.eye(4)):  # only tables have transforms after a joint
        end = fixed_joint("end", previous, after_joint[previous])
        bodies["end"], joints[end.name] = None, end
    return LinkTree(robot.name, bodies, joints, limits_required=False)


def _split_transforms(link: Any) -> tuple[FloatArray, Any, FloatArray]:
    """Return the constant transforms before the joint, the joint (None for a fixed link), and those after it."""
    before, after, variable = np.eye(4), np.eye(4), None
    for transform in link.ets:
        if transform.isjoint:
            variable = transform
        elif variable is None:
            before = before @ transform.A()
        else:
            after = after @ transform.A()
    return before, variable, after


def _read_joint(link: Any, variable: Any, parent: str, child: str, origin: FloatArray) -> TreeJoint:
    is_prismatic = variable.kind.startswith("t")
    axis = np.eye(3)["xyz".index(variable.kind[-1])] * (-1.0 if variable.isflip else 1.0)
    limits = np.full(2, np.nan) if link.qlim is None else np.asarray(link.qlim, dtype=np.float64).ravel()
    lower, upper = np.where(np.isfinite(limits), limits, [-np.inf, np.inf]).tolist()
    gear_ratio = float(link.G) if link.G else 1.0
    return TreeJoint(
        name=getattr(link, "_joint_name", None) or f"joint{link.jindex + 1}",
        type="prismatic" if is_prismatic else "revolute" if np.isfinite([lower, upper]).any() else "continuous",
        parent=parent,
        child=child,
        origin=origin,
        axis=axis,
        lower=lower,
        upper=upper,
        velocity=np.inf,
        effort=np.inf,
        friction=float(link.B) * gear_ratio**2,
        armature=float(link.Jm) * gear_ratio**2,
    )
