"""Initial downward acceleration of the tool after a power loss, with dry friction."""

from __future__ import annotations

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.indices.susceptibility.formulas import require_inertia
from holdfast.kinematics.indices.susceptibility.numeric import NumericObjective
from holdfast.model.arm import kinematics, statics
from holdfast.model.arm.friction import Friction, JointFriction
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import JointSet, read_joint_set

_MOST_SWEEPS = 500
_SETTLED_FRACTION = 1e-13  # of the largest acceleration: a sweep that changes less is the last one


class FrictionToolDrop(NumericObjective):
    """Downward acceleration of the tool of an arm at rest as several joints lose their torque, with dry friction.

    The accelerations a minimise ``1/2 a' M a + g' a + sum s_i |a_i|`` over the free joints, with the friction at rest ``s_i``,
    which includes the part that grows with the gravity torque. They are 0 where the arm holds. The gradient is exact except
    where a joint begins to slide, at which the measure has a kink.

    Attributes:
        arm: The arm.
        free: Indices from 0 of the joints without torque.
        friction: Friction of each joint.
    """

    def __init__(self, arm: Arm, free: JointSet, friction: Friction) -> None:
        self.arm, self.free = arm, read_joint_set(arm, free, friction.boards)
        require_inertia(arm, self.free)
        self.friction: JointFriction = friction.of_joints(arm)
        self.name, self.better, self.unit = "tool drop with friction", "smaller", "m/s^2"

    @cached_property
    @cached_kernel
    def _kernel(self) -> Kernel:
        q, a = kinematics.joint_symbols(self.arm), ca.SX.sym("a", self.arm.n)
        torques = statics.gravity_torques(self.arm, statics.composite_bodies(self.arm, q))
        inertia = statics.inertia_matrix(self.arm, q)
        to_tool = kinematics.world_jacobian(self.arm, q)[:3, :].T @ ca.DM(self.arm.down)
        slopes = (ca.jacobian(torques, q), ca.jacobian(inertia @ a, q), ca.jacobian(to_tool, q).T @ a)
        return Kernel("start of a fall", [q, a], [ca.densify(term) for term in (torques, to_tool, inertia, *slopes)])

    def measure(self, q: FloatArray) -> FloatArray:
        """Return the accelerations of the tool and their gradients, (N, 1 + n), at ``q`` (N, n), rad and m."""
        n = self.arm.n
        values = self._kernel.rows(q, np.zeros_like(q))
        torques, to_tool, inertia = values[:, :n], values[:, n : 2 * n], values[:, 2 * n : (2 + n) * n].reshape(-1, n, n)
        friction = self.friction.stiction + self.friction.load * np.abs(torques)
        a = self._find_accelerations(inertia, torques, friction)
        stiffness, coupling, turning = np.split(self._kernel.rows(q, a)[:, (2 + n) * n :], [n * n, 2 * n * n], axis=1)
        stiffness, coupling = (part.reshape(-1, n, n) for part in (stiffness, coupling))
        slides = a != 0
        growth = 1 + self.friction.load * np.sign(torques) * np.sign(a)
        residual_slopes = (stiffness * growth[:, :, None] + coupling) * slides[:, :, None]
        pairs = slides[:, :, None] & slides[:, None, :]
        lever = np.linalg.solve(np.where(pairs, inertia, np.eye(n)), (to_tool * slides)[:, :, None])[:, :, 0]
        gradient = turning - np.einsum("nij,ni->nj", residual_slopes, lever)
        is_valid = np.isfinite(q).all(axis=1, keepdims=True)
        return np.where(is_valid, np.column_stack([np.sum(to_tool * a, axis=1), gradient]), np.nan)

    def _find_accelerations(self, inertia: FloatArray, torques: FloatArray, friction: FloatArray) -> FloatArray:
        """Return the accelerations (N, n): joint by joint until nothing changes, then exactly for the joints that move."""
        a = np.zeros_like(torques)
        for _ in range(_MOST_SWEEPS):
            before = a.copy()
            for joint in self.free:
                own = inertia[:, joint, joint]
                push = -torques[:, joint] - np.einsum("nk,nk->n", inertia[:, joint], a) + own * a[:, joint]
                a[:, joint] = np.sign(push) * np.maximum(np.abs(push) - friction[:, joint], 0) / own
            if not (np.abs(a - before) > _SETTLED_FRACTION * np.abs(a).max(initial=0.0)).any():
                break
        slides = a != 0
        pairs, right_side = slides[:, :, None] & slides[:, None, :], -(torques + friction * np.sign(a)) * slides
        exact = np.linalg.solve(np.where(pairs, inertia, np.eye(self.arm.n)), right_side[:, :, None])[:, :, 0]
        return np.where(np.isfinite(exact) & slides, exact, 0.0)


@check_arguments
def tool_drop_with_friction(arm: Arm, friction: Friction, free: JointSet = None) -> FrictionToolDrop:
    """Return the initial downward acceleration of the tool as joints lose their torque together, with dry friction.

    After a short time t the tool has dropped by half of it times t^2. Without friction, the value is that of
    ``tool_drop``.

    Args:
        arm: Model with inertial data.
        friction: Friction of the joints.
        free: Joints without torque: names and indices from 0, or one text with names and numbers from 1 between commas;
            default: all joints.

    Raises:
        ArmError: The mass or inertia of a link is unknown or impossible, or a free joint carries no mass.
        InputError: A joint does not exist, or a number of the friction is wrong.
    """
    return FrictionToolDrop(arm, free, friction)
