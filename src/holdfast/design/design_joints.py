"""An arm in which every varied number is a joint of its own that stands still: one compiled law for all designs.

A link length is a slide along the link, a twist or a tool angle a turn about it. Simulation, inverse kinematics and
linearisation then take designs as they take configurations, each row its own, and nothing is compiled again.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm.dh_table import dh_table
from holdfast.arm.model import Arm, Joint
from holdfast.control.law import Law
from holdfast.errors import InputError
from holdfast.kernels import SX

Array = NDArray[np.float64]

_X, _Y, _Z = np.eye(3)
_TOOL = {"x": _X, "y": _Y, "z": _Z, "yaw": _Z, "pitch": _Y, "roll": _X}  # as a tool is put on: there, then turned
_SLIDES = ("a", "d", "x", "y", "z")


@dataclass(frozen=True, eq=False)
class DesignJoints:
    """An arm with joints for what is varied.

    Attributes:
        arm: The arm that is given.
        names: (k) What is varied: ``a2``, ``alpha2``, ``d2``, ``theta2`` of row 2 of the arm's standard Denavit-Hartenberg
            table (:func:`holdfast.arm.dh_table.dh_table`), ``tool.x``, ``tool.y``, ``tool.z``, ``tool.roll``, ``tool.pitch``
            or ``tool.yaw`` in the last row's frame.
        whole: The arm with n + k joints.
        moving: (n,) The arm's own joints, as indices of the whole.
        standing: (k,) Those of the design.
        given: (k,) The values of the given arm, m and rad.
    """

    arm: Arm
    names: tuple[str, ...]
    whole: Arm
    moving: NDArray[np.intp]
    standing: NDArray[np.intp]
    given: Array

    @classmethod
    def of(cls, arm: Arm, names: Sequence[str]) -> DesignJoints:
        """Put a joint in for each name.

        Raises:
            InputError: A name that is unknown or given twice, or none.
        """
        if not names or len(set(names)) != len(names):
            raise InputError(f"vary names {', '.join(names) or 'nothing'}; give each number of the arm once, as a2 or tool.z")
        table = dh_table(arm)
        joints: list[Joint] = []
        pending = table.base
        values: dict[str, float] = {}
        for name, axis, sliding, value, own in _parts(arm):
            if own is None and name not in names:
                pending = pending @ _moved(axis, sliding, value)
                continue
            if own is None:
                values[name] = value
                made = Joint(name, "prismatic" if sliding else "continuous", pending, axis)
            else:
                made = replace(own, origin=pending, axis=axis)
            joints.append(made)
            pending = np.eye(4)
        unknown = [name for name in names if name not in values]
        if unknown:
            raise InputError(
                f"'{unknown[0]}' is no number of '{arm.name}'; use a1 to a{arm.n}, alpha, d or theta with a row from 1, or "
                f"{', '.join('tool.' + x for x in ('x', 'y', 'z', 'roll', 'pitch', 'yaw'))}"
            )
        whole = Arm(f"{arm.name}, {', '.join(names)} varied", tuple(joints), tool=pending, gravity=arm.gravity)
        at = {joint.name: k for k, joint in enumerate(joints)}
        moving = np.array([at[name] for name in arm.joint_names])
        standing = np.array([at[name] for name in names])
        return cls(arm, tuple(names), whole, moving, standing, np.array([values[name] for name in names]))

    def configurations(self, values: Array, q: Array) -> Array:
        """(N, n + k) of the whole for designs (k,) or (N, k) and configurations (n,) or (N, n) of the arm."""
        rows = max(len(np.atleast_2d(values)), len(np.atleast_2d(q)))
        out = np.empty((rows, self.whole.n))
        out[:, self.standing], out[:, self.moving] = values, q
        return out

    def arm_of(self, values: Array) -> Arm:
        """The arm of one design (k,), without inertial data."""
        joints: list[Joint] = []
        value = dict(zip(self.standing.tolist(), np.asarray(values).tolist(), strict=True))
        pending = self.whole.base
        for k, joint in enumerate(self.whole.joints):
            pending = pending @ joint.origin
            if k in value:
                pending = pending @ _moved(joint.axis, joint.prismatic, value[k])
            else:
                joints.append(replace(joint, origin=pending))
                pending = np.eye(4)
        return Arm(f"{self.arm.name}, designed", tuple(joints), tool=pending @ self.whole.tool, gravity=self.arm.gravity)

    @cached_property
    def mask(self) -> Array:
        """(n + k,) 1 for the arm's own joints, 0 for those of the design."""
        out = np.zeros(self.whole.n)
        out[self.moving] = 1.0
        return out


class LawOfDesigns(Law):
    """The same law on any design: joints of the design have no part in it.

    Args:
        law: The law of the given arm.
        joints: Its design joints.
    """

    slug = "designs"

    def __init__(self, law: Law, joints: DesignJoints) -> None:
        super().__init__(joints.whole, law.task, law.gain, law.speed_limit)
        self.name, self.source = law.name, law.source
        self.law, self.joints = law, joints

    def inverse(self, j: SX, v: SX) -> SX:
        """See :meth:`Law.inverse`."""
        rates = self.law.inverse(j[:, self.joints.moving.tolist()], v)
        return ca.SX(ca.DM(np.eye(self.arm.n)[:, self.joints.moving])) @ rates


def _parts(arm: Arm) -> Iterator[tuple[str, Array, bool, float, Joint | None]]:
    """Name, axis, whether it slides, value, and the arm's own joint if it is one, of every step from the base to the tool."""
    from scipy.spatial.transform import Rotation

    table = dh_table(arm)
    for k, (row, joint) in enumerate(zip(table.rows, arm.joints, strict=True), 1):
        yield f"theta{k}", _Z, False, row.theta, None
        yield joint.name, _Z, joint.prismatic, 0.0, joint
        yield f"d{k}", _Z, True, row.d, None
        yield f"a{k}", _X, True, row.a, None
        yield f"alpha{k}", _X, False, row.alpha, None
    turns = Rotation.from_matrix(table.tool[:3, :3]).as_euler("ZYX", suppress_warnings=True)
    numbers = [*table.tool[:3, 3].tolist(), *turns.tolist()]
    for (name, axis), value in zip(_TOOL.items(), numbers, strict=True):
        yield f"tool.{name}", axis, name in _SLIDES, value, None


def _moved(axis: Array, sliding: bool, value: float) -> Array:
    from scipy.spatial.transform import Rotation

    out = np.eye(4)
    if sliding:
        out[:3, 3] = axis * value
    else:
        out[:3, :3] = Rotation.from_rotvec(axis * value).as_matrix()
    return out
