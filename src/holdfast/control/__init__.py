"""How to move: control laws that do not know of a failure, and redundancy resolution that serves an objective before one."""

from holdfast.control.deviation import Deviations
from holdfast.control.failure_tolerant import FailureTolerant, failure_tolerant
from holdfast.control.follow import METHODS, follow
from holdfast.control.inverses import Damped, Pseudoinverse, Weighted, damped, pseudoinverse, weighted
from holdfast.control.law import Law, by_name
from holdfast.control.redundancy import AugmentedJacobian, ExtendedJacobian, GradientProjection
from holdfast.control.resolution import Rates, Resolution
from holdfast.control.slow_motion import SlowMotion, slow_enough
from holdfast.control.step import Step
from holdfast.control.trade_off import TradeOff, trade_off
from holdfast.control.trajectory import Event, Trajectory
from holdfast.control.transpose import JacobianTranspose, jacobian_transpose

__all__ = [
    "METHODS",
    "AugmentedJacobian",
    "Damped",
    "Deviations",
    "Event",
    "ExtendedJacobian",
    "FailureTolerant",
    "GradientProjection",
    "JacobianTranspose",
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
    "jacobian_transpose",
    "pseudoinverse",
    "slow_enough",
    "trade_off",
    "weighted",
]
