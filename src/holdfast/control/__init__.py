"""How to move: control laws that do not know of a failure, and redundancy resolution that serves an objective before one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from holdfast.on_demand import offer

if TYPE_CHECKING:
    from holdfast.control.deviation import Deviations
    from holdfast.control.failure_tolerant import FailureTolerant
    from holdfast.control.follow import METHODS, follow
    from holdfast.control.inverses import Damped, Pseudoinverse, Weighted
    from holdfast.control.law import Law
    from holdfast.control.laws import BY_NAME, by_name, damped, failure_tolerant, pseudoinverse, weighted
    from holdfast.control.redundancy import AugmentedJacobian, ExtendedJacobian, GradientProjection
    from holdfast.control.resolution import Rates, Resolution
    from holdfast.control.slow_motion import SlowMotion, slow_enough
    from holdfast.control.step import Step
    from holdfast.control.trade_off import TradeOff, trade_off
    from holdfast.control.trajectory import Event, Trajectory

__all__ = [
    "BY_NAME",
    "METHODS",
    "AugmentedJacobian",
    "Damped",
    "Deviations",
    "Event",
    "ExtendedJacobian",
    "FailureTolerant",
    "GradientProjection",
    "Law",
    "Pseudoinverse",
    "Rates",
    "Resolution",
    "SlowMotion",
    "Step",
    "TradeOff",
    "Trajectory",
    "Weighted",
    "by_name",
    "damped",
    "failure_tolerant",
    "follow",
    "pseudoinverse",
    "slow_enough",
    "trade_off",
    "weighted",
]

offer(
    __name__,
    {
        "deviation": "Deviations",
        "failure_tolerant": "FailureTolerant",
        "follow": "METHODS follow",
        "inverses": "Damped Pseudoinverse Weighted",
        "law": "Law",
        "laws": "BY_NAME by_name damped failure_tolerant pseudoinverse weighted",
        "redundancy": "AugmentedJacobian ExtendedJacobian GradientProjection",
        "resolution": "Rates Resolution",
        "slow_motion": "SlowMotion slow_enough",
        "step": "Step",
        "trade_off": "TradeOff trade_off",
        "trajectory": "Event Trajectory",
    },
)
