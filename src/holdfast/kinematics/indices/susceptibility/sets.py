"""Susceptibilities of joints that lose their torque at the same time, while all other joints are held exactly.

With the gravity torques g and the inertia matrix M, the free joints F of an arm at rest start with the accelerations
``a_F = -M_FF^-1 g_F``. A single free joint has the acceleration of English and Maciejewski 1998, eq. (22).
"""

from __future__ import annotations

from functools import partial
from typing import Annotated, Any

import casadi as ca
import numpy as np

from holdfast.core.registry import Parameter, constructor
from holdfast.kernels.linalg import Cholesky
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.susceptibility.formulas import DEGENERATE_RATIO, SusceptibilityFormula, Total, require_inertia
from holdfast.kinematics.indices.susceptibility.measure import Susceptibility
from holdfast.model.arm import kinematics, statics
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import JointSet, read_joint_set


class FreeSetSusceptibility(Susceptibility):
    """Effect of the torque loss of several joints at the same time; smaller is better.

    The arm is at rest, and no joint holds by friction or by a stop. ``by_joint`` is the acceleration of each joint, 0 for held
    joints.

    Attributes:
        free: Indices from 0 of the joints without torque.
    """

    def __init__(self, name: str, arm: Arm, free: JointSet, *, total: Total | None = None, total_unit: str = "") -> None:
        self.free = read_joint_set(arm, free)
        formula = SusceptibilityFormula(
            name,
            "a_F = -M_FF^-1 g_F; for one joint English and Maciejewski 1998, eq. (22)",
            "rad/s^2",
            sliding="m/s^2",
            slides=True,
            check=partial(require_inertia, free=self.free),
            values=partial(_accelerations, free=self.free),
            total=total,
            total_unit=total_unit,
        )
        super().__init__(formula, arm)

    @property
    def settings(self) -> dict[str, Any]:
        """Free joints by name, or None for all joints."""
        return {"free": None if len(self.free) == self.arm.n else tuple(self.arm.joint_names[k] for k in self.free)}

    def describe(self) -> str:
        """Return a phrase with the name of the measure and the free joints."""
        names = ", ".join(self.arm.joint_names[k] for k in self.free)
        return f"{self.name} after {'all joints' if len(self.free) == self.arm.n else names} swing free together"


def _accelerations(arm: Arm, q: SX, free: tuple[int, ...]) -> tuple[SX, SX]:
    """Return the accelerations of all joints, NaN if the free joints can move without moving a mass."""
    bodies, inertia = statics.composite_bodies(arm, q), statics.inertia_matrix(arm, q)
    torques = statics.gravity_torques(arm, bodies)
    factor = Cholesky([[inertia[i, k] for k in free] for i in free])
    lengths = [1.0 if arm.joints[k].prismatic else statics.length_scale(arm) for k in free]
    smallest = [DEGENERATE_RATIO * bodies.masses[k] * length**2 for k, length in zip(free, lengths, strict=True)]
    is_singular = ca.logic_any(ca.vertcat(*factor.pivots) <= ca.DM(smallest))
    accelerations = ca.SX(arm.n, 1)
    for k, solved in zip(free, factor.solve([-torques[i] for i in free]), strict=True):
        accelerations[k] = ca.if_else(is_singular, np.nan, solved)
    return accelerations, ca.DM.zeros(arm.n)


def _release_rate(arm: Arm, q: SX, accelerations: SX) -> SX:
    return -ca.dot(statics.gravity_torques(arm, statics.composite_bodies(arm, q)), accelerations)


def _tool_acceleration(arm: Arm, q: SX, accelerations: SX) -> SX:
    return ca.dot(ca.DM(arm.down), kinematics.world_jacobian(arm, q)[:3, :] @ accelerations)


def _last_two(arm: Arm, task: object) -> tuple[str, ...]:
    del task
    return arm.joint_names[-2:]


Free = Annotated[JointSet, Parameter("1", "joints that fail together, default all", example="_last_two")]


@constructor(needs=("inertia",))
def free_acceleration(arm: Arm, free: Free = None) -> FreeSetSusceptibility:
    """The accelerations with which several joints start as they lose their torque together, as a sum of squares.

    Args:
        arm: Model with inertial data.
        free: Joints without torque: names and indices from 0, or one text with names and numbers from 1 between commas;
            default: all joints.

    Raises:
        ArmError: The mass or inertia of a link is unknown or impossible, or a free joint carries no mass.
        InputError: A joint does not exist.
    """
    return FreeSetSusceptibility("free acceleration", arm, free)


@constructor(needs=("inertia",))
def release(arm: Arm, free: Free = None) -> FreeSetSusceptibility:
    """The rate of energy release as several joints lose their torque together: kinetic energy is half of it times t^2.

    It is ``g_F' M_FF^-1 g_F`` in J/s^2. ``arm``, ``free``, and the errors are as for :func:`free_acceleration`.
    """
    return FreeSetSusceptibility("release", arm, free, total=_release_rate, total_unit="J/s^2")


@constructor(needs=("inertia",))
def tool_drop(arm: Arm, free: Free = None) -> FreeSetSusceptibility:
    """The downward acceleration of the tool as several joints lose their torque together: the drop is half of it times t^2.

    It is ``u' J a`` in m/s^2, with the direction u of gravity, and negative if the tool starts upwards. ``arm``, ``free``, and
    the errors are as for :func:`free_acceleration`.
    """
    return FreeSetSusceptibility("tool drop", arm, free, total=_tool_acceleration, total_unit="m/s^2")
