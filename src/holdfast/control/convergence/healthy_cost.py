"""Cost of a control law for the healthy arm: detours, deviations, and delays on the way to a target."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.closed_loop import CYCLE_LIMIT, simulate
from holdfast.control.simulation.runs import Reason
from holdfast.control.simulation.system import prescribed_offset, scale_errors
from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.solvers.inverse_kinematics import task_error_and_jacobian
from holdfast.model.arm import kinematics
from holdfast.model.arm.poses import check_poses

ARRIVAL_TOLERANCE = 1e-3  # rad, and fraction of the arm's own length: with a smaller error the target counts as reached
HORIZON_TIME_CONSTANTS = 40.0  # 1/Ke
MOTION_SAMPLES = 64  # samples of a motion, denser at its start


@dataclass(frozen=True, eq=False)
class HealthyCost:
    """Costs of N motions of the healthy arm under one law.

    Attributes:
        deviation: (N,) largest distance of the tool point from the straight line between start and target, m, in the
            directions that the task prescribes.
        angle: (N,) largest angle between the commanded velocity and the task's velocity, rad, while the error is above 1e-3
            (rad, and fraction of the arm's own length, which is that of its links end to end, rounded to a power of two).
        time: (N,) time until the error is below 1e-3, s; in cycles, time until the run ended. NaN: never.
    """

    deviation: FloatArray
    angle: FloatArray
    time: FloatArray


def measure_healthy_cost(law: Law, q0: FloatArray, target: FloatArray, cycles: bool, radius: float) -> HealthyCost:
    """Simulate N motions of the healthy arm from q0 (N, n) to target (N, 4, 4), sample by sample, and measure their cost.

    The 64 samples cover 40/Ke, the first 0.01/Ke and the last 1.3/Ke apart. The motion between two samples is not evaluated.
    """
    fractions = np.linspace(0, 1, MOTION_SAMPLES + 1) ** 2
    sample_times = np.unique(np.ceil(CYCLE_LIMIT / 4 * fractions)) if cycles else HORIZON_TIME_CONSTANTS / law.gain * fractions
    q, current_times, active = q0, np.zeros(len(q0)), np.arange(len(q0))
    configurations, times = [q0], [current_times]
    for duration in np.diff(sample_times):
        if active.size:
            runs = simulate(law, q[active], target[active], cycles=cycles, time_limit=float(duration), radius=radius)
            q, current_times = q.copy(), current_times.copy()
            # A run that has ended in a singularity stays there, because NaN would invalidate the samples before it.
            q[active] = np.where(np.isfinite(runs.q_final), runs.q_final, q[active])
            current_times[active] += np.nan_to_num(runs.time)
            # So does a run whose steps shrink to zero, because every further sample would use up the limit of steps.
            active = active[~np.isin(runs.reason, (Reason.STEPS, Reason.HALF_TURN))]
        configurations.append(q)
        times.append(current_times)
    evaluate_errors = _ErrorEvaluator(law)
    errors, scaled_errors, offsets, angle = evaluate_errors(np.array(configurations), check_poses(target))
    time, is_far = np.array(times), scaled_errors > ARRIVAL_TOLERANCE
    return HealthyCost(
        deviation=_line_deviation(offsets),
        angle=np.where(is_far & np.isfinite(angle), angle, 0.0).max(axis=0),
        time=_arrival_times(errors, time, radius) if cycles else _arrival_times(scaled_errors, time, ARRIVAL_TOLERANCE),
    )


class _ErrorEvaluator:
    """Evaluator of errors at targets, and of angles between prescribed and commanded velocities."""

    def __init__(self, law: Law) -> None:
        self._law = law

    @cached_property
    @cached_kernel
    def _error_kernel(self) -> Kernel:
        arm = self._law.arm
        q, position, rotation = kinematics.joint_symbols(arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        return Kernel(
            "error of the task",
            [q, position, rotation],
            [task_error_and_jacobian(arm, self._law.task, q, position, rotation)[0]],
        )

    def __call__(self, q: FloatArray, poses: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return errors (K, N), errors in the arm's own unit, remaining offsets (K, N, 3), and angles (K, N)."""
        samples, motion_count, n = q.shape
        configurations, targets = q.reshape(-1, n), np.tile(poses, (samples, 1, 1))
        error = self._error_kernel.rows(configurations, targets[:, :3, 3], targets[:, :3, :3]).reshape(len(configurations), -1)
        tool = self._law.arm.forward_kinematics(configurations)
        offsets = prescribed_offset(self._law, tool, targets)
        angle = self._law.healthy_angle(configurations, error)
        error_norms = np.linalg.norm(error, axis=1)
        scaled_errors = scale_errors(self._law, error_norms, tool, targets)
        shape = samples, motion_count
        return error_norms.reshape(shape), scaled_errors.reshape(shape), offsets.reshape(*shape, 3), angle.reshape(shape)


def _line_deviation(offsets: FloatArray) -> FloatArray:
    """Return the largest distance (N,) from the line between first point and target, for remaining offsets (K, N, 3)."""
    first_offset = offsets[0]
    squared_length = np.maximum((first_offset**2).sum(axis=1), 1e-30)
    fraction = np.clip((offsets * first_offset).sum(axis=2) / squared_length, 0.0, 1.0)
    return np.asarray(np.linalg.norm(offsets - fraction[:, :, None] * first_offset, axis=2).max(axis=0))


def _arrival_times(errors: FloatArray, time: FloatArray, tolerance: float) -> FloatArray:
    """Return the times (N,) after which errors (K, N) stay below ``tolerance``, interpolated exponentially."""
    inside = errors <= tolerance
    # First sample from which all samples are inside.
    first_inside = np.where(inside.all(axis=0), 0, len(errors) - np.argmax(~inside[::-1], axis=0))
    arrivals = np.full(errors.shape[1], np.nan)
    for motion in np.flatnonzero(first_inside < len(errors)):
        sample = first_inside[motion]
        if sample == 0:
            arrivals[motion] = 0.0
            continue
        log_before, log_after = np.log(np.maximum(errors[sample - 1 : sample + 1, motion], 1e-300))
        fraction = (log_before - np.log(tolerance)) / (log_before - log_after) if log_before > log_after else 1.0
        arrivals[motion] = time[sample - 1, motion] + fraction * (time[sample, motion] - time[sample - 1, motion])
    return arrivals
