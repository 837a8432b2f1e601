"""What a healthy arm's velocity error buys after a failure: the trade-off behind the allowed pre-failure error.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, section 2 and conclusion.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.control import damping_search, deviation
from holdfast.errors import InputError, TaskError
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.notice import working
from holdfast.result import Result

Array = NDArray[np.float64]

_ALLOWED = tuple(round(0.05 * k, 2) for k in range(19))
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


@dataclass(frozen=True, eq=False, kw_only=True)
class TradeOff(Result):
    """Peak velocity errors against the allowed pre-failure error e, E values of it and N samples.

    Attributes:
        arm, task: Of what.
        allowed: (E,) pre-failure errors.
        gain: (N, E) PKE with the best damping within e, by PKE of the pseudoinverse: below 1 the failed arm gains.
        healthy_error: (N, E) velocity error of the healthy arm that it costs.
        peak_error: (N, E) PKE itself.
        seed: Of the samples.
    """

    arm: Arm
    task: Task
    allowed: Array
    gain: Array
    healthy_error: Array
    peak_error: Array
    seed: int = field(kw_only=True)

    def quantiles(self, of: str = "gain", levels: Sequence[float] = QUANTILES) -> Array:
        """(L, E) quantiles over the samples of ``gain``, ``healthy_error`` or ``peak_error``."""
        return np.asarray(np.quantile(getattr(self, of), levels, axis=0))

    def median_interval(self, of: str = "gain", confidence: float = 0.95) -> Array:
        """(2, E) confidence interval of the medians over the samples, from order statistics: no distribution is assumed."""
        from scipy import stats

        values = np.sort(getattr(self, of), axis=0)
        low = int(stats.binom.ppf((1 - confidence) / 2, len(values), 0.5))
        return values[[max(low - 1, 0), min(len(values) - low, len(values) - 1)]]

    def describe(self) -> list[str]:
        """A few sentences for people."""
        middle, paid = np.median(self.gain, axis=0), np.median(self.healthy_error, axis=0)
        low, high = self.median_interval()
        lines = [f"{self.arm.title}, task {self.task.describe()}, {len(self.gain)} configurations and directions"]
        for k, e in enumerate(self.allowed):
            lines.append(
                f"pre-failure error up to {e:.2f}: median peak error after a failure {middle[k]:.3f} of the pseudoinverse's "
                f"(95% interval {low[k]:.3f} to {high[k]:.3f}), median error of the healthy arm {paid[k]:.3f}"
            )
        return lines


@checked
def trade_off(
    arm: Arm,
    task: str | Task | Sequence[str] = "pose",
    samples: int = 2000,
    *,
    allowed: ArrayLike = _ALLOWED,
    seed: int = 0,
) -> TradeOff:
    """Post-failure gain against pre-failure error, for random configurations and directions.

    Configurations are uniform within the limits (one turn and 1 m to either side where there are none), directions uniform
    on the sphere of the task's rows, linear ones divided by the characteristic length.

    Args:
        arm: The arm.
        task: Rows of the end effector's velocity that are prescribed.
        samples: Number of configurations and directions.
        allowed: (E,) pre-failure errors, from 0 to below 1, in increasing order.
        seed: Of the samples.

    Raises:
        TaskError: The task has more rows than the arm has joints.
        InputError: Allowed errors out of range, or fewer than 10 samples.

    Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (8), (9).
    """
    e = np.atleast_1d(np.asarray(allowed, dtype=np.float64))
    if e.ndim != 1 or not ((e >= 0) & (e < 1)).all() or (np.diff(e) <= 0).any():
        raise InputError("allowed pre-failure errors must be numbers from 0 to below 1 in increasing order")
    if samples < 10:
        raise InputError(f"samples is {samples}; give 10 or more")
    chosen = as_task(arm, task)
    if chosen.m > arm.n:
        raise TaskError(
            f"task '{chosen.name}' prescribes {chosen.m} rows, but '{arm.name}' has {arm.n} joints; prescribe fewer"
        )
    rng = np.random.default_rng(seed)
    free = np.where(arm.prismatic, 1.0, np.pi)
    low, high = np.where(np.isfinite(arm.lower), arm.lower, -free), np.where(np.isfinite(arm.upper), arm.upper, free)
    q = rng.uniform(low, high, (samples, arm.n))
    u = rng.normal(size=(samples, chosen.m))
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    peak, healthy = np.empty((samples, len(e))), np.empty((samples, len(e)))
    with working("computing the trade-off") as advance:
        kernel = _kernel(arm, chosen)
        for k, x in enumerate(e):
            out = kernel.rows(q, u, np.full(samples, max(x, 1e-9)))
            peak[:, k], healthy[:, k] = out[:, 0], out[:, 1]
            advance(k + 1, len(e) + 1)
        none = kernel.rows(q, u, np.full(samples, 1e-9))[:, 0]
    return TradeOff(
        arm=arm, task=chosen, allowed=e, gain=peak / none[:, None], healthy_error=healthy, peak_error=peak, seed=seed
    )


@recalled
def _kernel(arm: Arm, task: Task) -> Kernel:
    """Peak and healthy error of a configuration, a scaled direction and the allowed error."""
    q, u, e = kinematics.joint_symbols(arm), ca.SX.sym("u", task.m), ca.SX.sym("allowed")
    j = task.jacobian(arm, q)
    found = damping_search.search(j, u, e)
    told = deviation.expression(j, u, ca.vertcat(*found.rates))
    peak = told[0]
    for k in range(1, arm.n):
        peak = ca.if_else(told[k] > peak, told[k], peak)
    return Kernel("trade-off", [q, u, e], [peak, told[3 * arm.n]])
