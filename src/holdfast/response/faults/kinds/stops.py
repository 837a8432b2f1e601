"""Fault that reduces the range of a joint."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Unpack

from holdfast.response.faults.entry import Fault, FaultTiming, Joints, Value
from holdfast.response.faults.kind import FaultKind, FaultParameter, Numbers, register_kind

if TYPE_CHECKING:
    from holdfast.kernels.program import SX
    from holdfast.response.faults.model_joint import ActiveFault
    from holdfast.response.faults.step_symbols import StepSymbols


class ReducedRangeKind(FaultKind):
    """A joint with a stop inside its range."""

    code = 4
    parameters = (
        (FaultParameter("travel", 0.0, has_random_sign=True, absent=math.inf),),
        (FaultParameter("lower", absent=-math.inf), FaultParameter("upper", absent=math.inf)),
    )

    def remaining_range(self, limits: tuple[float, float], position: float, numbers: Numbers) -> tuple[float, float]:
        lower, upper = limits
        if "travel" in numbers:
            travel = float(numbers["travel"])
            lower, upper = (lower, position + travel) if travel > 0 else (position + travel, upper)
        # A stop beyond the joint would throw it back, so the stop is then at the position of the joint.
        lower = max(lower, min(float(numbers.get("lower", lower)), position))
        upper = min(upper, max(float(numbers.get("upper", upper)), position))
        return lower, upper

    def apply(self, fault: ActiveFault) -> None:
        fault.joint.limit_range(*self.remaining_range(fault.joint.model_limits, fault.position, fault.numbers))

    def change_motion(self, step: StepSymbols, active: SX) -> None:
        travel, q = step.first, step.q_onset
        lower = step.select(travel < 0, q + travel, step.minimum(step.second, q))
        upper = step.select(step.all_true(travel > 0, step.is_given(travel)), q + travel, step.maximum(step.third, q))
        step.lower = step.select(active, step.maximum(lower, step.lower), step.lower)
        step.upper = step.select(active, step.minimum(upper, step.upper), step.upper)


@register_kind(ReducedRangeKind())
def reduced_range(
    joints: Joints = None,
    *,
    travel: Value | None = None,
    lower: Value | None = None,
    upper: Value | None = None,
    **when: Unpack[FaultTiming],
) -> Fault:
    """Return a fault with a stop inside the range of a joint; give ``travel``, or ``lower``, ``upper`` or both.

    Args:
        joints: Name or names of the joints that can have the fault. None: any joint.
        travel: Distance of the stop from the position at the onset, rad or m; its side is random.
        lower: Position of a lower stop, rad or m.
        upper: Position of an upper stop, rad or m.
        **when: Times and probabilities, see :class:`holdfast.response.faults.Fault`.
    """
    return Fault("reduced_range", {"travel": travel, "lower": lower, "upper": upper}, joints, **when)
