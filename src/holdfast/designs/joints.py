"""An arm in which every varied number is a joint of its own that never moves: one compiled law for all designs.

A link length is a slide along the link, a twist or a tool angle a turn about it. Simulation, inverse kinematics and
linearisation then take designs as they take configurations, each row its own, and nothing is compiled again.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import KW_ONLY, dataclass, replace

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm.machine import Joint
from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.designs.space import DesignSpace
from holdfast.errors import InputError
from holdfast.kernels.program import SX

Array = NDArray[np.float64]

_X, _Y, _Z = np.eye(3)


@dataclass(frozen=True, eq=False)
class DesignJoints:
    """An arm with joints for what is varied.

    Attributes:
        space: What is varied; not joint limits.
        whole: The arm with n + k joints.
        moving: (n,) The arm's own joints, as indices of the whole.
        varied: (k,) Those of the design.
    """

    space: DesignSpace
    whole: Arm
    moving: NDArray[np.intp]
    _: KW_ONLY
    varied: NDArray[np.intp]

    @classmethod
    def of(cls, space: DesignSpace) -> DesignJoints:
        """Put a joint in for each parameter.

        Raises:
            InputError: A limit is varied.
        """
        limits = [p.name for p in space.parameters if p.kind in ("lower", "upper")]
        if limits:
            raise InputError(f"{limits[0]} is a joint limit, which no control law heeds; vary lengths, twists or the tool")
        joints: list[Joint] = []
        pending = space.table.base
        for name, axis, sliding, value, own in _parts(space):
            if own is not None:
                joints.append(replace(own, origin=pending, axis=axis))
            elif name in space.names:
                joints.append(Joint(name, "prismatic" if sliding else "continuous", pending, axis=axis))
            else:
                pending = pending @ _moved(axis, sliding, value)
                continue
            pending = np.eye(4)
        arm = space.arm
        whole = Arm(
            name=f"{arm.name}, {', '.join(space.names)} varied", joints=tuple(joints), tool=pending, gravity=arm.gravity
        )
        at = {joint.name: k for k, joint in enumerate(joints)}
        moving = np.array([at[name] for name in arm.joint_names])
        return cls(space, whole, moving, varied=np.array([at[name] for name in space.names]))

    @property
    def arm(self) -> Arm:
        """The given arm."""
        return self.space.arm

    def configurations(self, values: Array, q: Array) -> Array:
        """(N, n + k) of the whole for designs (k,) or (N, k) and configurations (n,) or (N, n) of the arm."""
        rows = max(len(np.atleast_2d(values)), len(np.atleast_2d(q)))
        out = np.empty((rows, self.whole.n))
        out[:, self.varied], out[:, self.moving] = values, q
        return out

    @cached_property
    def mask(self) -> Array:
        """(n + k,) 1 for the arm's own joints, 0 for those of the design."""
        out = np.zeros(self.whole.n)
        out[self.moving] = 1.0
        return out


class LawOfDesigns(Law):
    """The same law on any design: it moves no joint of the design.

    Args:
        law: The law of the given arm.
        joints: Its design joints.
    """

    slug = "designs"

    def __init__(self, law: Law, joints: DesignJoints) -> None:
        super().__init__(joints.whole, law.task, law.gain, speed_limit=law.speed_limit)
        self.name, self.source = law.name, law.source
        self.law, self.joints = law, joints

    def inverse(self, j: SX, v: SX) -> SX:
        """The law's own inverse with the columns of the joints that move."""
        rates = self.law.inverse(j[:, self.joints.moving.tolist()], v)
        return ca.SX(ca.DM(np.eye(self.arm.n)[:, self.joints.moving])) @ rates


def _parts(space: DesignSpace) -> Iterator[tuple[str, Array, bool, float, Joint | None]]:
    """Name, axis, whether it slides, value, and the arm's own joint if it is one, of every step from the base to the tool."""
    from scipy.spatial.transform import Rotation

    for k, (row, joint) in enumerate(zip(space.table.rows, space.arm.joints, strict=True), 1):
        yield f"theta{k}", _Z, False, row.theta, None
        yield joint.name, _Z, joint.prismatic, 0.0, joint
        yield f"d{k}", _Z, True, row.d, None
        yield f"a{k}", _X, True, row.a, None
        yield f"alpha{k}", _X, False, row.alpha, None
    tool = space.table.tool
    yaw, pitch, roll = Rotation.from_matrix(tool[:3, :3]).as_euler("ZYX", suppress_warnings=True)
    for name, axis, value in zip(("x", "y", "z"), np.eye(3), tool[:3, 3], strict=True):
        yield f"tool.{name}", axis, True, float(value), None
    for name, axis, value in (("yaw", _Z, yaw), ("pitch", _Y, pitch), ("roll", _X, roll)):
        yield f"tool.{name}", axis, False, float(value), None


def _moved(axis: Array, sliding: bool, value: float) -> Array:
    from scipy.spatial.transform import Rotation

    out = np.eye(4)
    if sliding:
        out[:3, 3] = axis * value
    else:
        out[:3, :3] = Rotation.from_rotvec(axis * value).as_matrix()
    return out
