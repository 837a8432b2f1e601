"""Trade-off behind the allowed pre-failure error: velocity error of the healthy arm against the gain after a failure.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, section 2 and conclusion.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws import damping_search, deviation
from holdfast.core.errors import InputError, TaskError
from holdfast.core.progress import report_work
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task

_ALLOWED_ERRORS = tuple(round(0.05 * k, 2) for k in range(19))
QUANTILE_LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)


@dataclass(frozen=True, eq=False, kw_only=True)
class TradeOff(Result):
    """Peak velocity errors of N samples for E allowed pre-failure errors e.

    Attributes:
        arm: The arm.
        task: The task.
        allowed: (E,) allowed pre-failure errors, as fractions of the commanded speed.
        gain: (N, E) PKE with the best damping within e, divided by PKE of the pseudoinverse; below 1 the failed arm benefits.
        healthy_error: (N, E) velocity error of the healthy arm with that damping, a fraction of the commanded speed.
        peak_error: (N, E) PKE with that damping.
        seed: Seed of the samples.
    """

    arm: Arm
    task: Task
    allowed: FloatArray
    gain: FloatArray
    healthy_error: FloatArray
    peak_error: FloatArray
    seed: int = field(kw_only=True)

    def quantiles(self, of: str = "gain", levels: Sequence[float] = QUANTILE_LEVELS) -> FloatArray:
        """Return (L, E) quantiles over the samples.

        Args:
            of: Name of the attribute: ``gain``, ``healthy_error``, or ``peak_error``.
            levels: (L,) levels of the quantiles, from 0 to 1.
        """
        return np.asarray(np.quantile(getattr(self, of), levels, axis=0))

    def median_interval(self, of: str = "gain", confidence: float = 0.95) -> FloatArray:
        """Return (2, E) distribution-free confidence limits of the medians over the samples, from order statistics.

        Args:
            of: Name of the attribute: ``gain``, ``healthy_error``, or ``peak_error``.
            confidence: Confidence level between 0 and 1.
        """
        from scipy import stats

        values = np.sort(getattr(self, of), axis=0)
        lower_rank = int(stats.binom.ppf((1 - confidence) / 2, len(values), 0.5))
        return values[[max(lower_rank - 1, 0), min(len(values) - lower_rank, len(values) - 1)]]


@check_arguments
def trade_off(
    arm: Arm,
    task: str | Task | Sequence[str] = "pose",
    samples: int = 2000,
    *,
    allowed: ArrayLike = _ALLOWED_ERRORS,
    seed: int = 0,
) -> TradeOff:
    """Compute the post-failure gain as a function of the allowed pre-failure error, on random samples.

    Configurations are uniform within the limits (one turn and 1 m to either side if a joint has none). Directions are uniform
    on the sphere of the task's rows, with linear rows divided by the characteristic length.

    Args:
        arm: The arm.
        task: Rows of the end effector's velocity that are prescribed.
        samples: Number of configurations and directions, 10 or more.
        allowed: (E,) allowed pre-failure errors, from 0 to below 1, in increasing order.
        seed: Seed of the samples.

    Raises:
        TaskError: The task has more rows than the arm has joints.
        InputError: The allowed errors are out of range, or there are fewer than 10 samples.

    Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (9).
    """
    allowed_errors = np.atleast_1d(np.asarray(allowed, dtype=np.float64))
    if (
        allowed_errors.ndim != 1
        or not ((allowed_errors >= 0) & (allowed_errors < 1)).all()
        or (np.diff(allowed_errors) <= 0).any()
    ):
        raise InputError("allowed pre-failure errors must be numbers from 0 to below 1 in increasing order")
    if samples < 10:
        raise InputError(f"samples is {samples}; give 10 or more")
    chosen = as_task(arm, task)
    if chosen.m > arm.n:
        raise TaskError(
            f"task '{chosen.name}' prescribes {chosen.m} rows, but '{arm.name}' has {arm.n} joints; prescribe fewer"
        )
    generator = np.random.default_rng(seed)
    default_ranges = np.where(arm.prismatic, 1.0, np.pi)
    lower = np.where(np.isfinite(arm.lower), arm.lower, -default_ranges)
    upper = np.where(np.isfinite(arm.upper), arm.upper, default_ranges)
    q = generator.uniform(lower, upper, (samples, arm.n))
    directions = generator.normal(size=(samples, chosen.m))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    peak_errors, healthy_errors = np.empty((samples, len(allowed_errors))), np.empty((samples, len(allowed_errors)))
    with report_work("computing the trade-off") as report_progress:
        kernel = _peak_healthy_error_kernel(arm, chosen)
        for index, allowed_error in enumerate(allowed_errors):
            outputs = kernel.rows(q, directions, np.full(samples, max(allowed_error, 1e-9)))
            peak_errors[:, index], healthy_errors[:, index] = outputs[:, 0], outputs[:, 1]
            report_progress(index + 1, len(allowed_errors) + 1)
        undamped_errors = kernel.rows(q, directions, np.full(samples, 1e-9))[:, 0]
    return TradeOff(
        arm=arm,
        task=chosen,
        allowed=allowed_errors,
        gain=peak_errors / undamped_errors[:, None],
        healthy_error=healthy_errors,
        peak_error=peak_errors,
        seed=seed,
    )


@cached_kernel
def _peak_healthy_error_kernel(arm: Arm, task: Task) -> Kernel:
    """Return the kernel of the peak and healthy error of a configuration, a scaled direction, and the allowed error."""
    q, u, e = kinematics.joint_symbols(arm), ca.SX.sym("u", task.m), ca.SX.sym("allowed")
    j = task.jacobian(arm, q)
    choice = damping_search.search_damping(j, u, e)
    deviations = deviation.deviation_expression(j, u, ca.vertcat(*choice.rates))
    peak_error = deviations[0]
    for joint in range(1, arm.n):
        peak_error = ca.if_else(deviations[joint] > peak_error, deviations[joint], peak_error)
    return Kernel("trade-off", [q, u, e], [peak_error, deviations[3 * arm.n]])
