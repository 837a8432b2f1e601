"""Energy that an arm releases until it hangs still, if several joints lose their torque at the same time."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.indices.susceptibility.formulas import require_inertia
from holdfast.kinematics.indices.susceptibility.numeric import NumericObjective
from holdfast.model.arm import kinematics, statics
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import JointSet, read_joint_set

_MAX_STEP = 0.05  # rad or m, about; so that the descent follows the slow fall
_MAX_STEPS = 2000
_SETTLED_STEP = 1e-12  # rad or m


class SwingEnergy(NumericObjective):
    """Potential energy at a configuration, minus that at the equilibrium to which the free joints sink; smaller is better.

    The joints in ``free`` sink slowly, as with strong viscous friction, until they hang still or lie against their stops. All
    other joints are held. For one joint i without limits the energy is ``R_i (1 - cos theta_i)`` with the swing angle of
    English and Maciejewski 1998, eq. (38).

    Attributes:
        arm: The arm.
        free: Indices from 0 of the joints without torque.
    """

    def __init__(self, arm: Arm, free: JointSet = None) -> None:
        self.arm, self.free = arm, read_joint_set(arm, free)
        require_inertia(arm, self.free)
        self.name, self.better, self.unit = "swing energy", "smaller", "J"

    @cached_property
    @cached_kernel
    def _kernel(self) -> Kernel:
        q = kinematics.joint_symbols(self.arm)
        bodies = statics.composite_bodies(self.arm, q)
        torques = statics.gravity_torques(self.arm, bodies)
        terms = (torques, ca.jacobian(torques, q), statics.inertia_matrix(self.arm, q))
        return Kernel("energy and its slopes", [q], [statics.potential_energy(bodies), *map(ca.densify, terms)])

    def _evaluate_terms(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return the energy (N,), the gravity torques (N, n), their Jacobian, and the inertia matrix (N, n, n)."""
        n, values = self.arm.n, self._kernel.rows(q)
        stiffness, inertia = values[:, 1 + n :].reshape(-1, 2, n, n).swapaxes(0, 1)
        return values[:, 0], values[:, 1 : 1 + n], stiffness, inertia

    def settle(self, q: ArrayLike) -> FloatArray:
        """Return the equilibria (N, n) or (n,) to which the free joints sink from configurations, rad and m."""
        rows, single = as_configurations(self.arm, q)
        lower, upper = np.fmin(self.arm.lower, rows), np.fmax(self.arm.upper, rows)  # from outside no joint moves further out
        rows = rows.copy()
        moving = np.flatnonzero(np.isfinite(rows).all(axis=1))
        for _ in range(_MAX_STEPS):
            if not moving.size:
                break
            steps = self._find_steps(rows[moving], lower[moving], upper[moving])
            sunk = np.clip(rows[moving] + steps, lower[moving], upper[moving])
            is_moving = np.abs(sunk - rows[moving]).max(axis=1) > _SETTLED_STEP
            rows[moving] = sunk
            moving = moving[is_moving]
        return rows[0] if single else rows

    def _find_steps(self, q: FloatArray, lower: FloatArray, upper: FloatArray) -> FloatArray:
        """Return damped Newton steps (N, n) down the potential energy, in the metric of the inertia matrix, between stops."""
        _, torques, stiffness, inertia = self._evaluate_terms(q)
        blocked = ((q <= lower) & (torques > 0)) | ((q >= upper) & (torques < 0))
        sinks = np.isin(np.arange(self.arm.n), self.free) & ~blocked
        pairs, identity = sinks[:, :, None] & sinks[:, None, :], np.eye(self.arm.n)
        factor = np.linalg.inv(np.linalg.cholesky(np.where(pairs, inertia, identity)))
        curvatures, directions = np.linalg.eigh(factor @ np.where(pairs, stiffness, 0.0) @ factor.swapaxes(1, 2))
        back = factor.swapaxes(1, 2) @ directions
        slopes = np.einsum("nik,ni->nk", back, np.where(sinks, torques, 0.0))
        acceleration = np.abs(np.einsum("nik,nk->ni", back, slopes)).max(axis=1)
        damping = np.maximum(-curvatures[:, :1], 0.0) + acceleration[:, None] / _MAX_STEP + 1e-12
        steps = np.einsum("nik,nk->ni", back, slopes / (np.maximum(curvatures, -damping) + damping + 1e-300))
        return np.asarray(-steps * sinks)

    def measure(self, q: FloatArray) -> FloatArray:
        """Return the energies and their gradients, (N, 1 + n), at ``q`` (N, n), rad and m."""
        lowest = self.settle(q)
        energy, torques, *_ = self._evaluate_terms(q)
        lowest_energy, lowest_torques, *_ = self._evaluate_terms(lowest)
        is_held = ~np.isin(np.arange(self.arm.n), self.free) | ((lowest == q) & ((q < self.arm.lower) | (q > self.arm.upper)))
        return np.column_stack([energy - lowest_energy, torques - is_held * lowest_torques])


@check_arguments
def swing_energy(arm: Arm, free: JointSet = None) -> SwingEnergy:
    """The energy that joints release after they lose their torque together, until they hang still or lie at their stops.

    Args:
        arm: Model with inertial data.
        free: Joints without torque: names and indices from 0, or one text with names and numbers from 1 between commas;
            default: all joints.

    Raises:
        ArmError: The mass or inertia of a link is unknown or impossible, or a free joint carries no mass.
        InputError: A joint does not exist.
    """
    return SwingEnergy(arm, free)
