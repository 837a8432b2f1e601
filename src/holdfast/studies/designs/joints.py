"""Arm in which every varied number is a separate joint that never moves, so that one compiled law serves all designs.

A link length becomes a prismatic joint along the link, a twist or a tool angle a revolute joint. Simulation, inverse kinematics
and linearisation then take designs in the same way as configurations, one for each row, and nothing is compiled again.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import KW_ONLY, dataclass, replace

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.control.laws.law import Law
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kernels.program import SX
from holdfast.kinematics.regions.region import rpy_from_rotation
from holdfast.model.arm.machine import Joint
from holdfast.model.arm.model import Arm
from holdfast.studies.designs.space import DesignSpace

_X_AXIS, _Y_AXIS, _Z_AXIS = np.eye(3)


@dataclass(frozen=True, eq=False)
class DesignJoints:
    """Arm with additional joints for the varied parameters.

    Attributes:
        space: Design space, without joint limits.
        whole: Whole arm with n + k joints.
        moving: (n,) indices of the arm's joints in the whole arm.
        varied: (k,) indices of the joints of the design in the whole arm.
    """

    space: DesignSpace
    whole: Arm
    moving: NDArray[np.intp]
    _: KW_ONLY
    varied: NDArray[np.intp]

    @classmethod
    def from_space(cls, space: DesignSpace) -> DesignJoints:
        """Insert a joint for each parameter of ``space``.

        Raises:
            InputError: A joint limit is varied.
        """
        limits = [parameter.name for parameter in space.parameters if parameter.kind in ("lower", "upper")]
        if limits:
            raise InputError(f"{limits[0]} is a joint limit, which no control law enforces; vary lengths, twists or the tool")
        joints: list[Joint] = []
        pending = space.table.base
        for name, axis, is_prismatic, value, own_joint in _iterate_steps(space):
            if own_joint is not None:
                joints.append(replace(own_joint, origin=pending, axis=axis))
            elif name in space.names:
                joints.append(Joint(name, "prismatic" if is_prismatic else "continuous", pending, axis=axis))
            else:
                pending = pending @ _make_transform(axis, is_prismatic, value)
                continue
            pending = np.eye(4)
        arm = space.arm
        whole = Arm(
            name=f"{arm.name}, {', '.join(space.names)} varied", joints=tuple(joints), tool=pending, gravity=arm.gravity
        )
        indices = {joint.name: index for index, joint in enumerate(joints)}
        moving = np.array([indices[name] for name in arm.joint_names])
        return cls(space, whole, moving, varied=np.array([indices[name] for name in space.names]))

    @property
    def arm(self) -> Arm:
        """Baseline arm."""
        return self.space.arm

    def configurations(self, values: FloatArray, q: FloatArray) -> FloatArray:
        """Return configurations (N, n + k) of the whole arm, rad and m, for ``values`` (k,) or (N, k), ``q`` (n,) or (N, n)."""
        row_count = max(len(np.atleast_2d(values)), len(np.atleast_2d(q)))
        combined = np.empty((row_count, self.whole.n))
        combined[:, self.varied], combined[:, self.moving] = values, q
        return combined

    @cached_property
    def mask(self) -> FloatArray:
        """(n + k,) mask that is 1 for the arm's joints and 0 for the joints of the design."""
        values = np.zeros(self.whole.n)
        values[self.moving] = 1.0
        return values


class LawOfDesigns(Law):
    """Control law on any design, which moves no joint of the design.

    Args:
        law: Control law of the baseline arm.
        joints: Baseline arm with the joints of the designs.
    """

    slug = "designs"

    def __init__(self, law: Law, joints: DesignJoints) -> None:
        super().__init__(joints.whole, law.task, law.gain, speed_limit=law.speed_limit)
        self.name, self.source = law.name, law.source
        self.law, self.joints = law, joints

    def inverse(self, j: SX, v: SX) -> SX:
        """Return the rates (n + k,) of the original law for the moving joints' columns of ``j`` (m, n + k), and ``v`` (m,)."""
        rates = self.law.inverse(j[:, self.joints.moving.tolist()], v)
        return ca.SX(ca.DM(np.eye(self.arm.n)[:, self.joints.moving])) @ rates


def _iterate_steps(space: DesignSpace) -> Iterator[tuple[str, FloatArray, bool, float, Joint | None]]:
    """Yield name, axis, prismatic flag, value, and joint of the arm (or None) for every step from the base to the tool."""
    for number, (row, joint) in enumerate(zip(space.table.rows, space.arm.joints, strict=True), 1):
        yield f"theta{number}", _Z_AXIS, False, row.theta, None
        yield joint.name, _Z_AXIS, joint.prismatic, 0.0, joint
        yield f"d{number}", _Z_AXIS, True, row.d, None
        yield f"a{number}", _X_AXIS, True, row.a, None
        yield f"alpha{number}", _X_AXIS, False, row.alpha, None
    tool = space.table.tool
    yaw, pitch, roll = rpy_from_rotation(tool[:3, :3])  # in the order of that function: the rotation about z is the first
    for name, axis, value in zip(("x", "y", "z"), np.eye(3), tool[:3, 3], strict=True):
        yield f"tool.{name}", axis, True, float(value), None
    for name, axis, value in (("yaw", _Z_AXIS, yaw), ("pitch", _Y_AXIS, pitch), ("roll", _X_AXIS, roll)):
        yield f"tool.{name}", axis, False, float(value), None


def _make_transform(axis: FloatArray, is_prismatic: bool, value: float) -> FloatArray:
    from scipy.spatial.transform import Rotation

    transform = np.eye(4)
    if is_prismatic:
        transform[:3, 3] = axis * value
    else:
        transform[:3, :3] = Rotation.from_rotvec(axis * value).as_matrix()
    return transform
