"""Control law that excludes joints that no longer follow their commands."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.control.laws.law import Law
from holdfast.control.simulation.system import ColumnLayout
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.solvers.inverse_kinematics import task_error_and_jacobian
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.task import target_poses
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.exact.exact_clearance import with_exact_distances

LIMIT_TOLERANCE = 2e-3  # rad or m; a joint nearer to its limit is at the limit, because sensors have noise
MIN_PROGRESS = 1e-3  # m and rad; a smaller decrease of the error is no progress
PROGRESS_TIMEOUT_S = 1.5  # a law without progress for this time has ended
TARGET_TOLERANCE = 2e-3  # m and rad; a law whose predicted error is smaller reaches its target
PREDICTION_HORIZON_S = 12.0  # forward simulation of a law
PREDICTION_STEP_S = 0.05  # time step of the forward simulation


@cached_kernel
def make_masked_kernel(law: Law) -> Kernel:
    """Compile ``(q, p, R, mask, pull) -> rates, position_error, orientation_error`` of the law without the masked joints.

    ``rates`` (n,) are the joint rates of the law without the Jacobian columns of masked joints. ``pull`` (n,) are the rates
    that a secondary objective requests; their part in the null space of the task is added. The errors are the norms of the
    linear part in m and of the angular part in rad.
    """
    arm, task = law.arm, law.task
    q, mask, pull = kinematics.joint_symbols(arm), ca.SX.sym("mask", arm.n), ca.SX.sym("pull", arm.n)
    position, rotation = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
    error, _ = task_error_and_jacobian(arm, task, q, position, rotation)
    jacobian, secondary_rates = law.jacobian(q) @ ca.diag(mask), mask * pull
    rates = mask * (
        law.inverse(jacobian, law.scale_velocity(law.command(error)) - jacobian @ secondary_rates) + secondary_rates
    )
    parts = [ca.norm_2(ca.SX(ca.DM(task.rows[:, rows].T)) @ error) for rows in (slice(0, 3), slice(3, 6))]
    return Kernel("law with a mask", [q, position, rotation, mask, pull], [ca.vertcat(rates, *parts)])


class MaskedLaw:
    """Control law that computes one step after the other towards a target without the masked joints.

    Args:
        law: Control law of all joints.
        target: (4, 4) pose, or the task's rows (m,), m.
        centring: Rate in 1/s at which joints with two limits move to their middle, in the null space of the task.
        clearance: Collision model for the forward simulation of the law; None: collisions are not checked.

    Attributes:
        whole: Control law of all joints.
        arm: Arm of the law.
        clearance: Collision model, or None.
        pose: (4, 4) target pose.
        mask: (n,) 1 for joints that follow, 0 for the others.
        position_error: Distance of the tool from its target in the last step, m.
        orientation_error: Angle between the tool and its target in the last step, rad.
    """

    def __init__(self, law: Law, target: ArrayLike, *, centring: float, clearance: Clearance | None = None) -> None:
        poses, rows = target_poses(law.task, target)
        self.arm, arm, n = law.arm, law.arm, law.arm.n
        self.whole, self.clearance = law, clearance
        self._exact_clearance = with_exact_distances(clearance) or clearance  # routes are proved with exact distances too
        self.pose = np.eye(4)
        if rows is None:
            self.pose = np.asarray(poses[0])
        else:
            self.pose[:3, 3] = rows[0] @ law.task.rows[:, :3]
        self.mask, self.position_error, self.orientation_error = np.ones(n), np.inf, np.inf
        bounded = np.isfinite(arm.lower) & np.isfinite(arm.upper)
        self._middle = np.mean(sampling_limits(arm), axis=0)
        self._centring_gains, self._rows = np.where(bounded, centring, 0.0), law.task.m
        self._lower, self._upper = arm.lower + LIMIT_TOLERANCE, arm.upper - LIMIT_TOLERANCE
        self._kernel, self._gain = make_masked_kernel(law), law.gain
        self._run = self._kernel.single_row()
        inputs = ColumnLayout(q=n, position=3, rotation=9, mask=n, pull=n)
        self._inputs = np.zeros(inputs.size)
        self._parts = inputs.view_parts(self._inputs[None])
        self._parts["position"][:], self._parts["rotation"][:] = self.pose[:3, 3], self.pose[:3, :3].ravel()
        self._parts["mask"][:] = 1.0

    def rates(self, q: FloatArray, *, mask: FloatArray | None = None) -> FloatArray:
        """Return commanded rates (n,) at a configuration (n,), rad/s and m/s; none moves a joint beyond its limit."""
        parts, free = self._parts, self.mask if mask is None else mask
        # Without redundancy there is no null space, and a damped law with the pull would miss its target.
        pull = self._centring_gains * (self._middle - q) if free.sum() > self._rows else 0.0
        parts["q"][:], parts["mask"][:], parts["pull"][:] = q, free, pull
        outputs = self._run(self._inputs)
        rates, (position_error, orientation_error) = outputs[:-2].copy(), outputs[-2:]
        if mask is None:
            self.position_error, self.orientation_error = float(position_error), float(orientation_error)
        passing = ((q <= self._lower) & (rates < 0)) | ((q >= self._upper) & (rates > 0))
        if passing.any():
            rates = self.rates(q, mask=np.where(passing, 0.0, free))
        return rates

    def target_errors(self, q: FloatArray) -> tuple[float, float]:
        """Return the position error in m and the orientation error in rad at a configuration (n,)."""
        self._parts["q"][:] = q
        *_, position_error, orientation_error = self._run(self._inputs)
        return float(position_error), float(orientation_error)

    def is_collision_free(self, q: FloatArray) -> NDArray[np.bool_]:
        """Return whether the arm keeps its clearance, (N,) for configurations (N, n), or a scalar for one configuration."""
        return np.ones(q.shape[:-1], dtype=bool) if self._exact_clearance is None else self._exact_clearance.margin_left(q) >= 0

    def predict_time_to_target(self, q: FloatArray, *, max_speeds: FloatArray) -> FloatArray:
        """Return the times (N,), s, after which the law reaches its target from configurations (N, n); infinite if never.

        Joints are assumed to follow at once, at rates (n,) of at most ``max_speeds``, rad/s and m/s. A time is also infinite if
        the arm violates its clearance in one of the steps, which are at most 50 ms long.
        """
        step = min(PREDICTION_STEP_S, 0.2 / self._gain)
        q, active, durations = q.copy(), np.arange(len(q)), np.full(len(q), np.inf)
        nearest, since = np.full(len(q), np.inf), np.zeros(len(q))
        for time in step * np.arange(round(PREDICTION_HORIZON_S / step)):
            rates, errors = self._rates_and_errors(q[active])
            nearer = errors < nearest[active] - MIN_PROGRESS
            nearest[active[nearer]], since[active[nearer]] = errors[nearer], time
            durations[active[errors < TARGET_TOLERANCE]] = time
            on = (errors >= TARGET_TOLERANCE) & (time - since[active] <= PROGRESS_TIMEOUT_S) & np.isfinite(rates).all(axis=1)
            in_collision = ~self.is_collision_free(q[active])
            durations[active[in_collision]], on[in_collision] = np.inf, False
            active, rates = active[on], rates[on]
            if not active.size:
                break
            slower = np.maximum(1.0, (np.abs(rates) / max_speeds).max(axis=1))
            q[active] = np.clip(q[active] + step * rates / slower[:, None], self._lower, self._upper)
        return durations

    def _rates_and_errors(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return rates (N, n) as :meth:`rates` does, and the sum of position and orientation error (N,), m and rad."""
        free, position, rotation = np.tile(self.mask, (len(q), 1)), self.pose[:3, 3], self.pose[:3, :3]
        while True:
            pull = np.where(free.sum(axis=1, keepdims=True) > self._rows, self._centring_gains * (self._middle - q), 0.0)
            values = self._kernel.rows(q, position, rotation, free, pull)
            rates, errors = values[:, :-2], values[:, -2] + values[:, -1]
            passing = ((q <= self._lower) & (rates < 0)) | ((q >= self._upper) & (rates > 0))
            if not passing.any():
                return rates, errors
            free[passing] = 0.0
